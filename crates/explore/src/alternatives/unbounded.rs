//! Alternatives that cannot be gone through.
//!
//! In: nothing. Out: of what kind they are, and where they stand in the text. It must not know how steps are made.

use program::FunctionId;
use syntax::{FileId, Span};

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
    /// Those of which an assumption cannot be evaluated: it is not known whether they count.
    Assumption,
}

/// Alternatives without end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Unbounded {
    /// Of what kind.
    pub kind: UnboundedKind,
    /// The function's declaration, the choose rule, or what of the assumption has no value.
    pub span: Span,
}

impl Unbounded {
    /// It as words of a checkpoint.
    pub fn words(&self) -> [u64; 5] {
        let (kind, function) = match self.kind {
            UnboundedKind::Input(function) => (0, function.0),
            UnboundedKind::Choice => (1, 0),
            UnboundedKind::Clock => (2, 0),
            UnboundedKind::Limit => (3, 0),
            UnboundedKind::Assumption => (4, 0),
        };
        let Span { file, start, end } = self.span;
        [kind, function.into(), file.0.into(), start.into(), end.into()]
    }

    /// What such words stand for, if they stand for something.
    pub fn of_words(words: &[u64]) -> Option<Unbounded> {
        let &[kind, function, file, start, end] = words else { return None };
        let kind = match kind {
            0 => UnboundedKind::Input(FunctionId(function as u32)),
            1 => UnboundedKind::Choice,
            2 => UnboundedKind::Clock,
            3 => UnboundedKind::Limit,
            4 => UnboundedKind::Assumption,
            _ => return None,
        };
        Some(Unbounded { kind, span: Span { file: FileId(file as u32), start: start as u32, end: end as u32 } })
    }
}
