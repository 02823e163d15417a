//! The meaning of a chart: machines with their shapes and arrows, names resolved; separately, where shapes lie.
//!
//! INVARIANT: in a chart without errors, every [`ShapeId`] is an index into its machine's shapes; an arrow has a branch
//! if and only if it leaves a guard, or the block of a pattern that answers; every path from a control state leads over guards and actions to a control state,
//! a pattern instance or an exit, and never in a circle without one of these.

use std::collections::BTreeMap;
use std::sync::Arc;

use syntax::Span;

use crate::link::Link;
use crate::system::System;

/// A chart file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// The name, that of the file.
    pub name: String,
    /// The modules whose names the links use, including those of imported charts, as paths relative to the file.
    pub imports: Vec<String>,
    /// The place of each import; for one that comes with a chart, the place of that chart's import.
    pub places: Vec<Span>,
    /// The charts whose patterns can be used, as paths relative to the file.
    pub charts: Vec<String>,
    /// The patterns of these charts.
    pub patterns: Vec<Machine>,
    /// The names of patterns that stand in charts which these import: they are not known here.
    pub beyond: Vec<String>,
    /// Machines and patterns in the order of the file.
    pub machines: Vec<Machine>,
    /// The system, if any.
    pub system: Option<System>,
    /// Where shapes lie, by the name of the machine; it has no meaning except to the eye.
    pub layouts: BTreeMap<String, Layout>,
}

impl Chart {
    /// The machine or pattern of that name, including imported patterns.
    pub fn machine(&self, name: &str) -> Option<&Machine> {
        self.machines.iter().chain(&self.patterns).find(|machine| machine.name == name)
    }

    /// The patterns that an instance may name.
    pub fn all_patterns(&self) -> impl Iterator<Item = &Machine> {
        self.machines.iter().filter(|machine| machine.is_pattern).chain(&self.patterns)
    }

    /// The pattern of an instance.
    pub fn pattern_of(&self, shape: &Shape) -> Option<&Machine> {
        match &shape.kind {
            ShapeKind::Instance(pattern) => self.machine(&pattern.name),
            _ => None,
        }
    }
}

/// Centres of shapes in pixels, to the right and down.
pub type Layout = BTreeMap<String, (f64, f64)>;

/// A control-state machine, or a pattern of one.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// The name.
    pub name: String,
    /// Whether it is a pattern: entered when its control variable is undef, and left by setting it to undef.
    pub is_pattern: bool,
    /// The parameters of the rule.
    pub parameters: Vec<Parameter>,
    /// The text shown.
    pub text: String,
    /// The corresponding rule of the specification; if `None`, a rule is made.
    pub rule: Option<Link>,
    /// The control variable; a pattern of actions only has none.
    pub control: Option<Control>,
    /// States, guards, actions and instances in the order of the file.
    pub shapes: Vec<Shape>,
    /// Arrows in the order of the file.
    pub arrows: Vec<Arrow>,
    /// Actions and instances to execute in sequence if one path contains them.
    pub sequences: Vec<Vec<ShapeId>>,
    /// Actions of a pattern that are done if it is left from outside, by a path from a composite state around an instance.
    pub aborts: Vec<ShapeId>,
    /// Whether it has a control state, or a block that takes steps, so that entering and leaving it takes several
    /// steps.
    pub steps: bool,
    /// The same machine without composite states and without answers, if it has any of these. Its first shapes are those of this one.
    pub flattened: Option<Arc<Machine>>,
    /// Where it is declared: its name.
    pub span: Span,
}

impl Machine {
    /// The shape with this number.
    pub fn shape(&self, id: ShapeId) -> &Shape {
        &self.shapes[id.0]
    }

    /// All shapes with their numbers.
    pub fn numbered(&self) -> impl Iterator<Item = (ShapeId, &Shape)> {
        self.shapes.iter().enumerate().map(|(index, shape)| (ShapeId(index), shape))
    }

    /// The arrows that leave this end.
    pub fn out_of(&self, end: End) -> impl Iterator<Item = &Arrow> {
        self.arrows.iter().filter(move |arrow| arrow.from == end)
    }

    /// The arrow from this exit of a guard.
    pub fn branch(&self, guard: ShapeId, branch: bool) -> Option<&Arrow> {
        self.out_of(End::Shape(guard)).find(|arrow| arrow.branch == Some(branch))
    }

    /// The control state in which the machine starts.
    pub fn initial(&self) -> Option<ShapeId> {
        self.first_in(None)
    }

    /// The control state in which a composite state begins; without one, the machine.
    pub fn first_in(&self, composite: Option<ShapeId>) -> Option<ShapeId> {
        let mut around = composite;
        // As deep as states are nested.
        for _ in 0..=self.shapes.len() {
            let is_first = |(_, shape): &(ShapeId, &Shape)| shape.inside == around && shape.is_initial();
            let (id, shape) = self.numbered().find(is_first)?;
            match shape.kind {
                ShapeKind::Composite(_) => around = Some(id),
                _ => return Some(id),
            }
        }
        None
    }

    /// The composite states around a shape, from the inside out.
    pub fn around(&self, id: ShapeId) -> Vec<ShapeId> {
        std::iter::successors(self.shape(id).inside, |outer| self.shape(*outer).inside).collect()
    }

