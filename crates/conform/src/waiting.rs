//! How long a task's cycle has waited for locks and for room, by its events.
//!
//! In: the events at which a wait ended. Out: bounds of the waiting, which are compared with the model's watchdog: no
//! task takes a lock for which its cycle waited longer than the model allows, and none gives one up earlier. INVARIANT:
//! the time waited lies between the two bounds, whatever the clock.

use recording::{Event, Kind};

/// The time of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pace {
    /// Virtual, and each step of the model is a tick: a task that asks within a tick enters, or gives up, in another
    /// one.
    Modelled,
    /// Virtual: it stands still while a task computes, so instants are exact.
    Drawn,
    /// A task may be interrupted between an action and its event.
    Real,
}

impl Pace {
    /// The pace of that name.
    pub fn named(name: &str) -> Pace {
        match name {
            "modelled" => Pace::Modelled,
            "drawn" => Pace::Drawn,
            _ => Pace::Real,
        }
    }
}

/// LIMIT: in real time, a task is without its processor for at most this long between an action and its event.
pub const INTERRUPTED_NS: i64 = 1_000_000_000;

/// What a cycle has spent waiting.
#[derive(Debug, Clone, Copy, Default)]
pub struct Waited {
    cycle: u64,
    /// For locks that it then had.
    pub at_least_ns: i64,
    /// For locks and for room.
    pub at_most_ns: i64,
    /// When it began at the latest.
    began_ns: Option<i64>,
}

impl Waited {
    /// The time waited with one more event; `before` is the event before it.
    pub fn with(mut self, before: Option<&Event>, event: &Event, pace: Pace, tick_ns: i64) -> Waited {
        if event.kind == Kind::Begins && (event.number != self.cycle || self.began_ns.is_none()) {
            return Waited { cycle: event.number, began_ns: Some(event.time_ns), ..Waited::default() };
        }
        let Some(before) = before else { return self };
        let span_ns = event.time_ns - before.time_ns;
        let span_ns = if pace == Pace::Modelled { span_ns / tick_ns * tick_ns } else { span_ns };
        match event.kind {
            Kind::Enters => {
                let off_ns = if pace == Pace::Real { INTERRUPTED_NS } else { 0 };
                self.at_least_ns += (span_ns - off_ns).max(0);
                self.at_most_ns += span_ns;
            }
            Kind::GivesUp | Kind::Sends | Kind::Refuses => self.at_most_ns += span_ns,
            _ => {}
        }
        self
    }

    /// How much of the watchdog's time may have been used up, for a cycle that was due at an instant. In real time a
    /// program subtracts the time by which a cycle begins late; in virtual time it counts as its model does.
    pub fn spent_ns(&self, due_ns: Option<i64>, pace: Pace) -> i64 {
        let late_ns = match (pace, due_ns, self.began_ns) {
            (Pace::Real, Some(due_ns), Some(began_ns)) => began_ns.saturating_sub(due_ns).max(0),
            _ => 0,
        };
        self.at_most_ns.saturating_add(late_ns)
    }
}
