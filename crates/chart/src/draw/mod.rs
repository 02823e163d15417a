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
mod fixed;
mod font;
mod lights;
mod notation;
mod picture;
mod route;
pub(crate) mod scene;
mod still;
mod style;
mod svg;
mod words;

pub use elk::LayoutFault;
pub use lights::{Light, Lights};
pub use picture::{Detail, Figure, Label, Line, Picture, Placed};
pub use still::DrawFault;
pub use style::Theme;
pub(crate) use svg::Text;

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
            Subject::System(system) => components::of_system(system, self.chart.layouts.get(&system.name)),
        }
    }

    /// What stands above it.
    pub fn title(&self) -> String {
        match self.subject {
            Subject::Machine(machine) => words::title(&machine.text),
            Subject::System(system) => words::title(&system.text),
        }
    }

    /// The machine, if it is one.
    pub fn machine(&self) -> Option<&'c Machine> {
        match self.subject {
            Subject::Machine(machine) => Some(machine),
            Subject::System(_) => None,
        }
    }

    /// The chart it is of.
    pub(crate) fn chart(&self) -> &'c Chart {
        self.chart
    }

    /// Where everything lies.
    ///
    /// # Errors
    /// The layout library refused the graph; this is a bug, told with the library's words.
    pub fn picture(&self) -> Result<Picture, LayoutFault> {
        let title = self.title();
        let rule = self.machine().and_then(|machine| machine.rule.as_ref());
        let link = rule.map(|link| format!("{{{}}}", link.name));
        let scene = self.scene();
        let given = scene.nodes.iter().any(|node| node.place.is_some());
        let mut picture = if given { fixed::placed(&scene)? } else { elk::placed(&scene)? };
        picture.make_room(notation::HEADING, notation::heading_width(&title, link.as_deref()));
        picture.heading = (title, link);
        Ok(picture)
    }

    /// The drawing as SVG.
    ///
    /// # Errors
    /// As [`Drawing::picture`].
    pub fn svg(&self, theme: Theme) -> Result<String, LayoutFault> {
        Ok(svg::svg(&self.picture()?, &self.description(), theme))
    }

    /// The drawing as a part of a page that has the [`style`] of its class: without heading and paper. A shape is a group
    /// with its name in `data-shape`, and is lit by the class `lit`. Identifiers begin with `prefix`.
    ///
    /// # Errors
    /// As [`Drawing::picture`].
    pub fn part(&self, prefix: &str, class: &str) -> Result<String, LayoutFault> {
        Ok(svg::part(&self.picture()?, &self.description(), prefix, class))
    }

    /// The drawing as a PNG of so many dots a pixel; [`Theme::Auto`] is light there.
    ///
    /// # Errors
    /// As [`Drawing::picture`], and where the picture is too large for memory.
    pub fn png(&self, theme: Theme, scale: f32) -> Result<Vec<u8>, DrawFault> {
        still::png(&self.svg(theme)?, scale)
    }

    /// The drawing as a PDF of one page; [`Theme::Auto`] is light there. Its text can be searched.
    ///
    /// # Errors
    /// As [`Drawing::picture`].
    pub fn pdf(&self, theme: Theme) -> Result<Vec<u8>, DrawFault> {
        still::pdf(&self.svg(theme)?)
    }

    fn description(&self) -> String {
        match self.subject {
            Subject::Machine(machine) => words::of_machine(self.chart, machine),
            Subject::System(system) => words::of_system(system),
        }
    }
}

/// The style of all drawings of a class in a page, in light and dark as the reader's screen is.
pub fn style(class: &str) -> String {
    style::css(Theme::Auto, &format!(".{class} "))
}
