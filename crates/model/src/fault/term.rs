//! Faults of terms.

use syntax::{Diagnostic, Span};

use super::Mismatch;

/// A number beyond 64 bits, or a real that is not finite.
pub(crate) fn number_too_large(span: Span, text: &str, limit: &str) -> Diagnostic {
    Diagnostic::error("number-too-large", span, format!("`{text}` is too large"))
        .here(limit.to_string())
        .with_help("write it as a real number, `1.0`, if the exact value does not matter")
}

/// A character literal of no or several characters.
pub(crate) fn malformed_character(span: Span, text: &str) -> Diagnostic {
    Diagnostic::error("malformed-character", span, format!("{text} is not one character"))
        .with_help("write a string between double quotes: `\"…\"`")
}

/// No function of that name takes that many arguments.
pub(crate) fn argument_count(
    span: Span,
    name: &str,
    expected: &str,
    found: usize,
    declared: &[(Span, String)],
) -> Diagnostic {
    let message = format!("`{name}` takes {expected}, not {found}");
    let fault = Diagnostic::error("argument-count", span, message).with_help(match found {
        0 => format!("write the arguments in parentheses: `{name}(…)`"),
        _ => "add or remove arguments".to_string(),
    });
    declared
        .iter()
        .fold(fault, |fault, (place, signature)| fault.with_label(*place, format!("declared as `{signature}`")))
}

/// An argument of the wrong domain, if only one function has that name.
pub(crate) fn argument_domain(
    span: Span,
    name: &str,
    mismatch: &Mismatch,
    declared: Span,
    signature: &str,
) -> Diagnostic {
    let Mismatch { expected, found, .. } = mismatch;
    Diagnostic::error("argument-domain", span, format!("`{name}` takes {expected} here, but this is {found}"))
        .here(mismatch.reason())
        .with_label(declared, format!("declared as `{signature}`"))
        .with_help(mismatch.help())
}

/// None of several functions takes arguments of these domains.
pub(crate) fn no_overload(span: Span, message: String, operands: &[(Span, String)], help: String) -> Diagnostic {
    let fault = Diagnostic::error("no-such-overload", span, message).with_help(help);
    operands.iter().fold(fault, |fault, (place, domain)| fault.with_label(*place, format!("this is {domain}")))
}

/// A function over a subset applied to a term over the whole abstract domain.
pub(crate) fn narrower_domain(span: Span, name: &str, expected: &str, found: &str, declared: Span) -> Diagnostic {
    Diagnostic::error(
        "narrower-domain",
        span,
        format!("`{name}` is declared for {expected} only, but this is any {found}"),
    )
    .here(format!("may be outside {expected}"))
    .with_label(declared, format!("`{name}` is declared here"))
    .with_help(format!("range over {expected} instead of {found}, or declare `{name}` over {found}"))
}

/// A condition that is not Boolean.
pub(crate) fn guard_not_boolean(span: Span, what: &str, found: &str) -> Diagnostic {
    Diagnostic::error("guard-not-boolean", span, format!("{what} must be Boolean, but this is {found}"))
        .here(format!("{found}, where Boolean is expected"))
        .with_help("compare it with something: `… = …`")
}

/// Branches of one term with domains that do not fit each other.
pub(crate) fn branch_domains(span: Span, found: &str, first: Span, expected: &str) -> Diagnostic {
    Diagnostic::error("branch-domains", span, format!("this branch gives {found}, but the first gives {expected}"))
        .here(found.to_string())
        .with_label(first, expected.to_string())
        .with_help("let all branches give values of one domain")
}

/// Elements of one collection with domains that do not fit each other.
pub(crate) fn element_domains(span: Span, found: &str, first: Span, expected: &str) -> Diagnostic {
    Diagnostic::error(
        "element-domains",
        span,
        format!("this element is {found}, but the elements before are {expected}"),
    )
    .here(found.to_string())
    .with_label(first, expected.to_string())
    .with_help("a collection holds elements of one domain; use a product for parts of several: `(1, \"a\")`")
}

/// The same constant twice in a set, or twice as a key of a map.
pub(crate) fn duplicate_element(span: Span, first: Span, what: &str) -> Diagnostic {
    Diagnostic::warning("duplicate-element", span, format!("this {what} stands twice"))
        .with_label(first, "first here")
        .with_help(match what {
            "key" => "remove one of the two entries; the later one counts",
            _ => "remove it; a set holds each element once",
        })
}

/// A case whose value can never equal the subject.
pub(crate) fn case_never_matches(span: Span, found: &str, subject: Span, expected: &str) -> Diagnostic {
    Diagnostic::warning(
        "case-never-matches",
        span,
        format!("this case never matches: it is {found}, but the subject is {expected}"),
    )
    .with_label(subject, format!("this is {expected}"))
    .with_help(format!("give a case of domain {expected}, or remove it"))
}

/// Ranging over a term that is not a collection.
pub(crate) fn not_a_collection(span: Span, found: &str) -> Diagnostic {
    Diagnostic::error(
        "not-a-collection",
        span,
        format!("a variable ranges over a domain or a collection, but this is {found}"),
    )
    .here(found.to_string())
    .with_help("name a domain, or give a set, sequence or bag: `{1 : 10}`")
}

/// Bounds of a range that are not numbers.
pub(crate) fn range_bounds(span: Span, found: &str) -> Diagnostic {
    Diagnostic::error("range-bounds", span, format!("a range goes over numbers, but this is {found}"))
        .here(found.to_string())
        .with_help("give Natural, Integer or Real bounds, or list the elements: `{AA, BB}`")
}

/// A range that is empty, or a step that leads nowhere.
pub(crate) fn empty_range(span: Span, reason: &str, help: &str) -> Diagnostic {
    Diagnostic::warning("empty-range", span, "this range holds nothing").here(reason.to_string()).with_help(help)
}
