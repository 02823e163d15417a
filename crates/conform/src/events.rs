//! The events of a model's own run, as a program that follows the model would record them.
//!
//! In: a model over the library of patterns, and the inputs of its steps. Out: the events of each step, those of one task in the order
//! of spec/conform.md.

use std::sync::Arc;

use machine::{Choice, Closed, Environment, Limits, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Program};
use recording::Event;

use crate::vocabulary::Vocabulary;

/// A run of a model, told by its events.
#[derive(Debug)]
pub struct Events {
    machine: Machine,
    vocabulary: Vocabulary,
}

impl Events {
    /// Starts the model.
    ///
    /// # Errors
    /// It does not start, or is not made of the library's patterns; in words.
    pub fn start(program: &Arc<Program>, limits: Limits, environment: &mut dyn Environment) -> Result<Events, String> {
        let mut machine = Machine::new(Arc::clone(program), limits);
        machine.start(environment).map_err(|fault| fault.show(program).to_string())?;
        let vocabulary = Vocabulary::new(program, &machine)?;
        Ok(Events { machine, vocabulary })
    }

    /// Makes a step; returns its events, each with the name of its task.
    ///
    /// # Errors
    /// The step cannot be made; in words.
    pub fn step(&mut self, environment: &mut dyn Environment) -> Result<Vec<(String, Event)>, String> {
        let made = self.machine.step(environment);
        made.map_err(|fault| fault.show(self.machine.program()).to_string())?;
        let claims = self.vocabulary.claims(&self.machine, &self.vocabulary.changes(&self.machine));
        let name = |component: usize| self.vocabulary.components[component].name.clone();
        Ok(claims.into_iter().map(|(component, claim)| (name(component), claim.event)).collect())
    }

    /// The machine after the last step.
    pub fn machine(&mut self) -> &mut Machine {
        &mut self.machine
    }
}

/// Each action lasts as long as it can: what a program does that follows the model.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Longest;

impl Environment for Longest {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        match program.function(location.function).name.as_str() {
            "endsNow" => Ok(Value::Boolean(false)),
            // A program in virtual time begins each cycle when its period starts.
            "isReleased" => Ok(Value::Boolean(true)),
            _ => Closed.monitored(program, location, codomain),
        }
    }

    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Closed.choose(program, choice)
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        Closed.time(unit)
    }
}
