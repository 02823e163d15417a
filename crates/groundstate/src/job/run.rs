//! A run as a job that can be steered: stepped, paused, taken back, given inputs and choices.
//!
//! In: a [`RunRequest`], and [`Command`]s while it goes on. Out: a [`RunEvent`] for each record, with what is wrong in it as
//! diagnostics. Where an input or a choice is wanted that nobody gave, the run asks and waits for a command. INVARIANT: what it
//! does depends on the request and the commands alone, not on when they come, unless the run is not paused.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::io;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

use machine::{Choice, Limits, Location, Value};
use model::Basic;
use program::{DomainId, DomainKind, Program};
use simulate::{Ask, Choices, Chooser, End, Inputs, Options, Record, Run, Signal, Source, Violation, read_value};
use syntax::{Diagnostic, Span};

use crate::job::{Cancel, Job, Port};
use crate::{diagnose_fault, diagnose_violation};

/// Between two looks at whether a job that waits for a command is cancelled.
const LOOK: Duration = Duration::from_millis(20);

/// The run that is wanted.
pub struct RunRequest {
    /// What runs.
    pub program: Arc<Program>,
    /// The machine's limits.
    pub limits: Limits,
    /// When it stops, and what its records hold. Only what [`Options::history`] keeps can be taken back.
    pub options: Options,
    /// Adds the sources of inputs, which are asked after those that [`Command::Set`] gave; made on the thread of the job.
    pub inputs: Box<dyn FnOnce(Inputs) -> Inputs + Send>,
    /// Whether choices are asked for, in place of those that `inputs` makes.
    pub asks_choices: bool,
    /// Whether it waits for a command before the first step.
    pub paused: bool,
    /// Whether each event holds the whole state.
    pub states: bool,
}

impl std::fmt::Debug for RunRequest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RunRequest").field("program", &self.program.name).field("options", &self.options).finish()
    }
}

/// What a run is told.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Command {
    /// Make so many steps, then wait.
    Step(u64),
    /// Make steps until something stops it.
    Resume,
    /// Wait before the next step.
    Pause,
    /// Take the last step back; where an input or a choice is asked for, give none and do the same.
    Back,
    /// From now on an input has this value.
    Set(Location, Value),
    /// From now on an input is asked for again.
    Unset(Location),
    /// Take this candidate of the choice that is asked for, from 0.
    Choose(usize),
    /// End the run.
    Stop,
}

/// What a run tells.
#[derive(Debug, Clone, PartialEq)]
pub enum RunEvent {
    /// Something happened.
    Record {
        /// What, as in a trace.
        record: Box<Record>,
        /// How many steps have been made.
        steps: u64,
        /// The state after it, where it is wanted.
        state: Option<Vec<(Location, Value)>>,
        /// What is wrong: a violated invariant, a fault.
        faults: Vec<Diagnostic>,
    },
    /// An input is wanted: it goes on with [`Command::Set`].
    AsksInput {
        /// The step that is being made, from 1; 0 while the initial state is made.
        step: u64,
        /// What is asked for.
        location: Location,
        /// The domain of its values.
        domain: DomainId,
        /// The values themselves, where they are not too many to be offered.
        values: Vec<Value>,
    },
    /// A choice is wanted: it goes on with [`Command::Choose`].
    AsksChoice {
        /// The choose rule or the term.
        span: Span,
        /// The values of its variables, by candidate.
        candidates: Vec<Vec<Value>>,
    },
    /// It waits for a command.
    Paused,
    /// A command that cannot be carried out now; a sentence.
    Refused(String),
}

/// A run; its result is the last step's number.
pub type RunJob = Job<RunEvent, u64>;

/// Steers a run from anywhere.
#[derive(Debug, Clone)]
pub struct Remote(Sender<Command>);

impl Remote {
    /// Gives a command; `false` where the run has ended.
    pub fn send(&self, command: Command) -> bool {
        self.0.send(command).is_ok()
    }
}

/// Starts a run.
///
/// # Errors
/// The system gives no thread.
pub fn run(request: RunRequest, cancel: Cancel) -> io::Result<(RunJob, Remote)> {
    let (sender, commands) = channel();
    let job = Job::start("run", cancel, move |port| go(request, Rc::new(port), commands, cancel))?;
    Ok((job, Remote(sender)))
}

/// Whether steps are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Turn {
    /// So many more.
    Steps(u64),
    /// All.
    All,
}

/// Where commands come in. The run, its inputs and its choices share it.
struct Desk {
    port: Rc<Port<RunEvent>>,
    commands: Receiver<Command>,
    /// Commands that came while something else was asked.
    later: VecDeque<Command>,
    given: BTreeMap<Location, Value>,
    turn: Turn,
    /// Who steers it is gone.
    alone: bool,
}

/// What came of waiting.
enum Waited {
    Command(Command),
    /// The job is cancelled, or nobody is there to give a command.
    Over,
}

impl Desk {
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

