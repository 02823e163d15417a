//! Names of the modules that building adds to a chart's imports, and that the chart's own imports have, too.

use std::collections::BTreeSet;

use model::Loader;
use syntax::Diagnostic;

use super::folder_of_patterns;
use super::known::Known;
use super::system::added;
use crate::chart::Chart;
use crate::fault;

/// The names that modules of the library declare which building adds to the chart's imports, and that these declare, too. `known` is what
/// the chart's imports declare; `beside` names a file in its folder.
pub fn clashes(chart: &Chart, known: &Known, beside: &str, loader: &mut dyn Loader) -> Vec<Diagnostic> {
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
