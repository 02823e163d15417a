//! Turns what goes wrong in a run into diagnostics: where it happened, the values involved, what to do.
//!
//! In: a fault of a step or a violated invariant, and the program. Out: a diagnostic.

use std::sync::Arc;

use machine::{Closed, Fault, FaultKind, Machine, Show, Value};
use model::Model;
use program::Program;
use scenario::Reading;
use simulate::{End, Record, Run, Violation};
use syntax::{Diagnostic, FileId, Span};

/// How many of the calls that led to a fault are shown.
const CALLS: usize = 4;

/// A fault of a step.
pub fn diagnose_fault(fault: &Fault, program: &Program) -> Diagnostic {
    let message = fault.show(program).to_string();
    let mut diagnostic = match &fault.kind {
        FaultKind::InconsistentUpdate { location, first, second } => {
            let location = location.show(program).to_string();
            let side = |value: &Value| format!("{location} becomes {} here", value.show(program).briefly());
            let clash = Diagnostic::error(fault.kind.id(), second.span, message).here(side(&second.value));
            if first.span == second.span {
                // One rule that ran twice: its arguments tell the two runs apart.
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

/// The reason, as the label at the place.
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
            "let only one rule write the location in a step, or put the two in a `seq` if the later one is to win"
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

/// An invariant that does not hold; `step` is the number of steps made so far.
///
/// The machine is in the state after the step. The values that the invariant reads there are shown, unless the
/// violation is about the state before a step that has been made.
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

/// The faults in the record that `run` has just made.
pub fn diagnose_record(record: &Record, run: &mut Run) -> Vec<Diagnostic> {
    let mut violated = |violations: &[Violation], step: u64| {
        violations.iter().map(|violation| diagnose_violation(violation, step, run.machine_mut())).collect()
    };
    match record {
        Record::Initial { violations, .. } => violated(violations, 0),
        Record::Step(step) | Record::Attempt(step) => violated(&step.violations, step.step),
        Record::End(End::Fault(fault)) => vec![diagnose_fault(fault, run.machine().program())],
        Record::End(_) | Record::Back { .. } => Vec::new(),
    }
}

pub(super) fn with_readings(diagnostic: Diagnostic, reads: &[Reading], program: &Program) -> Diagnostic {
    reads.iter().fold(diagnostic, |diagnostic, reading| {
        diagnostic.with_label(reading.span, format!("is {}", reading.value.show(program).briefly()))
    })
}

/// A model that should run has no main rule.
pub fn diagnose_no_main(model: &Model) -> Diagnostic {
    missing_main(start(model.root))
}

pub(crate) fn start(file: FileId) -> Span {
    Span { file, start: 0, end: 0 }
}

/// There is no text in a file but comments. Nothing was checked, so it is no model without faults.
pub(crate) fn no_model(file: FileId) -> Diagnostic {
    Diagnostic::error("no-main-rule", start(file), "the file has no model: there is nothing in it")
        .with_help("write `asm NAME` or `module NAME`, with NAME as the file is called")
}

pub(crate) fn missing_main(span: Span) -> Diagnostic {
    Diagnostic::error("no-main-rule", span, "the model has no main rule to run").with_help(
        "add `main rule r_Main = …` behind the other rules; what other models import is a `module`, and is run through an \
         `asm` that imports it",
    )
}
