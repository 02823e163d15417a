//! The prompt of a run: asks for inputs, and steers the run between them.
//!
//! In: what the run asks and records, and lines that somebody types or pipes in. Out: commands to the run. The run waits between steps, so
//! a step is made only when the prompt sends for it; `:run` and `:until` answer for the user meanwhile. INVARIANT: what is sent depends on
//! the run and the lines, not on when they come.

mod command;
mod line;
mod look;
mod save;

use std::collections::BTreeMap;

use groundstate::job::{Command, Frozen, Remote, RunEvent};
use groundstate::session::Notes;
use groundstate::simulate::{End, Record, read_value};
use machine::{Location, Show, Value};
use program::{DomainId, Expression, Program};

pub use look::Looking;
pub use save::Saver;

use command::{How, Wish, wish};
use line::{Lines, Words, say};

/// LIMIT: `:until` makes so many steps at most.
const SOUGHT: u64 = 1_000;

/// A requested input.
#[derive(Debug, Clone)]
struct Question {
    step: u64,
    location: Location,
    domain: DomainId,
    /// The first of its values, if they are known.
    values: Vec<Value>,
}

/// Who answers.
enum Pace {
    /// The user.
    Asks,
    /// Nobody is asked until so many steps have been made.
    Runs { to: u64 },
    /// Nobody is asked until the term holds, or so many steps have been made.
    Seeks { text: String, term: Expression, to: u64 },
}

/// Where the run is while somebody types.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    /// A step waits for an input.
    Asking,
    /// Between two steps.
    Waiting,
    /// The run has ended.
    Ended,
}

/// What the prompt can do besides answering. Without it, the run is not steered: it only asks.
pub struct Steering<'a> {
    /// Shows states and terms.
    pub looking: Looking<'a>,
    /// Writes scenarios.
    pub saver: Saver,
    /// Also waits where no input is asked for.
    pub waits: bool,
    /// The model has inputs that may be asked for.
    pub has_inputs: bool,
}

/// The terminal that a run asks for inputs.
pub struct Desk<'a> {
    program: &'a Program,
    remote: &'a Remote,
    steering: Option<Steering<'a>>,
    lines: Lines,
    question: Option<Question>,
    /// What each input was last.
    held: BTreeMap<Location, Value>,
    how: How,
    pace: Pace,
    notes: Notes,
    /// How many steps have been made.
    steps: u64,
    /// The step that is being made has asked for something.
    asked: bool,
    /// So has some step.
    has_asked: bool,
    /// The next step is made without waiting for a line.
    flows: bool,
    ended: bool,
    /// Its user has left it.
    leaves: bool,
}

