//! Machines that a model does not run, begins otherwise, or lets others change.

use syntax::{Diagnostic, Span};

/// A machine that the model has a rule for, which nothing calls.
pub(crate) fn machine_not_run(span: Span, rule: &str, declared: Span) -> Diagnostic {
    Diagnostic::warning("chart-differs", span, format!("nothing runs the machine: no rule that runs calls `{rule}`"))
        .here("this machine")
        .with_label(declared, "the main rule does not lead here")
        .with_help("call it in the main rule, or declare it as a `pattern`, which runs where it is called")
}

/// A rule written by hand that sets what is for a machine alone.
pub(crate) fn set_elsewhere(span: Span, function: &str, rule: &str, place: Span) -> Diagnostic {
    let message = format!("`{rule}` sets `{function}`, which the chart leaves to its machine: no arrow shows that");
    Diagnostic::error("chart-differs", span, message)
        .here("the machine")
        .with_label(place, "set here")
        .with_help("draw it as an arrow, or take it out of the rule")
}

/// A machine that the model begins in another state.
pub(crate) fn other_beginning(span: Span, drawn: &str, written: &str, place: Option<Span>) -> Diagnostic {
    let fault = Diagnostic::error(
        "chart-differs",
        span,
        format!("the chart begins in `{drawn}`, and the model in `{written}`"),
    )
    .here("the chart's first state");
    match place {
        Some(place) => fault
            .with_label(place, "the model's")
            .with_help("change the initial value, or say `initial` of the other state"),
        None => fault.with_help("give the control variable this value in the initial state, which sets nothing"),
    }
}

/// A function that the chart takes for undef until something happens, and that begins with a value in the model.
pub(crate) fn begins_too_early(
    span: Span,
    (function, until): (&str, &str),
    written: &str,
    place: Option<Span>,
) -> Diagnostic {
    let message = format!("`{function}` is undef in the chart until {until}, and begins with `{written}` in the model");
    let fault =
        Diagnostic::error("chart-differs", span, message).here("the chart's").with_help("leave its initial value out");
    place.into_iter().fold(fault, |fault, place| fault.with_label(place, "the model's"))
}

/// The same where the model's value is computed.
pub(crate) fn undef_not_compared(span: Span, (function, until): (&str, &str), place: Span) -> Diagnostic {
    let message = format!("that `{function}` is undef until {until}, as in the chart, was not looked at");
    Diagnostic::warning("chart-differs", span, message)
        .here("the chart's")
        .with_label(place, "the model computes its initial value")
        .with_help("leave its initial value out")
}

/// A machine whose first state is computed in the model.
pub(crate) fn beginning_not_compared(span: Span, drawn: &str, place: Span) -> Diagnostic {
    let message = format!("that the model begins in `{drawn}`, as the chart does, was not looked at");
    Diagnostic::warning("chart-differs", span, message)
        .here("the chart's first state")
        .with_label(place, "the model computes its own")
        .with_help("write it as a literal to have it compared")
}
