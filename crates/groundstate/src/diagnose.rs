//! Run-time trouble as diagnostics: where it happened, what the values were, what to do.

use std::sync::Arc;

use machine::{Closed, Fault, FaultKind, Machine, Show, Value};
use program::Program;
use scenario::{Failure, FailureKind, Reading};
use simulate::Violation;
use syntax::ast::Expected;
use syntax::{Diagnostic, Span};

/// How many of the calls that led to a fault are shown.
const CALLS: usize = 4;

/// A part of a model that solvers have no place for.
pub fn diagnose_outside(outside: &verify::solver::Outside) -> Diagnostic {
    Diagnostic::error("outside-solver", outside.span, format!("{} has no place in what solvers are told", outside.what))
        .here("not told to solvers")
        .with_help("let the states be explored: `--engine explicit`, or `bdd`")
}

/// A fault of a step.
pub fn diagnose_fault(fault: &Fault, program: &Program) -> Diagnostic {
    let message = fault.show(program).to_string();
    let mut diagnostic = match &fault.kind {
        FaultKind::InconsistentUpdate { location, first, second } => {
            let location = location.show(program).to_string();
            let side = |value: &Value| format!("{location} becomes {} here", value.show(program).briefly());
            let clash = Diagnostic::error(fault.kind.id(), second.span, message).here(side(&second.value));
            if first.span == second.span {
                // One rule, run twice: what it was run with tells the two apart.
                clash.here(format!(
                    "{location} becomes {} and {} here",
                    first.value.show(program).briefly(),
                    second.value.show(program).briefly()
                ))
            } else {
                clash.with_label(first.span, side(&first.value))
            }
        }
        _ => Diagnostic::error(fault.kind.id(), fault.span, message).here(reason(&fault.kind)),
    };
    let mut seen: Vec<Span> = vec![diagnostic.primary.span];
    for call in &fault.calls {
        if seen.len() <= CALLS && !seen.contains(call) {
            seen.push(*call);
            diagnostic = diagnostic.with_label(*call, "called here");
        }
    }
    match help(&fault.kind) {
        Some(help) => diagnostic.with_help(help),
        None => diagnostic,
    }
}

/// What is to be seen at the place.
fn reason(kind: &FaultKind) -> &'static str {
    match kind {
        FaultKind::UndefinedGuard => "this is undef",
        FaultKind::UndefinedOperand { .. } => "an operand is undef here",
        FaultKind::DivisionByZero => "the divisor is 0",
        FaultKind::OutOfDomain { .. } => "the value comes here",
        FaultKind::NotEnumerable { .. } => "its elements are needed here",
        FaultKind::Limit { .. } | FaultKind::Interrupted(_) => "reached here",
        FaultKind::Environment { .. } => "asked for here",
        _ => "here",
    }
}

fn help(kind: &FaultKind) -> Option<&'static str> {
    Some(match kind {
        FaultKind::InconsistentUpdate { .. } => {
            "let one rule alone write the location in a step, or put the two in a `seq` if the later one is to win"
        }
        FaultKind::UndefinedGuard => "give the locations it reads an initial value, or test them with `isDef` first",
        FaultKind::UndefinedOperand { .. } => "give the location an initial value, or test it with `isDef` first",
        FaultKind::DivisionByZero => "test the divisor first",
        FaultKind::OutOfDomain { .. } => "keep the value within the domain, or widen the domain",
        FaultKind::Overflow { .. } => "integers have 64 bits: bound the values, or use Real",
        FaultKind::NotEnumerable { .. } => "range over a finite set or domain instead",
        FaultKind::Temporal => "temporal operators belong into CTLSPEC and LTLSPEC",
        _ => return None,
    })
}

