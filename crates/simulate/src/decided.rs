//! Inputs that were decided beforehand, step by step: a counterexample that is run again.

use machine::{Location, Value};

use crate::choose::Choices;
use crate::inputs::{Ask, Inputs, Source};

/// What one step takes from outside.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Decided {
    /// Inputs.
    pub inputs: Vec<(Location, Value)>,
    /// The values of the variables of each choice, in order.
    pub choices: Vec<Vec<Value>>,
}

impl Inputs {
    /// Inputs and choices by step, from 0, which is the initial state.
    pub fn decided(steps: Vec<Decided>) -> Inputs {
        let choices = Choices::decided(steps.iter().map(|step| step.choices.clone()).collect());
        Inputs::new().with(Given(steps)).choosing(choices)
    }
}

struct Given(Vec<Decided>);

impl Source for Given {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        let step = self.0.get(ask.step as usize);
        let of = |inputs: &[(Location, Value)]| {
            let found = inputs.iter().find(|(location, _)| location.borrowed() == ask.location);
            found.map(|(_, value)| value.clone())
        };
        Ok(step.and_then(|step| of(&step.inputs)))
    }
}
