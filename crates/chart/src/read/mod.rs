//! Tree → chart: names resolved, links taken out, and what is wrong with the shape of the machines.
//!
//! In: the tree of one chart file. Out: a [`Chart`], as whole as the text allows, and the faults in the order of their
//! places. It knows no second file: whether links resolve is for `check` to say.

mod link;
mod machine;
mod structure;
mod system;

use std::collections::BTreeMap;

use syntax::ast::{self, AstNode, ChartFile};
use syntax::{Diagnostic, FileId, Parse, Span};

use crate::chart::{Chart, Machine, ShapeKind};
use crate::fault;

pub(crate) use machine::spoken;

/// Reads the chart of a file.
pub fn read(file: FileId, parse: &Parse) -> (Chart, Vec<Diagnostic>) {
    let mut reader = Reader { file, faults: parse.diagnostics.clone() };
    let tree = ChartFile::cast(parse.syntax());
    let chart = tree.map(|tree| reader.chart(&tree)).unwrap_or_else(|| Chart {
        name: String::new(),
        imports: Vec::new(),
        machines: Vec::new(),
        system: None,
        layouts: BTreeMap::new(),
    });
    let mut faults = reader.faults;
    faults.sort_by_key(|fault| fault.primary.span.start);
    (chart, faults)
}

struct Reader {
    file: FileId,
    faults: Vec<Diagnostic>,
}

impl Reader {
    fn chart(&mut self, tree: &ChartFile) -> Chart {
        let paths = tree.imports().filter_map(|import| import.path_token());
        let imports = paths.map(|path| path.text().trim_matches('"').to_string()).collect();
        let mut machines: Vec<Machine> = Vec::new();
        for node in tree.machines() {
            let Some(machine) = self.machine(&node) else { continue };
            if let Some(first) = machines.iter().find(|first| first.name == machine.name) {
                self.faults.push(fault::duplicate(machine.span, "machine", &machine.name, first.span));
                continue;
            }
            machines.push(machine);
        }
        let name = tree.name().map(|name| name.text().to_string()).unwrap_or_default();
        let mut systems = tree.systems();
        let system = systems.next().and_then(|node| self.system(&node));
        for second in systems.filter_map(|node| node.name()) {
            let first = system.as_ref().map_or_else(|| self.span(&second), |system| system.span);
            self.faults.push(fault::duplicate(self.span(&second), "system", second.text(), first));
        }
        let mut chart = Chart { name, imports, machines, system, layouts: BTreeMap::new() };
        self.instances(&chart);
        for layout in tree.layouts() {
            self.layout(&mut chart, &layout);
        }
        chart
    }

    /// Each instance is of a pattern that is here, with fitting arguments.
    fn instances(&mut self, chart: &Chart) {
        let patterns: Vec<&str> = chart.machines.iter().filter(|m| m.is_pattern).map(|m| m.name.as_str()).collect();
        for shape in chart.machines.iter().flat_map(|machine| &machine.shapes) {
            let ShapeKind::Instance(wanted) = &shape.kind else { continue };
            match chart.machine(&wanted.name).filter(|machine| machine.is_pattern) {
                None => self.faults.push(fault::unknown(shape.span, "pattern", &wanted.name, &patterns)),
                Some(pattern) if pattern.parameters.len() != wanted.arguments.len() => {
                    let (count, given) = (pattern.parameters.len(), wanted.arguments.len());
                    self.faults.push(fault::arguments(shape.span, &wanted.name, count, given, pattern.span));
                }
                Some(_) => {}
            }
        }
    }

    fn layout(&mut self, chart: &mut Chart, node: &ast::Layout) {
        let Some(name) = node.name() else { return };
        let names: Vec<&str> = chart.machines.iter().map(|machine| machine.name.as_str()).collect();
        if chart.system.as_ref().is_some_and(|system| system.name == name.text()) {
            let places = node.placements().filter_map(|place| Some((place.name()?.text().to_string(), place.place()?)));
            chart.layouts.insert(name.text().to_string(), places.collect());
            return;
        }
        let Some(machine) = chart.machine(name.text()) else {
            let span = Span::new(self.file, name.text_range());
            self.faults.push(fault::unknown(span, "machine", name.text(), &names));
            return;
        };
        let mut places = BTreeMap::new();
        for placement in node.placements() {
            let (Some(shape), Some(place)) = (placement.name(), placement.place()) else { continue };
            let known = shape.text() == "enter" || machine.shapes.iter().any(|known| known.name == shape.text());
            if known {
                places.insert(shape.text().to_string(), place);
            } else {
                let names: Vec<&str> = machine.shapes.iter().map(|shape| shape.name.as_str()).collect();
                let span = Span::new(self.file, shape.text_range());
                self.faults.push(fault::unknown(span, "shape", shape.text(), &names));
            }
        }
        chart.layouts.insert(name.text().to_string(), places);
    }
}
