//! The faults of couplings: texts that cannot be understood, inputs without counterpart, questions whose answer would say nothing.
//!
//! INVARIANT: every id is in [`IDS`] and has a page `spec/faults/<id>.md`.

use syntax::{Diagnostic, Span};

/// The kinds of faults that arise here.
pub const IDS: &[&str] = &["bad-coupling", "input-not-coupled", "vacuous-refinement"];

/// The coupling does not say what it should.
pub fn bad_coupling(span: Span, message: impl Into<String>) -> Box<Diagnostic> {
    Box::new(Diagnostic::error("bad-coupling", span, message.into()))
}

/// The abstract machine reads an input that the concrete one does not have.
pub(crate) fn input_not_coupled(span: Span, name: &str, why: &str) -> Diagnostic {
    let help = format!(
        "say its value, `input abstract.{name} = …;`, or let the abstract machine take any, `free abstract.{name};`"
    );
    Diagnostic::error("input-not-coupled", span, format!("the abstract machine's input {name} {why}")).with_help(help)
}

/// Whatever the machines did, the answer would be the same.
pub(crate) fn vacuous(span: Span, message: impl Into<String>) -> Diagnostic {
    Diagnostic::error("vacuous-refinement", span, message.into())
}
