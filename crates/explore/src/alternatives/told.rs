//! All there is to say of one step: for traces, graphs and whoever wants to know how an edge came about.

use machine::{Change, Fault, Location, Value};
use syntax::Span;

/// A choice as it was made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChoiceTaken {
    /// The choose rule, or the term.
    pub span: Span,
    /// The values of the variables bound.
    pub values: Vec<Value>,
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
