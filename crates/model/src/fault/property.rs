//! Faults of invariants and other properties.

use syntax::{Diagnostic, Span};

/// A property that is not Boolean.
pub(crate) fn not_boolean(span: Span, what: &str, found: &str) -> Diagnostic {
    Diagnostic::error("property-not-boolean", span, format!("{what} must be Boolean, but this is {found}"))
        .here(found.to_string())
        .with_help("compare it with something: `… = …`")
}

/// An item of an over list that names nothing.
pub(crate) fn over_unknown(span: Span, name: &str, help: String) -> Diagnostic {
    Diagnostic::warning(
        "over-unknown-name",
        span,
        format!("the invariant is over `{name}`, but there is nothing of that name"),
    )
    .with_help(help)
}
