//! A run of a model in which a test answers what is asked for, and the terms that it asks of each state.
//!
//! In: a loaded model, terms as texts, an environment. Out: their values, as they are shown. A step that cannot be made fails the test.

use std::collections::BTreeMap;

use groundstate::Loaded;
use machine::{Closed, Environment, Limits, Machine, Show};
use program::Expression;

/// See the module.
pub struct AskedRun {
    machine: Machine,
    terms: Vec<(String, Expression)>,
}

impl AskedRun {
    /// The run in its initial state.
    pub fn new(loaded: &Loaded, terms: &[String], environment: &mut dyn Environment) -> AskedRun {
        let mut overlay = loaded.overlay();
        let mut ask = |text: &String| {
            let term = overlay.value("asked", text).unwrap_or_else(|faults| panic!("{text}: {faults:#?}"));
            (text.clone(), term)
        };
        let terms = terms.iter().map(&mut ask).collect();
        let mut machine = Machine::new(overlay.program.clone(), Limits::default());
        machine.start(environment).unwrap_or_else(|fault| panic!("{fault:?}"));
        AskedRun { machine, terms }
    }

    /// Makes a step.
    pub fn step(&mut self, environment: &mut dyn Environment) {
        self.machine.step(environment).unwrap_or_else(|fault| panic!("{fault:?}"));
    }

    /// The values of the terms now.
    pub fn values(&mut self) -> BTreeMap<String, String> {
        let program = self.machine.program().clone();
        let machine = &mut self.machine;
        let value = |(name, term): &(String, Expression)| {
            let value = machine.evaluate(term, &mut Closed).map(|value| value.show(&program).to_string());
            (name.clone(), value.unwrap_or_else(|fault| format!("{fault:?}")))
        };
        self.terms.iter().map(value).collect()
    }
}
