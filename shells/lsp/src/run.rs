//! The state at the cursor: sessions that run models for an editor, by requests of their own (docs/editors.md).
//!
//! In: `groundstate/session/…` with parameters as JSON. Out: [`SessionState`] as JSON. A session has the texts that it was opened
//! with, whatever is typed since. LIMIT: so many sessions, steps of a request, and steps that can be taken back; a step that is
//! longer than [`WORK`] is a fault.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::mpsc::RecvTimeoutError;
use std::time::Duration;

use groundstate::Loaded;
use groundstate::job::{Cancel, Command, Remote, RunEvent, RunJob, RunRequest, at_once, run};
use groundstate::machine::{Limits, Location, Show};
use groundstate::simulate::{Bounds, Choices, Options, RandomSource, Record, read_location, read_value};
use ide::{Encoding, Lines};
use lsp_server::ErrorCode;
use lsp_types::{Position, Range};
use serde_json::Value;
use syntax::{Span, Stop};
use wire::{Named, SESSION_VERSION, SessionState, Waiting, Written, Wrong, written_state};

use crate::answer::Answers;
use crate::location::{path_of, uri_of};
use crate::route::Refused;

/// LIMIT: sessions that are open at a time.
const SESSIONS: usize = 16;

/// LIMIT: steps of one request.
const STEPS: u64 = 10_000;

/// LIMIT: steps that can be taken back.
const HISTORY: usize = 1_000;

/// LIMIT: what one step may take.
const WORK: u64 = 20_000_000;

/// How often a request that waits looks whether it was cancelled.
const LOOK: Duration = Duration::from_millis(20);

/// The beginning of the methods.
pub const PREFIX: &str = "groundstate/session/";

type Place = lsp_types::Location;
type State = SessionState<Place>;

/// The sessions that are open.
#[derive(Debug, Default)]
pub struct Sessions {
    last: u64,
    open: BTreeMap<u64, Session>,
}

#[derive(Debug)]
struct Session {
    loaded: Arc<Loaded>,
    texts: Texts,
    job: RunJob,
    remote: Remote,
    /// What is asked for, if an input is.
    asked: Option<Location>,
    /// A step was begun and not made: why, comes next.
    is_ending: bool,
    told: State,
}

/// The texts that a session was opened with, and how columns are counted.
#[derive(Debug)]
struct Texts {
    lines: BTreeMap<String, Lines>,
    encoding: Encoding,
}

fn wrong(message: impl Into<String>) -> Refused {
    Refused::new(ErrorCode::InvalidParams, message)
}

/// Answers a request of a session.
///
/// # Errors
/// There is no such session or method, the model cannot run, or parameters are missing.
pub fn answer(
    sessions: &mut Sessions,
    answers: &mut Answers,
    method: &str,
    params: &Value,
    stop: &Stop,
) -> Result<Value, Refused> {
    let id = match method {
        "open" => sessions.open(answers, params)?,
        _ => params["session"].as_u64().ok_or_else(|| wrong("`session` is the number of one"))?,
    };
    if method == "close" {
        sessions.open.remove(&id);
        return Ok(Value::Null);
    }
    let mut session = sessions.open.remove(&id).ok_or_else(|| wrong(format!("there is no session {id}")))?;
    session.told.refused = None;
    let kept = session.carry_out(method, params, stop);
    session.told.stale = session
        .texts
        .lines
        .iter()
        .any(|(path, lines)| answers.project.text(path).map_or(true, |source| source.text != *lines.text()));
    let told = serde_json::to_value(&session.told);
    if kept? {
        sessions.open.insert(id, session);
    }
    told.map_err(|error| Refused::new(ErrorCode::InternalError, error.to_string()))
}

