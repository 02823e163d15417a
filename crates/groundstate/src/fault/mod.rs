//! The faults that arise when working with a model: in runs, scenarios, reviews, verification.
//!
//! In: what the operations found, and the program. Out: diagnostics, each with its place, the reason there, and what to
//! do. INVARIANT: every id is in [`IDS`] or is one of [`machine::FaultKind::id`], and has a page `spec/faults/<id>.md`.

pub(crate) mod review;
pub(crate) mod run;
pub(crate) mod scenario;
pub(crate) mod verification;

use syntax::{Diagnostic, FileId};

/// The text should be a term, but is none.
pub(crate) fn no_term(file: FileId) -> Diagnostic {
    Diagnostic::error("expected-term", run::start(file), "a term is expected")
}

/// The kinds of faults that arise here, except those of [`REVIEW_IDS`](review::REVIEW_IDS) and of steps that fail.
pub const IDS: &[&str] = &[
    "assumption-without-value",
    "bound-reached",
    "check-failed",
    "expected-failure",
    "expected-term",
    "idle-part",
    "invariant-violated",
    "limit-reached",
    "no-bound",
    "no-main-rule",
    "outside-solver",
    "pick-no-candidate",
    "property-violated",
    "unknown-model",
    "unreachable-rule",
    "unused-pick",
];
