//! What steers a run: commands from outside, and the inputs and choices that it asks for.
//!
//! In: [`Command`]s, through a [`Remote`]. Out: what the run does next, and questions as [`RunEvent`]s. If an input or a choice
//! has no source, the run waits for its answer; commands for later are kept until then.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::Duration;

use machine::{Choice, Location, Show, Snapshot, Value};
use model::Basic;
use program::{DomainId, DomainKind, Program};
use simulate::{Ask, Chooser, RandomSource, Record, Signal, Source, read_value};
use syntax::{Diagnostic, Span};

use crate::job::Port;

/// While the job waits for a command, how often it checks whether it was cancelled.
const LOOK: Duration = Duration::from_millis(20);

/// A command to a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Command {
    /// Make this many steps, then wait.
    Step(u64),
    /// Make steps until something stops it.
    Resume,
    /// Take steps back until something stops it, or none is kept.
    Rewind,
    /// Wait before the next step.
    Pause,
    /// Take the last step back. While an input or a choice is asked for: go from the step that is being made to the last one,
    /// or in a session, which waits between steps, only abandon it.
    Back,
    /// Give the requested input this value, once.
    Answer(Value),
    /// Draw the requested input at random, by the seed of the run.
    Draw,
    /// Refuse the requested input: a fault, with this sentence.
    Withhold(String),
    /// Give an input this value from now on.
    Set(Location, Value),
    /// Ask for an input again from now on.
    Unset(Location),
    /// Take this candidate of the requested choice, from 0.
    Choose(usize),
    /// End the run.
    Stop,
}

/// A whole state, in which terms can be evaluated while the run goes on.
#[derive(Debug, Clone)]
pub struct Frozen(pub(crate) Arc<Snapshot>);

/// It is the same only if it is the same copy.
impl PartialEq for Frozen {
    fn eq(&self, other: &Frozen) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// An event of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum RunEvent {
    /// Something happened.
    Record {
        /// What happened, as in a trace.
        record: Box<Record>,
        /// How many steps have been made.
        steps: u64,
        /// The state after it, if requested.
        state: Option<Vec<(Location, Value)>>,
        /// The same, to evaluate terms in.
        frozen: Option<Frozen>,
        /// What is wrong: a violated invariant, a fault.
        faults: Vec<Diagnostic>,
    },
    /// This many steps have been made; sent if single steps are not reported.
    Progress(u64),
    /// An input is requested; continues with [`Command::Answer`] or [`Command::Set`].
    AsksInput {
        /// The step being made, from 1; 0 for the initial state.
        step: u64,
        /// The requested input.
        location: Location,
        /// The domain of its values.
        domain: DomainId,
        /// The first hundred values of the domain, if they are known.
        values: Vec<Value>,
        /// The least and the greatest value, if the domain is all integers between them.
        bounds: Option<(i64, i64)>,
    },
    /// A choice is requested; continues with [`Command::Choose`].
    AsksChoice {
        /// The choose rule or the term.
        span: Span,
        /// The values of its variables, for each candidate.
        candidates: Vec<Vec<Value>>,
    },
    /// A break of a session has something to say. The run goes on.
    Said {
        /// The number of the break.
        id: u64,
        /// What it says.
        text: String,
    },
    /// The run waits for a command.
    Paused,
    /// A command cannot be carried out now; a sentence.
    Refused(String),
}

/// Steers a run, from any thread.
#[derive(Debug, Clone)]
pub struct Remote(pub(crate) Sender<Command>);

impl Remote {
    /// Sends a command; `false` if the run has ended.
    pub fn send(&self, command: Command) -> bool {
        self.0.send(command).is_ok()
    }
}

/// How many steps to make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// This many more.
    Steps(u64),
    /// All.
    All,
    /// Backwards.
    Reverse,
}

/// Receives the commands. The run, its inputs and its choices share it.
pub(crate) struct Desk {
    port: Rc<Port<RunEvent>>,
    commands: Receiver<Command>,
    /// Commands that came while an input or a choice was requested.
    later: VecDeque<Command>,
    given: BTreeMap<Location, Value>,
    pub turn: Turn,
    /// What a step back means while something is asked for.
    back: Signal,
    /// Nobody steers the run any more.
    alone: bool,
}

/// The result of waiting.
enum Waited {
    Command(Command),
    /// The job was cancelled, or nobody is left to give a command.
    Over,
}

