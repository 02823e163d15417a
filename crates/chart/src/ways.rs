//! The ways that data take through a system, from one end of an age bound to the other.
//!
//! In: a system without errors. Out: its ways as lists of channels; where a component decides what it writes, and when it reads and writes
//! in a cycle. It must not know how long anything takes.

use crate::system::{Action, AgeBound, System};

/// LIMIT: the most ways of one bound.
pub(crate) const WAYS: usize = 64;

/// The components at one end of a bound: the named one, or those that are connected with the named device.
pub(crate) fn ends(system: &System, name: &str) -> Vec<usize> {
    let index = |name: &str| system.components.iter().position(|component| component.name == name);
    if let Some(component) = index(name) {
        return vec![component];
    }
    let connected = system.connections.iter().filter_map(|(from, to)| match (from == name, to == name) {
        (true, _) => index(to),
        (_, true) => index(from),
        _ => None,
    });
    let mut all: Vec<usize> = connected.collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The ways of a bound, each through a component at most once: the first component and the channels. At most [`WAYS`] and one more.
pub(crate) fn ways(system: &System, bound: &AgeBound) -> Vec<(usize, Vec<usize>)> {
    let all = all_ways(system, bound);
    match bound.way {
        Some(number) => all.into_iter().skip(number).take(1).collect(),
        None => all,
    }
}

fn all_ways(system: &System, bound: &AgeBound) -> Vec<(usize, Vec<usize>)> {
    let last = ends(system, &bound.to.text);
    let mut found = Vec::new();
    for first in ends(system, &bound.from.text) {
        let mut open = vec![(vec![first], Vec::new())];
        while let Some((through, channels)) = open.pop() {
            if found.len() > WAYS {
                return found;
            }
            let at = through.last().copied().unwrap_or(first);
            if last.contains(&at) {
                found.push((first, channels.clone()));
            }
            for (number, channel) in system.channels.iter().enumerate().rev() {
                if channel.from == at && !through.contains(&channel.to) {
                    let (mut through, mut channels) = (through.clone(), channels.clone());
                    through.push(channel.to);
                    channels.push(number);
                    open.push((through, channels));
                }
            }
        }
    }
    found
}

/// Where a component takes what it has read for what it writes or sets: the index of the elaboration, if it has any.
pub(crate) fn prepared(system: &System, component: usize, written: Option<usize>) -> Option<usize> {
    let phases = &system.components[component].phases;
    let elaborations = || {
        phases.iter().enumerate().filter(|(_, phase)| matches!(phase.action, Action::Elaborate(_))).map(|(at, _)| at)
    };
    match written {
        Some(written) => elaborations().rfind(|at| *at < written).or(elaborations().next_back()),
        None => elaborations().next_back(),
    }
}

/// A way, and where its components decide what goes on: by the index of an elaboration, if there is any.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Followed {
    /// The component in which it begins.
    pub first: usize,
    /// The channels, and where the writer of each decides what it writes.
    pub hops: Vec<(usize, Option<usize>)>,
    /// The component at its end.
    pub end: usize,
    /// Where that one decides.
    pub decided: Option<usize>,
}

/// The ways of a bound, as the model follows them.
pub fn followed(system: &System, bound: &AgeBound) -> Vec<Followed> {
    let each = |(first, channels): (usize, Vec<usize>)| {
        let end = channels.last().map_or(first, |channel| system.channels[*channel].to);
        let hop = |channel: usize| {
            let writer = system.channels[channel].from;
            (channel, prepared(system, writer, accessed(system, writer, &Action::Write(channel))))
        };
        let hops = channels.into_iter().map(hop).collect();
        Followed { first, hops, end, decided: prepared(system, end, None) }
    };
    ways(system, bound).into_iter().map(each).collect()
}

/// The index of the phase in which a component reads or writes a channel.
pub(crate) fn accessed(system: &System, component: usize, action: &Action) -> Option<usize> {
    system.components[component].phases.iter().position(|phase| phase.action == *action)
}
