//! The one fault of this crate: something that cannot be expressed in C++.

use syntax::{Diagnostic, Span};

/// The ids of all faults this crate reports.
pub const IDS: &[&str] = &["not-generated"];

/// A part of a system that cannot be generated.
pub(crate) fn not_generated(span: Span, what: String, reason: &str, help: &str) -> Diagnostic {
    Diagnostic::error("not-generated", span, what).here(reason.to_string()).with_help(help.to_string())
}

/// A part of a model that cannot be generated.
pub(crate) fn no_form(span: Span, message: impl Into<String>, help: &str) -> Diagnostic {
    let fault = Diagnostic::error("not-generated", span, message);
    if help.is_empty() { fault } else { fault.with_help(help) }
}
