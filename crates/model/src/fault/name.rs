//! Faults of names that mean nothing, or two things.

use syntax::{Diagnostic, Span};

use crate::library;
use crate::model::PropertyKind;

/// A domain that is not declared.
pub(crate) fn unknown_domain(span: Span, name: &str, help: String) -> Diagnostic {
    Diagnostic::error("unknown-domain", span, format!("there is no domain `{name}`")).with_help(help)
}

/// A function that is not declared.
pub(crate) fn unknown_function(span: Span, name: &str, help: String) -> Diagnostic {
    Diagnostic::error("unknown-function", span, format!("there is no function `{name}`")).with_help(help)
}

/// An unknown function in a formula about runs: says which library has it as an operator.
pub fn missing_operator(fault: &mut Diagnostic, kind: PropertyKind) {
    let name = fault.message.split('`').nth(1).filter(|_| fault.id == "unknown-function");
    if let Some((name, library)) = name.and_then(|name| Some((name, library::of_operator(name, kind)?))) {
        fault.help = Some(format!("`{name}` is an operator of this logic: `import {library}`"));
    }
}

/// A rule that is not declared.
pub(crate) fn unknown_rule(span: Span, name: &str, help: String) -> Diagnostic {
    Diagnostic::error("unknown-rule", span, format!("there is no rule `{name}`")).with_help(help)
}

/// A variable that is not bound here. If another scope of the declaration binds it, only a run that gets here fails.
pub(crate) fn unknown_variable(span: Span, name: &str, elsewhere: Option<Span>, help: String) -> Diagnostic {
    let message = format!("`{name}` is not bound here");
    match elsewhere {
        Some(place) => Diagnostic::warning("unknown-variable", span, message)
            .with_help(help)
            .with_label(place, "bound here, but its scope ends before"),
        None => Diagnostic::error("unknown-variable", span, message).with_help(help),
    }
}

/// An enum literal that no enum domain has.
pub(crate) fn unknown_literal(span: Span, name: &str, help: String) -> Diagnostic {
    Diagnostic::error("unknown-enum-literal", span, format!("no enum domain has the literal `{name}`")).with_help(help)
}

/// A domain whose name looks like an enum literal.
pub(crate) fn domain_in_capitals(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("domain-in-capitals", span, format!("`{name}` cannot name a domain"))
        .here("two capitals first and no small letter: this shape is for enum literals")
        .with_help(format!("name it `{}`", capitalised(name)))
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map(|first| first.to_string() + &letters.as_str().to_ascii_lowercase()).unwrap_or_default()
}

fn duplicate(id: &'static str, span: Span, first: Option<Span>, message: String) -> Diagnostic {
    let fault = Diagnostic::error(id, span, message).here("declared again");
    match first {
        Some(first) => fault.with_label(first, "first declared here"),
        None => fault,
    }
}

/// A domain declared twice.
pub(crate) fn duplicate_domain(span: Span, first: Option<Span>, name: &str) -> Diagnostic {
    let fault = duplicate("duplicate-domain", span, first, format!("the domain `{name}` is declared twice"));
    match first {
        Some(_) => fault.with_help("rename one of the two, or remove it"),
        None => fault.here("predefined").with_help("rename it, or remove the declaration and use the predefined one"),
    }
}

/// An enum literal declared twice.
pub(crate) fn duplicate_literal(span: Span, first: Option<Span>, name: &str, domain: &str) -> Diagnostic {
    let message = format!("the enum literal `{name}` is already one of `{domain}`");
    duplicate("duplicate-enum-literal", span, first, message)
        .with_help("rename it: a literal belongs to one enum domain only, among all that a file sees")
}

/// A function declared twice over the same domain.
pub(crate) fn duplicate_function(span: Span, first: Span, signature: &str) -> Diagnostic {
    duplicate("duplicate-function", span, Some(first), format!("the function `{signature}` is declared twice"))
        .with_help("rename one of the two, or declare it over another domain")
}

/// A rule declared twice with the same parameter domains.
pub(crate) fn duplicate_rule(span: Span, first: Span, signature: &str) -> Diagnostic {
    duplicate("duplicate-rule", span, Some(first), format!("the rule `{signature}` is declared twice"))
        .with_help("rename one of the two, or give it other parameter domains")
}

/// A parameter named twice.
pub(crate) fn duplicate_parameter(span: Span, first: Span, name: &str) -> Diagnostic {
    duplicate("duplicate-parameter", span, Some(first), format!("the parameter `{name}` stands twice in one list"))
        .with_help("rename one of the two")
}

/// A property named twice.
pub(crate) fn duplicate_property(span: Span, first: Span, name: &str) -> Diagnostic {
    duplicate("duplicate-property", span, Some(first), format!("the property `{name}` is declared twice"))
        .with_help("rename one of the two; names of properties are optional")
}
