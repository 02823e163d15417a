//! How far a search is, and why it ended before its end.

use machine::Cause;

/// How far a search is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Progress {
    /// States met.
    pub states: u64,
    /// Steps that change the state.
    pub transitions: u64,
    /// States that are still to be expanded.
    pub queue: u64,
    /// The greatest distance of a state from an initial one.
    pub depth: u64,
    /// Bytes of memory that states take.
    pub bytes: u64,
    /// Bytes of files.
    pub spilled: u64,
}

/// Why a search ended before it had met all states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stop {
    /// As many states as are allowed.
    States,
    /// As deep as is allowed.
    Depth,
    /// As many bytes as are allowed.
    Memory,
    /// A file could not be written or read.
    Disk,
    /// Whoever watches the search has had enough.
    Asked,
    /// Something was found and that is enough.
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
