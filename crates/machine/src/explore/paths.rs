//! The alternatives of one state, told one by one: for traces, graphs and whoever wants to know how an edge came about.
//!
//! In: a packed state. Out: what each alternative was and came to. Nothing here is remembered.

use crate::explore::branches::{ChoiceTaken, Unbounded};
use crate::fault::Fault;
use crate::location::Location;
use crate::machine::Change;
use crate::value::Value;

/// What an alternative came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// The next state.
    Next(Box<[u64]>),
    /// The step cannot be made.
    Fault(Box<Fault>),
    /// Its alternatives cannot be gone through.
    Unbounded(Unbounded),
    /// An assumption does not hold of the step's inputs.
    Excluded,
}

/// An alternative of a state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Path {
    /// The answers given, which lead to it again.
    pub picks: Vec<u32>,
    /// What it came to.
    pub outcome: Outcome,
    /// The conditions on the step that do not hold, by their numbers.
    pub failed: Vec<u32>,
}

/// All there is to say of one step.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Told {
    /// The inputs given, in the order asked.
    pub inputs: Vec<(Location, Value)>,
    /// The choices, in order.
    pub choices: Vec<ChoiceTaken>,
    /// What it changed, in canonical order.
    pub changes: Vec<Change>,
    /// Why it could not be made.
    pub fault: Option<Box<Fault>>,
}
