//! A parting as a diagnostic: the rule of the model that the program did not follow.
//!
//! INVARIANT: every id is in [`IDS`] and has a page `spec/faults/<id>.md`.

use syntax::Diagnostic;

use crate::Parted;

/// The kinds of diagnostics that holding a program to its model makes.
pub const IDS: &[&str] = &["conformance-parts"];

/// Where the two part: the rule by which the model did something. None where the model does nothing there, or the same.
pub fn diagnose_parted(parted: &Parted) -> Option<Diagnostic> {
    let claim = parted.claims.first()?;
    if parted.event.as_ref().is_some_and(|event| event.same(&claim.event)) {
        return None;
    }
    let message = format!("the model {} here", claim.event.words());
    Some(Diagnostic::error("conformance-parts", claim.span, message).here("the program did something else"))
}
