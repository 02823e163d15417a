//! Sessions: a model that runs, or a scenario that is played, for an editor or a debugger, step by step and back.
//!
//! In: a [`Scene`] and requests. Out: what the session waits for, and the [`Moment`] that it is at. The work is done by a thread of
//! its own, so a session can always be asked, paused and ended. INVARIANT: what a session tells depends on its scene, its options
//! and the requests, not on when they come.

pub mod breaks;
mod evaluate;
mod model;
mod moment;
mod scenario;
mod scene;
mod shared;
mod tape;
mod written;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use ::scenario::Script;
use machine::{Limits, Location, Show, Value};
use program::DomainId;
use report::Report;
use simulate::{Named, read_value};
use syntax::Span;

use crate::job::desk::{Desk, Turn};
use crate::job::{Cancel, Command, Job, Remote, RunEvent};
use crate::reporting::Watched;

pub use breaks::{Break, Breaks, Count, Hit, On, Piece};
pub use evaluate::Evaluator;
pub use moment::Moment;
pub use scene::Scene;
pub use written::Notes;

use shared::Shared;

/// How a session runs.
#[derive(Debug, Clone)]
pub struct SessionOptions {
    /// Draws inputs and choices at random; without one they are asked for. In a scenario only choices are made by it, and
    /// without one the first candidate is taken.
    pub seed: Option<u64>,
    /// How many steps can be taken back.
    pub history: usize,
    /// A model's run goes on after a violated invariant.
    pub passes_violations: bool,
    /// Inputs that are set from the beginning on.
    pub given: Vec<(Location, Value)>,
    /// Inputs by step; what is set by hand comes first. What it does not give is asked for, or drawn.
    pub recorded: Option<Arc<Named>>,
    /// The machine's limits.
    pub limits: Limits,
    /// What a timeline shows; its terms are part of the scene's program. None: there is no timeline.
    pub watched: Option<Arc<Watched>>,
    /// A scenario first waits in its initial state, as a model does; else before its name, whose move sets that state.
    pub begins: bool,
}

/// What a session waits for.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Waits {
    /// Nothing: it is running.
    #[default]
    Runs,
    /// To be told to go on.
    Step,
    /// The value of an input.
    Input {
        /// Which.
        location: Location,
        /// The first hundred values of its domain, if they are known.
        values: Vec<Value>,
        /// The least and the greatest value, if the domain is all integers between them.
        bounds: Option<(i64, i64)>,
    },
    /// A choice.
    Choice {
        /// The choose rule or the term.
        span: Span,
        /// The values of its variables, for each candidate.
        candidates: Vec<Vec<Value>>,
    },
    /// Nothing: the run has ended, and can only be taken back.
    End,
}

/// What was heard of a session.
#[derive(Debug, Clone, PartialEq)]
pub enum Heard {
    /// It waits now.
    Waits,
    /// A request cannot be carried out; a sentence.
    Refused(String),
    /// The break of this number says something, and the run goes on.
    Said(u64, String),
    /// Nothing within the time.
    Nothing,
    /// Its thread is gone.
    Gone,
}

/// See the module.
#[derive(Debug)]
pub struct Session {
    scene: Arc<Scene>,
    job: Job<RunEvent, ()>,
    remote: Remote,
    shared: Arc<Shared>,
    waits: Waits,
    /// What it asked for before it was answered.
    asked: Waits,
    /// The inputs that are set from now on.
    given: BTreeMap<Location, Value>,
    evaluator: Evaluator,
    conditions: Evaluator,
    watched: Option<Arc<Watched>>,
}

impl Session {
    /// Opens a session. It first sets the initial state; then it waits.
    ///
    /// # Errors
    /// The system cannot start a thread.
    pub fn open(scene: Arc<Scene>, options: SessionOptions) -> io::Result<Session> {
        let (sender, commands) = channel();
        let cancel = Cancel::new();
        let interrupt = cancel.interrupt().clone();
        let shared = Arc::new(Shared::default());
        let evaluator = Evaluator::new(&scene.sources, &scene.model, &scene.program, options.limits.clone());
        let limits = options.limits.clone();
        let conditions = Evaluator::new(&scene.sources, &scene.model, &scene.program, limits).keep();
        let given: BTreeMap<Location, Value> = options.given.iter().cloned().collect();
        let (theirs, played) = (Arc::clone(&shared), Arc::clone(&scene));
        let watched = options.watched.clone();
        let job = Job::start("session", cancel, move |port| {
            let desk = Desk::new(Rc::new(port), commands, Turn::Steps(0));
            let desk = Rc::new(RefCell::new(desk));
            let script: Option<Arc<Script>> = played.script.clone();
            match script {
                Some(script) => scenario::run(&played, &script, &options, &desk, interrupt, &theirs),
                None => model::run(&played, &options, &desk, interrupt, &theirs),
            }
        })?;
        let (waits, asked, remote) = (Waits::Runs, Waits::Runs, Remote(sender));
        Ok(Session { scene, job, remote, shared, waits, asked, given, evaluator, conditions, watched })
    }

