//! Where shapes lie, written into the chart: what has a place keeps it, the others get the place they are drawn at.
//!
//! In: a chart without errors and its text. Out: the text with `layout` sections for the machines asked for; every other
//! byte stays.

use std::fmt::Write;

use chart::Chart;
use syntax::Parse;
use syntax::ast::{AstNode, ChartFile};

use crate::drawing::{Drawing, drawings};
use crate::elk::LayoutFault;
use crate::picture::Figure;

/// The text of a chart with places for all shapes of the machines and systems that are `wanted`.
///
/// # Errors
/// The layout library refused a graph.
pub fn place(chart: &Chart, parse: &Parse, text: &str, wanted: impl Fn(&str) -> bool) -> Result<String, LayoutFault> {
    let tree = ChartFile::cast(parse.syntax());
    let mut edits: Vec<(usize, String)> = Vec::new();
    for drawing in drawings(chart).iter().filter(|drawing| wanted(drawing.name())) {
        let lines = lines(chart, drawing)?;
        if lines.is_empty() {
            continue;
        }
        let layouts = tree.iter().flat_map(|tree| tree.layouts());
        // Of several sections the last one counts.
        let section = layouts.filter(|layout| layout.name().is_some_and(|name| name.text() == drawing.name())).last();
        let end = section.and_then(|section| section.syntax().last_token());
        edits.push(match end {
            Some(end) => (usize::from(end.text_range().start()), lines),
            None => (text.len(), format!("\nlayout {}\n{lines}endlayout\n", drawing.name())),
        });
    }
    // From the end on, so that places stay; those of one place in their order.
    let mut out = text.to_string();
    if !out.ends_with('\n') && edits.iter().any(|(at, _)| *at == text.len()) {
        out.push('\n');
        edits.iter_mut().filter(|(at, _)| *at == text.len()).for_each(|(at, _)| *at += 1);
    }
    edits.sort_by_key(|(at, _)| *at);
    for (at, lines) in edits.into_iter().rev() {
        out.insert_str(at, &lines);
    }
    Ok(out)
}

/// A line for each shape that has no place yet.
fn lines(chart: &Chart, drawing: &Drawing) -> Result<String, LayoutFault> {
    let known = chart.layouts.get(drawing.name());
    let mut out = String::new();
    for shape in &drawing.picture()?.boxes {
        let placed = known.is_some_and(|places| places.contains_key(&shape.id));
        if placed || matches!(shape.figure, Figure::Exit | Figure::Composite) {
            continue;
        }
        let centre = ((shape.x + shape.width / 2.0).round(), (shape.y + shape.height / 2.0).round());
        let _ = writeln!(out, "\t{} at {}, {}", shape.id, centre.0, centre.1);
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use syntax::{FileId, parse_chart};

    use super::*;

    fn placed(text: &str) -> String {
        let parse = parse_chart(FileId(0), text);
        let (chart, faults) = chart::read(FileId(0), &parse);
        assert_eq!(faults, [], "{text}");
        place(&chart, &parse, text, |_| true).expect("it is laid out")
    }

    #[test]
    fn a_channel_of_several_readers_has_one_place() {
        let component = |name: &str, phase: &str| {
            format!("\tcomponent {name} synchronous period 10 ms\n\t\t{phase} data\n\tendcomponent\n")
        };
        let parts = [component("a", "write"), component("b", "read"), component("c", "read")].concat();
        let text =
            format!("chart S\n\nsystem s\n\ttick 1 ms\n{parts}\tchannel data from a to b, c queue 2\nendsystem\n");
        let once = placed(&text);
        assert_eq!(once.matches("data at ").count(), 1, "{once}");
        // It is read again as it was written, and nothing is left to place.
        assert_eq!(placed(&once), once);
    }

    #[test]
    fn places_are_added_and_kept() {
        let text = "chart Door\n\nmachine door\n\tcontrol position\n\tinitial state closed\n\tstate open\n\tguard handle\n\
                    \tclosed -> handle yes -> open\nendmachine\n\nlayout door\n\topen at 300, -40 // far\nendlayout\n";
        let once = placed(text);
        assert!(once.starts_with(&text[..text.len() - "endlayout\n".len()]), "{once}");
        assert!(once.contains("\tclosed at ") && once.contains("\thandle at "), "{once}");
        assert_eq!(placed(&once), once);
        assert_eq!(syntax::format(&parse_chart(FileId(0), &once)), once);
    }

    #[test]
    fn a_section_is_made() {
        let once = placed("chart A machine a control c initial state s endmachine");
        assert!(once.contains("\n\nlayout a\n\ts at "), "{once}");
        assert_eq!(placed(&once), once);
    }
}
