//! Runs a script to its end, and judges what happened.
//!
//! In: a script and the program it was resolved with. Out: the verdict, and what ran. [`crate::play`] makes the moves.

use std::sync::Arc;

use machine::FaultKind;
use program::Program;
use syntax::ast::Expected;

use crate::coverage::Counts;
use crate::environment::Choices;
use crate::play::Play;
use crate::script::Script;
use crate::stage::{Options, is_trouble};
use crate::verdict::{Failure, FailureKind, Judgement, Verdict};

/// Runs a script on the program it was resolved with.
pub fn run(script: &Script, program: Arc<Program>, options: Options, choices: &mut dyn Choices) -> (Verdict, Counts) {
    let mut play = Play::new(script, Arc::clone(&program), options, choices);
    while play.advance() {}
    let counts = play.machine().coverage().map(|coverage| Counts::of(&program, coverage)).unwrap_or_default();
    (play.verdict(&|steps, failures| judge(script, steps, failures)), counts)
}

/// Holds what has happened up to now against what was expected.
pub fn judged(script: &Script, play: &Play<'_>) -> Judgement {
    judge(script, play.steps(), play.failures().to_vec())
}

/// Holds what happened against what was expected.
fn judge(script: &Script, step: u64, failures: Vec<Failure>) -> Judgement {
    let Some(expectation) = &script.expectation else {
        return if failures.is_empty() { Judgement::Passed } else { Judgement::Failed(failures) };
    };
    let named = |name: &String| expectation.invariant.as_ref().is_none_or(|wanted| wanted == name);
    let fits = |failure: &Failure| match (&failure.kind, expectation.expected) {
        (FailureKind::Expected { .. }, _) => false,
        // It says nothing of the model.
        (FailureKind::Fault { fault, .. }, _) if matches!(fault.kind, FaultKind::Interrupted(_)) => false,
        (_, Expected::Failure) | (FailureKind::Check { .. }, Expected::Check) => true,
        (FailureKind::Invariant { name, .. }, Expected::Invariant) => named(name),
        (FailureKind::Fault { fault, .. }, expected) => is_trouble(fault, expected),
        _ => false,
    };
    if failures.iter().any(fits) {
        return Judgement::FailedAsExpected(failures);
    }
    let kind = FailureKind::Expected {
        expected: expectation.expected,
        invariant: expectation.invariant.clone(),
        instead: failures,
    };
    Judgement::Failed(vec![Failure { step, span: expectation.span, kind }])
}
