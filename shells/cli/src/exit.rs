//! Exit codes, a closed set.

use std::process::ExitCode;

/// What the command says to whoever started it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// All is well.
    Good,
    /// The model is at fault, an invariant is violated, a scenario fails.
    Model,
    /// Wrong usage, or the world failed.
    World,
    /// Not known: interrupted, or a bound was reached.
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
