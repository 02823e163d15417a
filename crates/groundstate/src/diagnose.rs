//! Run-time trouble as diagnostics: where it happened, what the values were, what to do.

use machine::{Fault, FaultKind, Show, Value};
use program::Program;
use simulate::Violation;
use syntax::{Diagnostic, Span};

/// How many of the calls that led to a fault are shown.
const CALLS: usize = 4;

/// A fault of a step.
pub fn diagnose_fault(fault: &Fault, program: &Program) -> Diagnostic {
    let message = fault.show(program).to_string();
    let mut diagnostic = match &fault.kind {
        FaultKind::InconsistentUpdate { location, first, second } => {
            let location = location.show(program).to_string();
            let side = |value: &Value| format!("{location} becomes {} here", value.show(program));
            let clash = Diagnostic::error(fault.kind.id(), second.span, message).because(side(&second.value));
            if first.span == second.span {
                // One rule, run twice: what it was run with tells the two apart.
                clash.because(format!(
                    "{location} becomes {} and {} here",
                    first.value.show(program),
                    second.value.show(program)
                ))
            } else {
                clash.with_label(first.span, side(&first.value))
            }
        }
        _ => Diagnostic::error(fault.kind.id(), fault.span, message).because(reason(&fault.kind)),
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
        FaultKind::OutOfDomain { .. } => "this update",
        FaultKind::NotEnumerable { .. } => "its elements are needed here",
        FaultKind::Limit { .. } => "reached here",
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
        FaultKind::OutOfDomain { .. } => "guard the update, or widen the domain",
        FaultKind::Overflow { .. } => "integers have 64 bits: bound the values, or use Real",
        FaultKind::NotEnumerable { .. } => "range over a finite set or domain instead",
        FaultKind::Temporal => "temporal operators belong into CTLSPEC and LTLSPEC",
        _ => return None,
    })
}

/// An invariant that does not hold; `step` is how many steps had been made.
pub fn diagnose_violation(violation: &Violation, step: u64, program: &Program) -> Diagnostic {
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
    let mut diagnostic = Diagnostic::error("invariant-violated", violation.span, message);
    for (span, value) in &violation.reads {
        diagnostic = diagnostic.with_label(*span, format!("= {}", value.show(program)));
    }
    diagnostic
}
