//! A step from a pair of states made by the machine, to tell the fault that it comes to.
//!
//! In: a program, one of its initial states, the values of a state that a solver gave, the values that inputs may have there. Out: the
//! faults of its steps, over what it may choose. INVARIANT: each is one that the machine came to in that state; where the state cannot be
//! set, none is told.

use std::collections::BTreeMap;
use std::sync::Arc;

use explore::{Given, Told};
use machine::{Bounds, Choice, Environment, Fault, Limits, Location, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Program};

/// LIMIT: so many alternatives of a step are made.
const TRIED: usize = 256;
/// LIMIT: so many faults are told.
const TOLD: usize = 2;

/// A state that a solver gave.
#[derive(Debug, Default)]
pub(super) struct Scene {
    /// The values of all locations that a step looks at or changes.
    pub state: Vec<(Location, Value)>,
    /// By input, the values that it may have.
    pub inputs: BTreeMap<Location, Vec<Value>>,
}

/// What steps are made with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage<'s> {
    pub program: &'s Arc<Program>,
    pub limits: &'s Limits,
    pub start: &'s Told,
    /// The values of inputs that the solver was not told of: they do not matter.
    pub bounds: &'s Bounds,
}

/// The faults of the steps from a state; those that `first` says come first.
pub(super) fn faults(stage: Stage<'_>, scene: &Scene, first: impl Fn(&Fault) -> bool) -> Vec<Fault> {
    let mut machine = Machine::new(Arc::clone(stage.program), stage.limits.clone());
    machine.ignore_interrupts();
    let begun = machine.start(&mut Given::new(stage.start)).is_ok();
    if !begun || !scene.state.iter().all(|(location, value)| machine.set(location, value.clone()).is_ok()) {
        return Vec::new();
    }
    let snapshot = machine.snapshot();
    let mut alternatives = Alternatives { scene, bounds: stage.bounds, answers: Vec::new(), at: 0 };
    let mut found: Vec<Fault> = Vec::new();
    for _ in 0..TRIED {
        machine.restore(&snapshot);
        match machine.prepare(&mut alternatives) {
            Err(fault) if fault.kind.is_of_the_model() && !found.contains(&fault) => found.push(fault),
            Ok(()) | Err(_) => {}
        }
        machine.discard();
        if !alternatives.next() {
            break;
        }
    }
    found.sort_by_key(|fault| !first(fault));
    found.truncate(TOLD);
    found
}

/// Goes through the values of inputs and the candidates of choices.
struct Alternatives<'a> {
    scene: &'a Scene,
    bounds: &'a Bounds,
    /// What was taken, of how many.
    answers: Vec<(usize, usize)>,
    at: usize,
}

impl Alternatives<'_> {
    fn ask(&mut self, of: usize) -> usize {
        if self.at == self.answers.len() {
            self.answers.push((0, of));
        }
        self.at += 1;
        self.answers[self.at - 1].0
    }

    /// Begins the next alternative; false where there is none.
    fn next(&mut self) -> bool {
        self.answers.truncate(self.at);
        self.at = 0;
        while let Some((taken, of)) = self.answers.pop() {
            if taken + 1 < of {
                self.answers.push((taken + 1, of));
                return true;
            }
        }
        false
    }
}

impl Environment for Alternatives<'_> {
    fn monitored(&mut self, _: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        let known = self.scene.inputs.get(&location.to_location());
        match known.or_else(|| self.bounds.get(&location.function)) {
            Some(values) if !values.is_empty() => Ok(values[self.ask(values.len())].clone()),
            _ => Err("an input without a value".to_string()),
        }
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        match choice.candidates() {
            0 => Err("a choice among none".to_string()),
            candidates => Ok(self.ask(candidates)),
        }
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Err("the clock".to_string())
    }
}
