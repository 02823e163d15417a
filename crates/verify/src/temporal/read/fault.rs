//! The faults of temporal formulas: their wording.
//!
//! INVARIANT: every id is in [`IDS`] and has a page `spec/faults/<id>.md`.

use syntax::{Diagnostic, Span};

/// The ids of the faults that reading a formula may report.
pub const IDS: &[&str] = &["formula-too-large", "mixed-logics", "temporal-in-term", "temporal-over-changing"];

/// LIMIT: different formulas in all properties of a program, and propositions.
pub(super) const MOST_FORMULAS: usize = 1_000_000;
/// LIMIT: see [`MOST_FORMULAS`].
pub(super) const MOST_PROPOSITIONS: usize = 10_000;
/// LIMIT: the largest number of steps for `exN` and `axN`.
pub(super) const MOST_STEPS: i64 = 10_000;

pub(super) fn mixed(span: Span, is_ctl: bool) -> Diagnostic {
    let (operator, formula, help) = match is_ctl {
        true => ("CTL", "LTL", "write a CTLSPEC, or the operator of the LTL library: `g` for `ag`, `f` for `af`"),
        false => ("LTL", "CTL", "write an LTLSPEC, or an operator of the CTL library: `ag` or `eg` for `g`"),
    };
    Diagnostic::error(
        "mixed-logics",
        span,
        format!("an operator of the {operator} library is used in a formula of {formula}"),
    )
    .here("this belongs to the other logic")
    .with_help(help)
}

pub(super) fn in_term(span: Span, operator: Span) -> Diagnostic {
    let fault = Diagnostic::error("temporal-in-term", span, "a formula about runs stands where a value is needed");
    let fault = if operator == span {
        fault.here("this has no value in a single state")
    } else {
        fault.here("this needs the values of one state").with_label(operator, "this speaks of runs")
    };
    fault.with_help("join formulas about runs by `not`, `and`, `or`, `xor`, `implies`, `iff`, `if … then … else … endif` and quantifiers")
}

pub(super) fn changing(span: Span, what: &str) -> Diagnostic {
    Diagnostic::error("temporal-over-changing", span, format!("{what} of a formula about runs changes from state to state"))
        .here("this depends on the state")
        .with_help("range over a fixed domain, and say in which states an element counts: `(forall $x in D with ag($x = … implies …))`")
}

pub(super) fn not_enumerable(span: Span, reason: &str) -> Diagnostic {
    Diagnostic::error("temporal-over-changing", span, "what this ranges over cannot be enumerated")
        .here(reason.to_string())
        .with_help("range over a finite fixed domain")
}

pub(super) fn too_large(span: Span, what: &str, most: u64) -> Diagnostic {
    Diagnostic::error("formula-too-large", span, format!("the formula has more than {most} {what}"))
        .here("the limit is passed here")
        .with_help("quantify over fewer elements, or split the property")
}
