//! Faults of components' own machines.

use syntax::{Diagnostic, Span};

const MACHINE: &str = "component-machine";

/// There is no file of the machine.
pub(crate) fn not_found(span: Span, name: &str, reason: &str, known: &[&str]) -> Diagnostic {
    let help = match model::nearest(name, known.iter().copied()) {
        Some(close) => format!("did you mean `{close}`?"),
        None => format!("write it to {name}.asm beside the chart, or import it: `import FOLDER/{name}`"),
    };
    Diagnostic::error(MACHINE, span, format!("there is no machine `{name}`")).here(reason.to_string()).with_help(help)
}

/// A model that cannot be a component's machine.
pub(crate) fn unusable(span: Span, name: &str, reason: &str, file: &str) -> Diagnostic {
    Diagnostic::error(MACHINE, span, format!("`{name}` cannot be the machine of a component"))
        .here(reason.to_string())
        .with_help(format!(
            "`groundstate check {file}` shows its faults; a component's machine has a main rule and no agents"
        ))
}

/// A second machine in one component.
pub(crate) fn second(span: Span, component: &str, first: Span) -> Diagnostic {
    Diagnostic::error(MACHINE, span, format!("a second machine in the component `{component}`"))
        .here("a component is one machine")
        .with_label(first, "the first one")
        .with_help("join the two, or make two components with a channel between them")
}

/// A machine after `read` or `write`.
pub(crate) fn no_elaboration(span: Span) -> Diagnostic {
    Diagnostic::error(MACHINE, span, "this phase has a machine and computes nothing")
        .here("only elaborations have machines")
        .with_help("write it after an `elaborate` phase")
}

/// State in a module that several machines may import.
pub(crate) fn foreign_state(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error(MACHINE, span, format!("the machine imports `{name}`, which is part of a state"))
        .here("components share no state: two that import it would")
        .with_help("declare it in the machine's own file")
}

/// A monitored function that nothing feeds.
pub(crate) fn unfed(
    span: Span,
    name: &str,
    why: Option<String>,
    offered: &[String],
    label: Option<Span>,
) -> Diagnostic {
    let fault = Diagnostic::error(
        "unfed-function",
        span,
        format!("nothing feeds the monitored function `{name}` of the machine"),
    )
    .here("what a component's machine monitors comes from the channels it reads and from its sensors");
    labelled(fault, label).with_help(help(name, why, offered))
}

/// An out function that nothing takes.
pub(crate) fn untaken(
    span: Span,
    name: &str,
    why: Option<String>,
    offered: &[String],
    label: Option<Span>,
) -> Diagnostic {
    let fault =
        Diagnostic::error("untaken-function", span, format!("nothing takes the out function `{name}` of the machine"))
            .here("what a component's machine puts out goes to the channels it writes and to its actuators");
    labelled(fault, label).with_help(help(name, why, offered))
}

fn help(name: &str, why: Option<String>, offered: &[String]) -> String {
    match (why, model::nearest(name, offered.iter().map(String::as_str))) {
        (Some(why), _) => why,
        (None, Some(close)) => format!("did you mean `{close}`?"),
        (None, None) if offered.is_empty() => {
            "this component has nothing of that kind: make the function controlled".to_string()
        }
        (None, None) => format!("give it the name of one of: {}", offered.join(", ")),
    }
}

fn labelled(fault: Diagnostic, label: Option<Span>) -> Diagnostic {
    match label {
        Some(span) => fault.with_label(span, "it is declared here"),
        None => fault,
    }
}

/// A function and a channel with different domains.
pub(crate) fn misfit(
    span: Span,
    name: &str,
    is: &str,
    wanted: &str,
    label: Option<Span>,
    said: Option<Span>,
) -> Diagnostic {
    let fault = Diagnostic::error(
        "message-domain",
        span,
        format!("the function `{name}` of the machine is of {is}, what goes through is of {wanted}"),
    )
    .here("a function has the domain of its channel or device");
    let fault = labelled(fault, label);
    let fault = match said {
        Some(span) => fault.with_label(span, "the chart says it here"),
        None => fault,
    };
    fault.with_help("give both the same domain: one that a module declares which the chart and the machine import")
}

/// A domain that the chart's imports do not declare.
pub(crate) fn unknown_message(span: Span, found: &Diagnostic) -> Diagnostic {
    Diagnostic::error("message-domain", span, found.message.clone())
        .here("the domain of what a channel or device carries")
        .with_help("declare it in a module, and import that in the chart and in the machines")
}

/// A channel without an out function.
pub(crate) fn no_out_function(span: Span, channel: &str, label: Option<Span>) -> Diagnostic {
    let fault = Diagnostic::error("unwritten-channel", span, format!("the machine has no out function `{channel}`"))
        .here(format!("the component writes the channel `{channel}`, and this machine says what"));
    labelled(fault, label).with_help(format!("declare `out {channel}: DOMAIN` in it, and update it"))
}

/// An out function that no rule updates.
pub(crate) fn never_written(span: Span, channel: &str, label: Option<Span>) -> Diagnostic {
    let fault = Diagnostic::error("unwritten-channel", span, format!("the machine never updates `{channel}`"))
        .here(format!("the component writes the channel `{channel}`, and this machine says what"));
    labelled(fault, label).with_help(format!("update it: `{channel} := …`"))
}

/// A datum that is written before anything computes it.
pub(crate) fn written_too_early(span: Span, component: &str, channel: &str) -> Diagnostic {
    Diagnostic::error(
        "unwritten-channel",
        span,
        format!("`{component}` writes `{channel}` before it has elaborated anything"),
    )
    .here("what is written comes from the elaboration before it in the cycle")
    .with_help("put an `elaborate` phase before it")
}

/// An actuator that two machines set.
pub(crate) fn set_twice(span: Span, actuator: &str, first: Span) -> Diagnostic {
    Diagnostic::error("untaken-function", span, format!("two machines set the actuator `{actuator}`"))
        .here("the one that steps last would win")
        .with_label(first, "the first one")
        .with_help("let one component set it, and send it what to set through a channel")
}

/// A name that a component's machine would make, and that there is already.
pub(crate) fn made_twice(span: Span, name: &str, first: Option<Span>) -> Diagnostic {
    let fault = Diagnostic::error("made-name", span, format!("a second `{name}` would be made"))
        .here("the names of a component's machine get the component's name before them");
    let fault = match first {
        Some(first) => fault.with_label(first, "the first one is made from this"),
        None => fault,
    };
    fault.with_help("rename what it is made from, or the component")
}
