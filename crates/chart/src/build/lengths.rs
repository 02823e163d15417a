//! How long elaborations take in the model that verifies a system.
//!
//! In: a system without what elaborations compute. Out: the same with other times, and which components may take any time.

use std::collections::BTreeSet;

use super::observed;
use crate::system::{Action, AgeBound, Component, System};
use crate::ways::ways;

/// How long the elaborations of asynchronous components take in the model that verifies a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lengths {
    /// As long as the chart says.
    AsDrawn,
    /// Any time, but not for ever, if the time of any elaboration varies. Each run of the system is such a run, and the states are far
    /// fewer. If all times are fixed, there is only one run.
    Any,
    /// As drawn on one way of an age bound, any time beside it; of the age bounds only that of this way. Each run of the system is such a
    /// run, with the same ages on this way.
    AnyBeside {
        /// The number of the bound.
        bound: usize,
        /// That of the way.
        way: usize,
    },
}

impl Lengths {
    /// Makes the elaborations of a system that long; returns the components whose elaborations may take any time, with these.
    pub(super) fn free(self, system: &mut System) -> Vec<(String, Vec<String>)> {
        let free = match self {
            Lengths::AsDrawn => Vec::new(),
            Lengths::Any => set_free(system, &|_| true),
            Lengths::AnyBeside { bound, way } => {
                let bound = AgeBound { way: Some(way), ..system.bounds[bound].clone() };
                let through = components(system, &bound);
                system.bounds = vec![bound];
                set_free(system, &|component| !through.contains(&component))
            }
        };
        // How old data are says nothing where elaborations on their way take any time.
        let is_any = !free.is_empty() && self == Lengths::Any;
        if is_any {
            system.bounds.clear();
        }
        if is_any || matches!(self, Lengths::AnyBeside { .. }) {
            observed::without_fresh(system);
        }
        free
    }
}

/// The components on the ways of a bound.
fn components(system: &System, bound: &AgeBound) -> BTreeSet<usize> {
    let channel = |channel: usize| [system.channels[channel].from, system.channels[channel].to];
    let through = |(first, channels): (usize, Vec<usize>)| channels.into_iter().flat_map(channel).chain([first]);
    ways(system, bound).into_iter().flat_map(through).collect()
}

/// Lets asynchronous components elaborate for any time; returns these, with their elaborations.
fn set_free(system: &mut System, is_asked: &dyn Fn(usize) -> bool) -> Vec<(String, Vec<String>)> {
    let mut free = Vec::new();
    if !varies(system) {
        return free;
    }
    let asynchronous =
        |(index, component): &(usize, &mut Component)| component.timing.period().is_none() && is_asked(*index);
    for (_, component) in system.components.iter_mut().enumerate().filter(asynchronous) {
        let elaborations = component.phases.iter_mut().filter(|phase| matches!(phase.action, Action::Elaborate(_)));
        let phases: Vec<String> = elaborations.map(|phase| (phase.least = 0, phase.name.clone()).1).collect();
        if !phases.is_empty() {
            free.push((component.name.clone(), phases));
        }
    }
    free
}

/// Whether the time of some elaboration varies.
pub(super) fn varies(system: &System) -> bool {
    system.components.iter().flat_map(|component| &component.phases).any(|phase| phase.least < phase.time)
}
