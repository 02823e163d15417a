//! The result of a scenario.

use machine::{Fault, Value};
use syntax::Span;
use syntax::ast::Expected;

use crate::explain::Reading;
use crate::story::Story;

/// The result of a scenario.
#[derive(Debug, Clone)]
pub struct Verdict {
    /// Its name.
    pub name: String,
    /// Passed, or what is wrong.
    pub judgement: Judgement,
    /// Steps made.
    pub steps: u64,
    /// Checks that held, and checks that did not.
    pub checks: (u64, u64),
    /// What is odd but not wrong.
    pub remarks: Vec<Remark>,
    /// What happened, if [`Options::story`](crate::Options::story) asks for it.
    pub story: Option<Story>,
}

/// Passed or not.
#[derive(Debug, Clone)]
pub enum Judgement {
    /// All is as the scenario says.
    Passed,
    /// As the scenario says, it failed, in this way.
    FailedAsExpected(Vec<Failure>),
    /// In these ways it is not.
    Failed(Vec<Failure>),
}

impl Verdict {
    /// All is as the scenario says.
    pub fn passed(&self) -> bool {
        !matches!(self.judgement, Judgement::Failed(_))
    }

    /// What is wrong; nothing for one that passed.
    pub fn failures(&self) -> &[Failure] {
        match &self.judgement {
            Judgement::Failed(failures) => failures,
            _ => &[],
        }
    }
}

/// Something odd.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Where in the scenario.
    pub span: Span,
    /// A sentence.
    pub message: String,
}

/// One failure.
#[derive(Debug, Clone)]
pub struct Failure {
    /// How many steps had been made.
    pub step: u64,
    /// Where in the scenario: the check, the step, the expectation; an invariant of the model at its own place.
    pub span: Span,
    /// What happened.
    pub kind: FailureKind,
}

/// What happened.
#[derive(Debug, Clone)]
pub enum FailureKind {
    /// A check does not hold.
    Check {
        /// What it should have been: the right side of `a = b`, otherwise true.
        expected: Value,
        /// What it was: the left side of `a = b`, otherwise false or undef.
        actual: Value,
        /// The locations and derived functions that the check reads.
        reads: Vec<Reading>,
    },
    /// An invariant does not hold.
    Invariant {
        /// Its name.
        name: String,
        /// False or undef.
        value: Value,
        /// The step of the scenario in which it happened.
        during: Span,
        /// What it reads.
        reads: Vec<Reading>,
    },
    /// A step, a check or a set could not be computed.
    Fault {
        /// The machine's fault.
        fault: Box<Fault>,
        /// The scenario's command.
        during: Span,
    },
    /// A `pick` whose value is not a candidate.
    Pick {
        /// The choose rule.
        choice: Span,
        /// A sentence.
        message: String,
    },
    /// `step until` reached its bound.
    Bound {
        /// The bound.
        bound: u64,
    },
    /// A failure was expected and did not come, or another one came.
    Expected {
        /// Which.
        expected: Expected,
        /// The invariant that was named.
        invariant: Option<String>,
        /// What happened instead, if anything did.
        instead: Vec<Failure>,
    },
}