    /// A command that changes how the run goes on.
    fn heed(&mut self, command: Command) -> Option<Do> {
        match command {
            Command::Step(steps) => self.turn = Turn::Steps(steps),
            Command::Resume => self.turn = Turn::All,
            Command::Pause => self.turn = Turn::Steps(0),
            Command::Set(location, value) => _ = self.given.insert(location, value),
            Command::Unset(location) => _ = self.given.remove(&location),
            Command::Back => return Some(Do::Back),
            Command::Stop => return Some(Do::Stop),
            Command::Choose(_) => self.port.tell(RunEvent::Refused("no choice is asked for".to_string())),
        }
        None
    }

    /// What the run does next.
    fn next(&mut self) -> Do {
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
        if self.port.is_cancelled() { Do::Stop } else { Do::Step }
    }
}

#[derive(PartialEq)]
enum Do {
    Step,
    Back,
    Stop,
}

/// Inputs as commands gave them.
struct Given(Rc<RefCell<Desk>>);

impl Source for Given {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        Ok(self.0.borrow().given.get(&ask.location.to_location()).cloned())
    }
}

/// Asks for inputs that no source has, and for choices.
struct Asking {
    desk: Rc<RefCell<Desk>>,
    signal: Option<Signal>,
}

impl Asking {
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
        let (step, domain, values) = (ask.step, ask.codomain, offered(ask));
        desk.port.tell(RunEvent::AsksInput { step, location: location.clone(), domain, values });
        loop {
            match desk.wait() {
                Waited::Over | Waited::Command(Command::Stop) => return Err(self.stop(Signal::Quit)),
                Waited::Command(Command::Back) => return Err(self.stop(Signal::Back)),
                Waited::Command(Command::Set(at, value)) if at == location => {
                    desk.given.insert(at, value.clone());
                    return Ok(Some(value));
                }
                Waited::Command(other) => desk.later.push_back(other),
            }
        }
    }

    fn signal(&mut self) -> Option<Signal> {
        self.signal.take()
    }
}

/// LIMIT: of a larger domain no values are offered.
const OFFERED: usize = 100;

/// The values of a small domain.
fn offered(ask: &Ask<'_>) -> Vec<Value> {
    if let Some(elements) = ask.carriers.get(ask.codomain) {
        return if elements.len() <= OFFERED { elements.to_vec() } else { Vec::new() };
    }
    let named = |name: &str| read_value(ask.program, ask.codomain, name).ok();
    match &ask.program.domain(ask.codomain).kind {
        DomainKind::Enum { literals } => literals.iter().filter_map(|literal| named(literal)).collect(),
        DomainKind::Basic(Basic::Boolean) => vec![Value::Boolean(true), Value::Boolean(false)],
        _ => Vec::new(),
    }
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
                Waited::Command(Command::Back) => return Err(self.stop(Signal::Back)),
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

fn go(request: RunRequest, port: Rc<Port<RunEvent>>, commands: Receiver<Command>, cancel: Cancel) -> u64 {
    let RunRequest { program, limits, options, inputs, asks_choices, paused, states } = request;
    let desk = Desk {
        port: Rc::clone(&port),
        commands,
        later: VecDeque::new(),
        given: BTreeMap::new(),
        turn: if paused { Turn::Steps(0) } else { Turn::All },
        alone: false,
    };
    let desk = Rc::new(RefCell::new(desk));
    let asking = || Asking { desk: Rc::clone(&desk), signal: None };
    let mut sources = inputs(Inputs::new().with(Given(Rc::clone(&desk)))).with(asking());
    if asks_choices {
        sources = sources.choosing(Choices::asked(asking()));
    }
    let limits = Limits { interrupt: Some(cancel.interrupt()), ..limits };
    let mut run = Run::new(Arc::clone(&program), limits, sources, options);
    let mut initial = true;
    loop {
        // The initial state is there before anybody is asked how to go on.
        let what = if std::mem::take(&mut initial) { Do::Step } else { desk.borrow_mut().next() };
        let stops = what == Do::Stop;
        let record = match what {
            Do::Step => run.advance(),
            Do::Back => {
                let back = run.take_back();
                if back.is_none() {
                    port.tell(RunEvent::Refused("no step is kept that could be taken back".to_string()));
                    continue;
                }
                back
            }
            Do::Stop => {
                run.stop(if port.is_cancelled() { End::Interrupted } else { End::Quit });
                run.advance()
            }
        };
        let Some(record) = record else { return run.steps() };
        let faults = faults_of(&record, &mut run, &program);
        let state = states.then(|| run.machine().locations());
        if let (Record::End(_), Turn::Steps(steps)) = (&record, &mut desk.borrow_mut().turn) {
            // Whoever steps by hand may take the last step back.
            *steps = 0;
        }
        port.tell(RunEvent::Record { record: Box::new(record), steps: run.steps(), state, faults });
        if stops {
            return run.steps();
        }
    }
}

/// What is wrong in a record.
fn faults_of(record: &Record, run: &mut Run, program: &Program) -> Vec<Diagnostic> {
    let mut violated = |violations: &[Violation], step: u64| {
        violations.iter().map(|violation| diagnose_violation(violation, step, run.machine_mut())).collect()
    };
    match record {
        Record::Initial { violations, .. } => violated(violations, 0),
        Record::Step(step) | Record::Attempt(step) => violated(&step.violations, step.step),
        Record::End(End::Fault(fault)) => vec![diagnose_fault(fault, program)],
        Record::End(_) | Record::Back { .. } => Vec::new(),
    }
}
