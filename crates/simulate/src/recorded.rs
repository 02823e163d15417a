//! Plays a trace back: a run takes its inputs, writes, choices and times, and is compared with it.
//!
//! In: the records of a trace, one after the other. Out: the records of the run made now, or [`Parted`] where they
//! differ, which happens exactly when the model has changed since.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;
use std::sync::Arc;

use machine::{Limits, Location, TimeUnit, Value};
use program::Program;

use crate::choose::{ChoiceMade, Choices, PlayedChoice};
use crate::clock::Clock;
use crate::inputs::{Ask, Inputs, Source};
use crate::run::{Options, Run};
use crate::trace::{Record, StepRecord};

#[derive(Debug, Default)]
struct Tape {
    inputs: BTreeMap<Location, Value>,
    writes: Vec<(Location, Value)>,
    times: VecDeque<(TimeUnit, i64)>,
}

/// A run that follows a trace.
#[derive(Debug)]
pub struct Recorded {
    run: Run,
    tape: Rc<RefCell<Tape>>,
    choices: crate::choose::Played,
}

/// Where a run no longer follows its trace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parted {
    /// The step, 0 for the initial state.
    pub step: u64,
    /// What the trace has there.
    pub expected: Box<Record>,
    /// What the run has there; none if it had ended.
    pub actual: Option<Box<Record>>,
}

impl Recorded {
    /// A run of the program that takes everything from a trace. The options are those of the trace's header.
    pub fn new(program: Arc<Program>, limits: Limits, options: Options) -> Recorded {
        let tape = Rc::new(RefCell::new(Tape::default()));
        let choices = crate::choose::Played::default();
        let inputs = Inputs::new()
            .with(Player(Rc::clone(&tape)))
            .choosing(Choices::Recorded(Rc::clone(&choices)))
            .timed_by(Player(Rc::clone(&tape)));
        Recorded { run: Run::new(program, limits, inputs, options), tape, choices }
    }

    /// The run.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The run, to evaluate terms in its current state.
    pub fn run_mut(&mut self) -> &mut Run {
        &mut self.run
    }

    /// Makes the next record with what the trace's next record took from outside.
    ///
    /// # Errors
    /// The two differ.
    pub fn follow(&mut self, expected: &Record) -> Result<Record, Parted> {
        match expected {
            Record::Initial { inputs, choices, times, .. } => self.play(inputs, &[], times, choices),
            Record::Step(step) | Record::Attempt(step) => {
                self.play(&step.inputs, &step.writes, &step.times, &step.choices);
            }
            Record::Back { .. } => {}
            // What ended the run from outside is not there to do it again.
            Record::End(end @ (crate::End::Interrupted | crate::End::Quit)) => self.run.stop(end.clone()),
            Record::End(_) => {}
        }
        let step = self.run.steps() + u64::from(!matches!(expected, Record::Initial { .. }));
        let actual = self.run.advance();
        match actual {
            Some(actual) if agree(expected, &actual) => Ok(actual),
            actual => Err(Parted { step, expected: Box::new(expected.clone()), actual: actual.map(Box::new) }),
        }
    }

    fn play(
        &mut self,
        inputs: &[(Location, Value)],
        writes: &[(Location, Value)],
        times: &[(TimeUnit, i64)],
        choices: &[ChoiceMade],
    ) {
        *self.tape.borrow_mut() = Tape {
            inputs: inputs.iter().cloned().collect(),
            writes: writes.to_vec(),
            times: times.iter().copied().collect(),
        };
        let played =
            |choice: &ChoiceMade| PlayedChoice { of: choice.of, index: choice.index, values: choice.values.clone() };
        *self.choices.borrow_mut() = choices.iter().map(played).collect();
    }
}

/// Places in the text do not count: a trace survives a change of layout.
fn agree(expected: &Record, actual: &Record) -> bool {
    match (expected, actual) {
        (Record::Initial { values: a, violations: v, .. }, Record::Initial { values: b, violations: w, .. }) => {
            a == b && names(v).eq(names(w))
        }
        (Record::Step(a), Record::Step(b)) | (Record::Attempt(a), Record::Attempt(b)) => steps_agree(a, b),
        (Record::End(a), Record::End(b)) => a.word() == b.word(),
        _ => false,
    }
}

fn names(violations: &[crate::Violation]) -> impl Iterator<Item = &str> {
    violations.iter().map(|violation| violation.name.as_str())
}

fn steps_agree(a: &StepRecord, b: &StepRecord) -> bool {
    let changes = |step: &StepRecord| -> Vec<(Location, Value)> {
        step.changes.iter().map(|change| (change.location.clone(), change.after.clone())).collect()
    };
    a.step == b.step
        && a.inputs == b.inputs
        && a.updates == b.updates
        && changes(a) == changes(b)
        && names(&a.violations).eq(names(&b.violations))
}

struct Player(Rc<RefCell<Tape>>);

impl Source for Player {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        Ok(self.0.borrow().inputs.get(&ask.location.to_location()).cloned())
    }

    fn has_writes(&self) -> bool {
        true
    }

    fn writes(&mut self, _step: u64) -> Vec<(Location, Value)> {
        self.0.borrow().writes.clone()
    }
}

impl Clock for Player {
    fn now(&mut self, unit: TimeUnit) -> Result<i64, String> {
        let mut tape = self.0.borrow_mut();
        // Equal readings in a row are recorded once: the last one stays.
        while tape.times.len() > 1 && tape.times[0].0 != unit {
            tape.times.pop_front();
        }
        match tape.times.front() {
            Some((read, now)) if *read == unit => Ok(*now),
            _ => Err("the trace did not read the clock here".to_string()),
        }
    }
}
