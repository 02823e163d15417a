//! Whether decisions were recorded where they belong: one in each elaboration.
//!
//! In: the events of a task, and the decisions among them, one after the other. Out: why a decision belongs to no elaboration, or an
//! elaboration has none. Values are not looked at.

use recording::{Decision, Event, Kind};

/// The elaborations of a task that decides in them, as far as its events have been walked over.
#[derive(Debug, Default)]
pub(crate) struct Elaborated {
    phase: String,
    /// How many events have been walked over, and how often the elaboration began and ended in them.
    events: usize,
    begun: usize,
    ended: usize,
    /// How many decisions there were.
    decided: usize,
}

impl Elaborated {
    /// Nothing has been seen of the elaboration with this name.
    pub(crate) fn new(phase: &str) -> Elaborated {
        Elaborated { phase: phase.to_string(), ..Elaborated::default() }
    }

    /// Why the next decision, made of these records, was not recorded within an elaboration of its own, if it was not.
    pub(crate) fn misplaced(&mut self, events: &[Event], decision: &[Decision]) -> Option<String> {
        for record in decision {
            self.walk(events, record.events);
            if self.ended > self.decided {
                return Some(self.undecided());
            }
            if self.begun <= self.decided {
                let (phase, begun) = (&self.phase, times(self.begun));
                return Some(format!("decided {}, and had begun {phase} {begun}", times(self.decided + 1)));
            }
        }
        self.decided += 1;
        None
    }

    /// Why elaborations that have ended lack a decision, if some do and no more events come.
    pub(crate) fn lacks(&mut self, events: &[Event]) -> Option<String> {
        self.walk(events, events.len());
        (self.ended > self.decided).then(|| self.undecided())
    }

    fn walk(&mut self, events: &[Event], to: usize) {
        let new = events.get(self.events..to).unwrap_or_default();
        for event in new.iter().filter(|event| *event.object == *self.phase) {
            match event.kind {
                Kind::Begins => self.begun += 1,
                Kind::Ends => self.ended += 1,
                _ => {}
            }
        }
        self.events += new.len();
    }

    fn undecided(&self) -> String {
        let (phase, ended, decided) = (&self.phase, times(self.ended), times(self.decided));
        format!("ended {phase} {ended}, but what it decided is recorded {decided}")
    }
}

fn times(count: usize) -> String {
    match count {
        0 => "never".to_string(),
        1 => "once".to_string(),
        _ => format!("{count} times"),
    }
}