    /// What it is about.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// What it waits for.
    pub fn waits(&self) -> &Waits {
        &self.waits
    }

    /// The present moment; none as long as the initial state is being set. While it runs, the moment is of some step just made.
    pub fn moment(&self) -> Option<Arc<Moment>> {
        self.shared.moment()
    }

    /// The lanes of the run so far; none if nothing is watched, or as long as the initial state is being set.
    pub fn timeline(&self) -> Option<Report> {
        self.shared.tape.report(self.watched.as_ref()?, &self.scene.program.name)
    }

    /// The run so far as a scenario of this name; `model` is what it loads.
    ///
    /// # Errors
    /// A sentence: it is a scenario already, no step was made, or more than are kept.
    pub fn scenario(&self, name: &str, model: &str) -> Result<String, String> {
        match &self.scene.script {
            Some(_) => Err("this run is one of a scenario already".to_string()),
            None => self.shared.notes.scenario(&self.scene.program, name, model),
        }
    }

    /// Whether it asks for an input or a choice.
    pub fn is_asking(&self) -> bool {
        matches!(self.waits, Waits::Input { .. } | Waits::Choice { .. })
    }

    /// From now on this stops the run.
    pub fn set_breaks(&mut self, breaks: Breaks) {
        self.shared.set_breaks(breaks);
    }

    /// Ends the work, also in the midst of a step.
    pub fn cancel(&self) {
        self.job.cancel().cancel();
    }

    /// Waits at most this long for news.
    pub fn hear(&mut self, time: Duration) -> Heard {
        match self.job.next_event_within(time) {
            Ok(RunEvent::Refused(reason)) => {
                if matches!(self.asked, Waits::Input { .. } | Waits::Choice { .. }) {
                    self.waits = std::mem::take(&mut self.asked);
                }
                Heard::Refused(reason)
            }
            Ok(RunEvent::AsksInput { location, values, bounds, .. }) => {
                self.waits = Waits::Input { location, values, bounds };
                Heard::Waits
            }
            Ok(RunEvent::AsksChoice { span, candidates }) => {
                self.waits = Waits::Choice { span, candidates };
                Heard::Waits
            }
            Ok(RunEvent::Paused) => {
                let moment = self.moment();
                let ended = moment.as_ref().is_some_and(|moment| moment.end.is_some());
                if let Some(moment) = moment.filter(|moment| moment.step == 0) {
                    self.evaluator.begin(&moment.inputs);
                }
                self.waits = if ended { Waits::End } else { Waits::Step };
                Heard::Waits
            }
            Ok(RunEvent::Said { id, text }) => Heard::Said(id, text),
            Ok(RunEvent::Record { .. } | RunEvent::Progress(_)) | Err(RecvTimeoutError::Timeout) => Heard::Nothing,
            Err(RecvTimeoutError::Disconnected) => Heard::Gone,
        }
    }

    /// Makes steps, or moves of a scenario.
    ///
    /// # Errors
    /// It cannot now; a sentence.
    pub fn step(&mut self, steps: u64) -> Result<(), String> {
        self.may_go_on()?;
        self.go(Command::Step(steps))
    }

    /// Makes steps until something stops it.
    ///
    /// # Errors
    /// It cannot now; a sentence.
    pub fn resume(&mut self) -> Result<(), String> {
        self.may_go_on()?;
        self.go(Command::Resume)
    }

    fn may_go_on(&self) -> Result<(), String> {
        match self.waits {
            Waits::Input { .. } | Waits::Choice { .. } => {
                Err("the step waits for an answer: answer, choose or go back".to_string())
            }
            Waits::End => Err("the run has ended".to_string()),
            Waits::Step | Waits::Runs => Ok(()),
        }
    }

    /// Takes the last step back; the one that waits for an answer is abandoned.
    ///
    /// # Errors
    /// It cannot now; a sentence.
    pub fn back(&mut self) -> Result<(), String> {
        if self.moment().is_none() {
            return Err("the initial state is being set: nothing can be taken back".to_string());
        }
        self.go(Command::Back)
    }

    /// Takes steps back until something stops it.
    ///
    /// # Errors
    /// It cannot now; a sentence.
    pub fn rewind(&mut self) -> Result<(), String> {
        if self.is_asking() {
            return self.back();
        }
        self.go(Command::Rewind)
    }

    /// Asks a run to wait before its next step.
    pub fn pause(&mut self) {
        self.remote.send(Command::Pause);
    }

