//! A moment between two steps: what the last step did, and the state that it led to.
//!
//! In: what a thread that runs a model or a scenario has seen. Out: a [`Moment`], which its owner reads. It never changes.

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Change, Coverage, Location, Snapshot, Value};
use program::{Program, Rule, RuleId};
use syntax::{Diagnostic, Span};

use crate::job::desk::Frozen;
use crate::session::breaks::Hit;

/// See the module.
#[derive(Debug, Clone)]
pub struct Moment {
    /// How many steps have been made.
    pub step: u64,
    /// Something ran to get here; else a command of a scenario was made that runs nothing, and the last step is as before.
    pub ran_now: bool,
    /// What the last step changed.
    pub changes: Vec<Change>,
    /// Updates that ran in it and changed nothing, in the order of the program.
    pub idle: Vec<Span>,
    /// The rules that ran in it, attempts included.
    pub ran: Vec<RuleId>,
    /// The inputs that are known.
    pub inputs: Vec<(Location, Value)>,
    /// Its choices, each with its place.
    pub choices: Vec<(Span, Vec<Value>)>,
    /// What is wrong: a fault, violated invariants, what a scenario finds.
    pub faults: Vec<Diagnostic>,
    /// Of a scenario: the command that comes next.
    pub next: Option<Span>,
    /// Why the run has ended, in a word.
    pub end: Option<&'static str>,
    /// Of a scenario: checks that held, and checks that did not.
    pub checks: (u64, u64),
    /// What stops the run here.
    pub hit: Option<Hit>,
    /// How often each break was reached on the way here, by its number.
    pub reached: BTreeMap<u64, u64>,
    /// The state.
    pub snapshot: Arc<Snapshot>,
}

impl Moment {
    /// The moment after so many steps of a run, the last of which took these inputs.
    pub fn after(step: u64, state: &Frozen, inputs: Vec<(Location, Value)>) -> Moment {
        let snapshot = Arc::clone(&state.0);
        Moment { step, inputs, ..Moment::with(snapshot) }
    }

    /// A moment at which nothing has happened.
    pub(crate) fn new(snapshot: Snapshot) -> Moment {
        Moment::with(Arc::new(snapshot))
    }

    fn with(snapshot: Arc<Snapshot>) -> Moment {
        Moment {
            step: 0,
            ran_now: true,
            changes: Vec::new(),
            idle: Vec::new(),
            ran: Vec::new(),
            inputs: Vec::new(),
            choices: Vec::new(),
            faults: Vec::new(),
            next: None,
            end: None,
            checks: (0, 0),
            hit: None,
            reached: BTreeMap::new(),
            snapshot,
        }
    }

    /// Notes which rules ran, and which of their updates changed nothing.
    pub(crate) fn note_ran(&mut self, program: &Program, ran: Vec<RuleId>) {
        let changing = |span: &Span| self.changes.iter().any(|change| change.span == *span);
        let updates = ran.iter().filter(|rule| matches!(program.rule(**rule), Rule::Update { .. }));
        let mut idle: Vec<Span> = updates.map(|rule| program.rule_span(*rule)).filter(|span| !changing(span)).collect();
        idle.dedup();
        (self.idle, self.ran) = (idle, ran);
    }
}

/// Which rules ran since the last look.
#[derive(Debug, Default)]
pub(crate) struct Ran(Vec<u64>);

impl Ran {
    /// The rules that have run since, in the order of the program.
    pub fn since(&mut self, coverage: Option<&Coverage>) -> Vec<RuleId> {
        let Some(Coverage { executed, .. }) = coverage else { return Vec::new() };
        self.0.resize(executed.len(), 0);
        let grown = executed.iter().zip(&self.0).zip(0..).filter(|((now, then), _)| now > then);
        let ran = grown.map(|(_, rule)| RuleId(rule)).collect();
        self.0.clone_from(executed);
        ran
    }
}
