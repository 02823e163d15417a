//! Turns what is wrong with a scenario's run into diagnostics: the failure, the actual values, what was not used.
//!
//! In: a failure or a remark of a verdict, and the program. Out: diagnostics, the failure first.

use machine::{Show, Value};
use program::Program;
use scenario::{Failure, FailureKind, Remark};
use syntax::ast::Expected;
use syntax::{Diagnostic, Span};

use super::run::{diagnose_fault, with_readings};

/// The model that a scenario loads does not exist.
pub(crate) fn unknown_model(place: Span, message: String) -> Diagnostic {
    Diagnostic::error("unknown-model", place, message)
}

/// Something odd about a scenario that passes.
pub fn diagnose_remark(remark: &Remark) -> Diagnostic {
    Diagnostic::warning("unused-pick", remark.span, remark.message.as_str())
}

/// A failure of a scenario, followed by the actual values.
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
                .with_help(format!("write `step until … within N;` with an N above {bound} to allow more")))
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
