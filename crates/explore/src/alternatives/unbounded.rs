//! Alternatives that cannot be gone through.
//!
//! In: nothing. Out: of what kind they are, and where they stand in the text. It must not know how steps are made.

use program::FunctionId;
use syntax::Span;

/// What kind of alternatives cannot be gone through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum UnboundedKind {
    /// The values of an input.
    Input(FunctionId),
    /// The candidates of a choice.
    Choice,
    /// The readings of the clock.
    Clock,
    /// What a step may take: see [`machine::Limits`].
    Limit,
}

/// Alternatives without end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Unbounded {
    /// Of what kind.
    pub kind: UnboundedKind,
    /// The function's declaration, or the choose rule.
    pub span: Span,
}
