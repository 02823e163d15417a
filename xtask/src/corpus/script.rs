//! A recorded run as a text that generated code replays.
//!
//! In: a program, a trace that our machine makes as it was recorded, and the choices with which it does. Out: the
//! answers of each step and the states that the machine comes to with them (`generate::model::replay`), which are those of the
//! record on every location that it lists.

use std::path::{Path, PathBuf};

use generate::model::replay::{self, Answers};
use machine::{Choice, Draw, Environment, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Program};
use syntax::Span;

use crate::Failure;

/// A run to be replayed.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Script {
    /// The answers, step by step.
    pub answers: String,
    /// The states, and the fault that ends the run.
    pub states: String,
}

impl Script {
    /// Makes the initial state, or a step; tells whether it could be made.
    pub fn advance(&mut self, machine: &mut Machine, environment: &mut dyn Environment, is_first: bool) -> bool {
        let program = machine.program().clone();
        let mut noting = Noting { inner: environment, answers: Answers::default() };
        let made = match is_first {
            true => machine.start(&mut noting),
            false => machine.prepare(&mut noting),
        };
        self.answers.push_str(&replay::script(&program, &noting.answers));
        match made {
            Ok(()) => {
                if !is_first {
                    machine.commit();
                }
                self.states.push_str(&replay::state(&program, &machine.locations()));
                true
            }
            Err(fault) => {
                self.states.push_str(&format!("fault {}\n", fault.kind.id()));
                false
            }
        }
    }

    /// Writes it: a folder for each model, two files for each of its traces.
    ///
    /// # Errors
    /// The files cannot be written.
    pub fn write(&self, folder: &Path, model: &str, trace: &Path) -> Result<(), Failure> {
        let kind = trace.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
        let stem = trace.file_stem().unwrap_or_default().to_string_lossy();
        let folder: PathBuf = folder.join(model);
        let wrap = |error: std::io::Error| format!("{}: {error}", folder.display());
        std::fs::create_dir_all(&folder).map_err(wrap)?;
        for (ending, text) in [("script", &self.answers), ("expected", &self.states)] {
            std::fs::write(folder.join(format!("{kind}-{stem}.{ending}")), text).map_err(wrap)?;
        }
        Ok(())
    }
}

/// An environment whose answers are noted.
struct Noting<'a> {
    inner: &'a mut dyn Environment,
    answers: Answers,
}

impl Environment for Noting<'_> {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        let value = self.inner.monitored(program, location, codomain)?;
        self.answers.inputs.push((location.to_location(), value.clone()));
        Ok(value)
    }

    fn keeps_initial(&self, location: LocationRef<'_>) -> bool {
        self.inner.keeps_initial(location)
    }

    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let index = self.inner.choose(program, choice)?;
        self.answers.choices.push((choice.span, index, choice.candidate(index).to_vec()));
        Ok(index)
    }

    fn number(&mut self, program: &Program, draw: &Draw) -> Result<Value, String> {
        self.inner.number(program, draw)
    }

    fn picks(&self, draw: &Draw) -> bool {
        self.inner.picks(draw)
    }

    fn no_candidate(&mut self, program: &Program, choose: Span) -> Result<(), String> {
        self.inner.no_candidate(program, choose)
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        let time = self.inner.time(unit)?;
        self.answers.times.push((unit, time));
        Ok(time)
    }
}
