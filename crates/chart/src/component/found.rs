//! Finds the machine that an elaboration names, and reads it.
//!
//! In: the chart's imports and a [`Loader`]. Out: for each elaboration with a machine its text and its checked model. A machine is a file
//! of that name in the chart's folder, or one that the chart imports. It has a main rule, which is its step, and no agents.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use model::{Checked, Loader};
use syntax::ast::{self, AstNode};
use syntax::{Diagnostic, FileId, Severity, SourceFile, Sources};

use crate::chart::Chart;
use crate::computing::ComponentMachine;
use crate::fault::component as fault;
use crate::system::System;

/// The machines of a system, and the faults of those that cannot be used.
pub(super) fn find(
    root: &SourceFile,
    system: &System,
    chart: &Chart,
    sources: &mut Sources,
    loader: &mut dyn Loader,
) -> (Vec<ComponentMachine>, Vec<Diagnostic>) {
    let (mut found, mut faults) = (Vec::new(), Vec::new());
    let mut read: BTreeMap<String, (FileId, Arc<Checked>)> = BTreeMap::new();
    for (component, owner) in system.components.iter().enumerate() {
        for (phase, named) in
            owner.phases.iter().enumerate().filter_map(|(at, phase)| Some((at, phase.machine.as_ref()?)))
        {
            let import = chart.imports.iter().find(|import| stem(import) == named.text).cloned();
            let path = import.unwrap_or_else(|| named.text.clone());
            let source = match loader.load(root, &path) {
                Ok(source) => source,
                Err(reason) => {
                    let others = system.components.iter().flat_map(|component| &component.phases);
                    let others = others.filter_map(|phase| phase.machine.as_ref()).map(|machine| machine.text.as_str());
                    let imported = chart.imports.iter().map(|import| stem(import));
                    let known: Vec<&str> = imported.chain(others).filter(|name| *name != named.text).collect();
                    faults.push(fault::not_found(named.span, &named.text, &reason, &known));
                    continue;
                }
            };
            let (file, checked) = read.entry(source.name.clone()).or_insert_with(|| {
                let file = sources.add(source.clone());
                (file, Arc::new(model::check(source.clone(), loader)))
            });
            if let Some(reason) = unusable(checked) {
                faults.push(fault::unusable(named.span, &named.text, &reason, &source.name));
                continue;
            }
            let folder = path.rfind(['/', '\\']).map_or("", |end| &path[..=end]).to_string();
            found.push(ComponentMachine {
                component,
                phase,
                feeds: Vec::new(),
                takes: Vec::new(),
                folder,
                file: *file,
                checked: Arc::clone(checked),
                freed: BTreeSet::new(),
                source,
            });
        }
    }
    (found, faults)
}

/// The last part of a path, without its ending.
pub(super) fn stem(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path).trim_end_matches(".asm")
}

/// Why a model cannot be a component's machine.
fn unusable(checked: &Checked) -> Option<String> {
    let root = checked.model.root;
    if let Some(first) = checked.diagnostics.iter().find(|found| found.severity == Severity::Error) {
        return Some(format!(
            "it has faults, the first one in {}: {}",
            checked.sources.position(first.primary.span),
            first.message
        ));
    }
    let file = checked.sources.file(root);
    let tree = ast::SourceFile::cast(syntax::parse_asmetal(root, &file.text).syntax())?;
    if checked.model.main.is_none() {
        return Some("it has no main rule, which is its step".to_string());
    }
    if tree.is_asynchronous() || checked.model.inits.iter().any(|init| !init.agents.is_empty()) {
        return Some("it has agents, and a component is one".to_string());
    }
    None
}
