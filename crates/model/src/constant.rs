//! Integers known without a state: literals and arithmetic on them.
//!
//! In: a checked term. Out: its value, if it is plainly the same in every state. This allows a constant as a Natural, and
//! finds empty ranges and elements written twice. It knows no definitions.

use crate::model::Model;
use crate::term::{Literal, Term, TermKind};

/// The value of a constant integer term.
pub(crate) fn integer(model: &Model, term: &Term) -> Option<i64> {
    match &term.kind {
        TermKind::Literal(Literal::Integer(value)) => Some(*value),
        TermKind::Apply { function, arguments } => {
            let function = model.function(*function);
            if !function.library {
                return None;
            }
            let value = |index: usize| integer(model, &arguments[index]);
            match (function.name.as_str(), arguments.len()) {
                ("plus", 1) | ("iton" | "ntoi", 1) => value(0),
                ("minus", 1) => value(0)?.checked_neg(),
                ("plus", 2) => value(0)?.checked_add(value(1)?),
                ("minus", 2) => value(0)?.checked_sub(value(1)?),
                ("mult", 2) => value(0)?.checked_mul(value(1)?),
                ("idiv", 2) => value(0)?.checked_div(value(1)?),
                ("mod", 2) => value(0)?.checked_rem(value(1)?),
                ("max", 2) => Some(value(0)?.max(value(1)?)),
                ("min", 2) => Some(value(0)?.min(value(1)?)),
                _ => None,
            }
        }
        _ => None,
    }
}

/// The value of a constant number, for comparing the bounds of a range.
pub(crate) fn number(model: &Model, term: &Term) -> Option<f64> {
    match &term.kind {
        TermKind::Literal(Literal::Real(value)) => Some(*value),
        TermKind::Coerce(inner) => number(model, inner),
        _ => integer(model, term).map(|value| value as f64),
    }
}