impl Desk {
    /// A desk that is to wait, or not, before the first step.
    pub fn new(port: Rc<Port<RunEvent>>, commands: Receiver<Command>, turn: Turn) -> Desk {
        let (later, given) = (VecDeque::new(), BTreeMap::new());
        Desk { port, commands, later, given, turn, back: Signal::Back, alone: false }
    }

    /// These inputs are given from the beginning on, and a step back while something is asked for only abandons the step.
    pub fn begin_session(&mut self, given: &[(Location, Value)]) {
        self.given.extend(given.iter().cloned());
        self.back = Signal::Abandon;
    }

    /// The step that waits for an answer is left.
    fn left(&mut self) -> Signal {
        if self.back == Signal::Abandon {
            self.turn = Turn::Steps(0);
        }
        self.back
    }

    /// Says that a command cannot be carried out now, and waits for others.
    pub fn refuse(&mut self, reason: &str) {
        self.turn = Turn::Steps(0);
        self.port.tell(RunEvent::Refused(reason.to_string()));
    }

    /// Hands over what a break says; waits while too much is unread.
    pub fn say(&mut self, id: u64, text: String) {
        self.port.tell(RunEvent::Said { id, text });
    }

    /// No step is left that could be taken back.
    pub fn is_at_the_beginning(&mut self) {
        if self.turn == Turn::Reverse {
            self.turn = Turn::Steps(0);
        } else {
            self.port.tell(RunEvent::Refused("no step is kept that could be taken back".to_string()));
        }
    }

    fn wait(&mut self) -> Waited {
        loop {
            if self.port.is_cancelled() || self.alone {
                return Waited::Over;
            }
            match self.commands.recv_timeout(LOOK) {
                Ok(command) => return Waited::Command(command),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => self.alone = true,
            }
        }
    }

    /// Carries out a command, and returns what it makes the run do at once.
    fn heed(&mut self, command: Command) -> Option<Do> {
        match command {
            Command::Step(steps) => self.turn = Turn::Steps(steps),
            Command::Resume => self.turn = Turn::All,
            Command::Rewind => self.turn = Turn::Reverse,
            Command::Pause => self.turn = Turn::Steps(0),
            Command::Set(location, value) => _ = self.given.insert(location, value),
            Command::Unset(location) => _ = self.given.remove(&location),
            Command::Back => return Some(Do::Back),
            Command::Stop => return Some(Do::Stop),
            Command::Choose(_) => self.port.tell(RunEvent::Refused("no choice is asked for".to_string())),
            Command::Answer(_) | Command::Draw | Command::Withhold(_) => {
                self.port.tell(RunEvent::Refused("no input is asked for".to_string()))
            }
        }
        None
    }

    /// What the run does next.
    pub fn next(&mut self) -> Do {
        while let Some(command) = self.later.pop_front().or_else(|| self.commands.try_recv().ok()) {
            if let Some(what) = self.heed(command) {
                return what;
            }
        }
        let mut told = false;
        while self.turn == Turn::Steps(0) {
            if !std::mem::replace(&mut told, true) {
                self.port.tell(RunEvent::Paused);
            }
            match self.wait() {
                Waited::Over => return Do::Stop,
                Waited::Command(command) => {
                    if let Some(what) = self.heed(command) {
                        return what;
                    }
                }
            }
        }
        if let Turn::Steps(steps) = &mut self.turn {
            *steps -= 1;
        }
        match self.turn {
            _ if self.port.is_cancelled() => Do::Stop,
            Turn::Reverse => Do::Back,
            Turn::Steps(_) | Turn::All => Do::Step,
        }
    }
}

#[derive(Debug, PartialEq)]
pub(crate) enum Do {
    Step,
    Back,
    Stop,
}

/// The inputs that commands set.
pub(crate) struct Given(pub Rc<RefCell<Desk>>);

impl Source for Given {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        let desk = self.0.borrow();
        if desk.given.is_empty() { Ok(None) } else { Ok(desk.given.get(&ask.location.to_location()).cloned()) }
    }
}

/// Asks for inputs that no source has, and for choices.
pub(crate) struct Asking {
    desk: Rc<RefCell<Desk>>,
    /// Draws what is to be drawn.
    random: Option<RandomSource>,
    signal: Option<Signal>,
}

impl Asking {
    pub fn at(desk: &Rc<RefCell<Desk>>) -> Asking {
        Asking { desk: Rc::clone(desk), random: None, signal: None }
    }

    /// Inputs may also be drawn.
    pub fn drawing(self, random: RandomSource) -> Asking {
        Asking { random: Some(random), ..self }
    }

