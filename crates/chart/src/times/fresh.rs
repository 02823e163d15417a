//! How long a reader waits for something new, at most, bounded without a search.
//!
//! In: a system, and the responses of its tasks. Out: for each reading with a bound, the longest time between two readings that bring
//! something new. What is written is there for each reading that begins later. So the time is that until the next writing is done, and from
//! then until the next reading begins; a periodic reader begins on its grid. The verification of small systems is held to it in tests.
//! INVARIANT: nothing is given where a task may leave out an access.

use super::Analysis;
use super::ages::Chain;
use crate::system::{Action, FreshBound, Phase, System};

/// How long a reader waits for something new.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fresh {
    /// The index of the reading component.
    pub component: usize,
    /// The index of the phase.
    pub phase: usize,
    /// The longest time, in ticks.
    pub most: Option<u64>,
    /// Why there is none.
    pub reason: Option<String>,
}

/// A reading with a bound: where it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) component: usize,
    pub(super) phase: usize,
    pub(super) channel: usize,
}

/// The readings that have to bring something new now and then, in the order of the chart.
pub fn bounded(system: &System) -> impl Iterator<Item = (&Phase, &FreshBound)> {
    readings(system).map(|(reading, _)| reading)
}

pub(super) fn readings(system: &System) -> impl Iterator<Item = ((&Phase, &FreshBound), Place)> {
    system.components.iter().enumerate().flat_map(|(component, one)| {
        one.phases.iter().enumerate().filter_map(move |(at, phase)| match (&phase.action, &phase.fresh) {
            (Action::Read(channel), Some(bound)) => {
                Some(((phase, bound), Place { component, phase: at, channel: *channel }))
            }
            _ => None,
        })
    })
}

/// The longest times of all readings with bounds.
pub(super) fn fresh(system: &System, analysis: &Analysis<'_>) -> Vec<Fresh> {
    let each = |(_, place): ((&Phase, &FreshBound), Place)| {
        let (most, reason) = match longest(system, analysis, place) {
            Ok(most) => (Some(most), None),
            Err(reason) => (None, Some(reason)),
        };
        Fresh { component: place.component, phase: place.phase, most, reason }
    };
    readings(system).map(each).collect()
}

fn longest(system: &System, analysis: &Analysis<'_>, place: Place) -> Result<u64, String> {
    let chain = Chain::new(system, analysis);
    let (reader, writer) = (place.component, system.channels[place.channel].from);
    let least = |component: usize, phases: std::ops::Range<usize>| -> u64 {
        system.components[component].phases[phases].iter().map(|phase| phase.least).sum()
    };
    let written =
        system.components[writer].phases.iter().position(|phase| phase.action == Action::Write(place.channel));
    // From the end of a writing, or later, to that of the next one.
    let until_written = chain.gap(writer)? + chain.response(writer)? - least(writer, 0..written.unwrap_or(0));
    let response = chain.response(reader)?;
    if analysis.starts_by(place.channel) {
        // It begins when the datum comes, or when the cycle before is over.
        return Ok(until_written + 2 * response + 1);
    }
    // When a cycle reads, from its beginning on.
    let soonest = least(reader, 0..place.phase);
    let latest = response - least(reader, place.phase + 1..system.components[reader].phases.len());
    let varies = latest.saturating_sub(soonest);
    let gap = chain.gap(reader)?;
    let any = until_written + gap + response - soonest;
    Ok(match system.components[reader].timing.period() {
        // The last reading before the datum is there begins no later than it.
        Some(period) => any.min(((until_written + varies) / period + 1) * period + varies),
        None => any,
    })
}
