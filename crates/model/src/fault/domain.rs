//! Faults of domain declarations and definitions.

use syntax::{Diagnostic, Span};

/// `basic domain` with a name that is not basic.
pub(crate) fn not_basic(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("not-basic-domain", span, format!("`{name}` is not a basic domain"))
        .here("basic are Complex, Real, Integer, Natural, Char, String, Boolean and Undef")
        .with_help(format!("write `abstract domain {name}` for a set of unnamed elements"))
}

/// `subsetof` a concrete domain.
pub(crate) fn concrete_over_concrete(
    span: Span,
    name: &str,
    base: &str,
    type_domain: &str,
    declared: Option<Span>,
) -> Diagnostic {
    let message = format!("`{name}` cannot be a subset of `{base}`, which is itself a subset of `{type_domain}`");
    let fault = Diagnostic::error("concrete-over-concrete", span, message)
        .with_help(format!("write `domain {name} subsetof {type_domain}` and define its contents"));
    match declared {
        Some(place) => fault.with_label(place, format!("`{base}` is declared here")),
        None => fault,
    }
}

/// A definition of a domain that has no contents to define.
pub(crate) fn not_definable(span: Span, name: &str, kind: &str, help: &str) -> Diagnostic {
    Diagnostic::error("domain-not-definable", span, format!("the contents of `{name}` cannot be defined here"))
        .here(kind.to_string())
        .with_help(help)
}

/// A static subset without a definition of its contents.
pub(crate) fn without_contents(span: Span, name: &str, base: &str) -> Diagnostic {
    Diagnostic::warning(
        "domain-without-contents",
        span,
        format!("nothing says which elements of {base} are in `{name}`"),
    )
    .here("no value can be written where it is the codomain, and its elements cannot be ranged over")
    .with_help(format!("define it: `domain {name} = {{…}}` in the definitions section"))
}

/// Contents that are not a set of elements of the base.
pub(crate) fn contents(span: Span, name: &str, base: &str, found: &str) -> Diagnostic {
    Diagnostic::error("domain-contents", span, format!("`{name}` is a subset of {base}, but its contents are {found}"))
        .here(format!("a set of {base} is expected"))
        .with_help("write the elements in braces: `{1, 2, 5}`, or a range: `{1 : 5}`")
}
