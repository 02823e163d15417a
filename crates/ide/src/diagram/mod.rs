//! Drawing in a chart: what is done to its picture, as a change of its text.
//!
//! In: the text of a chart, the name of one of its drawings, an [`Operation`]. Out: the edit that does it, and what is then selected.
//! The text is the chart, so undoing an edit of the text undoes what was drawn. INVARIANT: comments and layout of what is not touched
//! stay, byte by byte; an edit that would make text unreadable is refused. Nothing here knows how a chart looks.

mod arrow;
mod clear;
mod composite;
mod copy;
mod declare;
mod ends;
mod name;
mod nest;
mod place;
mod system;
mod text;
mod value;

use std::collections::BTreeMap;

use syntax::ast::{AstNode, ChartFile, MachineChart, PhaseKind, SystemChart};
use syntax::{FileId, Parse, Severity, SyntaxNode, parse_chart};

use crate::position::{Edit, difference};

pub use arrow::Joint;
pub use system::Property;

/// A centre in pixels, to the right and down.
pub type Centre = (f64, f64);

/// What is done to a drawing; shapes have the names of the text.
#[derive(Debug, Clone, PartialEq)]
pub enum Operation {
    /// Shapes are moved to these centres.
    Move(BTreeMap<String, Centre>),
    /// A new shape.
    Add(Fresh),
    /// A new arrow. An exit that can have only one arrow gets this one.
    Connect(Joint),
    /// An arrow goes.
    Disconnect(Joint),
    /// An arrow gets other ends.
    Redirect(Joint, Joint),
    /// Shapes go, and all that hangs on them.
    Delete(Vec<String>),
    /// A shape gets another name, wherever the chart names it.
    Rename(String, String),
    /// What a shape shows; without a text, its name in words.
    Text(String, Option<String>),
    /// The part of the specification that a shape stands for.
    Link(String, Option<String>),
    /// Whether a shape is to be refined, and by what.
    Refine(String, Option<Option<String>>),
    /// The machine starts in this control state.
    Initial(String),
    /// Shapes go into a composite state, or out of all; those that are moved with it to these centres.
    Nest(Vec<String>, Option<String>, BTreeMap<String, Centre>),
    /// A new machine at the end of the chart.
    Machine {
        /// The name that is wanted.
        name: String,
        /// It is a pattern.
        is_pattern: bool,
        /// What the picture shows.
        title: String,
    },
    /// Shapes, composite states with all that they hold, and the arrows between them, from here or from another chart. Arrows name shapes
    /// by what they were called: [`Fresh::name`], or the name in a source.
    Paste(Vec<Fresh>, Vec<Copied>, Vec<Joint>),
    /// Whether a composite state is entered where it was left, and which location remembers.
    History(String, Option<Option<String>>),
    /// A composite state gets an action that is done whenever it is entered, or left; with what it shows.
    AddDoing(String, Moment, Option<String>),
    /// A property of a part of a system, or of the system itself; without a text it goes, if it may.
    Set(String, Property, Option<String>),
    /// A component gets a phase: a reading at the beginning of its cycle, another one at the end.
    AddPhase(String, PhaseKind, String),
    /// The phase of this number of a component goes.
    RemovePhase(String, usize),
    /// The phase of this number of a component gets this place in the cycle.
    MovePhase(String, usize, usize),
    /// A bound on the age of data.
    AddAge {
        /// The component or sensor that they come from.
        from: String,
        /// The component or actuator that gets what rests on them.
        to: String,
        /// The greatest age.
        limit: String,
    },
}

/// The kinds of shapes that can be drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FreshKind {
    /// A control state.
    State,
    /// A composite state, with a state in it.
    Composite,
    /// A guard.
    Guard,
    /// An action.
    Action,
    /// A block: an instance of a pattern.
    Instance,
    /// A component of a system.
    Component,
    /// A sensor of a system.
    Sensor,
    /// An actuator of a system.
    Actuator,
}

/// A shape that is not there yet.
#[derive(Debug, Clone, PartialEq)]
pub struct Fresh {
    /// What it is.
    pub kind: FreshKind,
    /// The name that is wanted; made of the text else.
    pub name: Option<String>,
    /// What it shows.
    pub text: Option<String>,
    /// Its link.
    pub link: Option<String>,
    /// The pattern of an instance, with arguments in parentheses if it has any.
    pub of: Option<String>,
    /// Where its centre is.
    pub at: Centre,
}

/// When an action of a composite state is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Moment {
    /// Whenever it is entered.
    Entry,
    /// Whenever it is left.
    Exit,
}

/// A composite state that is pasted.
#[derive(Debug, Clone, PartialEq)]
pub struct Copied {
    /// Its declaration, as it is written.
    pub source: String,
    /// Where the shapes in it are to lie.
    pub places: BTreeMap<String, Centre>,
}

/// What became of the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Drawn {
    /// The change; none if nothing changes.
    pub edit: Option<Edit>,
    /// The names of shapes that are to be selected.
    pub select: Vec<String>,
}

