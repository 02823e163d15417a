//! Runs: the initial state, and one step after the other (Börger & Stärk 2003, definition 2.4.6).
//!
//! A step fires the update set that the main rule yields. After a fault the state is the one before the step; but what
//! the environment wrote to shared locations when it was asked stays.

use std::collections::BTreeMap;

use model::{DomainId, FunctionKind, Model, PropertyKind, Term};

use crate::environment::Environment;
use crate::fault::{Fault, consistent};
use crate::interpreter::{Assignment, Bounds, Interpreter};
use crate::state::{Location, State, Symbol, UpdateSet};
use crate::value::Value;

/// A model and its current state.
pub struct Oracle<'m> {
    model: &'m Model,
    bounds: Bounds,
    initial: State,
    state: State,
    inputs: BTreeMap<Location, Value>,
}

impl<'m> Oracle<'m> {
    /// Before the initial state; the model must be free of errors.
    pub fn new(model: &'m Model, bounds: Bounds) -> Oracle<'m> {
        Oracle { model, bounds, initial: State::default(), state: State::default(), inputs: BTreeMap::new() }
    }

    /// Goes to the initial state.
    pub fn start(&mut self, environment: &mut dyn Environment) -> Result<(), Fault> {
        self.state = State::default();
        self.inputs.clear();
        self.state = self.interpreter(environment).initial_state()?;
        self.keep_shared();
        self.initial = self.state.clone();
        Ok(())
    }

    /// Makes one step; gives the update set it fired.
    pub fn step(&mut self, environment: &mut dyn Environment) -> Result<UpdateSet, Fault> {
        self.inputs.clear();
        let main = self.model.main.ok_or(Fault::NoMain)?;
        let body = &self.model.rule(main).body;
        let state = self.state.clone();
        let updates = consistent(self.interpreter(environment).yields(body, &state, &Assignment::default()));
        self.keep_shared();
        let updates = updates?;
        self.state = self.state.fire(&updates);
        Ok(updates)
    }

    /// The shared locations that had no value until the environment was asked for one have it from now on.
    fn keep_shared(&mut self) {
        for (location, value) in &self.inputs {
            if let Symbol::Function(id) = location.symbol
                && self.model.function(id).kind == FunctionKind::Shared
                && !self.state.has(location)
            {
                self.state.set(location.clone(), value.clone());
            }
        }
    }

    /// Evaluates a closed term in the current state, with the inputs of the last step.
    pub fn evaluate(&mut self, term: &Term, environment: &mut dyn Environment) -> Result<Value, Fault> {
        let state = self.state.clone();
        let value = self.interpreter(environment).value(term, &state, &Assignment::default());
        self.keep_shared();
        value
    }

    /// The value of each invariant in the current state.
    pub fn invariants(&mut self, environment: &mut dyn Environment) -> Vec<(String, Result<Value, Fault>)> {
        let model = self.model;
        let invariants = model.properties.iter().filter(|property| property.kind == PropertyKind::Invariant);
        invariants.map(|property| (property.name.clone(), self.evaluate(&property.formula, environment))).collect()
    }

    /// The elements of a domain in the current state, in canonical order.
    pub fn elements(&mut self, domain: DomainId, environment: &mut dyn Environment) -> Result<Vec<Value>, Fault> {
        let state = self.state.clone();
        self.interpreter(environment).elements(domain, &state)
    }

    /// The value of a location in the current state.
    pub fn value(&mut self, location: &Location, environment: &mut dyn Environment) -> Result<Value, Fault> {
        let state = self.state.clone();
        self.interpreter(environment).read(location.clone(), &state)
    }

    /// The current state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// What the environment answered in the last step.
    pub fn inputs(&self) -> &BTreeMap<Location, Value> {
        &self.inputs
    }

    fn interpreter<'a>(&'a mut self, environment: &'a mut dyn Environment) -> Interpreter<'a> {
        Interpreter::new(self.model, (&self.initial, &self.state), environment, &mut self.inputs, self.bounds)
    }
}
