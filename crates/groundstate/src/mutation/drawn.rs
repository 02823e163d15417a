//! Charts: what is built of them, and the systems that they draw as judges.
//!
//! In: the path of a chart, and the texts. Out: the model that `chart build` makes of it, which scenarios load; and the model that
//! `verify` makes of its system. INVARIANT: a chart is mutated only if the model beside it is what is built of it, so that what judges
//! the model as it is judges the chart.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use chart::Chart;
use inputs::verification;
use program::Program;
use syntax::{Diagnostic, FileId, SourceFile, Sources};

use super::ask::Asked;
use crate::asked_of_system::{libraries_of, refusal, words_of};
use crate::workspace::{Files, tidy};
use crate::{Loaded, Workspace, build_chart, verified_system};

/// A chart that is mutated.
#[derive(Debug)]
pub(super) struct Drawn {
    /// Its text.
    pub chart: SourceFile,
    /// The path of the model that is built of it.
    pub model: String,
    /// That model's text.
    pub text: String,
    /// There is no such file; otherwise what the chart does not determine is kept from it.
    pub is_new: bool,
    /// By their paths, the machines by which its components decide: the components' names.
    pub machines: BTreeMap<String, Vec<String>>,
}

/// Why something cannot be judged, or cannot judge.
#[derive(Debug)]
pub(super) struct Trouble {
    /// A clause after the path.
    pub why: String,
    pub sources: Sources,
    pub faults: Vec<Diagnostic>,
}

impl Trouble {
    pub fn plain(why: impl Into<String>) -> Trouble {
        Trouble { why: why.into(), sources: Sources::default(), faults: Vec::new() }
    }

    /// The faults of one of several texts: the first of which one is an error.
    fn of(faults: Vec<(Sources, Vec<Diagnostic>)>) -> Trouble {
        let worst = faults.into_iter().find(|(_, faults)| crate::has_errors(faults));
        let (sources, faults) = worst.unwrap_or_default();
        Trouble { why: "has faults".to_string(), sources, faults }
    }
}

/// Whether a path is that of a chart.
pub(super) fn is_chart(path: &str) -> bool {
    Path::new(path).extension().is_some_and(|ending| ending == "chart")
}

/// The path of the model that is built of a chart.
pub(super) fn model_of(chart: &str) -> String {
    tidy(&Path::new(chart).with_extension("asm").to_string_lossy())
}

/// The machines by which the components of a chart decide: their paths, and the names of the components.
fn deciding(chart: &Chart) -> impl Iterator<Item = (String, String)> {
    chart.system.iter().flat_map(|system| {
        let name = |component: usize| system.components[component].name.clone();
        system.computing.machines.iter().map(move |machine| (tidy(&machine.source.name), name(machine.component)))
    })
}

/// The paths of the machines by which the components of a chart decide; none if the chart has faults.
pub fn machines_of<F: Files>(path: &str, workspace: &mut Workspace<F>) -> BTreeSet<String> {
    let Ok(chart) = workspace.text(path) else { return BTreeSet::new() };
    let chart::Loaded { chart, .. } = chart::load(chart, &mut workspace.texts());
    deciding(&chart).map(|(path, _)| path).collect()
}

/// Builds the model of a chart, by its text as it is now, into the model that is there, unless it is new.
pub(super) fn built<F: Files>(path: &str, is_new: bool, workspace: &mut Workspace<F>) -> Result<Drawn, Trouble> {
    let chart = workspace.text(path).map_err(|absent| Trouble::plain(absent.told(path)))?;
    let model = model_of(path);
    let existing = workspace.text(&model).ok().map(|file| file.text).filter(|_| !is_new);
    let made = build_chart(chart.clone(), &model, existing.as_deref(), &mut workspace.texts());
    let Some(built) = made.built else { return Err(Trouble::of(made.faults)) };
    let mut machines: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (path, component) in deciding(&made.chart) {
        machines.entry(path).or_default().push(component);
    }
    Ok(Drawn { chart, model, text: built.text, is_new, machines })
}

/// The model that verifies the system of a chart, with what the file beside the chart asks.
pub(super) fn system<F: Files>(
    path: &str,
    beside: Option<&SourceFile>,
    workspace: &mut Workspace<F>,
) -> Result<(Loaded, Asked), Trouble> {
    let chart = workspace.text(path).map_err(|absent| Trouble::plain(absent.told(path)))?;
    let said = beside.and_then(|beside| verification::read(FileId(0), &beside.text).ok()).unwrap_or_default();
    let spoken = words_of(&said);
    let mut texts = workspace.texts();
    let system = verified_system(chart, libraries_of(&said), &|name| spoken.contains(name), &mut texts);
    let system = system.map_err(Trouble::of)?;
    let own = system.loaded.program.properties.len();
    let asked = Asked::of(&system.loaded, beside, &mut texts);
    let asked = asked.map_err(|(sources, faults)| Trouble { why: BESIDE.to_string(), sources, faults })?;
    for property in &asked.program().properties[own..] {
        if let Some(reason) = refusal(asked.program(), &property.formula, &system.data) {
            return Err(Trouble::plain(format!("is asked for `{}`, which {reason}", property.name)));
        }
    }
    Ok((system.loaded, asked))
}

/// What is wrong with a model whose specification has faults.
pub(super) const BESIDE: &str = "has a .verify.yaml with faults";

/// Whether two programs declare the same, so that their states can be compared.
pub(super) fn declare_alike(one: &Program, other: &Program) -> bool {
    let functions = |program: &Program| {
        let declared = program.functions.iter().map(|function| {
            let (name, parameters) = (function.name.clone(), function.parameters.clone());
            (name, function.kind, parameters, function.codomain, function.element)
        });
        declared.collect::<Vec<_>>()
    };
    one.domains == other.domains && functions(one) == functions(other)
}
