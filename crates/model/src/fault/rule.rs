//! Faults of rules and rule declarations.

use syntax::{Diagnostic, Span};

use super::Mismatch;

/// An unknown function in the place of a rule: says how rules are called.
pub(crate) fn not_called_by_rule_name(fault: &mut Diagnostic, name: &str, known: bool) {
    if fault.id != "unknown-function" {
        return;
    }
    fault.help = Some(match known {
        true => format!("is the rule meant? It is called `r_{name}[]`"),
        false => format!("a rule's name starts with `r_`: declare `rule r_{name} = …`, and call it `r_{name}[]`"),
    });
}

/// An update with a value of the wrong domain.
pub(crate) fn update_domain(span: Span, target: &str, mismatch: &Mismatch, declared: Span) -> Diagnostic {
    let Mismatch { expected, found, .. } = mismatch;
    Diagnostic::error("update-domain", span, format!("`{target}` takes {expected}, but this is {found}"))
        .here(mismatch.reason())
        .with_label(declared, "declared here")
        .with_help(mismatch.help())
}

/// A value of the wrong domain for something that is not a location.
pub(crate) fn value_domain(span: Span, what: &str, mismatch: &Mismatch) -> Diagnostic {
    let Mismatch { expected, found, .. } = mismatch;
    Diagnostic::error("update-domain", span, format!("{what} takes {expected}, but this is {found}"))
        .here(mismatch.reason())
        .with_help(mismatch.help())
}

/// An update of a function that a rule may not update.
pub(crate) fn update_not_allowed(
    span: Span,
    name: &str,
    kind: &str,
    reason: &str,
    declared: Span,
    help: String,
) -> Diagnostic {
    Diagnostic::error("update-not-allowed", span, format!("the {kind} function `{name}` cannot be updated"))
        .here(reason.to_string())
        .with_label(declared, format!("declared {kind} here"))
        .with_help(help)
}

/// A turbo rule's result for a function that only the environment writes.
pub(crate) fn return_lost(span: Span, name: &str, declared: Span) -> Diagnostic {
    Diagnostic::warning("return-lost", span, format!("what is returned to the monitored function `{name}` is lost"))
        .here("only the environment writes it")
        .with_label(declared, "declared monitored here")
        .with_help(format!("declare `{name}` controlled, or call the rule without `<-`"))
}

/// An update of a variable that changes nothing but the variable.
pub(crate) fn update_of_variable(span: Span, name: &str, bound: Span, what: &str, help: &str) -> Diagnostic {
    Diagnostic::warning(
        "update-of-variable",
        span,
        format!("this changes `{name}` for the rest of its scope, and nothing else"),
    )
    .with_label(bound, what.to_string())
    .with_help(help)
}

/// An update of a term that is not a location at all.
pub(crate) fn not_a_location(span: Span, message: &str, declared: Option<Span>) -> Diagnostic {
    let fault = Diagnostic::error("not-a-location", span, message.to_string())
        .with_help("give a dynamic function with its arguments: `f(a)`");
    match declared {
        Some(place) => fault.with_label(place, "this parameter is updated"),
        None => fault,
    }
}

/// `[]` for a turbo rule or `()` for a macro rule.
pub(crate) fn call_brackets(span: Span, name: &str, turbo: bool, declared: Span) -> Diagnostic {
    let (kind, brackets) = if turbo { ("turbo", "()") } else { ("macro", "[]") };
    Diagnostic::error("rule-call-brackets", span, format!("`{name}` is a {kind} rule, called with `{brackets}`"))
        .with_label(declared, format!("declared as a {kind} rule here"))
        .with_help(if turbo {
            format!("write `{name}(…)`")
        } else {
            format!("write `{name}[…]`, or declare it `turbo rule`")
        })
}

/// A call with the wrong number of arguments.
pub(crate) fn argument_count(span: Span, name: &str, expected: &str, found: usize, declared: &[Span]) -> Diagnostic {
    let fault = Diagnostic::error("rule-argument-count", span, format!("`{name}` takes {expected}, not {found}"))
        .with_help("add or remove arguments");
    declared.iter().fold(fault, |fault, place| fault.with_label(*place, "declared here"))
}

/// A call with an argument of the wrong domain.
pub(crate) fn argument_domain(
    span: Span,
    message: String,
    found: &str,
    declared: &[(Span, String)],
    help: String,
) -> Diagnostic {
    let fault = Diagnostic::error("rule-argument-domain", span, message).here(found.to_string()).with_help(help);
    declared
        .iter()
        .fold(fault, |fault, (place, signature)| fault.with_label(*place, format!("declared as `{signature}`")))
}

/// Macro rules that call each other in a circle.
pub(crate) fn recursive_macro(span: Span, cycle: &[String], declared: Span) -> Diagnostic {
    let message = match cycle {
        [one, _] => format!("the macro rule `{one}` calls itself"),
        _ => format!("macro rules call each other in a circle: {}", cycle.join(" → ")),
    };
    Diagnostic::error("recursive-macro-rule", span, message)
        .here("a macro call stands for the body of the rule, which would never end")
        .with_label(declared, "declared here")
        .with_help("declare it `turbo rule` and call it with `()`")
}

/// A term in the place of a rule; its value is not a rule.
pub(crate) fn not_a_rule(span: Span, found: &str, help: String) -> Diagnostic {
    Diagnostic::error("not-a-rule", span, format!("a rule is expected here, but this term is {found}"))
        .here(found.to_string())
        .with_help(help)
}

/// The result of a rule that returns none.
pub(crate) fn without_result(span: Span, name: &str, declared: Span) -> Diagnostic {
    Diagnostic::warning("rule-without-result", span, format!("`{name}` declares no result"))
        .with_label(declared, "declared here")
        .with_help(format!("write `turbo rule {name}… in Domain = …`"))
}

/// Extending a domain that does not grow.
pub(crate) fn extend_static(span: Span, name: &str, what: &str, declared: Option<Span>, help: String) -> Diagnostic {
    let fault = Diagnostic::error("extend-static-domain", span, format!("`{name}` cannot be extended"))
        .here(what.to_string())
        .with_help(help);
    match declared {
        Some(place) => fault.with_label(place, "declared here"),
        None => fault,
    }
}

/// A main rule with parameters.
pub(crate) fn main_with_parameters(span: Span, name: &str) -> Diagnostic {
    Diagnostic::warning("main-with-parameters", span, format!("the main rule `{name}` has parameters"))
        .here("nothing gives them values")
        .with_help("remove the parameters; choose or let may give them values in the body")
}
