//! The faults of a system's times: what cannot hold on its processors, and how old data may be.

use syntax::{Diagnostic, Span};

fn on(processors: u64) -> String {
    if processors == 1 { "one processor".to_string() } else { format!("{processors} processors") }
}

/// No processor at all.
pub(crate) fn no_processor(span: Span) -> Diagnostic {
    Diagnostic::error("overloaded", span, "a system without a processor does nothing")
        .here("the tasks share these")
        .with_help("write `processors 1`, or more")
}

/// An unknown unit of time behind this number.
pub(crate) fn unknown_unit(span: Span, number: &str, unit: &str) -> Diagnostic {
    Diagnostic::error("time-unit", span, format!("`{unit}` is not a unit of time"))
        .here("a time needs a unit")
        .with_help(match period(number, unit) {
            Some(nanoseconds) => {
                format!("{number} {unit} is once in {nanoseconds} ns: write a time, in `ns`, `us`, `ms` or `s`")
            }
            None => "write `ns`, `us`, `ms` or `s`".to_string(),
        })
}

/// How long a cycle of this frequency takes, in nanoseconds.
fn period(number: &str, unit: &str) -> Option<u64> {
    let hertz = match unit {
        "Hz" => 1.0,
        "kHz" => 1e3,
        "MHz" => 1e6,
        _ => return None,
    };
    let nanoseconds = 1e9 / (number.parse::<f64>().ok()? * hertz);
    nanoseconds.is_finite().then_some(nanoseconds.round() as u64)
}

/// A period of no length.
pub(crate) fn no_period(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "a period takes at least a tick")
        .here("cycles would begin all at once")
        .with_help("write a longer period")
}

/// A jitter of no length.
pub(crate) fn no_jitter(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "a jitter takes at least a tick")
        .here("every cycle would be released just when its period starts")
        .with_help("leave the jitter out, or write a longer one")
}

/// A jitter that is longer than the period.
pub(crate) fn long_jitter(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "a cycle is released within its period")
        .here("the jitter is longer than the period")
        .with_help("write a jitter that is no longer than the period")
}

/// A jitter of a component without a period.
pub(crate) fn no_period_of_jitter(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error(
        "time-unit",
        span,
        format!("`{name}` is asynchronous: it has no period that its releases could miss"),
    )
    .here("a jitter is how much later than its period a cycle may be released")
    .with_help("leave the jitter out, or make the component synchronous and give it a period")
}

/// An offset that is longer than the period.
pub(crate) fn late_offset(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "the first cycle begins within the first period")
        .here("the offset is longer than the period")
        .with_help("write an offset that is no longer than the period")
}

/// More synchronous work than the processors can do.
pub(crate) fn overloaded(span: Span, needed: f64, processors: u64) -> Diagnostic {
    let message = format!("the synchronous tasks need {needed:.2} processors, more than there are");
    Diagnostic::error("overloaded", span, message)
        .here(format!("the tasks share {}", on(processors)))
        .with_help("shorten phases, make periods longer, or give the system more processors")
}

/// A task that may end after its deadline.
pub(crate) fn late_response(
    span: Span,
    name: &str,
    certain: bool,
    reason: &str,
    deadline: &str,
    (processors, more_help): (u64, bool),
) -> Diagnostic {
    // That it is late for certain is known of more urgent tasks alone. Otherwise nobody knows what keeps it waiting, if anything does.
    let (misses, cause) = match certain {
        true => ("misses", "more urgent tasks keep it waiting"),
        false => ("may miss", "the analysis does not show that it ends in time"),
    };
    let message = format!("`{name}` {misses} its deadline of {deadline} on {}: {reason}", on(processors));
    Diagnostic::warning("late-response", span, message).here(cause).with_help(match more_help {
        true => "`groundstate chart times` shows the times of all tasks; shorten phases, or use more processors",
        false => "`groundstate chart times` shows the times of all tasks; shorten phases, or allow a later deadline",
    })
}

/// An age bound below what the phases alone take.
pub(crate) fn never_fresh(span: Span, from: &str, to: &str, limit: &str, least: &str) -> Diagnostic {
    let message = format!("what `{to}` gets from `{from}` is never as young as {limit}: the phases alone take {least}");
    Diagnostic::error("age-bound", span, message)
        .here("the age that data may have")
        .with_help("allow more time, or shorten the phases on the way")
}

/// An age bound between places that no channel connects.
pub(crate) fn no_way(span: Span, from: &str, to: &str, reason: &str) -> Diagnostic {
    Diagnostic::error("age-bound", span, format!("no data come from `{from}` to `{to}`: {reason}"))
        .here("an age is that of data on their way through channels")
        .with_help("name a component or sensor, and a component or actuator, that channels connect")
}

/// A task that may miss all deadlines.
pub(crate) fn all_missed(span: Span, missed: u64, cycles: u64) -> Diagnostic {
    Diagnostic::error(
        "missed-deadlines",
        span,
        format!("{missed} of {cycles} are all: its deadlines would say nothing"),
    )
    .here("how many deadlines may be missed")
    .with_help("allow fewer misses than cycles, as in `misses 1 of 20`")
}

/// More cycles than are looked at.
pub(crate) fn long_window(span: Span, most: u64) -> Diagnostic {
    Diagnostic::error("missed-deadlines", span, format!("missed deadlines are counted among {most} cycles at most"))
        .here("how many deadlines may be missed")
        .with_help("state it for fewer cycles: `misses 1 of 1000` allows no more than `misses 2 of 2000`")
}

/// A bound below what periods allow.
pub(crate) fn seldom_fresh(span: Span, name: &str, limit: &str, who: &str, period: &str) -> Diagnostic {
    let message = format!("`{name}` cannot bring something new every {limit}: {who} once in {period}");
    Diagnostic::error("fresh-bound", span, message)
        .here("the longest time until something new comes")
        .with_help("allow a longer time, or let both ends work more often")
}

/// More ways than are told apart.
pub(crate) fn many_ways(span: Span, most: usize) -> Diagnostic {
    Diagnostic::error("age-bound", span, format!("data take more than {most} ways between these"))
        .here("each way is followed by itself")
        .with_help("state bounds for parts of the way")
}