    /// Decides how many steps come after the one that waits for an answer.
    pub fn then(&mut self, all: bool) {
        self.remote.send(if all { Command::Resume } else { Command::Pause });
    }

    fn go(&mut self, command: Command) -> Result<(), String> {
        match self.remote.send(command) {
            true => {
                self.asked = std::mem::take(&mut self.waits);
                Ok(())
            }
            false => Err("the run is gone".to_string()),
        }
    }

    /// Reads an input and a value for it; none takes its value away.
    ///
    /// # Errors
    /// A sentence: there is no such input or no such value.
    pub fn read_input(&mut self, location: &str, value: Option<&str>) -> Result<(Location, Option<Value>), String> {
        if self.scene.script.is_some() {
            return Err("the scenario gives the inputs: change its text".to_string());
        }
        let program = Arc::clone(&self.scene.program);
        let location = self.scene.input(location)?;
        let function = program.function(location.function);
        let value = value.map(|value| read_value(&program, function.codomain, value)).transpose()?;
        if let (Some(value), Some(moment)) = (&value, self.moment())
            && !self.evaluator.contains(function.codomain, value, &moment)
        {
            let domain = &program.domain(function.codomain).name;
            return Err(format!("{} is not in {domain}", value.show(&program)));
        }
        Ok((location, value))
    }

    /// Gives an input a value from now on, or takes it away. Out: whether this is what the step waits for, which now goes on.
    ///
    /// # Errors
    /// The run is gone.
    pub fn set(&mut self, location: Location, value: Option<Value>) -> Result<bool, String> {
        let is_asked = matches!(&self.waits, Waits::Input { location: asked, .. } if *asked == location);
        let goes_on = is_asked && value.is_some();
        let command = match value {
            Some(value) => {
                self.given.insert(location.clone(), value.clone());
                Command::Set(location, value)
            }
            None => {
                self.given.remove(&location);
                Command::Unset(location)
            }
        };
        if goes_on {
            self.go(command)?;
        } else if !self.remote.send(command) {
            return Err("the run is gone".to_string());
        }
        Ok(goes_on)
    }

    /// Gives the input that is asked for a value, once.
    ///
    /// # Errors
    /// A sentence: no input is asked for, or there is no such value.
    pub fn answer(&mut self, value: &str) -> Result<(), String> {
        let Waits::Input { location, .. } = &self.waits else { return Err("no input is asked for".to_string()) };
        let program = &self.scene.program;
        let value = read_value(program, program.function(location.function).codomain, value)?;
        self.remote.send(Command::Answer(value)).then_some(()).ok_or_else(|| "the run is gone".to_string())
    }

    /// Takes a candidate of the choice that is asked for, from 0.
    ///
    /// # Errors
    /// A sentence: no choice is asked for, or there are fewer candidates.
    pub fn choose(&mut self, candidate: usize) -> Result<(), String> {
        let Waits::Choice { candidates, .. } = &self.waits else { return Err("no choice is asked for".to_string()) };
        if candidate >= candidates.len() {
            return Err(format!("there are {} candidates, none is number {}", candidates.len(), candidate + 1));
        }
        self.go(Command::Choose(candidate))
    }

    /// Reads the conditions of breaks.
    pub fn conditions(&mut self) -> &mut Evaluator {
        &mut self.conditions
    }

    /// The inputs that are set from now on.
    pub fn given(&self) -> &BTreeMap<Location, Value> {
        &self.given
    }

    /// The present moment, with the inputs as they are set now.
    fn seen(&self) -> Result<Moment, String> {
        let moment = self.moment().ok_or("the initial state is being set: there is no state yet")?;
        let mut moment = Moment::clone(&moment);
        moment.inputs.retain(|(location, _)| !self.given.contains_key(location));
        moment.inputs.extend(self.given.iter().map(|(location, value)| (location.clone(), value.clone())));
        Ok(moment)
    }

    /// The elements of a domain in the present moment.
    ///
    /// # Errors
    /// A sentence: they cannot be listed.
    pub fn elements(&mut self, domain: DomainId) -> Result<Vec<Value>, String> {
        let moment = self.seen()?;
        self.evaluator.elements(domain, &moment)
    }

    /// The value of the text of a term in the present moment.
    ///
    /// # Errors
    /// A sentence: it is no term, or it has no value.
    pub fn evaluate(&mut self, text: &str) -> Result<Value, String> {
        let moment = self.seen()?;
        let term = self.evaluator.term(text)?;
        self.evaluator.value(&term, &moment)
    }

    /// The state: each location with its value.
    pub fn state(&mut self) -> Vec<(Location, Value)> {
        match self.moment() {
            Some(moment) => self.evaluator.locations(&moment),
            None => Vec::new(),
        }
    }
}

/// A session that is dropped ends.
impl Drop for Session {
    fn drop(&mut self) {
        self.cancel();
    }
}
