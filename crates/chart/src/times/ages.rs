//! How old data get on their ways through a system, bounded without a search.
//!
//! In: a system with age bounds, and the responses of its tasks. Out: for each bound its ways, and the greatest age that is possible on
//! each. For periodic tasks, the age grows by a period and a response with each task, and by a response in the last one: A. Davare, Q. Zhu,
//! M. Di Natale, C. Pinello, S. Kanajan, A. Sangiovanni-Vincentelli, *Period Optimization for Hard Real-time Distributed Automotive
//! Systems* (2007). What is added for asynchronous tasks, queues, and results that wait for the next cycle is reasoned here; the
//! verification of small systems is held to it in tests. INVARIANT: no age is given where a task may leave out an access.

use super::Analysis;
use crate::system::{Action, AgeBound, ChannelKind, Needs, System, Timing};
use crate::ways::{accessed, prepared, ways};

/// The greatest age that a bound is about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Age {
    /// On all ways, in ticks; none if one of them has none.
    pub most: Option<u64>,
    /// No run has an age below: the least one of the way that takes longest.
    pub least: Option<u64>,
    /// The ways, in the order of the chart's channels.
    pub ways: Vec<Way>,
}

/// A way that data take.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Way {
    /// The indices of the channels; none where one component has both ends.
    pub channels: Vec<usize>,
    /// The index of the component in which it begins.
    pub first: usize,
    /// The greatest age at its end, in ticks.
    pub most: Option<u64>,
    /// Why there is none.
    pub reason: Option<String>,
}

/// The ages of all bounds.
pub(super) fn ages(system: &System, analysis: &Analysis<'_>) -> Vec<Age> {
    let chain = Chain::new(system, analysis);
    let each = |bound: &AgeBound| {
        let ways: Vec<Way> = ways(system, bound)
            .into_iter()
            .map(|(first, channels)| {
                let age = chain.age(first, &channels);
                let (most, reason) = match age {
                    Ok(most) => (Some(most), None),
                    Err(reason) => (None, Some(reason)),
                };
                Way { channels, first, most, reason }
            })
            .collect();
        let most = ways.iter().map(|way| way.most).collect::<Option<Vec<u64>>>();
        let least = ways.iter().map(|way| least(system, way.first, &way.channels)).max();
        Age { most: most.and_then(|all| all.into_iter().max()), least, ways }
    };
    system.bounds.iter().map(each).collect()
}

/// The age on a way where nothing ever waits: what a datum takes through the phases, from the beginning of the first cycle to the end of
/// the last one.
fn least(system: &System, first: usize, channels: &[usize]) -> u64 {
    let mut age = 0;
    let mut at = first;
    let mut entered = 0;
    for channel in channels {
        let written = accessed(system, at, &Action::Write(*channel)).unwrap_or(0);
        let phases = &system.components[at].phases;
        // A reader may have it as soon as the writing begins.
        age += phases.iter().take(written).skip(entered).map(|phase| phase.least).sum::<u64>();
        at = system.channels[*channel].to;
        entered = accessed(system, at, &Action::Read(*channel)).unwrap_or(0);
    }
    age + system.components[at].phases.iter().skip(entered).map(|phase| phase.least).sum::<u64>()
}

pub(super) struct Chain<'a> {
    pub(super) system: &'a System,
    pub(super) analysis: &'a Analysis<'a>,
    /// Of each component, the longest time between the beginnings of two cycles that follow each other, or why none is known.
    gaps: Vec<Result<u64, String>>,
}

