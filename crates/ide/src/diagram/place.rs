//! Where shapes lie: lines of a `layout` section.

use std::collections::BTreeMap;
use std::fmt::Write;

use syntax::ast::{AstNode, Layout, Shape};

use super::{Centre, Section, Work};

/// LIMIT: pixels from the middle.
const FAR: f64 = 1e6;

impl Work {
    /// Gives these places to shapes that have none. Names that are no shape's are left out.
    pub(super) fn keep_places(&mut self, places: &BTreeMap<String, Centre>) -> Result<(), String> {
        if places.is_empty() {
            return Ok(());
        }
        let known = self.placeable()?;
        let placed: Vec<String> = self.layout()?.iter().flat_map(placed).map(|(name, ..)| name).collect();
        let of = |(name, centre): (&String, &Centre)| {
            (known.contains(name) && !placed.contains(name)).then(|| (name.clone(), *centre))
        };
        let missing: BTreeMap<String, Centre> = places.iter().filter_map(of).collect();
        self.place(&missing)
    }

    /// What may stand in the layout of the drawing: a frame, and what is told in it, lie where what it holds lies.
    pub(super) fn placeable(&self) -> Result<Vec<String>, String> {
        let mut names = self.shown()?;
        if let Section::Machine(machine) = self.section()? {
            let framed = machine
                .shapes()
                .filter(|shape| matches!(shape, Shape::Composite(_) | Shape::Entry(_) | Shape::Exit(_)));
            let framed: Vec<String> = framed.filter_map(|shape| Some(shape.name()?.text().to_string())).collect();
            names.retain(|name| !framed.contains(name));
        }
        Ok(names)
    }

    /// What the drawing shows that has a name.
    pub(super) fn shown(&self) -> Result<Vec<String>, String> {
        Ok(match self.section()? {
            Section::Machine(machine) => {
                let shapes = machine.shapes().filter_map(|shape| shape.name()).map(|name| name.text().to_string());
                machine.is_pattern().then(|| "enter".to_string()).into_iter().chain(shapes).collect()
            }
            Section::System(system) => {
                let components = system.components().filter_map(|component| component.name());
                let channels = system.channels().filter_map(|channel| channel.name());
                let devices = system.devices().filter_map(|device| device.name());
                components.chain(channels).chain(devices).map(|name| name.text().to_string()).collect()
            }
        })
    }

    /// Puts shapes there.
    pub(super) fn place(&mut self, places: &BTreeMap<String, Centre>) -> Result<(), String> {
        let known = self.placeable()?;
        for (name, centre) in places {
            if !known.contains(name) {
                return Err(format!("`{name}` has no place of its own"));
            }
            let place = format!("{}, {}", pixels(centre.0)?, pixels(centre.1)?);
            let layout = self.layout()?;
            let lines: Vec<_> = layout.iter().flat_map(placed).collect();
            let line = lines.iter().rfind(|(known, ..)| known == name);
            let end = layout.as_ref().and_then(|layout| layout.syntax().last_token());
            match (line, end) {
                (Some((_, from, to)), _) => self.replace(*from..*to, &place),
                (None, Some(end)) => {
                    let at = usize::from(end.text_range().start());
                    // What stands behind a comment of the same line is part of it.
                    let begun = self.text[..at].ends_with(['\n', '\t', ' ']);
                    let own = self.text[..at].trim_end_matches([' ', '\t']).ends_with('\n');
                    let at = if own { self.text[..at].trim_end_matches([' ', '\t']).len() } else { at };
                    let before = if own || begun { "" } else { " " };
                    let line = format!("{before}{}{name} at {place}\n", if own { "\t" } else { "" });
                    self.replace(at..at, &line);
                }
                (None, None) => {
                    let mut section = String::new();
                    if !self.text.ends_with('\n') {
                        section.push('\n');
                    }
                    // Writing to a text cannot fail.
                    _ = write!(section, "\nlayout {}\n\t{name} at {place}\nendlayout\n", self.drawing);
                    let end = self.text.len();
                    self.replace(end..end, &section);
                }
            }
        }
        Ok(())
    }

    /// The section of the drawing; of several, the last one counts.
    pub(super) fn layout(&self) -> Result<Option<Layout>, String> {
        let file = self.file()?;
        Ok(file.layouts().filter(|layout| layout.name().is_some_and(|name| name.text() == self.drawing)).last())
    }
}

/// Names with the bytes of their two numbers.
fn placed(layout: &Layout) -> Vec<(String, usize, usize)> {
    let of = |line: syntax::ast::Placement| {
        let name = line.name()?.text().to_string();
        line.place()?;
        let mut numbers = line.syntax().children().filter(|node| node.kind() == syntax::SyntaxKind::COORDINATE);
        let (first, second) = (numbers.next()?, numbers.next()?);
        let tokens = |node: &syntax::SyntaxNode| {
            let tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
            tokens.filter(|token| !token.kind().is_trivia()).collect::<Vec<_>>()
        };
        let from = tokens(&first).first()?.text_range().start();
        let to = tokens(&second).last()?.text_range().end();
        Some((name, usize::from(from), usize::from(to)))
    };
    layout.placements().filter_map(of).collect()
}

/// A number of pixels, to a tenth.
fn pixels(number: f64) -> Result<String, String> {
    if !number.is_finite() {
        return Err("a place is two numbers of pixels".to_string());
    }
    let rounded = (number.clamp(-FAR, FAR) * 10.0).round() / 10.0;
    Ok(format!("{}", if rounded == 0.0 { 0.0 } else { rounded }))
}
