//! What an explorer is made with, and why there may be none.

use std::sync::Arc;

use machine::inside::SharedCode;
use machine::{Bounds, Cause, EngineChoice, Fault, Interrupt, Limits};
use program::Expression;

use crate::alternatives::unbounded::Unbounded;
use crate::packed::widening::Widening;

/// What an explorer is made with.
#[derive(Debug, Clone, Default)]
pub struct Settings {
    /// The machine's limits.
    pub limits: Limits,
    /// The values of inputs that are not all those of their domains.
    pub bounds: Arc<Bounds>,
    /// Conditions on states.
    pub conditions: Vec<Expression>,
    /// Conditions on a state with the inputs of its step; whether each is an assumption, by which alternatives are left
    /// out.
    pub step_conditions: Vec<(Expression, bool)>,
    /// From this condition on steps on, each second one is the negation of the one before, and is decided with it.
    pub in_pairs_from: Option<usize>,
    /// What a [`crate::Visitor`] reads in steps.
    pub read_in_steps: Vec<Expression>,
    /// Nothing is remembered.
    pub forgetful: bool,
    /// What makes the steps that are not remembered; by itself the explorer compiles them where remembering does not pay.
    pub engine: EngineChoice,
    /// The code of the steps, once an explorer has compiled them.
    pub code: SharedCode,
    /// Collections get numbers, and no step changes a piece of one: for who goes through sets of states, or permutes them.
    pub numbered: bool,
    /// Looked at between the alternatives of a state, of which there may be many.
    pub interrupt: Interrupt,
    /// What happens within steps is told: see [`crate::Explorer::sightings`].
    pub observed: bool,
    /// By term, where any is: a range whose elements are to be interchangeable. Quantifiers look at all of them, and where a
    /// fault may depend on their order [`crate::Explorer::order_mattered`] tells.
    pub unordered: Arc<[bool]>,
}

impl Settings {
    /// The conditions on steps in the order in which they are evaluated: assumptions first, since a step that they exclude counts for
    /// nothing else.
    pub(crate) fn checks_of_steps(&self) -> impl Iterator<Item = Check<'_>> {
        let pairs = self.in_pairs_from.unwrap_or(usize::MAX);
        let check = move |index: usize| {
            let (formula, assumed) = &self.step_conditions[index];
            let negation = (index >= pairs).then_some(index as u32 + 1);
            Check { index: index as u32, formula, assumed: *assumed, negation }
        };
        let is_evaluated = move |index: &usize| *index < pairs || (index - pairs).is_multiple_of(2);
        let all = move || (0..self.step_conditions.len()).filter(is_evaluated).map(check);
        all().filter(|check| check.assumed).chain(all().filter(|check| !check.assumed))
    }
}

/// A condition on a step.
pub(crate) struct Check<'s> {
    pub index: u32,
    pub formula: &'s Expression,
    /// Whether it excludes steps.
    pub assumed: bool,
    /// The number of its negation.
    pub negation: Option<u32>,
}

/// Notes which of a condition and its negation fail. What is neither true nor false, or cannot be evaluated, fails as both.
pub(crate) fn note_failures(truth: Option<bool>, (index, negation): (u32, Option<u32>), failed: &mut Vec<u32>) {
    if truth != Some(true) {
        failed.push(index);
    }
    if truth != Some(false) {
        failed.extend(negation);
    }
}

/// Why there is no explorer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trouble {
    /// An initial state cannot be made.
    Fault(Box<Fault>),
    /// The initial states cannot be gone through.
    Unbounded(Unbounded),
    /// The states do not fit: try again with this.
    TooNarrow(Widening),
    /// Whoever waits has had enough before all initial states were made.
    Interrupted(Cause),
}