impl Sessions {
    /// Opens a session on a model.
    fn open(&mut self, answers: &mut Answers, params: &Value) -> Result<u64, Refused> {
        let uri = params.pointer("/textDocument/uri").and_then(Value::as_str).and_then(|uri| uri.parse().ok());
        let path = uri.as_ref().and_then(path_of).ok_or_else(|| wrong("`textDocument.uri` is a model"))?;
        if self.open.len() >= SESSIONS {
            return Err(Refused::new(
                ErrorCode::RequestFailed,
                format!("{SESSIONS} sessions are open: close one first"),
            ));
        }
        let failed = |message: String| Refused::new(ErrorCode::RequestFailed, message);
        let loaded = answers.project.load(&path).map_err(failed)?;
        if loaded.program.main.is_none() {
            return Err(failed("a module has no main rule to run".to_string()));
        }
        let seed = params["seed"].as_u64();
        let request = RunRequest {
            program: Arc::clone(&loaded.program),
            limits: Limits { work: WORK, ..Limits::default() },
            options: Options { steps: None, history: HISTORY, ..Options::default() },
            inputs: Box::new(move |inputs| match seed {
                Some(seed) => inputs.with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed)),
                None => inputs,
            }),
            asks_inputs: seed.is_none(),
            asks_choices: seed.is_none(),
            paused: true,
            states: true,
            due: at_once(),
        };
        let (job, remote) = run(request, Cancel::new()).map_err(|error| failed(error.to_string()))?;
        self.last += 1;
        let id = self.last;
        let files = loaded.sources.iter().filter(|(_, source)| ide::library_text(&source.name).is_none());
        let lines = files.map(|(_, source)| (source.name.clone(), Lines::new(Arc::clone(&source.text)))).collect();
        let texts = Texts { lines, encoding: answers.settings.encoding };
        let told = State {
            version: SESSION_VERSION,
            session: id,
            step: 0,
            waiting: Waiting::Step,
            word: None,
            offered: Vec::new(),
            at: None,
            state: written_state(&[], &loaded.program),
            updates: Vec::new(),
            rules: Vec::new(),
            faults: Vec::new(),
            refused: None,
            stale: false,
        };
        self.open.insert(id, Session { loaded, texts, job, remote, asked: None, is_ending: false, told });
        Ok(id)
    }
}

impl Session {
    /// Carries out a request. Out: whether the session goes on.
    fn carry_out(&mut self, method: &str, params: &Value, stop: &Stop) -> Result<bool, Refused> {
        let is_asking = matches!(self.told.waiting, Waiting::Input | Waiting::Choice);
        let (command, waits) = match method {
            "open" => return self.wait(false, stop),
            "step" if is_asking => return Ok(self.refuse("the step waits for an answer: answer, choose or go back")),
            "step" if self.told.waiting == Waiting::Nothing => return Ok(self.refuse("the run has ended")),
            "step" => (Command::Step(params["steps"].as_u64().unwrap_or(1).clamp(1, STEPS)), true),
            "back" => (Command::Back, true),
            "set" => {
                let text = params["location"].as_str().ok_or_else(|| wrong("`location` is a text"))?;
                let location = match read_location(&self.loaded.program, text) {
                    Ok(location) => location,
                    Err(reason) => return Ok(self.refuse(reason)),
                };
                let waits = self.asked.as_ref() == Some(&location) && !params["value"].is_null();
                match self.value(&location, &params["value"])? {
                    Ok(Some(value)) => (Command::Set(location, value), waits),
                    Ok(None) => (Command::Unset(location), false),
                    Err(reason) => return Ok(self.refuse(reason)),
                }
            }
            "answer" => {
                let Some(location) = self.asked.clone() else { return Ok(self.refuse("no input is asked for")) };
                match self.value(&location, &params["value"])? {
                    Ok(Some(value)) => (Command::Answer(value), true),
                    Ok(None) => return Err(wrong("`value` is a text")),
                    Err(reason) => return Ok(self.refuse(reason)),
                }
            }
            "choose" if self.told.waiting != Waiting::Choice => return Ok(self.refuse("no choice is asked for")),
            "choose" => {
                let candidate = params["candidate"].as_u64().ok_or_else(|| wrong("`candidate` is a number from 0"))?;
                (Command::Choose(usize::try_from(candidate).unwrap_or(usize::MAX)), true)
            }
            "state" => return Ok(true),
            other => return Err(Refused::new(ErrorCode::MethodNotFound, format!("{PREFIX}{other} is not known"))),
        };
        let goes_back = command == Command::Back;
        let sent = self.remote.send(command);
        if waits && sent { self.wait(is_asking && !goes_back, stop) } else { Ok(sent) }
    }

    fn refuse(&mut self, reason: impl Into<String>) -> bool {
        self.told.refused = Some(reason.into());
        true
    }

    /// A value for a location; none for `null`.
    fn value(
        &self,
        location: &Location,
        value: &Value,
    ) -> Result<Result<Option<groundstate::machine::Value>, String>, Refused> {
        let program = &self.loaded.program;
        match value {
            Value::Null => Ok(Ok(None)),
            Value::String(text) => {
                Ok(read_value(program, program.function(location.function).codomain, text).map(Some))
            }
            _ => Err(wrong("`value` is a text, as AsmetaL writes it, or null")),
        }
    }

