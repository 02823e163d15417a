//! One event of a task: what happened, to what, and when.
//!
//! The kinds are those of spec/conform.md, in its order. Each has one word, which recordings and messages use.

use std::fmt;
use std::sync::Arc;

/// One event of a task, as spec/conform.md lists them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Event {
    /// Since the origin of the run.
    pub time_ns: i64,
    /// What happened.
    pub kind: Kind,
    /// The phase, channel or component. Events of one recording that name the same share the text.
    pub object: Arc<str>,
    /// The number of the datum, message or cycle.
    pub number: u64,
    /// The array worked on; of a swap the index read.
    pub array: Option<u64>,
    /// Of a swap the index written.
    pub next: Option<u64>,
    /// Of a reading, whether it brought something new.
    pub fresh: Option<bool>,
}

/// A value that a component's machine got or decided.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decision {
    /// Since the origin of the run.
    pub time_ns: i64,
    /// It was got; otherwise it was decided.
    pub is_got: bool,
    /// The channel, sensor or actuator.
    pub object: Arc<str>,
    /// Of a tuple, which of its parts, from 0 on; parts that are tuples are counted by theirs.
    pub part: u64,
    /// The bits of the value: 0 or 1, the place of a literal, a number.
    pub bits: u64,
    /// There is a value.
    pub known: bool,
    /// Of what is got from a channel, whether it was new.
    pub fresh: bool,
    /// How many events the task recorded before.
    pub events: usize,
}

impl Decision {
    /// What was got or decided, in words: `decides motor`.
    pub fn words(&self) -> String {
        format!("{} {}", if self.is_got { "gets" } else { "decides" }, self.object)
    }
}

/// What happened.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Kind {
    /// A phase.
    #[default]
    Begins,
    /// A phase.
    Ends,
    /// A writing was skipped: there was nothing to hand over.
    Passes,
    /// Wants the lock.
    Asks,
    /// Has the lock.
    Enters,
    /// The watchdog ended before the lock came.
    GivesUp,
    /// The lock.
    Releases,
    /// The indexes of a buffer.
    Swaps,
    /// Begins to write into an array.
    Writes,
    /// Begins to read from an array.
    Reads,
    /// A message.
    Sends,
    /// A message.
    Takes,
    /// The queue stayed full.
    Refuses,
    /// A shared value.
    Stores,
    /// A shared value.
    Loads,
    /// A datum was not handed over.
    Invalid,
    /// The deadline.
    Meets,
    /// The deadline.
    Misses,
    /// The hook threw.
    Faults,
}

impl Kind {
    /// All of them, in the order of the table.
    pub const ALL: &[Kind] = &[
        Kind::Begins,
        Kind::Ends,
        Kind::Passes,
        Kind::Asks,
        Kind::Enters,
        Kind::GivesUp,
        Kind::Releases,
        Kind::Swaps,
        Kind::Writes,
        Kind::Reads,
        Kind::Sends,
        Kind::Takes,
        Kind::Refuses,
        Kind::Stores,
        Kind::Loads,
        Kind::Invalid,
        Kind::Meets,
        Kind::Misses,
        Kind::Faults,
    ];

    /// The kind of that word.
    pub fn of(word: &str) -> Option<Kind> {
        Kind::ALL.iter().find(|kind| kind.word() == word).copied()
    }

    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Kind::Begins => "begins",
            Kind::Ends => "ends",
            Kind::Passes => "passes",
            Kind::Asks => "asks",
            Kind::Enters => "enters",
            Kind::GivesUp => "gives_up",
            Kind::Releases => "releases",
            Kind::Swaps => "swaps",
            Kind::Writes => "writes",
            Kind::Reads => "reads",
            Kind::Sends => "sends",
            Kind::Takes => "takes",
            Kind::Refuses => "refuses",
            Kind::Stores => "stores",
            Kind::Loads => "loads",
            Kind::Invalid => "invalid",
            Kind::Meets => "meets",
            Kind::Misses => "misses",
            Kind::Faults => "faults",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl Event {
    /// Whether both say the same, whenever they happen.
    pub fn same(&self, other: &Event) -> bool {
        let key = |event: &Event| (event.kind, event.number, event.array, event.next, event.fresh);
        key(self) == key(other) && self.object == other.object
    }

    /// The event in words: `writes camera_to_vs, number 3, array 1`.
    pub fn words(&self) -> String {
        let nothing = self.number == 0 && matches!(self.kind, Kind::Reads | Kind::Takes | Kind::Loads);
        let mut text = match nothing {
            true => format!("finds {} empty", self.object),
            false => format!("{} {}", self.kind, self.object),
        };
        match self.kind {
            _ if nothing => {}
            Kind::Begins | Kind::Ends | Kind::Passes | Kind::Meets | Kind::Misses | Kind::Faults => {
                text += &format!(", cycle {}", self.number);
            }
            Kind::Asks | Kind::Enters | Kind::GivesUp | Kind::Releases | Kind::Refuses | Kind::Invalid => {}
            Kind::Swaps | Kind::Writes | Kind::Reads | Kind::Sends | Kind::Takes | Kind::Stores | Kind::Loads => {
                text += &format!(", number {}", self.number)
            }
        }
        for (name, value) in [("array", self.array), ("next", self.next)] {
            if let Some(value) = value {
                text += &format!(", {name} {value}");
            }
        }
        match self.fresh {
            // Nothing is not new anyway.
            Some(false) if nothing => {}
            Some(true) => text += ", new",
            Some(false) => text += ", not new",
            None => {}
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words() {
        let check = |kind: Kind, number: u64, fresh: Option<bool>, expect: &str| {
            let event = Event { kind, number, fresh, object: "codes".into(), ..Event::default() };
            assert_eq!(event.words(), expect);
        };
        check(Kind::Takes, 3, None, "takes codes, number 3");
        check(Kind::Takes, 0, None, "finds codes empty");
        check(Kind::Loads, 0, Some(false), "finds codes empty");
        check(Kind::Reads, 2, Some(false), "reads codes, number 2, not new");
        check(Kind::Stores, 0, None, "stores codes, number 0");
        check(Kind::Begins, 0, None, "begins codes, cycle 0");
    }
}
