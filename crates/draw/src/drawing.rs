//! The drawing of a machine or system, in the forms that files and pages need.

use chart::{Chart, NotDrawn, Part, Pictures, Subject, subjects};

use crate::elk::{self, LayoutFault};
use crate::fixed;
use crate::measure::{HEADING, heading_width};
use crate::picture::Picture;
use crate::scene::{self, Scene};
use crate::still::{self, DrawFault};
use crate::style::{self, Theme};
use crate::{components, font, svg, words};

/// A machine or system that is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Drawing<'c>(Subject<'c>);

/// A PNG or a PDF.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Still {
    /// The file.
    pub bytes: Vec<u8>,
    /// The letters that it leaves out: the faces of this crate do not have them.
    pub left_out: Vec<char>,
}

/// The drawings of a chart, in the order of the file, the system last.
pub fn drawings(chart: &Chart) -> Vec<Drawing<'_>> {
    subjects(chart).map(Drawing).collect()
}

impl<'c> Drawing<'c> {
    /// What it shows.
    pub fn subject(&self) -> Subject<'c> {
        self.0
    }

    /// The name of the machine or system.
    pub fn name(&self) -> &'c str {
        self.0.name()
    }

    /// Shapes and arrows, before they have places.
    pub(crate) fn scene(&self) -> Scene {
        let chart = self.0.chart;
        match self.0.part {
            Part::Machine(machine) => scene::of_machine(chart, machine),
            Part::System(system) => components::of_system(system, chart.layouts.get(&system.name)),
        }
    }

    /// Where everything lies.
    ///
    /// # Errors
    /// The layout library refused the graph; this is a bug, told with the library's words.
    pub fn picture(&self) -> Result<Picture, LayoutFault> {
        let title = self.0.title();
        let rule = self.0.machine().and_then(|machine| machine.rule.as_ref());
        let link = rule.map(|link| format!("{{{}}}", link.name));
        let scene = self.scene();
        let given = scene.nodes.iter().any(|node| node.place.is_some());
        let mut picture = if given { fixed::placed(&scene)? } else { elk::placed(&scene)? };
        picture.make_room(HEADING, heading_width(&title, link.as_deref()));
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

    /// The drawing as a PNG of so many dots a pixel; [`Theme::Auto`] is light there.
    ///
    /// # Errors
    /// As [`Drawing::picture`], and where the picture is too large for memory.
    pub fn png(&self, theme: Theme, scale: f32) -> Result<Still, DrawFault> {
        let svg = self.svg(theme)?;
        Ok(Still { bytes: still::png(&svg, scale)?, left_out: font::lacking(&svg) })
    }

    /// The drawing as a PDF of one page; [`Theme::Auto`] is light there. Its text can be searched.
    ///
    /// # Errors
    /// As [`Drawing::picture`].
    pub fn pdf(&self, theme: Theme) -> Result<Still, DrawFault> {
        let svg = self.svg(theme)?;
        Ok(Still { bytes: still::pdf(&svg)?, left_out: font::lacking(&svg) })
    }

    fn description(&self) -> String {
        match self.0.part {
            Part::Machine(machine) => words::of_machine(self.0.chart, machine),
            Part::System(system) => words::of_system(system),
        }
    }
}

/// Pictures without heading and paper, as parts of a page.
#[derive(Debug, Clone, Copy)]
pub struct Page;

impl Pictures for Page {
    fn style(&self, class: &str) -> String {
        style::css(Theme::Auto, &format!(".{class} "), true)
    }

    fn part(&self, subject: Subject<'_>, prefix: &str, class: &str) -> Result<String, NotDrawn> {
        let drawing = Drawing(subject);
        let picture = drawing.picture().map_err(|fault| NotDrawn(fault.to_string()))?;
        Ok(svg::part(&picture, &drawing.description(), prefix, class))
    }
}

/// The same for a page that defines the palette's colours as variables.
#[derive(Debug, Clone, Copy)]
pub struct Embedded;

impl Pictures for Embedded {
    fn style(&self, class: &str) -> String {
        style::css_of(&format!(".{class} "), true, palette::named)
    }

    fn part(&self, subject: Subject<'_>, prefix: &str, class: &str) -> Result<String, NotDrawn> {
        Page.part(subject, prefix, class)
    }
}
