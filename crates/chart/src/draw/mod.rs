//! Chart → SVG, in the notation of the paper (Figures 4 to 6): circles, hexagons with yes and no exits, rectangles,
//! dashed where they are to be refined, blocks for pattern instances, an entering arrow and floating exit arrows, and
//! `{links}` in small type.
//!
//! In: a chart without errors. Out: one SVG a machine, the same bytes for the same chart. Shapes are placed and arrows
//! routed by ELK's layered algorithm; what is made of its answer is a [`Picture`], which tests measure.

mod elk;
mod notation;
mod picture;
mod scene;
mod svg;
mod words;

pub use elk::LayoutFault;
pub use picture::{Figure, Label, Line, Picture, Placed};
pub use svg::Theme;

use crate::chart::{Chart, Machine};

/// One drawing: the name of the machine it shows, and how to draw it.
pub fn drawings(chart: &Chart) -> impl Iterator<Item = &str> {
    chart.machines.iter().map(|machine| machine.name.as_str())
}

/// Where everything of a machine's picture lies.
///
/// # Errors
/// The layout library refused the graph; this is a bug, told with the library's words.
pub fn picture(chart: &Chart, machine: &Machine) -> Result<Picture, LayoutFault> {
    let mut picture = elk::placed(&scene::of_machine(chart, machine))?;
    let link = machine.rule.as_ref().map(|link| format!("{{{}}}", link.name));
    let width = notation::heading_width(&words::title(machine), link.as_deref());
    picture.make_room(notation::HEADING, width);
    picture.heading = (words::title(machine), link);
    Ok(picture)
}

/// Draws a machine.
///
/// # Errors
/// As [`picture`].
pub fn draw(chart: &Chart, machine: &Machine, theme: Theme) -> Result<String, LayoutFault> {
    Ok(svg::svg(&picture(chart, machine)?, &words::description(chart, machine), theme))
}
