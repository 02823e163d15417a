//! Components' own machines: `elaborate decide by SequencerMachine` (spec/charts.md, "A component's own machine").
//!
//! In: a chart with its system, and a [`Loader`]. Out: [`Computing`](crate::computing::Computing) within the system: the machines that were found, which of their
//! functions are fed by which channel or sensor and taken by which channel or actuator, and the texts that they become in the ground
//! model; and the faults. INVARIANT: a machine's own names get the name of its component before them, so two components never share a
//! name, even if they have the same machine. Whatever the machine's module imports is shared and keeps its names.

pub(crate) mod carry;
mod compose;
mod cut;
mod found;
mod own;
mod reads;
mod roles;
mod slice;
mod types;

pub(crate) use compose::{Carrying, compose};
pub(crate) use cut::{Cut, Reduction};
pub(crate) use reads::updated;
pub(crate) use slice::slice;

use model::Loader;
use syntax::{Diagnostic, SourceFile, Sources};

use crate::chart::Chart;
use crate::system::System;

/// Finds the machines of a chart's system, and composes what they compute. The chart's imports of machines are taken out of its imports:
/// a machine becomes a part of its component instead of being imported.
pub(crate) fn compute(
    root: &SourceFile,
    chart: &mut Chart,
    sources: &mut Sources,
    loader: &mut dyn Loader,
) -> Vec<Diagnostic> {
    let Some(system) = &chart.system else { return Vec::new() };
    if !says_anything(system) {
        return Vec::new();
    }
    let mut faults = roles::misplaced(system);
    let (mut found, unfound) = found::find(root, system, chart, sources, loader);
    faults.extend(unfound);
    let phases = || system.components.iter().flat_map(|component| &component.phases);
    let is_machine = |import: &str| {
        phases().filter_map(|phase| phase.machine.as_ref()).any(|machine| machine.text == found::stem(import))
    };
    let kept: Vec<bool> = chart.imports.iter().map(|import| !is_machine(import)).collect();
    let mut keeps = kept.iter();
    chart.imports.retain(|_| *keeps.next().unwrap_or(&true));
    let mut keeps = kept.iter();
    chart.places.retain(|_| *keeps.next().unwrap_or(&true));
    let Some(system) = &chart.system else { return faults };
    let (types, unknown) = types::types(root, chart, system, loader);
    faults.extend(unknown);
    if faults.is_empty() {
        for machine in &mut found {
            faults.extend(roles::assign(system, machine, &types));
        }
        faults.extend(roles::doubled(system, &found));
    }
    if faults.is_empty() {
        let contents = types.iter().map(|(name, carried)| (name.clone(), carried.content.clone())).collect();
        let computing = compose(system, found, contents, Carrying::ByNumber);
        if let Some(system) = &mut chart.system {
            system.computing = computing;
        }
    }
    faults
}

/// Whether a system says what its components compute, or what its channels carry.
fn says_anything(system: &System) -> bool {
    let phases = system.components.iter().flat_map(|component| &component.phases);
    phases.into_iter().any(|phase| phase.machine.is_some())
        || system.channels.iter().any(|channel| channel.message.is_some())
        || system.devices.iter().any(|device| device.message.is_some())
}
