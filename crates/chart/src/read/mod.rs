//! Reads the tree of a chart file: resolves names, extracts links, and checks the structure of the machines.
//!
//! In: the tree of one chart file, and its imports. Out: a [`Chart`], as complete as the text allows, and the faults in
//! the order of their places. Whether links resolve is for `check` to decide.

mod answer;
mod awaits;
mod import;
mod link;
mod machine;
mod structure;
mod system;

use std::collections::BTreeMap;
use std::sync::Arc;

use syntax::ast::{self, AstNode, ChartFile};
use syntax::{Diagnostic, FileId, Parse, Span};

use crate::chart::{Chart, ShapeKind};
use crate::flat::flattened;
use crate::{fault, flow};

pub use import::{Loaded, load, load_beside};
pub(crate) use link::{flat, names_function};
pub(crate) use machine::spoken;

/// Reads a chart without a loader, so importing another chart is a fault.
pub fn read(file: FileId, parse: &Parse) -> (Chart, Vec<Diagnostic>) {
    let (imported, unfound) = import::alone(file, ChartFile::cast(parse.syntax()));
    let (chart, mut faults) = read_with(file, parse, imported);
    faults.extend(unfound);
    faults.sort_by_key(|fault| fault.primary.span.start);
    (chart, faults)
}

fn read_with(file: FileId, parse: &Parse, imported: import::Imported) -> (Chart, Vec<Diagnostic>) {
    let mut reader = Reader { file, faults: parse.diagnostics.clone(), broken: Vec::new() };
    let import::Imported { charts, models, places, patterns, beyond } = imported;
    let mut chart = Chart { imports: models, places, charts, patterns, beyond, ..Chart::default() };
    if let Some(tree) = ChartFile::cast(parse.syntax()) {
        reader.chart(&tree, &mut chart);
    }
    let mut faults = reader.faults;
    faults.sort_by_key(|fault| fault.primary.span.start);
    (chart, faults)
}

struct Reader {
    file: FileId,
    faults: Vec<Diagnostic>,
    /// The names of channels of which the text says too little.
    broken: Vec<String>,
}

impl Reader {
    fn chart(&mut self, tree: &ChartFile, chart: &mut Chart) {
        chart.name = tree.name().map(|name| name.text().to_string()).unwrap_or_default();
        for node in tree.machines() {
            let Some(machine) = self.machine(&node) else { continue };
            if let Some(first) = chart.machine(&machine.name) {
                let what = if machine.is_pattern { "pattern" } else { "machine" };
                self.faults.push(fault::duplicate(machine.span, what, &machine.name, first.span));
                continue;
            }
            chart.machines.push(machine);
        }
        let mut systems = tree.systems();
        chart.system = systems.next().and_then(|node| self.system(&node));
        for second in systems.filter_map(|node| node.name()) {
            let first = chart.system.as_ref().map_or_else(|| self.span(&second), |system| system.span);
            self.faults.push(fault::duplicate(self.span(&second), "system", second.text(), first));
        }
        self.instances(chart);
        for (machine, over) in flow::settle(chart) {
            self.faults.push(fault::contains_itself(chart.machines[machine].span, &over));
        }
        self.answers(chart);
        self.refinements(chart);
        for index in 0..chart.machines.len() {
            match flattened(chart, &chart.machines[index]) {
                Ok(flat) => chart.machines[index].flattened = flat.map(Arc::new),
                Err(_) => {
                    let machine = &chart.machines[index];
                    self.faults.push(fault::too_nested(machine.span, &machine.name));
                }
            }
        }
        for machine in &chart.machines {
            let blocks = machine.numbered().any(|(id, _)| flow::is_block(chart, machine, id));
            if blocks && machine.control.is_none() && !structure::has_states(machine) {
                self.faults.push(fault::no_control(machine.span, &machine.name));
            }
        }
        for layout in tree.layouts() {
            self.layout(chart, &layout);
        }
    }

    /// Checks that each instance names a known pattern, with fitting arguments.
    fn instances(&mut self, chart: &Chart) {
        let patterns: Vec<&str> = chart.all_patterns().map(|machine| machine.name.as_str()).collect();
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
        let shapes: Vec<&str> = match (&chart.system, chart.machines.iter().find(|machine| machine.name == name.text()))
        {
            (_, Some(machine)) => {
                // A composite state is drawn around what lies in it; entry and exit actions are lines of text.
                let placed =
                    machine.numbered().filter(|(id, one)| one.composite().is_none() && !machine.is_told_in_frame(*id));
                let shapes = placed.map(|(_, shape)| shape.name.as_str());
                machine.is_pattern.then_some("enter").into_iter().chain(shapes).collect()
            }
            (Some(system), None) if system.name == name.text() => {
                let components = system.components.iter().map(|component| component.name.as_str());
                // Those of several readers are drawn as one, and placed by its name.
                let mut channels: Vec<&str> = Vec::new();
                for name in system.channels.iter().flat_map(|channel| [&channel.drawn, &channel.name]) {
                    if !channels.contains(&name.as_str()) {
                        channels.push(name);
                    }
                }
                components.chain(channels).chain(system.devices.iter().map(|device| device.name.as_str())).collect()
            }
            _ => {
                let span = Span::new(self.file, name.text_range());
                self.faults.push(fault::unknown(span, "machine", name.text(), &names));
                return;
            }
        };
        let mut places = BTreeMap::new();
        for placement in node.placements() {
            let (Some(shape), Some(place)) = (placement.name(), placement.place()) else { continue };
            if shapes.contains(&shape.text()) {
                places.insert(shape.text().to_string(), place);
            } else {
                let span = Span::new(self.file, shape.text_range());
                self.faults.push(fault::unknown(span, "shape", shape.text(), &shapes));
            }
        }
        chart.layouts.insert(name.text().to_string(), places);
    }
}
