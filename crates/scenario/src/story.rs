//! What a scenario did, step by step, to show why it failed.
//!
//! In: the machine after each step, and what the environment gave for it. Out: a [`Story`], kept with the verdict if it
//! is asked for. LIMIT: of a long run only the last steps are kept.

use std::collections::{BTreeMap, VecDeque};

use machine::{Change, Location, Machine, Value};

use crate::environment::Made;

/// So many passages are kept.
const KEPT: usize = 200;

/// A run of a scenario.
#[derive(Debug, Clone, Default)]
pub struct Story {
    /// The initial state.
    pub initial: Vec<(Location, Value)>,
    /// How many passages came before those that are kept.
    pub left_out: u64,
    /// What happened then.
    pub passages: VecDeque<Passage>,
    given: BTreeMap<Location, Value>,
}

/// What a passage is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PassageKind {
    /// A step of this number.
    Step(u64),
    /// A step of this number that could not be made.
    Attempt(u64),
    /// A rule that the scenario executed.
    Exec,
}

/// A step, or a rule that was executed between two.
#[derive(Debug, Clone)]
pub struct Passage {
    /// Which.
    pub kind: PassageKind,
    /// Inputs that are not what they were.
    pub inputs: Vec<(Location, Value)>,
    /// Choices in order.
    pub choices: Vec<Made>,
    /// What it changed.
    pub changes: Vec<Change>,
}

impl Story {
    /// The machine is in its initial state.
    pub(crate) fn begin(&mut self, machine: &Machine) {
        self.initial = machine.locations();
    }

    /// Something happened, with these inputs and choices.
    pub(crate) fn add(
        &mut self,
        kind: PassageKind,
        inputs: &BTreeMap<Location, Value>,
        choices: Vec<Made>,
        machine: &Machine,
    ) {
        let changes = if matches!(kind, PassageKind::Attempt(_)) { Vec::new() } else { machine.changes() };
        let new = inputs.iter().filter(|(location, value)| self.given.get(location) != Some(value));
        let new = new.map(|(location, value)| (location.clone(), value.clone())).collect();
        self.given.clone_from(inputs);
        if self.passages.len() == KEPT {
            self.passages.pop_front();
            self.left_out += 1;
        }
        self.passages.push_back(Passage { kind, inputs: new, choices, changes });
    }
}
