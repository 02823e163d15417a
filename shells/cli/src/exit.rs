//! Exit codes, a closed set.

use std::process::ExitCode;

/// The result of a command, for its caller.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// All is well.
    Good,
    /// The model is at fault, an invariant is violated, a scenario fails.
    Model,
    /// Wrong usage, or the world failed.
    World,
    /// Not known: the command was interrupted, or reached a bound.
    Unknown,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> ExitCode {
        ExitCode::from(match exit {
            Exit::Good => 0,
            Exit::Model => 1,
            Exit::World => 2,
            Exit::Unknown => 3,
        })
    }
}
