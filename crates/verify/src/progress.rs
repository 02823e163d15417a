//! The progress of a search, and why it ended early.

use machine::Cause;

/// How far a search is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Progress {
    /// States discovered.
    pub states: u64,
    /// Steps that change the state.
    pub transitions: u64,
    /// States that still have to be expanded.
    pub queue: u64,
    /// The largest distance of a state from an initial one.
    pub depth: u64,
    /// Bytes of memory for states.
    pub bytes: u64,
    /// Bytes of files.
    pub spilled: u64,
    /// States whose steps were made by machine code.
    pub compiled: u64,
    /// States of which the assumptions leave no step: what a run would do after them is not looked at. A search of single states
    /// counts them.
    pub blocked: u64,
}

/// Why a search ended before it had explored all states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stop {
    /// The limit of states was reached.
    States,
    /// The limit of depth was reached.
    Depth,
    /// The limit of memory was reached.
    Memory,
    /// A file could not be written or read.
    Disk,
    /// The caller asked to stop.
    Asked,
    /// A finding was enough.
    Found,
}

impl From<Cause> for Stop {
    fn from(cause: Cause) -> Stop {
        match cause {
            Cause::Asked => Stop::Asked,
            Cause::Memory => Stop::Memory,
        }
    }
}