/// The change of a chart's text that an operation on one of its drawings makes. Shapes of that drawing that have no place get those of
/// `places`, so that nothing moves that was not moved.
///
/// # Errors
/// It cannot be done; a sentence for the user.
pub fn drawn(
    text: &str,
    drawing: &str,
    operation: &Operation,
    places: &BTreeMap<String, Centre>,
) -> Result<Drawn, String> {
    let mut work = Work { text: text.to_string(), drawing: drawing.to_string(), select: Vec::new() };
    let before = work.faults();
    work.keep_places(places)?;
    work.perform(operation)?;
    if work.faults() > before {
        let parse = work.parse();
        let fault = parse.diagnostics.iter().rfind(|fault| fault.severity == Severity::Error);
        return Err(fault.map_or_else(|| "the text would not be readable".to_string(), |fault| fault.message.clone()));
    }
    Ok(Drawn { edit: difference(text, &work.text), select: work.select })
}

/// A text that is being changed, change by change.
struct Work {
    text: String,
    drawing: String,
    select: Vec<String>,
}

/// A drawing's part of the text.
enum Section {
    Machine(MachineChart),
    System(SystemChart),
}

impl Section {
    fn syntax(&self) -> &SyntaxNode {
        match self {
            Section::Machine(machine) => machine.syntax(),
            Section::System(system) => system.syntax(),
        }
    }
}

impl Work {
    fn perform(&mut self, operation: &Operation) -> Result<(), String> {
        if !matches!(operation, Operation::Machine { .. }) {
            self.section()?;
        }
        match operation {
            Operation::Move(places) => {
                self.select = places.keys().cloned().collect();
                self.place(places)
            }
            Operation::Add(fresh) => {
                let name = self.add(fresh)?;
                self.select = vec![name];
                Ok(())
            }
            Operation::Connect(joint) => self.connect(joint),
            Operation::Disconnect(joint) => self.disconnect(joint),
            Operation::Redirect(joint, new) => self.redirect(joint, new),
            Operation::Delete(names) => names.iter().try_for_each(|name| self.delete(name)),
            Operation::Rename(name, to) => self.rename(name, to),
            Operation::Text(name, text) => self.set_text(name, text.as_deref()),
            Operation::Link(name, link) => self.set_link(name, link.as_deref()),
            Operation::Refine(name, refinement) => {
                self.set_refinement(name, refinement.as_ref().map(|by| by.as_deref()))
            }
            Operation::Initial(name) => self.set_initial(name),
            Operation::Nest(names, into, places) => {
                self.nest(names, into.as_deref())?;
                self.place(places)
            }
            Operation::Machine { name, is_pattern, title } => self.add_machine(name, *is_pattern, title),
            Operation::Paste(shapes, composites, arrows) => self.paste(shapes, composites, arrows),
            Operation::History(name, history) => self.set_history(name, history.as_ref().map(|link| link.as_deref())),
            Operation::AddDoing(name, moment, text) => self.add_doing(name, *moment, text.as_deref()),
            Operation::Set(name, property, value) => self.set(name, *property, value.as_deref()),
            Operation::AddPhase(name, kind, subject) => self.add_phase_of(name, *kind, subject),
            Operation::RemovePhase(name, at) => self.remove_phase(name, *at),
            Operation::MovePhase(name, at, to) => self.move_phase(name, *at, *to),
            Operation::AddAge { from, to, limit } => self.add_age(from, to, limit),
        }
    }

    fn paste(&mut self, shapes: &[Fresh], composites: &[Copied], arrows: &[Joint]) -> Result<(), String> {
        let mut names = BTreeMap::new();
        for copied in composites {
            let (name, inner) = self.paste_composite(copied)?;
            names.extend(inner);
            self.select.push(name);
        }
        for fresh in shapes {
            let name = self.add(fresh)?;
            names.extend(fresh.name.clone().map(|old| (old, name.clone())));
            self.select.push(name);
        }
        let renamed = |name: &String| names.get(name).cloned();
        for joint in arrows {
            if let (Some(from), Some(to)) = (renamed(&joint.from), renamed(&joint.to)) {
                self.connect(&Joint { from, branch: joint.branch, to })?;
            }
        }
        Ok(())
    }

    fn parse(&self) -> Parse {
        parse_chart(FileId(0), &self.text)
    }

    /// How much of the text cannot be read.
    fn faults(&self) -> usize {
        self.parse().diagnostics.iter().filter(|fault| fault.severity == Severity::Error).count()
    }

    fn file(&self) -> Result<ChartFile, String> {
        ChartFile::cast(self.parse().syntax()).ok_or_else(|| "this is no chart".to_string())
    }

    fn section(&self) -> Result<Section, String> {
        let file = self.file()?;
        let named = |name: Option<syntax::SyntaxToken>| name.is_some_and(|name| name.text() == self.drawing);
        let machine = file.machines().find(|machine| named(machine.name())).map(Section::Machine);
        let section = machine.or_else(|| file.systems().find(|system| named(system.name())).map(Section::System));
        section.ok_or_else(|| format!("the chart has no machine or system `{}`", self.drawing))
    }

    /// Replaces bytes of the text.
    fn replace(&mut self, range: std::ops::Range<usize>, text: &str) {
        self.text.replace_range(range, text);
    }
}

#[cfg(test)]
mod composite_tests;
#[cfg(test)]
mod ends_tests;
#[cfg(test)]
mod nest_tests;
#[cfg(test)]
mod system_tests;
#[cfg(test)]
mod tests;