    /// What the machine means: itself, or the same without composite states and without answers.
    pub fn flat(&self) -> &Machine {
        self.flattened.as_deref().unwrap_or(self)
    }

    /// Whether an action is told in the frame of a composite state: it is done when that is entered or left.
    pub fn is_told_in_frame(&self, id: ShapeId) -> bool {
        self.is_apart(id) && !self.aborts.contains(&id)
    }

    /// Whether an action stands on no path: it is done when a composite state is entered or left, or a pattern is aborted.
    pub fn is_apart(&self, id: ShapeId) -> bool {
        let has = |composite: &Composite| composite.entry.contains(&id) || composite.exit.contains(&id);
        let composites = self.shapes.iter().filter_map(Shape::composite);
        self.aborts.contains(&id) || composites.into_iter().any(has)
    }

    /// Whether it is left with an answer, yes or no: a block of it has two exits, like a guard.
    pub fn answers(&self) -> bool {
        self.arrows.iter().any(|arrow| arrow.answer.is_some())
    }

    /// Whether entering and leaving it takes several steps, since it has a control state or a block that takes steps.
    pub fn takes_steps(&self) -> bool {
        self.steps
    }
}

/// The number of a shape in its machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ShapeId(pub usize);

/// A parameter of a machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// The variable, with its `$`.
    pub variable: String,
    /// Its domain, as it is written.
    pub domain: String,
}

/// The control variable of a machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Control {
    /// A location of the specification.
    Linked(Link),
    /// A function to be created, with the machine's parameters as arguments.
    Made {
        /// The function's name.
        name: String,
        /// The place of its name.
        span: Span,
    },
}

/// A shape of a machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shape {
    /// The name that paths use.
    pub name: String,
    /// The text shown in the shape.
    pub text: String,
    /// The kind of shape.
    pub kind: ShapeKind,
    /// The corresponding part of the specification.
    pub link: Option<Link>,
    /// Set if what the shape stands for is still to be refined; such a shape is drawn dashed.
    pub refinement: Option<Refinement>,
    /// The composite state that it stands in.
    pub inside: Option<ShapeId>,
    /// Where it is declared: its name.
    pub span: Span,
}

impl Shape {
    /// Whether the machine, or the composite state around it, begins in it.
    pub fn is_initial(&self) -> bool {
        match &self.kind {
            ShapeKind::State { initial } => *initial,
            ShapeKind::Composite(composite) => composite.initial,
            ShapeKind::Guard | ShapeKind::Action | ShapeKind::Instance(_) => false,
        }
    }

    /// What it says if it is a composite state.
    pub fn composite(&self) -> Option<&Composite> {
        match &self.kind {
            ShapeKind::Composite(composite) => Some(composite),
            _ => None,
        }
    }
}

/// The kinds of shapes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ShapeKind {
    /// A control state: a circle.
    State {
        /// The machine starts in it.
        initial: bool,
    },
    /// A state that holds others: the machine is in it while it is in one of these. A rounded rectangle around them.
    Composite(Composite),
    /// A test predicate: a hexagon with the exits yes and no.
    Guard,
    /// A rule: a rectangle.
    Action,
    /// A block that stands for a pattern machine, called an instance.
    Instance(Pattern),
}

/// A state that holds others.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Composite {
    /// The machine, or the composite state around it, begins in it.
    pub initial: bool,
    /// It is entered where it was left.
    pub history: Option<History>,
    /// Actions that are done whenever it is entered.
    pub entry: Vec<ShapeId>,
    /// Actions that are done whenever it is left.
    pub exit: Vec<ShapeId>,
}

/// Where a composite state remembers in which of its states it was left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum History {
    /// In a location of the specification.
    Linked(Link),
    /// In a function to be created, with the machine's parameters as arguments.
    Made,
}

/// The pattern of an instance.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    /// The pattern's name.
    pub name: String,
    /// The arguments, as they are written.
    pub arguments: Vec<String>,
}

/// What refines a shape.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refinement {
    /// The chart that refines it, if known yet.
    pub by: Option<String>,
}

/// Where an arrow starts or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum End {
    /// The entering arrow of a pattern: its control variable is undef.
    Enter,
    /// A shape.
    Shape(ShapeId),
    /// The floating exit arrow of a pattern: its control variable becomes undef.
    Exit,
}

/// An arrow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Arrow {
    /// Where it starts.
    pub from: End,
    /// The exit of the guard that it leaves, or of the block of a pattern that answers.
    pub branch: Option<bool>,
    /// Where it ends.
    pub to: End,
    /// The answer with which it leaves a pattern that answers.
    pub answer: Option<bool>,
    /// The place of its end in a path.
    pub span: Span,
}

/// Words that begin items of a chart or stand in paths; shapes must not have these names.
pub const WORDS: [&str; 25] = [
    "control",
    "initial",
    "composite",
    "state",
    "endstate",
    "history",
    "entry",
    "abort",
    "guard",
    "action",
    "instance",
    "sequence",
    "enter",
    "exit",
    "yes",
    "no",
    "machine",
    "pattern",
    "system",
    "layout",
    "endmachine",
    "endpattern",
    "endsystem",
    "endcomponent",
    "endlayout",
];
