//! A run as a scenario: what each step was given, what it chose, and what it changed.
//!
//! In: each moment of a session as it comes, or each record of a run. Out: the text of a scenario that makes the run again. INVARIANT: after a step was taken back, it is as
//! if that step had never been made. LIMIT: so many steps are kept; of a longer run there is no scenario.

use std::fmt::Write;
use std::sync::{Mutex, PoisonError};

use explore::ChoiceTaken;
use machine::{Change, Location, Show, Value};
use program::Program;
use simulate::Record;
use syntax::Span;

use crate::avalla::{is_said, pick, set};
use crate::session::moment::Moment;

/// LIMIT: steps that are kept.
const STEPS: usize = 20_000;

/// A step as it was made.
#[derive(Debug, Clone)]
struct Made {
    step: u64,
    inputs: Vec<(Location, Value)>,
    /// What the environment wrote and what was picked, as the scenario says it.
    given: String,
    /// What it changed, as the scenario says it.
    checks: String,
}

/// What was noted of a run.
#[derive(Debug, Default)]
pub struct Notes {
    made: Mutex<Vec<Made>>,
}

/// What a step took and did.
struct Taken<'a> {
    step: u64,
    inputs: &'a [(Location, Value)],
    /// What the environment wrote: the machine may have changed it since, so it is set each time.
    writes: &'a [(Location, Value)],
    choices: Vec<ChoiceTaken>,
    changes: &'a [Change],
}

fn choice(span: Span, values: &[Value]) -> ChoiceTaken {
    ChoiceTaken { span, values: values.to_vec() }
}

impl Notes {
    /// Notes the moment that the run is at now. A step that could not be made is none.
    pub(crate) fn note(&self, program: &Program, moment: &Moment) {
        let Moment { step, inputs, choices, changes, .. } = moment;
        let choices = choices.iter().map(|(span, values)| choice(*span, values)).collect();
        self.add(program, &Taken { step: *step, inputs, writes: &[], choices, changes });
    }

    /// Notes a record of a run. A step that could not be made is none, and one that was taken back is forgotten.
    pub fn note_record(&self, program: &Program, record: &Record) {
        match record {
            Record::Initial { inputs, .. } => {
                self.add(program, &Taken { step: 0, inputs, writes: &[], choices: Vec::new(), changes: &[] });
            }
            Record::Step(made) => {
                let choices = made.choices.iter().map(|made| choice(made.span, &made.values)).collect();
                let (inputs, writes, changes) = (&made.inputs, &made.writes, &made.changes);
                self.add(program, &Taken { step: made.step, inputs, writes, choices, changes });
            }
            Record::Back { step } => {
                let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
                made.retain(|made| made.step < *step);
            }
            Record::Attempt(_) | Record::End(_) => {}
        }
    }

    fn add(&self, program: &Program, taken: &Taken<'_>) {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        while made.last().is_some_and(|last| last.step >= taken.step) {
            made.pop();
        }
        if made.len() > STEPS {
            return;
        }
        let (mut writes, mut picks, mut checks) = (String::new(), String::new(), String::new());
        set(&mut writes, program, &mut Vec::new(), taken.writes);
        if taken.step > 0 {
            taken.choices.iter().for_each(|choice| pick(&mut picks, program, choice));
            for change in taken.changes {
                if is_said(program, &change.location, &change.after) && change.after != Value::Undef {
                    let (location, value) = (change.location.show(program), change.after.show(program));
                    let _ = writeln!(checks, "check {location} = {value};");
                }
            }
        }
        made.push(Made { step: taken.step, inputs: taken.inputs.to_vec(), given: writes + &picks, checks });
    }

    /// The run so far as a scenario of this name; `model` is what it loads.
    ///
    /// # Errors
    /// A sentence: no step was made, or more than are kept.
    pub fn scenario(&self, program: &Program, name: &str, model: &str) -> Result<String, String> {
        let made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if made.len() > STEPS {
            return Err(format!("a run of more than {STEPS} steps is not written as a scenario"));
        }
        if made.iter().all(|made| made.step == 0) {
            return Err("no step has been made".to_string());
        }
        let mut text = format!("scenario {name}\n\nload \"{model}\"\n");
        let mut given = Vec::new();
        for Made { step, inputs, given: picked, checks } in made.iter() {
            if *step > 0 || !inputs.is_empty() {
                text.push('\n');
            }
            set(&mut text, program, &mut given, inputs);
            text.push_str(picked);
            if *step > 0 {
                text.push_str("step\n");
            }
            text.push_str(checks);
        }
        Ok(text)
    }
}
