//! Chart → SVG, in the notation of the paper (Figures 4 to 6): circles, hexagons with yes and no exits, rectangles,
//! dashed where they are to be refined, blocks for pattern instances, an entering arrow and floating exit arrows, and
//! `{links}` in small type.
//!
//! Systems are drawn as component diagrams (Figures 1 and 2).
//!
//! In: a chart without errors. Out: one SVG a machine and system, the same bytes for the same chart. Shapes are placed and arrows
//! routed by ELK's layered algorithm; what is made of its answer is a [`Picture`], which tests measure.

mod components;
mod elk;
mod notation;
mod picture;
pub(crate) mod scene;
mod svg;
mod words;

pub use elk::LayoutFault;
pub use picture::{Figure, Label, Line, Picture, Placed};
pub(crate) use svg::Text;
pub use svg::Theme;

use crate::chart::{Chart, Machine};
use crate::system::System;

/// Something of a chart that is drawn: a machine, or the system.
#[derive(Debug, Clone, Copy)]
pub struct Drawing<'c> {
    chart: &'c Chart,
    subject: Subject<'c>,
}

#[derive(Debug, Clone, Copy)]
enum Subject<'c> {
    Machine(&'c Machine),
    System(&'c System),
}

/// The drawings of a chart, in the order of the file, the system last.
pub fn drawings(chart: &Chart) -> Vec<Drawing<'_>> {
    let machines = chart.machines.iter().map(Subject::Machine);
    let subjects = machines.chain(chart.system.iter().map(Subject::System));
    subjects.map(|subject| Drawing { chart, subject }).collect()
}

impl<'c> Drawing<'c> {
    /// The name of the machine or system.
    pub fn name(&self) -> &'c str {
        match self.subject {
            Subject::Machine(machine) => &machine.name,
            Subject::System(system) => &system.name,
        }
    }

    /// What is to be drawn.
    pub(crate) fn scene(&self) -> scene::Scene {
        match self.subject {
            Subject::Machine(machine) => scene::of_machine(self.chart, machine),
            Subject::System(system) => components::of_system(system),
        }
    }

    /// The machine, if it is one.
    pub(crate) fn machine(&self) -> Option<(&'c Chart, &'c Machine)> {
        match self.subject {
            Subject::Machine(machine) => Some((self.chart, machine)),
            Subject::System(_) => None,
        }
    }

    /// Where everything lies.
    ///
    /// # Errors
    /// The layout library refused the graph; this is a bug, told with the library's words.
    pub fn picture(&self) -> Result<Picture, LayoutFault> {
        let (title, link) = match self.subject {
            Subject::Machine(machine) => {
                let link = machine.rule.as_ref().map(|link| format!("{{{}}}", link.name));
                (words::title(&machine.text), link)
            }
            Subject::System(system) => (words::title(&system.text), None),
        };
        let mut picture = elk::placed(&self.scene())?;
        picture.make_room(notation::HEADING, notation::heading_width(&title, link.as_deref()));
        picture.heading = (title, link);
        Ok(picture)
    }

    /// The drawing as SVG.
    ///
    /// # Errors
    /// As [`Drawing::picture`].
    pub fn svg(&self, theme: Theme) -> Result<String, LayoutFault> {
        let description = match self.subject {
            Subject::Machine(machine) => words::of_machine(self.chart, machine),
            Subject::System(system) => words::of_system(system),
        };
        Ok(svg::svg(&self.picture()?, &description, theme))
    }
}
