//! A mutant: an edit of a model's text, with its operator and place.
//!
//! INVARIANT: the edits are in the order of the text and do not overlap.

use crate::edit::Edit;
use crate::operator::Operator;

/// A model's text with one small fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mutant {
    /// The kind of fault.
    pub operator: Operator,
    /// The bytes of what is mutated: the guard, the rule, the term.
    pub place: std::ops::Range<usize>,
    /// The edits, in the order of the text.
    pub edits: Vec<Edit>,
    /// The function whose definition or initial value is mutated; none in a rule.
    pub function: Option<Named>,
}

/// A function as a text names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// The names of its parameters' domains.
    pub parameters: Vec<String>,
}
