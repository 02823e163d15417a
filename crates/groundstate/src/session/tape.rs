//! What watched terms were, step by step, in the run of a session: what its timeline is made of.
//!
//! In: each moment as it comes. Out: a [`Report`] with the lanes. INVARIANT: after a step was taken back, it is as if that step had
//! never been made. LIMIT: so many values are kept; then the lanes end, and the report says so.

use std::sync::{Arc, Mutex, PoisonError};

use machine::{Location, Show, Value};
use program::Program;
use report::{Report, ReportBuilder};

use crate::reporting::Watched;
use crate::session::evaluate::Player;
use crate::session::moment::Moment;

/// LIMIT: values that are kept.
const ENTRIES: usize = 2_000_000;

/// A term has another value.
#[derive(Debug)]
struct Entry {
    step: u64,
    term: u32,
    text: Box<str>,
}

/// What was noted.
#[derive(Debug, Default)]
pub(crate) struct Tape {
    noted: Mutex<Noted>,
}

#[derive(Debug, Default)]
struct Noted {
    /// In the order of steps.
    entries: Vec<Entry>,
    /// The last step that is known; none before the initial state.
    step: Option<u64>,
    /// The first step that was not noted any more.
    full: Option<u64>,
}

/// Notes moments.
#[derive(Debug)]
pub(crate) struct Recorder {
    watched: Arc<Watched>,
    program: Arc<Program>,
    player: Player,
    last: Vec<Value>,
}

impl Recorder {
    /// One that knows no moment yet.
    pub fn new(watched: &Arc<Watched>, program: &Arc<Program>, player: Player) -> Recorder {
        let last = vec![Value::Undef; watched.terms.len()];
        Recorder { watched: Arc::clone(watched), program: Arc::clone(program), player, last }
    }

    /// Notes the moment that the run is at now. `initial` are the inputs of the initial state.
    pub fn note(&mut self, tape: &Tape, moment: &Moment, initial: &[(Location, Value)]) {
        let Recorder { watched, program, player, last } = self;
        let mut noted = tape.noted.lock().unwrap_or_else(PoisonError::into_inner);
        while noted.entries.last().is_some_and(|entry| entry.step > moment.step) {
            noted.entries.pop();
        }
        if noted.full.is_some_and(|full| full > moment.step) {
            noted.full = None;
        }
        noted.step = Some(moment.step);
        for ((term, last), number) in watched.terms.iter().zip(last).zip(0..) {
            let value = player.value(program, term, moment, initial).unwrap_or(Value::Undef);
            if value == *last {
                continue;
            }
            if noted.full.is_none() && noted.entries.len() >= ENTRIES {
                noted.full = Some(moment.step);
            }
            if noted.full.is_none() {
                let text = value.show(program).to_string().into();
                noted.entries.push(Entry { step: moment.step, term: number, text });
            }
            *last = value;
        }
    }
}

impl Tape {
    /// The lanes of the run so far; none before there is an initial state.
    pub fn report(&self, watched: &Watched, model: &str) -> Option<Report> {
        let noted = self.noted.lock().unwrap_or_else(PoisonError::into_inner);
        let last = noted.step?;
        let shown = noted.full.unwrap_or(last + u64::from(watched.spec.counts_steps())).max(1);
        let mut builder = ReportBuilder::new(watched.spec.clone()).show_ticks(shown);
        let mut entries = noted.entries.iter().peekable();
        for step in 0..=last {
            while let Some(entry) = entries.next_if(|entry| entry.step == step) {
                builder.set(entry.term as usize, &entry.text);
            }
            match step {
                0 => builder.begin(),
                _ => builder.step(),
            }
        }
        Some(builder.finish(model))
    }
}
