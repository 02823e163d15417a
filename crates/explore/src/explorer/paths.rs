//! The alternatives of one state, told one by one: for traces, graphs and whoever wants to know how an edge came about.
//!
//! In: a packed state. Out: what each alternative was and came to. Nothing here is remembered.

use std::ops::ControlFlow;

use machine::{Fault, Location, Machine, Value};
use program::{Expression, Slot};

use crate::alternatives::branches::Branches;
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

/// A step that can be made, before it is: what it reads, it asks for as the step does.
pub struct Reading<'r> {
    pub(super) machine: &'r mut Machine,
    pub(super) branches: &'r mut Branches,
}

impl std::fmt::Debug for Reading<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Reading").finish_non_exhaustive()
    }
}

impl Reading<'_> {
    /// The value of a term with parameters, in the state before the step and with its inputs.
    ///
    /// # Errors
    /// What evaluation meets. A fault that is not of the model is to be passed on.
    pub fn value(&mut self, term: &Expression, arguments: &[Value]) -> Result<Value, Fault> {
        let bindings: Vec<(Slot, Value)> = (0..).map(Slot).zip(arguments.iter().cloned()).collect();
        self.machine.evaluate_with(term.body, term.frame, &bindings, self.branches)
    }
}

/// Whoever goes through the alternatives of a state.
pub trait Visitor {
    /// Reads something in a step that can be made. What it asks for makes alternatives of its own. It reads by
    /// [`crate::Settings::read_in_steps`] alone.
    ///
    /// # Errors
    /// A fault that is not of the model: the step cannot be gone through.
    fn read(&mut self, step: &mut Reading<'_>) -> Result<(), Fault>;

    /// Is told of an alternative, behind what was read in it.
    fn visit(&mut self, path: Path) -> ControlFlow<()>;
}

/// Reads nothing.
struct Only<'v>(&'v mut dyn FnMut(Path) -> ControlFlow<()>);

impl Visitor for Only<'_> {
    fn read(&mut self, _: &mut Reading<'_>) -> Result<(), Fault> {
        Ok(())
    }

    fn visit(&mut self, path: Path) -> ControlFlow<()> {
        (self.0)(path)
    }
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
        self.paths_read(state, &mut Only(visit))
    }

    /// The same by somebody who reads more in each step than it does itself.
    ///
    /// # Errors
    /// A successor does not fit.
    pub fn paths_read(&mut self, state: &[u64], visitor: &mut dyn Visitor) -> Result<bool, Widening> {
        self.branches.first();
        self.refusals.begin();
        loop {
            if self.settings.interrupt.is_raised() {
                return Ok(false);
            }
            if let Some(attempt) = self.attempt(state, &mut |step| visitor.read(step))? {
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
                if visitor.visit(Path { picks, outcome, failed: attempt.failed, choices, inputs }).is_break() {
                    return Ok(true);
                }
            }
            if !self.branches.next() {
                return Ok(true);
            }
        }
    }
}