impl<'a> Desk<'a> {
    pub fn new(program: &'a Program, remote: &'a Remote, steering: Option<Steering<'a>>) -> Desk<'a> {
        let flows = steering.as_ref().is_some_and(|steering| steering.has_inputs);
        Desk {
            program,
            remote,
            steering,
            lines: Lines::default(),
            question: None,
            held: BTreeMap::new(),
            how: How::Held,
            pace: Pace::Asks,
            notes: Notes::default(),
            steps: 0,
            asked: false,
            has_asked: false,
            flows,
            ended: false,
            leaves: false,
        }
    }

    /// Takes in what the run recorded.
    pub fn note(&mut self, record: &Record, steps: u64, frozen: Option<&Frozen>, updates: String) {
        let Some(steering) = &mut self.steering else { return };
        self.notes.note_record(self.program, record);
        steering.looking.note(record, steps, frozen, updates);
        (self.steps, self.question) = (steps, None);
        match record {
            Record::Step(step) => {
                self.held.extend(step.inputs.iter().cloned());
                self.flows = std::mem::take(&mut self.asked);
            }
            Record::Back { .. } => {
                (self.flows, self.asked, self.ended, self.pace) = (steering.has_inputs, false, false, Pace::Asks);
            }
            Record::End(end) => {
                (self.ended, self.pace) = (true, Pace::Asks);
                self.leaves = matches!(end, End::Quit | End::Interrupted);
            }
            Record::Initial { .. } | Record::Attempt(_) => self.asked = false,
        }
    }

    /// Answers what a run asks. After its end a run hears no answer.
    pub fn hear(&mut self, event: RunEvent) {
        match event {
            RunEvent::AsksInput { step, location, domain, values, .. } => {
                self.question = Some(Question { step, location, domain, values });
                (self.asked, self.has_asked) = (true, true);
                self.answer();
            }
            RunEvent::Refused(reason) => {
                say(&format!("  {reason}"));
                self.lines.forget();
                if let Some(question) = &self.question {
                    self.held.remove(&question.location);
                }
                self.converse();
            }
            RunEvent::Paused => self.go_on(),
            RunEvent::Record { .. } | RunEvent::Progress(_) | RunEvent::AsksChoice { .. } | RunEvent::Said { .. } => {}
        }
    }

    fn send(&self, command: Command) {
        let _ = self.remote.send(command);
    }

    /// Answers the question: for the user, while nobody is to be asked.
    fn answer(&mut self) {
        let Some(question) = &self.question else { return };
        match (&self.pace, self.how, self.held.get(&question.location)) {
            (Pace::Asks, _, _) => self.converse(),
            (_, How::Random, _) => self.send(Command::Draw),
            (_, How::Held, Some(value)) => self.send(Command::Answer(value.clone())),
            (_, How::Held, None) => {
                say(&format!("  {} has no value yet that could be held", question.location.show(self.program)));
                self.converse();
            }
        }
    }

    /// The run waits between two steps.
    fn go_on(&mut self) {
        let waits = self.steering.as_ref().is_some_and(|steering| steering.waits);
        if self.ended {
            return if !self.leaves && (waits || self.has_asked) { self.converse() } else { self.send(Command::Stop) };
        }
        match &self.pace {
            Pace::Asks if !waits || self.flows => self.send(Command::Step(1)),
            Pace::Asks => self.converse(),
            Pace::Runs { to } if self.steps < *to => self.send(Command::Step(to - self.steps)),
            Pace::Runs { .. } => {
                self.pace = Pace::Asks;
                self.converse();
            }
            Pace::Seeks { text, term, to } => {
                let held = self.steering.as_mut().map(|steering| steering.looking.holds(term));
                let told = match held {
                    Some(Ok(true)) => format!("  `{text}` holds"),
                    Some(Ok(false)) if self.steps < *to => return self.send(Command::Step(1)),
                    Some(Ok(false)) => format!("  `{text}` did not hold within {SOUGHT} steps; `:until` goes on"),
                    Some(Err(reason)) => format!("  {reason}"),
                    None => return,
                };
                say(&told);
                self.pace = Pace::Asks;
                self.converse();
            }
        }
    }

    /// Reads lines until one of them is for the run.
    fn converse(&mut self) {
        let place = match (&self.question, self.ended) {
            (Some(_), _) => Place::Asking,
            (None, true) => Place::Ended,
            (None, false) => Place::Waiting,
        };
        loop {
            match self.lines.read(&self.prompt(place), self.question.as_ref().map(|one| one.domain), self.words()) {
                Ok(None) => return self.send(Command::Stop),
                Err(reason) if place == Place::Asking => return self.send(Command::Withhold(reason)),
                Err(_) => return self.send(Command::Stop),
                Ok(Some(line)) => match wish(&line).and_then(|wish| self.grant(wish, place)) {
                    Ok(true) => return,
                    Ok(false) => {}
                    Err(reason) => say(&format!("  {reason}")),
                },
            }
        }
    }

    /// Does what a line asks for. Out: whether the run goes on, or ends.
    fn grant(&mut self, wish: Wish<'_>, place: Place) -> Result<bool, String> {
        match wish {
            Wish::Nothing => match place {
                Place::Asking => return Ok(false),
                Place::Waiting => self.send(Command::Step(1)),
                Place::Ended => self.send(Command::Stop),
            },
            Wish::Value(text) => return self.give(text, place),
            Wish::Quit => self.send(Command::Stop),
            Wish::Back => {
                // What was left of `:run` is left out.
                self.send(Command::Pause);
                self.send(Command::Back);
            }
            Wish::Help => {
                say(&self.help(place));
                return Ok(false);
            }
            Wish::Inputs(how) => {
                self.how = how;
                say(match how {
                    How::Held => "  `:run` and `:until` leave each input at the value that it was given last",
                    How::Random => "  `:run` and `:until` draw the inputs, by --seed",
                });
                return Ok(false);
            }
            Wish::State(text) => {
                say(self.looking()?.state(text)?.trim_end());
                return Ok(false);
            }
            Wish::Updates => {
                say(self.looking()?.updates());
                return Ok(false);
            }
            Wish::Save { path, replaces } => {
                let steering = self.steering.as_ref().ok_or(NOT_STEERED)?;
                say(&format!("  {}", steering.saver.save(self.program, &self.notes, path, replaces)?));
                return Ok(false);
            }
            Wish::Run(steps) => {
                self.may_go_on(place)?;
                self.hurry(Pace::Runs { to: self.steps.saturating_add(steps) }, place);
            }
            Wish::Until(text) => {
                self.may_go_on(place)?;
                let looking = self.looking()?;
                let term = looking.condition(text)?;
                if looking.has_state() && looking.holds(&term)? {
                    return Err(format!("`{text}` holds already"));
                }
                let to = self.steps.saturating_add(SOUGHT);
                self.hurry(Pace::Seeks { text: text.to_string(), term, to }, place);
            }
        }
        Ok(true)
    }

    fn looking(&mut self) -> Result<&mut Looking<'a>, String> {
        self.steering.as_mut().map(|steering| &mut steering.looking).ok_or_else(|| NOT_STEERED.to_string())
    }

