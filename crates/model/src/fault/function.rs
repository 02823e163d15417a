//! Faults of function definitions and initial values.

use syntax::{Diagnostic, Span};

use super::Mismatch;

/// A definition, in the definitions section, of a function that is neither static nor derived.
pub(crate) fn define_dynamic(span: Span, name: &str, kind: &str, declared: Span) -> Diagnostic {
    Diagnostic::error("define-dynamic-function", span, format!("the {kind} function `{name}` cannot be defined"))
        .here("only static and derived functions have a definition")
        .with_label(declared, format!("declared {kind} here"))
        .with_help(format!("declare `{name}` derived; or give its initial value in an init section"))
}

/// A definition that matches no declaration.
pub(crate) fn no_declaration(
    span: Span,
    name: &str,
    domain: &str,
    declared: &[(Span, String)],
    help: String,
) -> Diagnostic {
    let message = match domain {
        "" => format!("there is no function `{name}` without arguments to define"),
        _ => format!("there is no function `{name}` over {domain} to define"),
    };
    let fault = Diagnostic::error("undeclared-definition", span, message).with_help(help);
    declared
        .iter()
        .fold(fault, |fault, (place, signature)| fault.with_label(*place, format!("declared as `{signature}`")))
}

/// A static function with a concrete meaning but without definition.
pub(crate) fn undefined(span: Span, name: &str, kind: &str) -> Diagnostic {
    Diagnostic::warning("undefined-function", span, format!("the {kind} function `{name}` has no definition"))
        .here("a run stops where it is evaluated")
        .with_help(format!("define it: `function {name}… = …` in the definitions section"))
}

/// A function that begins without a value, and is set only if it has one already.
pub(crate) fn unstarted(span: Span, name: &str, asked: Span, has_init: bool) -> Diagnostic {
    let help = match has_init {
        true => format!("give it its first value in the `default init` section: `function {name} = …`"),
        false => format!("give it its first value behind the main rule: `default init s0: function {name} = …`"),
    };
    Diagnostic::warning("never-begins", span, format!("`{name}` never gets a value, so nothing that asks for one runs"))
        .here("it has no initial value, and every rule that sets it asks for a value first")
        .with_label(asked, "asked for here")
        .with_help(help)
}

/// Definitions that use each other in a circle in every state.
pub(crate) fn endless(span: Span, cycle: &[String], declared: Span) -> Diagnostic {
    let name = cycle.last().map(String::as_str).unwrap_or_default();
    let message = match cycle {
        [_, _] => format!("every evaluation of `{name}` evaluates `{name}` again"),
        _ => format!("the definitions of {} use each other in a circle", cycle.join(" → ")),
    };
    Diagnostic::warning("endless-definition", span, message)
        .here("a run that comes here never ends, but for a limit")
        .with_label(declared, format!("`{name}` is declared here"))
        .with_help("put the use behind a condition that comes false, or remove it")
}

/// A second definition.
pub(crate) fn duplicate_definition(span: Span, first: Span, what: &str, name: &str) -> Diagnostic {
    Diagnostic::error("duplicate-definition", span, format!("the {what} `{name}` is defined twice"))
        .here("defined again")
        .with_label(first, "first defined here")
        .with_help("remove one of the two definitions")
}

/// A body whose domain is not the codomain.
pub(crate) fn definition_domain(span: Span, name: &str, mismatch: &Mismatch, declared: Span) -> Diagnostic {
    let Mismatch { expected, found, .. } = mismatch;
    Diagnostic::error("definition-domain", span, format!("`{name}` gives {expected}, but this is {found}"))
        .here(mismatch.reason())
        .with_label(declared, format!("`{name}` is declared here"))
        .with_help(mismatch.help())
}

/// A static function that depends on the state.
pub(crate) fn dynamic_in_static(span: Span, name: &str, mentioned: &str, what: &str, declared: Span) -> Diagnostic {
    Diagnostic::error(
        "dynamic-in-static",
        span,
        format!("the static function `{name}` depends on {what} `{mentioned}`"),
    )
    .here(format!("`{mentioned}` may change from state to state"))
    .with_label(declared, "declared static here")
    .with_help(format!("declare `{name}` derived"))
}

/// A derived function that does not depend on the state.
pub(crate) fn static_derived(span: Span, name: &str, declared: Span) -> Diagnostic {
    Diagnostic::error(
        "static-derived-function",
        span,
        format!("the derived function `{name}` depends on no dynamic function"),
    )
    .here("this never changes")
    .with_label(declared, "declared derived here")
    .with_help(format!("declare `{name}` static"))
}

/// An initial value for a function that has none.
pub(crate) fn init_static(span: Span, name: &str, kind: &str, declared: Span) -> Diagnostic {
    Diagnostic::error("init-static-function", span, format!("the {kind} function `{name}` has no initial value"))
        .here("only dynamic functions are initialised")
        .with_label(declared, format!("declared {kind} here"))
        .with_help(format!("move this to the definitions section, or declare `{name}` controlled"))
}

/// No init section is the default one.
pub(crate) fn missing_default_init(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("missing-default-init", span, "no initial state is the default one")
        .with_help(format!("write `default init {name}:`"))
}

/// Two init sections are the default one.
pub(crate) fn duplicate_default_init(span: Span, first: Span) -> Diagnostic {
    Diagnostic::error("duplicate-default-init", span, "two initial states are the default one")
        .with_label(first, "the first default")
        .with_help("remove one `default`")
}

/// `agent D: …` where `D` is not a domain of agents, or the rule is not a program for it.
pub(crate) fn agent_program(span: Span, message: String, help: &str) -> Diagnostic {
    Diagnostic::error("agent-without-program", span, message).with_help(help)
}
