//! Turns the findings of a review into diagnostics: where it is, what is wrong, what to do.

use machine::{Location, Show, Value};
use program::Program;
use syntax::Diagnostic;
use verify::review::{Finding, Matter, Review};

/// LIMIT: a message names at most this many values or locations.
const NAMED: usize = 8;

/// The kinds of diagnostics that only reviews produce.
pub const REVIEW_IDS: &[&str] =
    &["incomplete-conditional", "trivial-update", "unused-element", "value-never-taken", "never-updated", "never-read"];

/// A finding. If not every state was visited, the message counts those that were.
pub fn diagnose_finding(finding: &Finding, review: &Review, program: &Program) -> Diagnostic {
    let span = finding.span;
    let seen = match (review.reasons.is_empty(), review.progress.states) {
        (true, _) => "no reachable state".to_string(),
        (false, states) => format!("none of the {states} states explored so far"),
    };
    let warning = |id, message: String| Diagnostic::warning(id, span, message);
    let never = |what: &str| format!("{seen} {what}");
    match &finding.matter {
        Matter::Clash(other) => {
            let diagnostic = Diagnostic::error("inconsistent-update", span, "two updates of one step clash");
            let diagnostic = diagnostic.here("one of the two").with_label(*other, "the other one");
            diagnostic.with_help("let only one rule write the location in a step, or put the two in a `seq`")
        }
        Matter::NoBranch => {
            warning("incomplete-conditional", "no branch of this rule is taken in some state".to_string())
                .here("runs while none of its guards holds")
                .with_help("if nothing should happen then, add `else skip`; otherwise a case is missing")
        }
        Matter::NeverRuns => warning("unreachable-rule", never("runs this rule"))
            .here("never runs")
            .with_help("if it should run, its guard or what leads to it is wrong; else remove it"),
        Matter::NeverCalled(name) => warning("unreachable-rule", format!("nothing that runs calls {name}"))
            .here("never runs")
            .with_help("call it, or remove it"),
        Matter::RunsInFaults => {
            warning("unreachable-rule", "this rule runs only in steps that cannot be made".to_string())
                .here("every step that runs it faults")
                .with_help("`groundstate verify` shows the fault")
        }
        Matter::AlwaysTrivial => warning("trivial-update", never("is changed by this update"))
            .here("always writes the present value")
            .with_help("remove it, or see whether it should write something else"),
        Matter::Unused(domain, values) => {
            let name = &program.domain(*domain).name;
            warning("unused-element", never(&format!("has a location with {} of {name}", named(values, program))))
                .here("has elements that are no location's value")
                .with_help("see why nothing becomes one of them; remove those that are no arguments either")
        }
        Matter::NeverTaken(function, values) => {
            let function = program.function(*function);
            let domain = &program.domain(function.codomain).name;
            warning(
                "value-never-taken",
                never(&format!("gives {} the value {}", function.name, named(values, program))),
            )
            .here(format!("could be declared over less than {domain}"))
            .with_help("declare it over a smaller domain, or see why it never takes the value")
        }
        Matter::NeverUpdated(function, locations) => {
            let name = &program.function(*function).name;
            warning("never-updated", format!("no rule updates {}", places(name, locations, program)))
                .here("keeps its initial value")
                .with_help("declare it static, or see why nothing updates it")
        }
        Matter::NeverRead(function, locations) => {
            let name = &program.function(*function).name;
            warning("never-read", format!("no rule reads {}", places(name, locations, program)))
                .here("has no influence on a run")
                .with_help("remove it; if it is there for others to read, declare it `out`")
        }
    }
}

fn places(function: &str, locations: &[Location], program: &Program) -> String {
    match locations {
        [] => function.to_string(),
        _ => joined(locations.iter().map(|location| location.show(program).to_string()), "and"),
    }
}

fn named(values: &[Value], program: &Program) -> String {
    joined(values.iter().map(|value| value.show(program).to_string()), "or")
}

/// Joins the first of some words into one phrase.
fn joined(words: impl ExactSizeIterator<Item = String>, last: &str) -> String {
    let count = words.len();
    let mut words: Vec<String> = words.take(NAMED).collect();
    if count > NAMED {
        return format!("{} {last} {} others", words.join(", "), count - NAMED);
    }
    match words.pop() {
        Some(end) if words.is_empty() => end,
        Some(end) => format!("{} {last} {end}", words.join(", ")),
        None => String::new(),
    }
}