    /// Waits until the run waits. Where it was asking, a refusal leaves it as it was. Out: whether the session goes on.
    fn wait(&mut self, is_asking: bool, stop: &Stop) -> Result<bool, Refused> {
        loop {
            match self.job.next_event_within(LOOK) {
                Ok(RunEvent::Refused(reason)) => {
                    self.told.refused = Some(reason);
                    if is_asking {
                        return Ok(true);
                    }
                }
                Ok(event) => {
                    if self.heed(event) {
                        return Ok(true);
                    }
                }
                Err(RecvTimeoutError::Timeout) if stop.is_asked() => {
                    self.job.cancel().cancel();
                    return Ok(false);
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(Refused::new(ErrorCode::InternalError, "the run is gone"));
                }
            }
        }
    }

    /// Takes in an event. Out: whether the run waits now.
    fn heed(&mut self, event: RunEvent) -> bool {
        let program = Arc::clone(&self.loaded.program);
        match event {
            RunEvent::Record { record, steps, state, faults } => {
                self.told.step = steps;
                if let Some(state) = state {
                    self.told.state = written_state(&state, &program);
                }
                self.record(&record);
                let place = |span| self.texts.place(&self.loaded, span);
                self.told.faults.extend(faults.iter().filter_map(|fault| Wrong::new(fault, &place)));
                return false;
            }
            RunEvent::Progress(steps) => {
                self.told.step = steps;
                return false;
            }
            RunEvent::Refused(_) => return false,
            RunEvent::AsksInput { location, values, .. } => {
                self.told.waiting = Waiting::Input;
                self.told.word = Some(location.show(&program).to_string());
                self.told.offered = values.iter().map(|value| value.show(&program).to_string()).collect();
                self.told.at = None;
                self.asked = Some(location);
            }
            RunEvent::AsksChoice { span, candidates } => {
                self.told.waiting = Waiting::Choice;
                self.told.word = None;
                let shown = |values: &Vec<groundstate::machine::Value>| {
                    values.iter().map(|value| value.show(&program).briefly().to_string()).collect::<Vec<_>>().join(", ")
                };
                self.told.offered = candidates.iter().take(OFFERED).map(shown).collect();
                self.told.at = self.texts.place(&self.loaded, span);
                self.asked = None;
            }
            RunEvent::Paused if std::mem::take(&mut self.is_ending) => return !self.remote.send(Command::Step(1)),
            RunEvent::Paused => {
                if self.told.waiting != Waiting::Nothing {
                    self.told.waiting = Waiting::Step;
                    self.told.word = None;
                }
                self.told.offered.clear();
                self.told.at = None;
                self.asked = None;
            }
        }
        true
    }

    fn record(&mut self, record: &Record) {
        // An end belongs to what came before it.
        if !matches!(record, Record::End(_)) {
            self.told.updates.clear();
            self.told.rules.clear();
            self.told.faults.clear();
            self.told.waiting = Waiting::Step;
            self.told.word = None;
        }
        match record {
            Record::Step(step) => {
                for change in &step.changes {
                    let Some(at) = self.texts.place(&self.loaded, change.span) else { continue };
                    self.told.updates.push(Written::new(change, &self.loaded.program, at));
                    let rule = self.rule_of(change.span);
                    self.told.rules.extend(rule.filter(|rule| !self.told.rules.contains(rule)));
                }
            }
            Record::End(end) => {
                self.is_ending = false;
                self.told.waiting = Waiting::Nothing;
                self.told.word = Some(end.word().to_string());
            }
            Record::Attempt(_) => self.is_ending = true,
            Record::Initial { .. } | Record::Back { .. } => {}
        }
    }

    /// The declared rule that a place is in.
    fn rule_of(&self, span: Span) -> Option<Named<Place>> {
        let holds = |body: Span| body.file == span.file && body.start <= span.start && span.end <= body.end;
        let rule = self.loaded.model.rules.iter().find(|rule| holds(rule.body.span))?;
        Some(Named { name: rule.name.clone(), at: self.texts.place(&self.loaded, rule.span)? })
    }
}

/// LIMIT: so many candidates of a choice are shown; others can be chosen by their number.
const OFFERED: usize = 100;

impl Texts {
    /// A place of the texts; none in a library.
    fn place(&self, loaded: &Loaded, span: Span) -> Option<Place> {
        let path = &loaded.sources.file(span.file).name;
        let lines = self.lines.get(path)?;
        let at = |offset: u32| {
            let at = lines.position(offset as usize, self.encoding);
            Position::new(at.line, at.column)
        };
        Some(Place { uri: uri_of(path)?, range: Range::new(at(span.start), at(span.end)) })
    }
}
