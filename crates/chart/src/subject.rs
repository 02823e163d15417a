//! What a picture of a chart shows: one machine, or the system. And how a page asks for such a picture without waiting for
//! the crate that draws it.

use crate::chart::{Chart, Machine};
use crate::system::System;

/// A machine or the system of a chart.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'c> {
    /// The chart it is of.
    pub chart: &'c Chart,
    /// Which of both.
    pub part: Part<'c>,
}

/// A part of a chart that has a picture of its own.
#[derive(Debug, Clone, Copy)]
pub enum Part<'c> {
    /// A control-state machine or a pattern.
    Machine(&'c Machine),
    /// Components and channels.
    System(&'c System),
}

/// What can be drawn of a chart, in the order of the file, the system last.
pub fn subjects(chart: &Chart) -> impl Iterator<Item = Subject<'_>> {
    let machines = chart.machines.iter().map(Part::Machine);
    machines.chain(chart.system.iter().map(Part::System)).map(move |part| Subject { chart, part })
}

impl<'c> Subject<'c> {
    /// The name of the machine or system.
    pub fn name(&self) -> &'c str {
        match self.part {
            Part::Machine(machine) => &machine.name,
            Part::System(system) => &system.name,
        }
    }

    /// Its text in one line.
    pub fn title(&self) -> String {
        let text = match self.part {
            Part::Machine(machine) => &machine.text,
            Part::System(system) => &system.text,
        };
        text.replace('\n', " ")
    }

    /// The machine, if it is one.
    pub fn machine(&self) -> Option<&'c Machine> {
        match self.part {
            Part::Machine(machine) => Some(machine),
            Part::System(_) => None,
        }
    }
}

/// Pictures for a page that holds several of them. The crate `draw` makes them; whoever writes a page gets them handed in.
pub trait Pictures {
    /// The style of all pictures of a class of elements, in light and dark.
    fn style(&self, class: &str) -> String;

    /// The SVG element of a subject, of this class. A shape is a group with its name in `data-shape`, and is lit by the
    /// class `lit`. Identifiers begin with `prefix`.
    ///
    /// # Errors
    /// It cannot be laid out.
    fn part(&self, subject: Subject<'_>, prefix: &str, class: &str) -> Result<String, NotDrawn>;
}

/// A picture that could not be made, and why: a bug of ours or of a library.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotDrawn(pub String);

impl std::fmt::Display for NotDrawn {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NotDrawn {}

/// No pictures: for those who ask only whether everything else is right.
#[derive(Debug, Clone, Copy)]
pub struct NoPictures;

impl Pictures for NoPictures {
    fn style(&self, _: &str) -> String {
        String::new()
    }

    fn part(&self, _: Subject<'_>, _: &str, _: &str) -> Result<String, NotDrawn> {
        Ok(String::new())
    }
}
