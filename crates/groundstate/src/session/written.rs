//! A session's run as a scenario: what each step was given, what it chose, and what it changed.
//!
//! In: each moment as it comes. Out: the text of a scenario that makes the run again. INVARIANT: after a step was taken back, it is as
//! if that step had never been made. LIMIT: so many steps are kept; of a longer run there is no scenario.

use std::fmt::Write;
use std::sync::{Mutex, PoisonError};

use explore::ChoiceTaken;
use machine::{Location, Show, Value};
use program::Program;

use crate::avalla::{is_written, pick, set};
use crate::session::moment::Moment;

/// LIMIT: steps that are kept.
const STEPS: usize = 20_000;

/// A step as it was made.
#[derive(Debug, Clone)]
struct Made {
    step: u64,
    inputs: Vec<(Location, Value)>,
    /// Its picks and its checks, as they are written.
    picks: String,
    checks: String,
}

/// What was noted.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    made: Mutex<Vec<Made>>,
}

impl Notes {
    /// Notes the moment that the run is at now. A step that could not be made is none.
    pub fn note(&self, program: &Program, moment: &Moment) {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        while made.last().is_some_and(|last| last.step >= moment.step) {
            made.pop();
        }
        if made.len() > STEPS {
            return;
        }
        let (mut picks, mut checks) = (String::new(), String::new());
        if moment.step > 0 {
            for (span, values) in &moment.choices {
                let choice = ChoiceTaken { span: *span, values: values.clone() };
                pick(&mut picks, program, &choice);
            }
            for change in &moment.changes {
                let written = is_written(program, &change.after)
                    && change.location.arguments.iter().all(|argument| is_written(program, argument));
                if written && change.after != Value::Undef {
                    let (location, value) = (change.location.show(program), change.after.show(program));
                    let _ = writeln!(checks, "check {location} = {value};");
                }
            }
        }
        made.push(Made { step: moment.step, inputs: moment.inputs.clone(), picks, checks });
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
        for Made { step, inputs, picks, checks } in made.iter() {
            if *step > 0 || !inputs.is_empty() {
                text.push('\n');
            }
            set(&mut text, program, &mut given, inputs);
            text.push_str(picks);
            if *step > 0 {
                text.push_str("step\n");
            }
            text.push_str(checks);
        }
        Ok(text)
    }
}
