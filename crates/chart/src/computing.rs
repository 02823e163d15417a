//! What the components of a system compute by machines of their own: data alone (spec/charts.md, "A component's own machine").
//!
//! Out of `component`, which finds the machines and composes the texts. A [`System`](crate::system::System) has it, so that whatever is
//! made of a system knows it: the ground model, the program. INVARIANT: each monitored function of a machine's own file has a feed, and
//! each out function a take, in the order of their declarations.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use model::{Checked, Model};
use syntax::{FileId, SourceFile, Span};

/// What the components of a system compute.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Computing {
    /// The machines, in the order of the components.
    pub machines: Vec<ComponentMachine>,
    /// What each channel, sensor and actuator carries that says so, by the name that is drawn.
    pub contents: BTreeMap<String, Content>,
    /// Modules that the machines import, as paths relative to the chart.
    pub(crate) imports: Vec<String>,
    /// Declarations of the signature.
    pub(crate) declarations: Vec<Made>,
    /// Definitions: the machines' own, and those that carry the data.
    pub(crate) definitions: Vec<Made>,
    /// Definitions of the initial state.
    pub(crate) initial: Vec<String>,
    /// The elaborations that compute something: the phase, and the rule of its end.
    pub(crate) ends: Vec<(String, String)>,
}

/// A declaration or definition that is made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Made {
    /// The name it declares.
    pub(crate) name: String,
    /// Its text.
    pub(crate) text: String,
    /// What it is made of.
    pub(crate) span: Span,
}

/// The machine of a component.
#[derive(Debug, Clone)]
pub struct ComponentMachine {
    /// The index of the component.
    pub component: usize,
    /// The index of the elaboration among the component's phases.
    pub phase: usize,
    /// Its file.
    pub source: SourceFile,
    /// What its monitored functions are fed by.
    pub feeds: Vec<(String, Feed)>,
    /// What takes its out functions.
    pub takes: Vec<(String, Take)>,
    /// The folder of its file, as the chart's imports write it.
    pub(crate) folder: String,
    /// Its file among the texts of the chart.
    pub(crate) file: FileId,
    /// Its model, checked by itself.
    pub(crate) checked: Arc<Checked>,
    /// Functions of its own that may have any value in each step: only of a part of a system, see `component::cut`.
    pub(crate) freed: BTreeSet<String>,
}

impl PartialEq for ComponentMachine {
    fn eq(&self, other: &ComponentMachine) -> bool {
        let parts = |machine: &ComponentMachine| (machine.component, machine.phase);
        parts(self) == parts(other) && self.source.name == other.source.name && self.source.text == other.source.text
    }
}

impl ComponentMachine {
    /// Its model.
    pub(crate) fn model(&self) -> &Model {
        &self.checked.model
    }
}

/// What feeds a monitored function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feed {
    /// The datum that was read from the channel with this index.
    Channel(usize),
    /// Whether that datum was not there in the elaboration before.
    IsNew(usize),
    /// The sensor with this index.
    Sensor(usize),
}

/// What takes an out function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Take {
    /// The channel with this index.
    Channel(usize),
    /// The actuator with this index.
    Actuator(usize),
}

/// The form of a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Content {
    /// A truth value.
    Boolean,
    /// A whole number.
    Integer,
    /// A number.
    Real,
    /// A literal of an enum.
    Enum {
        /// The domain's name.
        name: String,
        /// Its literals.
        literals: Vec<String>,
    },
    /// A tuple of two to five values.
    Tuple(Vec<Content>),
    /// Any other domain, as a model writes it.
    Other(String),
}

impl Content {
    /// The enums in it, with their literals.
    pub fn enums(&self) -> Vec<(&str, &[String])> {
        match self {
            Content::Enum { name, literals } => vec![(name, literals)],
            Content::Tuple(parts) => parts.iter().flat_map(Content::enums).collect(),
            Content::Boolean | Content::Integer | Content::Real | Content::Other(_) => Vec::new(),
        }
    }
}
