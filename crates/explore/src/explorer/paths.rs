//! The alternatives of one state, told one by one: for traces, graphs and whoever wants to know how an edge came about.
//!
//! In: a packed state. Out: what each alternative was and came to. Nothing here is remembered.

use std::ops::ControlFlow;

use machine::{Fault, Location, Value};

use crate::alternatives::kind::AlternativeKind;
use crate::alternatives::told::ChoiceTaken;
use crate::alternatives::unbounded::Unbounded;
use crate::explorer::Explorer;
use crate::packed::widening::Widening;
use crate::packed::words::apply;

/// What an alternative came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// The next state.
    Next(Box<[u64]>),
    /// The step cannot be made.
    Fault(Box<Fault>),
    /// Its alternatives cannot be gone through.
    Unbounded(Unbounded),
    /// An assumption does not hold of the step's inputs.
    Excluded,
}

/// An alternative of a state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Path {
    /// The answers given, which lead to it again.
    pub picks: Vec<u32>,
    /// What it came to.
    pub outcome: Outcome,
    /// The conditions on the step that do not hold, by their numbers.
    pub failed: Vec<u32>,
    /// What was chosen.
    pub choices: Vec<ChoiceTaken>,
    /// The inputs given, in the order asked.
    pub inputs: Vec<(Location, Value)>,
}

impl Explorer {
    /// Each alternative of a state, in order; false where these are not all, since whoever waits has had enough.
    ///
    /// # Errors
    /// A successor does not fit.
    pub fn paths(&mut self, state: &[u64], visit: &mut dyn FnMut(Path)) -> Result<bool, Widening> {
        self.paths_until(state, &mut |path| {
            visit(path);
            ControlFlow::Continue(())
        })
    }

    /// The same until a visit breaks off.
    ///
    /// # Errors
    /// A successor does not fit.
    pub fn paths_until(
        &mut self,
        state: &[u64],
        visit: &mut dyn FnMut(Path) -> ControlFlow<()>,
    ) -> Result<bool, Widening> {
        self.branches.first();
        loop {
            if self.settings.interrupt.is_raised() {
                return Ok(false);
            }
            if let Some(attempt) = self.attempt(state)? {
                let picks = self.branches.answers().iter().map(|asked| asked.taken).collect();
                let outcome = match (attempt.kind, attempt.fault, self.branches.unbounded) {
                    (AlternativeKind::Next, ..) => {
                        let mut next: Box<[u64]> = state.into();
                        apply(&attempt.overwrites, &mut next);
                        Outcome::Next(next)
                    }
                    (_, _, Some(unbounded)) => Outcome::Unbounded(unbounded),
                    (_, Some(fault), _) => Outcome::Fault(fault),
                    _ => Outcome::Excluded,
                };
                let choices = std::mem::take(&mut self.branches.chosen);
                let inputs = self.machine.inputs();
                if visit(Path { picks, outcome, failed: attempt.failed, choices, inputs }).is_break() {
                    return Ok(true);
                }
            }
            if !self.branches.next() {
                return Ok(true);
            }
        }
    }
}
