//! What a step takes from outside: values of monitored locations, choices, the clock.

use model::{Basic, Model};

use crate::state::Location;
use crate::value::Value;

/// A unit of the clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they say it")]
pub enum Tick {
    Nanoseconds,
    Milliseconds,
    Seconds,
}

/// The environment of a run. An error is a sentence for the user.
pub trait Environment {
    /// The value of a monitored location in this step, or of a shared one that has none yet.
    fn monitored(&mut self, model: &Model, location: &Location) -> Result<Value, String>;

    /// The index of the candidate chosen; there is at least one.
    fn choose(&mut self, model: &Model, candidates: &[Vec<Value>]) -> Result<usize, String>;

    /// A number for a variable that a choose rule without a guard binds over all numbers of a kind: which of its
    /// variables, which kind.
    fn number(&mut self, model: &Model, variable: usize, basic: Basic) -> Result<Value, String>;

    /// The clock.
    fn time(&mut self, unit: Tick) -> Result<i64, String>;
}
