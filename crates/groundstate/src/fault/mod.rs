//! The faults that working with a model brings up: runs, scenarios, reviews, verification.
//!
//! In: what the operations found, as data of theirs, with the program it was found in. Out: diagnostics, each with its place, what is
//! to be seen there, and what to do. INVARIANT: every id is in [`IDS`], or is one of [`machine::FaultKind::id`], and has a page
//! `spec/faults/<id>.md`.

pub(crate) mod review;
pub(crate) mod run;
pub(crate) mod scenario;
pub(crate) mod verification;

use syntax::{Diagnostic, FileId};

/// A text that is to be a term, and is none.
pub(crate) fn no_term(file: FileId) -> Diagnostic {
    Diagnostic::error("expected-term", run::start(file), "a term is expected")
}

/// The kinds that are found here, besides those of [`REVIEW_IDS`](review::REVIEW_IDS) and of a step that cannot be made.
pub const IDS: &[&str] = &[
    "bound-reached",
    "check-failed",
    "expected-failure",
    "expected-term",
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