/// An invariant that does not hold; `step` is how many steps had been made.
///
/// The machine is in the state after the step; what the invariant reads there is shown, unless it speaks of the
/// state before a step that has been made.
pub fn diagnose_violation(violation: &Violation, step: u64, machine: &mut Machine) -> Diagnostic {
    let program = &Arc::clone(machine.program());
    let when = match (step, violation.before) {
        (0, _) => "in the initial state".to_string(),
        (step, true) => format!("with the inputs of step {step}"),
        (step, false) => format!("after step {step}"),
    };
    let name = match violation.name.strip_prefix("invariant at ") {
        Some(_) => "the invariant".to_string(),
        None => format!("invariant {}", violation.name),
    };
    let message = match violation.value {
        Value::Undef => format!("{name} is undef {when}"),
        _ => format!("{name} does not hold {when}"),
    };
    let diagnostic = Diagnostic::error("invariant-violated", violation.span, message);
    let property = program.properties.iter().find(|property| property.span == violation.span);
    match property {
        Some(property) if !(violation.before && machine.steps() >= step) => {
            let readings = scenario::explain(machine, &mut Closed, &property.formula);
            with_readings(diagnostic, &readings, program)
        }
        _ => diagnostic,
    }
}

/// A failure of a scenario: the failure, then what came instead of what was expected.
pub fn diagnose_failure(failure: &Failure, program: &Program) -> Vec<Diagnostic> {
    let steps = |count: u64| if count == 1 { "1 step".to_string() } else { format!("{count} steps") };
    let after = steps(failure.step);
    let show = |value: &Value| value.show(program).briefly().to_string();
    let one = |diagnostic: Diagnostic| vec![diagnostic];
    match &failure.kind {
        FailureKind::Check { expected, actual, reads } => {
            let message = format!("check failed after {after}: expected {}, found {}", show(expected), show(actual));
            one(with_readings(Diagnostic::error("check-failed", failure.span, message), reads, program))
        }
        FailureKind::Invariant { name, value, during, reads } => {
            let verb = if value.is_undef() { "is undef" } else { "does not hold" };
            let message = format!("invariant {name} {verb} after {after}");
            let diagnostic = Diagnostic::error("invariant-violated", failure.span, message);
            let diagnostic = if *during == failure.span {
                diagnostic
            } else {
                diagnostic.with_label(*during, "here in the scenario")
            };
            one(with_readings(diagnostic, reads, program))
        }
        FailureKind::Fault { fault, during } => {
            let diagnostic = diagnose_fault(fault, program);
            let diagnostic =
                if *during == fault.span { diagnostic } else { diagnostic.with_label(*during, "here in the scenario") };
            one(diagnostic)
        }
        FailureKind::Pick { choice, message } => {
            let diagnostic = Diagnostic::error("pick-no-candidate", failure.span, format!("after {after}: {message}"));
            one(diagnostic.with_label(*choice, "the choice that was to be made"))
        }
        FailureKind::Bound { bound } => {
            let message = format!("the condition did not hold within {}", steps(*bound));
            one(Diagnostic::error("bound-reached", failure.span, message)
                .with_help("write `step until … within N;` to allow more"))
        }
        FailureKind::Expected { expected, invariant, instead } => {
            let what = expected_words(*expected, invariant.as_deref());
            let came = if instead.is_empty() { "none came" } else { "something else happened" };
            let mut all =
                one(Diagnostic::error("expected-failure", failure.span, format!("{what} was expected, but {came}")));
            all.extend(instead.iter().flat_map(|failure| diagnose_failure(failure, program)));
            all
        }
    }
}

fn expected_words(expected: Expected, invariant: Option<&str>) -> String {
    match (expected, invariant) {
        (Expected::Failure, _) => "a failure".to_string(),
        (Expected::Check, _) => "a failed check".to_string(),
        (Expected::Invariant, Some(name)) => format!("a violation of invariant {name}"),
        (Expected::Invariant, None) => "a violated invariant".to_string(),
        (Expected::InconsistentUpdate, _) => "an inconsistent update".to_string(),
        (Expected::Error, _) => "a run-time error".to_string(),
    }
}

fn with_readings(diagnostic: Diagnostic, reads: &[Reading], program: &Program) -> Diagnostic {
    reads.iter().fold(diagnostic, |diagnostic, reading| {
        diagnostic.with_label(reading.span, format!("is {}", reading.value.show(program).briefly()))
    })
}
