//! Pieces of sequences and sets, and changes of one piece.
//!
//! In: nothing. Out: what a step looks at of a collection that an explorer keeps piece by piece, and how it changes one
//! ([`crate::Alternatives`]). It must not know how steps are made, nor how states are kept.

use crate::value::Value;

/// A piece of a collection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Piece<'v> {
    /// How long the sequence is.
    Length,
    /// Its element of this position, which it has.
    Element(usize),
    /// Whether the set has this element.
    Member(&'v Value),
}

/// How a rule changes a collection.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Edit {
    /// The sequence gets one more element at its end.
    Append(Value),
    /// The same at its beginning.
    Prepend(Value),
    /// It loses its first element.
    Tail,
    /// The set has this element.
    Include(Value),
    /// It does not have it.
    Exclude(Value),
}
