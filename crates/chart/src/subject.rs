//! The subject of a chart's picture: one machine, or the system. Also the trait by which a page asks for such a picture
//! without depending on the crate that draws it.

use crate::chart::{Chart, Machine};
use crate::system::System;

/// A machine or the system of a chart.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'c> {
    /// The chart that contains it.
    pub chart: &'c Chart,
    /// Which of both.
    pub part: Part<'c>,
}

/// A part of a chart that has its own picture.
#[derive(Debug, Clone, Copy)]
pub enum Part<'c> {
    /// A control-state machine or a pattern.
    Machine(&'c Machine),
    /// Components and channels.
    System(&'c System),
}

/// The subjects of a chart's pictures, in the order of the file, the system last.
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

    /// Its text on one line.
    pub fn title(&self) -> String {
        let text = match self.part {
            Part::Machine(machine) => &machine.text,
            Part::System(system) => &system.text,
        };
        text.replace('\n', " ")
    }

    /// The machine, if the subject is one.
    pub fn machine(&self) -> Option<&'c Machine> {
        match self.part {
            Part::Machine(machine) => Some(machine),
            Part::System(_) => None,
        }
    }
}

/// Draws pictures for a page that contains several of them. The crate `draw` implements it; the caller passes it in.
pub trait Pictures {
    /// The style of all pictures of a class of elements, in light and dark.
    fn style(&self, class: &str) -> String;

    /// The SVG element of a subject, with this class. A shape is a group with its name in `data-shape`; the class `lit`
    /// lights it up. Identifiers begin with `prefix`.
    ///
    /// # Errors
    /// It cannot be laid out.
    fn part(&self, subject: Subject<'_>, prefix: &str, class: &str) -> Result<String, NotDrawn>;
}

/// Why a picture could not be drawn: a bug of ours or of a library.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotDrawn(pub String);

impl std::fmt::Display for NotDrawn {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NotDrawn {}

/// Draws no pictures, for callers that only check everything else.
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