impl<'a> Chain<'a> {
    pub(super) fn new(system: &'a System, analysis: &'a Analysis<'a>) -> Chain<'a> {
        let count = system.components.len();
        let circle =
            |component: &crate::system::Component| Err(format!("{} awaits what rests on its own data", component.name));
        let mut chain = Chain { system, analysis, gaps: system.components.iter().map(circle).collect() };
        // Each round knows the gaps of tasks that are a writer further from the periodic ones.
        for _ in 0..=count {
            chain.gaps = (0..count).map(|component| chain.gap_after(component)).collect();
        }
        chain
    }

    fn name(&self, component: usize) -> &str {
        &self.system.components[component].name
    }

    /// The longest cycle of a component, from its release or the arrival of what it awaits.
    pub(super) fn response(&self, component: usize) -> Result<u64, String> {
        if let Err(reason) = &self.analysis.blocking[component] {
            return Err(format!("{}: {reason}", self.name(component)));
        }
        let response = self.analysis.responses[component];
        let response = response.ok_or_else(|| format!("no longest response of {} is known", self.name(component)))?;
        match self.system.components[component].available() {
            Some(available) if response > available => {
                Err(format!("{} may leave out an access to keep its deadline", self.name(component)))
            }
            _ => Ok(response),
        }
    }

    /// The longest time between the beginnings of two cycles that follow each other.
    pub(super) fn gap(&self, component: usize) -> Result<u64, String> {
        self.gaps[component].clone()
    }

    /// The same, by what is known of the writers of what it awaits.
    fn gap_after(&self, component: usize) -> Result<u64, String> {
        let response = self.response(component)?;
        let awaits = match &self.system.components[component].timing {
            Timing::Synchronous { period, .. } => return Ok(*period),
            Timing::Asynchronous { awaits } if awaits.channels.is_empty() => return Ok(response + 1),
            Timing::Asynchronous { awaits } => awaits,
        };
        // From a cycle's end on, something new comes on a channel when its writer begins again and is done.
        let comes = |channel: &usize| {
            let writer = self.system.channels[*channel].from;
            Ok(self.gap(writer)? + self.response(writer)?)
        };
        let mut times = awaits.channels.iter().map(comes);
        let comes = match awaits.needs {
            Needs::All => {
                times.try_fold(0, |longest, time: Result<u64, String>| Ok::<u64, String>(longest.max(time?)))?
            }
            // The first that is known will do; one of the others may come sooner.
            Needs::Any => {
                let all: Vec<Result<u64, String>> = times.collect();
                match all.iter().flatten().min() {
                    Some(shortest) => *shortest,
                    None => all.into_iter().find_map(Result::err).map_or(Ok(0), Err)?,
                }
            }
        };
        Ok(response + 1 + comes)
    }

    fn age(&self, first: usize, channels: &[usize]) -> Result<u64, String> {
        // How old what a component reads is, at most, whenever it reads.
        let mut age = 0;
        let mut at = first;
        let mut by = None;
        for channel in channels {
            age += self.waits(at, by, Some(*channel))?;
            let response = self.response(at)?;
            // A component that awaits the data themselves begins as soon as they come, or when its cycle is over.
            let follows = by.is_some_and(|by| self.analysis.starts_by(by));
            age += match self.system.components[at].timing {
                Timing::Asynchronous { .. } if follows => 2 * response + 1,
                _ => self.gap(at)? + response,
            };
            at = self.system.channels[*channel].to;
            by = Some(*channel);
            if let ChannelKind::Queue { capacity } = self.system.channels[*channel].kind {
                // A sender that never waits for room comes no more often than its periodic reader: what lies before a message is
                // what came late, and is taken late.
                let late = match self.system.components[self.system.channels[*channel].from].timing {
                    Timing::Synchronous { .. } => response,
                    Timing::Asynchronous { .. } => 0,
                };
                let gap = self.gap(at)?;
                age += capacity.saturating_mul(gap).min(gap + self.response(at)? + late);
            }
        }
        Ok(age + self.waits(at, by, None)? + self.response(at)?)
    }

    /// What is read after the elaboration waits for the next one; what is written before it, for the next cycle.
    fn waits(&self, component: usize, read: Option<usize>, write: Option<usize>) -> Result<u64, String> {
        let written = write.and_then(|channel| accessed(self.system, component, &Action::Write(channel)));
        let read = read.and_then(|channel| accessed(self.system, component, &Action::Read(channel)));
        let taken = prepared(self.system, component, written);
        let later =
            |early: Option<usize>, late: Option<usize>| early.zip(late).is_some_and(|(early, late)| early > late);
        let cycles = match taken {
            Some(_) => u64::from(later(read, taken)) + u64::from(later(taken, written)),
            None => u64::from(later(read, written)),
        };
        Ok(if cycles == 0 { 0 } else { cycles * self.gap(component)? })
    }
}
