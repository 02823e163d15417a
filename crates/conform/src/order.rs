//! When the recorded actions were taken, as far as the recorded instants say.
//!
//! In: a task's events. Out: between which instants each next action lies. An action was taken between the event before
//! it and the one after it. An event that is recorded before its action (asks, releases, sends, stores) narrows the
//! beginning; one recorded after it (enters, takes) narrows the end. A beginning and what is done with it are one
//! action. But a task that is woken by data was woken before it recorded that it begins.

use recording::{Event, Kind};

use crate::vocabulary::Wakes;
use crate::waiting::Waited;

/// LIMIT: this many events of another task are searched for one that may have come before.
const NEAR: usize = 64;

/// A task's events, as far as they are known, and its position in them.
#[derive(Debug, Default)]
pub struct Lane {
    pub events: Vec<Event>,
    pub place: Place,
    /// For a task that data wake: by which.
    pub wakes: Option<Wakes>,
}

/// A task's position.
#[derive(Debug, Clone, Copy, Default)]
pub struct Place {
    /// Its next event.
    pub cursor: usize,
    /// Its last tick: its clock does not go back.
    pub tick: i64,
    /// What its cycle has spent waiting.
    pub waited: Waited,
    /// The data came for which the next event begins a cycle.
    pub woken: bool,
}

/// Between which instants an action was taken.
#[derive(Debug, Clone, Copy)]
pub struct Span {
    pub from_ns: i64,
    pub to_ns: i64,
}

impl Lane {
    /// The next event.
    pub fn next(&self) -> Option<&Event> {
        self.events.get(self.place.cursor)
    }

    /// The event before the next one.
    pub fn last(&self) -> Option<&Event> {
        self.place.cursor.checked_sub(1).map(|last| &self.events[last])
    }

    /// What must have woken the task before the next event.
    pub fn awaits(&self) -> Option<&Wakes> {
        let wakes = self.wakes.as_ref()?;
        let begins = self.next().is_some_and(|next| next.kind == Kind::Begins && next.object == wakes.first);
        (begins && !self.place.woken).then_some(wakes)
    }

    /// The event of the task's next action: the one that comes with a beginning, otherwise the next one.
    fn acts(&self) -> usize {
        let at = self.place.cursor;
        match (self.events.get(at), self.events.get(at + 1)) {
            (Some(event), Some(next))
                if event.kind == Kind::Begins
                    && matches!(next.kind, Kind::Asks | Kind::Takes | Kind::Loads | Kind::Writes) =>
            {
                at + 1
            }
            _ => at,
        }
    }

    /// Between which instants the next action was taken. While `more` may come it is not known with what a beginning comes.
    pub fn span(&self, more: bool) -> Option<Span> {
        let event = self.next()?;
        let before_ns = self.last().map_or(i64::MIN, |before| before.time_ns);
        if self.awaits().is_some() {
            return Some(Span { from_ns: before_ns, to_ns: event.time_ns });
        }
        let acts = self.acts();
        let action = &self.events[acts];
        let is_last = more && self.place.cursor + 1 == self.events.len();
        let told_before =
            matches!(action.kind, Kind::Asks | Kind::Releases | Kind::Sends | Kind::Stores | Kind::Refuses);
        let from_ns = if told_before || acts > self.place.cursor || is_last { event.time_ns } else { before_ns };
        let to_ns =
            if told_before { self.events.get(acts + 1).map_or(i64::MAX, |next| next.time_ns) } else { action.time_ns };
        Some(Span { from_ns, to_ns })
    }

    /// The channels that the next action depends on: several, if it is that they wake the task.
    pub fn channels(&self) -> Vec<&str> {
        if let Some(wakes) = self.awaits() {
            return wakes.channels.iter().map(|channel| &**channel).collect();
        }
        let action = self.events.get(self.acts()).filter(|action| !is_local(action.kind));
        action.map(|action| &*action.object).into_iter().collect()
    }

    /// Whether the task acts on a channel perhaps before that instant.
    pub fn may_act_on(&self, channel: &str, until_ns: i64) -> bool {
        let mut before_ns = self.last().map_or(i64::MIN, |before| before.time_ns);
        for event in self.events[self.place.cursor..].iter().take(NEAR) {
            // An action is taken after the event before it, whenever its own event is recorded.
            if before_ns > until_ns {
                return false;
            }
            let awaits = |wakes: &Wakes| wakes.channels.iter().any(|awaited| **awaited == *channel);
            let wakes = self.wakes.as_ref().is_some_and(|wakes| event.object == wakes.first && awaits(wakes));
            if wakes || *event.object == *channel {
                return true;
            }
            before_ns = event.time_ns;
        }
        false
    }
}

/// Whether it concerns no other task.
fn is_local(kind: Kind) -> bool {
    matches!(kind, Kind::Begins | Kind::Ends | Kind::Passes | Kind::Meets | Kind::Misses | Kind::Invalid | Kind::Faults)
}
