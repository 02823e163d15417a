//! One order of the events of all tasks in which every channel takes them: looked for among all that the instants allow.
//!
//! In: the tasks' events, each of which is right by itself. Out: nothing, or that there is none. An event lies between the
//! instant of the one before it in its task and its own; one that is told before it is done, between its own and that of the
//! one after it. Nothing is left out of the search: what was looked at once is not looked at again, that is all.

use std::collections::BTreeSet;

use chart::system::{Needs, Timing};
use recording::{Event, Kind};

use super::channel::Channel;
use super::{Plan, told_before};

/// LIMIT: a search that looks at more than this is a fault of the judge, not of the log.
const MOST: usize = 2_000_000;

pub(super) struct Search<'a> {
    plan: &'a Plan<'a>,
    tracks: &'a [&'a [Event]],
    /// By task, how many events come before the stop.
    ends: Vec<usize>,
}

/// How far all tasks have come, and what their channels have come to.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct State {
    cursors: Vec<usize>,
    channels: Vec<Channel>,
}

impl<'a> Search<'a> {
    pub(super) fn new(plan: &'a Plan<'a>, tracks: &'a [&'a [Event]], stopped_ns: i64) -> Search<'a> {
        let ends = tracks.iter().map(|events| events.partition_point(|event| event.time_ns < stopped_ns)).collect();
        Search { plan, tracks, ends }
    }

    pub(super) fn run(&self) -> Result<(), String> {
        let channels = self.plan.system.channels.iter().enumerate();
        let channels = channels.map(|(index, channel)| Channel::new(self.plan.form(index), channel.from)).collect();
        let mut open = vec![State { cursors: vec![0; self.tracks.len()], channels }];
        let mut seen = BTreeSet::new();
        while let Some(state) = open.pop() {
            if state.cursors == self.ends {
                return Ok(());
            }
            if seen.len() > MOST {
                return Err("the judge came to no end".to_string());
            }
            if !seen.insert(state.clone()) {
                continue;
            }
            open.extend(self.after(&state));
        }
        Err("no order of the events fits".to_string())
    }

    /// The states after one more event. An event that no other task has to do with is taken at once, where there is one.
    fn after(&self, state: &State) -> Vec<State> {
        let next = |lane: usize| (state.cursors[lane] < self.ends[lane]).then(|| self.span(lane, state.cursors[lane]));
        let spans: Vec<Option<(i64, i64)>> = (0..self.tracks.len()).map(next).collect();
        let first_ns = spans.iter().flatten().map(|(_, to_ns)| *to_ns).min().unwrap_or(i64::MAX);
        let mut states = Vec::new();
        for (lane, span) in spans.iter().enumerate() {
            if span.is_none_or(|(from_ns, _)| from_ns > first_ns) {
                continue;
            }
            let event = &self.tracks[lane][state.cursors[lane]];
            let mut state = state.clone();
            state.cursors[lane] += 1;
            match self.plan.channel(&event.object).filter(|_| event.kind != Kind::Invalid) {
                Some(channel) => {
                    let end = usize::from(self.plan.system.channels[channel].from != lane);
                    if state.channels[channel].take(end, event) {
                        states.push(state);
                    }
                }
                None if self.is_woken(lane, event, &state) => return vec![state],
                None => {}
            }
        }
        states
    }

    /// A cycle of an asynchronous task begins when there are data; once there are, they stay.
    fn is_woken(&self, lane: usize, event: &Event, state: &State) -> bool {
        let component = &self.plan.system.components[lane];
        let is_first = component.phases.first().is_some_and(|first| *first.name == *event.object);
        match &component.timing {
            Timing::Asynchronous { awaits } if event.kind == Kind::Begins && is_first => {
                let mut channels = awaits.channels.iter().map(|channel| state.channels[*channel].wakes());
                match awaits.needs {
                    Needs::All => channels.all(|wakes| wakes),
                    Needs::Any => channels.any(|wakes| wakes),
                }
            }
            Timing::Asynchronous { .. } | Timing::Synchronous { .. } => true,
        }
    }

    /// Between which instants an event lies.
    fn span(&self, lane: usize, at: usize) -> (i64, i64) {
        let events = self.tracks[lane];
        let own_ns = events[at].time_ns;
        if told_before(events[at].kind) {
            (own_ns, events.get(at + 1).map_or(i64::MAX, |next| next.time_ns))
        } else {
            (at.checked_sub(1).map_or(i64::MIN, |before| events[before].time_ns), own_ns)
        }
    }
}
