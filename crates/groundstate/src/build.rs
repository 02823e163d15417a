//! Builds the model that a chart means, and checks it like any other model.
//!
//! In: a chart's text, the name and the present text of the model's file, and a [`Loader`]. Out: the new text, or the
//! faults of the chart, its imports, the present text or the model to be built. INVARIANT: a model that is returned has
//! no errors. A fault of the model to be built is reported in the chart if one of its links causes it.

use chart::{Built, Chart, Known, Loaded};
use model::Loader;
use syntax::{Diagnostic, SourceFile, Sources};

use crate::{check, has_errors};

/// Faults, and the texts that their places refer to.
pub type Located = (Sources, Vec<Diagnostic>);

/// The result of building a chart.
#[derive(Debug)]
pub struct BuiltChart {
    /// The chart, with the imports that it needs.
    pub chart: Chart,
    /// The model; `None` if there is an error.
    pub built: Option<Built>,
    /// The faults, grouped by the texts that they refer to.
    pub faults: Vec<Located>,
}

/// Builds the model of a chart under a name, into the existing text.
pub fn build_chart(root: SourceFile, name: &str, existing: Option<&str>, loader: &mut dyn Loader) -> BuiltChart {
    let Loaded { sources, mut chart, diagnostics } = chart::load(root.clone(), loader);
    let whole = !has_errors(&diagnostics);
    let mut faults = vec![(sources.clone(), diagnostics)];
    let built = if whole { built(&root, &sources, &mut chart, name, existing, loader, &mut faults) } else { None };
    faults.retain(|(_, found)| !found.is_empty());
    BuiltChart { chart, built, faults }
}

fn built(
    root: &SourceFile,
    sources: &Sources,
    chart: &mut Chart,
    name: &str,
    existing: Option<&str>,
    loader: &mut dyn Loader,
    faults: &mut Vec<Located>,
) -> Option<Built> {
    let folder = root.name.rfind(['/', '\\']).map_or("", |end| &root.name[..=end]);
    let known = match Known::completed(chart, &format!("{folder}Imports.asm"), loader) {
        Ok(known) => known,
        Err(unknown) => {
            faults.push((sources.clone(), unknown.imports));
            faults.push((unknown.checked.sources, unknown.modules));
            return None;
        }
    };
    let mut unbuilt = chart::unbuilt(chart, &known);
    unbuilt.extend(chart::stateless(chart));
    if !unbuilt.is_empty() {
        faults.push((sources.clone(), unbuilt));
        return None;
    }
    let built = match chart::build(chart, &known, existing) {
        Ok(built) => built,
        Err(found) => {
            let mut there = Sources::default();
            there.add(SourceFile::new(name, existing.unwrap_or_default()));
            faults.push((there, found));
            return None;
        }
    };
    let found = faults_of(root, chart, name, &built.text, loader);
    if found.1.is_empty() {
        faults.push(found);
        return Some(built);
    }
    // One fault in the chart instead of many in a text that nobody has written.
    let clashes = chart::clashes(chart, &known, &format!("{folder}Imports.asm"), loader);
    faults.push(if clashes.is_empty() { found } else { (sources.clone(), clashes) });
    None
}

/// The errors of the text that was built.
fn faults_of(root: &SourceFile, chart: &Chart, name: &str, text: &str, loader: &mut dyn Loader) -> Located {
    let mut checked = check(SourceFile::new(name, text), loader);
    if !has_errors(&checked.diagnostics) {
        return (checked.sources, Vec::new());
    }
    let Ok(probed) = chart::probed(chart, text) else {
        return (checked.sources, checked.diagnostics);
    };
    checked = check(SourceFile::new(name, probed.text.as_str()), loader);
    // Faults of the built text may point into the chart, too.
    let loaded = chart::load_beside(std::mem::take(&mut checked.sources), root.clone(), loader);
    checked.sources = loaded.sources;
    let mut placed = loaded.chart;
    placed.imports.clone_from(&chart.imports);
    let faults = chart::built_faults(&placed, &probed, &checked);
    (checked.sources, faults)
}