    fn may_go_on(&self, place: Place) -> Result<(), String> {
        match (&self.steering, place) {
            (None, _) => Err(NOT_STEERED.to_string()),
            (_, Place::Ended) => Err("the run has ended; `:back` takes its last step back".to_string()),
            _ => Ok(()),
        }
    }

    /// From now on nobody is asked.
    fn hurry(&mut self, pace: Pace, place: Place) {
        self.pace = pace;
        match place {
            Place::Asking => self.answer(),
            _ => self.send(Command::Step(1)),
        }
    }

    /// Gives the input that is asked for a value.
    fn give(&mut self, text: &str, place: Place) -> Result<bool, String> {
        let Some(question) = self.question.as_ref().filter(|_| place == Place::Asking) else {
            return Err(look::no_value(text, place == Place::Ended));
        };
        let (domain, location) = (question.domain, question.location.clone());
        let value = read_value(self.program, domain, text).map_err(|told| {
            let values = question.values.iter().map(|value| value.show(self.program).to_string());
            look::not_a_value(text, &told, &values.collect::<Vec<_>>())
        })?;
        self.lines.remember(domain, text);
        self.held.insert(location, value.clone());
        self.send(Command::Answer(value));
        Ok(true)
    }

    fn words(&self) -> Words {
        let values = self.question.iter().flat_map(|question| &question.values);
        let values = values.map(|value| value.show(self.program).to_string()).collect();
        Words { values, names: look::names(self.program) }
    }

    fn prompt(&self, place: Place) -> String {
        match (place, &self.question) {
            (Place::Asking, Some(question)) => {
                let location = question.location.show(self.program);
                format!("step {}: {location} ({}) = ", question.step, self.wanted(question))
            }
            (Place::Ended, _) => "ended> ".to_string(),
            _ => format!("step {}> ", self.steps + 1),
        }
    }

    fn wanted(&self, question: &Question) -> String {
        look::wanted(self.program, question.domain, &question.values)
    }

    fn help(&self, place: Place) -> String {
        let here = match (place, &self.question) {
            (Place::Asking, Some(question)) => {
                let location = question.location.show(self.program).to_string();
                let held = self.held.get(&question.location).map(|value| value.show(self.program).to_string());
                look::asked(question.step, &location, &self.wanted(question), held.as_deref())
            }
            (Place::Ended, _) => "  The run has ended: Enter leaves it".to_string(),
            _ => format!("  Enter makes step {}", self.steps + 1),
        };
        let commands = if self.steering.is_some() { look::COMMANDS } else { look::FEW };
        format!("{here}\n{commands}")
    }
}

const NOT_STEERED: &str = "this run only asks for inputs: `groundstate run` can be steered";
