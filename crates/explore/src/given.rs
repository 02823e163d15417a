//! The recorded inputs and choices of a step, as the machine's environment.
//!
//! In: what was told of a step. Out: an environment that gives it again, so that the machine repeats the step. What was not told is an
//! error, and so is a choice among other candidates.

use std::collections::{BTreeMap, VecDeque};

use machine::{Choice, Draw, Environment, Location, LocationRef, TimeUnit, Value};
use program::{DomainId, Program};

use crate::{ChoiceTaken, Told};

/// An environment that gives recorded inputs and choices.
#[derive(Debug, Default)]
pub struct Given {
    /// By location.
    pub inputs: BTreeMap<Location, Value>,
    /// What is still to be chosen, the next one first.
    pub choices: VecDeque<Vec<Value>>,
    /// What is still to be drawn.
    pub numbers: VecDeque<Value>,
    /// The choices that were made.
    pub taken: Vec<ChoiceTaken>,
}

impl Given {
    /// The inputs and choices of a step.
    pub fn new(told: &Told) -> Given {
        Given {
            inputs: told.inputs.iter().cloned().collect(),
            choices: told.choices.iter().map(|choice| choice.values.clone()).collect(),
            ..Given::default()
        }
    }
}

impl Environment for Given {
    fn monitored(&mut self, _: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        self.inputs.get(&location.to_location()).cloned().ok_or_else(|| "an input that was not given".to_string())
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let wanted = self.choices.pop_front().ok_or("a choice that was not made")?;
        let found = (0..choice.candidates()).find(|index| choice.candidate(*index) == wanted);
        self.taken.push(ChoiceTaken { span: choice.span, values: wanted });
        found.ok_or_else(|| "a candidate that there is not".to_string())
    }

    fn number(&mut self, _: &Program, _: &Draw) -> Result<Value, String> {
        self.numbers.pop_front().ok_or_else(|| "a number that was not drawn".to_string())
    }

    fn picks(&self, _: &Draw) -> bool {
        true
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Err("the clock".to_string())
    }
}
