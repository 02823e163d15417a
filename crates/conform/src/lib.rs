//! Checks whether a running program did what its ground model says: the machine replays its recorded events.
//!
//! In: a checked model over the library of patterns, and a [`Recording`] of the program's events (spec/conform.md),
//! whole or still being written. Out of a [`Session`]: a [`Verdict`]. The changes of a machine's step show which events
//! the tasks have in it (`claims`); these and the recorded ones must be the same. In virtual time that follows the
//! model, each tick is a step of the main rule (`timed`). In any other time one task steps at a time, in an order that
//! agrees with the recorded instants (`untimed`, `single`). What components' machines decide is replayed apart (`functions`, `ends`). The meaning of a rule
//! stays in the machine; a run that was not wholly recorded never conforms.

mod accesses;
mod apart;
mod bounds;
mod carried;
mod claims;
mod elaborated;
mod ends;
mod events;
mod evidence;
mod fault;
mod functions;
mod head;
mod kept;
mod order;
mod refusal;
mod session;
mod single;
mod steps;
mod timed;
mod untimed;
mod vocabulary;
mod waiting;
mod way;

pub use accesses::Access;
pub use bounds::Open;
pub use events::Events;
pub use evidence::{Claim, Parted, Recorded};
pub use fault::{IDS as FAULT_IDS, diagnose_parted};
pub use recording::{Decision, Event, Kind, Malformed, Reader, Recording, Rhythm, Track};
pub use refusal::Refusal;
pub use session::Session;
pub use way::Way;

/// The result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// All events, until the tasks were asked to stop, are those of a run of the model.
    Conforms {
        /// How many events there were.
        events: usize,
        /// How many steps the machine made.
        steps: u64,
        /// How many events came after the tasks had been asked to stop; these are not compared.
        after: usize,
    },
    /// The program and the model differ.
    Parts(Box<Parted>),
    /// It is not known, from some event on.
    Unknown {
        /// How many events agreed before.
        events: usize,
        /// Why.
        reason: String,
    },
}

impl Verdict {
    /// The same, of a run that went on when whoever read along left.
    pub fn left(self) -> Verdict {
        match self {
            Verdict::Unknown { events, .. } => {
                Verdict::Unknown { events, reason: "the run went on when following it was ended".to_string() }
            }
            other => other,
        }
    }
}
