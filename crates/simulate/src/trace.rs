//! A trace, record by record: what a run took from outside and what it changed.
//!
//! INVARIANT: header, inputs, writes, choices and times are enough to make the run again. The rest is for readers, and
//! shows where a changed model differs from the trace. Shells own the format of trace files.

use machine::{Change, Fault, Location, TimeUnit, Value};
use syntax::Span;

use crate::choose::ChoiceMade;

/// What is done about an invariant that does not hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Invariants {
    /// It ends the run.
    #[default]
    Stop,
    /// It is reported and the run goes on.
    Report,
    /// Invariants are not evaluated.
    Ignore,
}

/// What a trace says of its run as a whole.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Header {
    /// The machine's name.
    pub model: String,
    /// The path of the model as it was given.
    pub path: String,
    /// A fingerprint of all texts of the model.
    pub source: String,
    /// The seed of random inputs and choices.
    pub seed: Option<u64>,
    /// The most steps to make.
    pub steps: Option<u64>,
    /// Stops at an empty update set.
    pub stop_on_empty: bool,
    /// Stops at an update set that changes nothing.
    pub stop_on_trivial: bool,
    /// The text of the term that stops the run.
    pub until: Option<String>,
    /// What is done about invariants.
    pub invariants: Invariants,
}

/// One record of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Record {
    /// The initial state: all locations that have a value.
    Initial {
        /// Inputs that initial values asked for.
        inputs: Vec<(Location, Value)>,
        /// Choices that initial values made, in order.
        choices: Vec<ChoiceMade>,
        /// Times that initial values asked for.
        times: Vec<(TimeUnit, i64)>,
        /// The state.
        values: Vec<(Location, Value)>,
        /// Invariants that do not hold in it.
        violations: Vec<Violation>,
    },
    /// A step made.
    Step(StepRecord),
    /// A step that was begun and not made: what it took from outside before a fault or a violation ended the run.
    Attempt(StepRecord),
    /// The last step is undone; this one is made next.
    Back {
        /// The next step.
        step: u64,
    },
    /// The run's end.
    End(End),
}

/// A step.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StepRecord {
    /// Its number, from 1.
    pub step: u64,
    /// Values given when asked for.
    pub inputs: Vec<(Location, Value)>,
    /// Shared locations that the environment wrote before the step.
    pub writes: Vec<(Location, Value)>,
    /// Choices in order.
    pub choices: Vec<ChoiceMade>,
    /// Readings of the clock.
    pub times: Vec<(TimeUnit, i64)>,
    /// Locations whose values changed, in canonical order.
    pub changes: Vec<Change>,
    /// How many updates the update set held.
    pub updates: usize,
    /// Whether the state changed.
    pub changed: bool,
    /// Invariants that do not hold.
    pub violations: Vec<Violation>,
}

/// An invariant that does not hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Violation {
    /// Its name.
    pub name: String,
    /// Where it is written.
    pub span: Span,
    /// False, or undef.
    pub value: Value,
    /// It reads inputs, so it is about the state before the step together with the step's inputs.
    pub before: bool,
}

/// Why a run ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// The steps asked for are made.
    Steps,
    /// The update set was empty.
    Empty,
    /// The update set changed nothing.
    Trivial,
    /// The term to stop at holds.
    Until,
    /// An invariant does not hold.
    Violation,
    /// A step could not be made.
    Fault(Box<Fault>),
    /// Stopped from outside.
    Interrupted,
    /// The user at the prompt has seen enough.
    Quit,
}

impl End {
    /// The word that names the reason in trace files.
    pub fn word(&self) -> &'static str {
        match self {
            End::Steps => "steps",
            End::Empty => "empty",
            End::Trivial => "trivial",
            End::Until => "until",
            End::Violation => "violation",
            End::Fault(_) => "fault",
            End::Interrupted => "interrupted",
            End::Quit => "quit",
        }
    }
}