    fn stop(&mut self, signal: Signal) -> String {
        self.signal = Some(signal);
        "nobody answered".to_string()
    }
}

impl Source for Asking {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        if ask.clock {
            return Ok(None);
        }
        let location = ask.location.to_location();
        let desk = Rc::clone(&self.desk);
        let mut desk = desk.borrow_mut();
        let (step, domain, values, bounds) = (ask.step, ask.codomain, offered(ask), bounds(ask));
        desk.port.tell(RunEvent::AsksInput { step, location: location.clone(), domain, values, bounds });
        loop {
            match desk.wait() {
                Waited::Over | Waited::Command(Command::Stop) => return Err(self.stop(Signal::Quit)),
                Waited::Command(Command::Back) => return Err(self.stop(desk.left())),
                Waited::Command(Command::Withhold(why)) => return Err(why),
                Waited::Command(Command::Answer(value)) if ask.admits(&value) => return Ok(Some(value)),
                Waited::Command(Command::Draw) => match &mut self.random {
                    Some(random) => return random.input(ask),
                    None => desk.port.tell(RunEvent::Refused("no inputs are drawn here".to_string())),
                },
                Waited::Command(Command::Set(at, value)) if at == location && ask.admits(&value) => {
                    desk.given.insert(at, value.clone());
                    return Ok(Some(value));
                }
                Waited::Command(Command::Answer(value)) => desk.port.tell(not_in(ask, &value)),
                Waited::Command(Command::Set(at, value)) if at == location => desk.port.tell(not_in(ask, &value)),
                Waited::Command(other) => desk.later.push_back(other),
            }
        }
    }

    fn signal(&mut self) -> Option<Signal> {
        self.signal.take()
    }
}

fn not_in(ask: &Ask<'_>, value: &Value) -> RunEvent {
    let domain = &ask.program.domain(ask.codomain).name;
    RunEvent::Refused(format!("{} is not in {domain}", value.show(ask.program)))
}

/// LIMIT: at most this many values are offered.
const OFFERED: usize = 100;

/// The values to offer: all of a domain that is enumerable, up to the limit.
fn offered(ask: &Ask<'_>) -> Vec<Value> {
    if let Some(elements) = ask.carriers.get(ask.codomain) {
        return elements.iter().take(OFFERED).cloned().collect();
    }
    let named = |name: &str| read_value(ask.program, ask.codomain, name).ok();
    match &ask.program.domain(ask.codomain).kind {
        DomainKind::Enum { literals } => literals.iter().filter_map(|literal| named(literal)).collect(),
        DomainKind::Basic(Basic::Boolean) => vec![Value::Boolean(true), Value::Boolean(false)],
        _ => Vec::new(),
    }
}

/// The ends of a domain that is all integers between them.
fn bounds(ask: &Ask<'_>) -> Option<(i64, i64)> {
    let elements = ask.carriers.get(ask.codomain)?;
    let number = |value: &Value| match value {
        Value::Integer(number) => Some(*number),
        _ => None,
    };
    let numbers: Vec<i64> = elements.iter().map(number).collect::<Option<_>>()?;
    let (least, most) = (*numbers.iter().min()?, *numbers.iter().max()?);
    let different: BTreeSet<i64> = numbers.into_iter().collect();
    (most.checked_sub(least)?.checked_add(1)? == different.len() as i64).then_some((least, most))
}

impl Chooser for Asking {
    fn choose(&mut self, _program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let of = choice.candidates();
        let desk = Rc::clone(&self.desk);
        let mut desk = desk.borrow_mut();
        let candidates = (0..of).map(|index| choice.candidate(index).to_vec()).collect();
        desk.port.tell(RunEvent::AsksChoice { span: choice.span, candidates });
        loop {
            match desk.wait() {
                Waited::Over | Waited::Command(Command::Stop) => return Err(self.stop(Signal::Quit)),
                Waited::Command(Command::Back) => return Err(self.stop(desk.left())),
                Waited::Command(Command::Choose(index)) if index < of => return Ok(index),
                Waited::Command(Command::Choose(index)) => {
                    let refused = format!("there are {of} candidates, none is number {}", index + 1);
                    desk.port.tell(RunEvent::Refused(refused));
                }
                Waited::Command(other) => desk.later.push_back(other),
            }
        }
    }

    fn signal(&mut self) -> Option<Signal> {
        self.signal.take()
    }
}
