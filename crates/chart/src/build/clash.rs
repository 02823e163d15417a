//! Names that stand twice in what is built of a chart: those of the modules that building adds, and the literals of its states.

use std::collections::BTreeSet;

use model::Loader;
use syntax::Diagnostic;

use super::folder_of_patterns;
use super::known::Known;
use super::spelling::state_value;
use super::system::added;
use crate::chart::{Chart, Control, Machine, Shape, ShapeId, ShapeKind};
use crate::fault;
use crate::flow::is_block;

/// The names that the chart's imports declare and that building declares, too: in modules of the library that it adds, and as literals of
/// control states. `known` is what the chart's imports declare; `beside` names a file in its folder.
pub fn clashes(chart: &Chart, known: &Known, beside: &str, loader: &mut dyn Loader) -> Vec<Diagnostic> {
    let mut faults: Vec<Diagnostic> =
        chart.machines.iter().flat_map(|machine| literals(chart, machine, known)).collect();
    faults.extend(of_modules(chart, known, beside, loader));
    faults
}

/// The states whose literals an import declares.
fn literals(chart: &Chart, machine: &Machine, known: &Known) -> Vec<Diagnostic> {
    if !matches!(machine.control, Some(Control::Made { .. })) {
        return Vec::new();
    }
    let is_made = |(id, shape): &(ShapeId, &Shape)| match shape.kind {
        ShapeKind::State { .. } => shape.link.is_none(),
        _ => is_block(chart, machine, *id),
    };
    let value = |(id, shape)| (state_value(chart, machine, id), shape);
    let values = machine.numbered().filter(is_made).map(value).filter(|(value, _)| known.terms.contains(value));
    values.map(|(value, shape): (String, &Shape)| fault::import::literal(shape.span, &shape.name, &value)).collect()
}

/// The names that modules of the library declare which building adds to the chart's imports, and that these declare, too.
fn of_modules(chart: &Chart, known: &Known, beside: &str, loader: &mut dyn Loader) -> Vec<Diagnostic> {
    let Some(system) = &chart.system else { return Vec::new() };
    let own = known.all();
    let patterns: Vec<String> =
        chart.imports.iter().filter(|path| folder_of_patterns(path).is_some()).cloned().collect();
    let mut names_of = |imports: Vec<String>| -> BTreeSet<String> {
        let alone = Chart { imports, ..Chart::default() };
        Known::imported(&alone, beside, loader).map(|known| known.all()).unwrap_or_default()
    };
    let base = names_of(patterns.clone());
    let mut faults = Vec::new();
    for module in added(chart, known).into_iter().filter(|module| !chart.imports.contains(module)) {
        let names = names_of(patterns.iter().cloned().chain([module.clone()]).collect());
        let module = module.rsplit('/').next().unwrap_or(&module);
        let clash = |name: &&String| !base.contains(*name) && own.contains(*name);
        faults.extend(names.iter().filter(clash).map(|name| fault::import::clash(system.span, name, module)));
    }
    faults
}
