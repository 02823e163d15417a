//! Faults of texts in other notations.

use syntax::{Diagnostic, Span};

const ID: &str = "foreign-notation";

/// The text is not a document of this kind.
pub(crate) fn malformed(span: Span, message: &str) -> Diagnostic {
    Diagnostic::error(ID, span, format!("this is not SCXML: {message}"))
        .here("reading ends here")
        .with_help("a document of State Chart XML has the element `scxml` around its states")
}

/// Charts cannot express this, and it cannot be left out.
pub(crate) fn no_counterpart(span: Span, what: &str, help: &str) -> Diagnostic {
    Diagnostic::error(ID, span, format!("charts cannot express {what}"))
        .here("without it, the chart would mean something else")
        .with_help(help.to_string())
}

/// Something that is left out.
pub(crate) fn left_out(span: Span, what: &str, help: &str) -> Diagnostic {
    Diagnostic::warning(ID, span, format!("{what} is not imported"))
        .here("charts cannot express it")
        .with_help(help.to_string())
}

/// Something in a language other than AsmetaL, which is kept as the text of a shape.
pub(crate) fn kept_as_text(span: Span, what: &str, name: &str) -> Diagnostic {
    Diagnostic::warning(ID, span, format!("{what} becomes `{name}`, which is to be refined"))
        .here("it is not AsmetaL")
        .with_help(format!("write `{name}` in the specification, or link the shape to what it stands for"))
}

/// Something in a document of our own for which composite states cannot be read back.
pub(crate) fn flattened(span: Span, why: &str, help: String) -> Diagnostic {
    Diagnostic::warning(
        ID,
        span,
        "the composite states are read without their frames: each state gets the paths around it",
    )
    .here(why.to_string())
    .with_help(help)
}

/// A second state with the same id.
pub(crate) fn second_state(span: Span, id: &str, first: Span) -> Diagnostic {
    Diagnostic::error(ID, span, format!("a second state with the id `{id}`"))
        .here("transitions could not tell the two apart")
        .with_label(first, "the first one")
        .with_help("give each state an id of its own")
}

/// A transition to a state that does not exist.
pub(crate) fn unknown_target(span: Span, id: &str) -> Diagnostic {
    Diagnostic::error(ID, span, format!("there is no state `{id}`"))
        .here("a transition leads there")
        .with_help("correct the target; in a `parallel`, states of other regions cannot be targets")
}

/// A state whose initial state does not lie within it.
pub(crate) fn begins_outside(span: Span, id: &str) -> Diagnostic {
    Diagnostic::error(ID, span, format!("`{id}`, where this state begins, does not lie within it"))
        .here("entering the state would never end, or lead elsewhere")
        .with_help("name a state within it")
}
