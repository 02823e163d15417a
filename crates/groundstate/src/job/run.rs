//! Runs a model as a job that can be steered: stepped, paused, taken back, given inputs and choices.
//!
//! In: a [`RunRequest`], and [`Command`]s while it runs. Out: a [`RunEvent`] for each record, with its faults as
//! diagnostics. If an input or a choice has no source, the run asks for it and waits for a command. INVARIANT: a paused
//! run depends only on the request and the commands, not on when they arrive.
//!
//! A run makes hundreds of thousands of steps a second. So events are sent in batches, and a run that keeps no records
//! ([`Options::keep`]) reports a step only if something is wrong in it.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::io;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

use machine::{Choice, Interrupt, Limits, Location, Show, Value};
use model::Basic;
use program::{DomainId, DomainKind, Program};
use simulate::{Ask, Choices, Chooser, End, Inputs, Options, Record, Run, Signal, Source, read_value};
use syntax::{Diagnostic, Sources, Span};

use crate::diagnose_record;
use crate::job::{Cancel, Job, Port};
use crate::reporting::Reporter;

/// While the job waits for a command, how often it checks whether it was cancelled.
const LOOK: Duration = Duration::from_millis(20);

/// The run to make.
pub struct RunRequest {
    /// What runs.
    pub program: Arc<Program>,
    /// The machine's limits.
    pub limits: Limits,
    /// When it stops, and what its records contain. Only steps that [`Options::history`] keeps can be taken back.
    pub options: Options,
    /// Adds sources of inputs, which are asked after those set by [`Command::Set`]. Called on the job's thread.
    pub inputs: Box<dyn FnOnce(Inputs) -> Inputs + Send>,
    /// Whether to ask for inputs that no source has; otherwise such an input is a fault.
    pub asks_inputs: bool,
    /// Whether to ask for choices, instead of making them as `inputs` says.
    pub asks_choices: bool,
    /// Whether to wait for a command before the first step.
    pub paused: bool,
    /// Whether each event contains the whole state.
    pub states: bool,
    /// Called after each record: whether to send it now rather than with later ones. The clock is the shell's. Use
    /// [`at_once`] to send each record immediately.
    pub due: Box<dyn FnMut() -> bool + Send>,
}

/// Sends every record immediately.
pub fn at_once() -> Box<dyn FnMut() -> bool + Send> {
    Box::new(|| true)
}

impl std::fmt::Debug for RunRequest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RunRequest").field("program", &self.program.name).field("options", &self.options).finish()
    }
}

/// A command to a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Command {
    /// Make this many steps, then wait.
    Step(u64),
    /// Make steps until something stops it.
    Resume,
    /// Wait before the next step.
    Pause,
    /// Take the last step back. If an input or a choice is asked for, abandon the step instead.
    Back,
    /// Give the requested input this value, once.
    Answer(Value),
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
    },
    /// A choice is requested; continues with [`Command::Choose`].
    AsksChoice {
        /// The choose rule or the term.
        span: Span,
        /// The values of its variables, for each candidate.
        candidates: Vec<Vec<Value>>,
    },
    /// The run waits for a command.
    Paused,
    /// A command cannot be carried out now; a sentence.
    Refused(String),
}

/// A run; its result is the number of the last step.
pub type RunJob = Job<RunEvent, u64>;

/// Steers a run, from any thread.
#[derive(Debug, Clone)]
pub struct Remote(Sender<Command>);

impl Remote {
    /// Sends a command; `false` if the run has ended.
    pub fn send(&self, command: Command) -> bool {
        self.0.send(command).is_ok()
    }
}

/// Starts a run.
///
/// # Errors
/// The system cannot start a thread.
pub fn run(request: RunRequest, cancel: Cancel) -> io::Result<(RunJob, Remote)> {
    let (sender, commands) = channel();
    let looked_at = cancel.interrupt().clone();
    let job = Job::start("run", cancel, move |port| go(request, Rc::new(port), commands, looked_at, &mut |_, _| {}))?;
    Ok((job, Remote(sender)))
}

/// Starts a run for a report. It is steered like any other run; its result is the reporter.
///
/// # Errors
/// The system cannot start a thread.
pub fn report(
    request: RunRequest,
    mut reporter: Reporter,
    sources: Sources,
    cancel: Cancel,
) -> io::Result<(Job<RunEvent, Reporter>, Remote)> {
    let (sender, commands) = channel();
    let looked_at = cancel.interrupt().clone();
    let job = Job::start("report", cancel, move |port| {
        go(request, Rc::new(port), commands, looked_at, &mut |record, run| reporter.note(record, run, &sources));
        reporter
    })?;
    Ok((job, Remote(sender)))
}

/// How many steps to make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Turn {
    /// This many more.
    Steps(u64),
    /// All.
    All,
}

/// Receives the commands. The run, its inputs and its choices share it.
struct Desk {
    port: Rc<Port<RunEvent>>,
    commands: Receiver<Command>,
    /// Commands that came while an input or a choice was requested.
    later: VecDeque<Command>,
    given: BTreeMap<Location, Value>,
    turn: Turn,
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
            Command::Pause => self.turn = Turn::Steps(0),
            Command::Set(location, value) => _ = self.given.insert(location, value),
            Command::Unset(location) => _ = self.given.remove(&location),
            Command::Back => return Some(Do::Back),
            Command::Stop => return Some(Do::Stop),
            Command::Choose(_) => self.port.tell(RunEvent::Refused("no choice is asked for".to_string())),
            Command::Answer(_) | Command::Withhold(_) => {
                self.port.tell(RunEvent::Refused("no input is asked for".to_string()))
            }
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

/// The inputs that commands set.
struct Given(Rc<RefCell<Desk>>);

impl Source for Given {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        let desk = self.0.borrow();
        if desk.given.is_empty() { Ok(None) } else { Ok(desk.given.get(&ask.location.to_location()).cloned()) }
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
                Waited::Command(Command::Withhold(why)) => return Err(why),
                Waited::Command(Command::Answer(value)) if ask.admits(&value) => return Ok(Some(value)),
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

fn go(
    request: RunRequest,
    port: Rc<Port<RunEvent>>,
    commands: Receiver<Command>,
    interrupt: Interrupt,
    follow: &mut dyn FnMut(&Record, &mut Run),
) -> u64 {
    let RunRequest { program, limits, options, inputs, asks_inputs, asks_choices, paused, states, mut due } = request;
    let is_told = options.keep;
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
    let mut sources = inputs(Inputs::new().with(Given(Rc::clone(&desk))));
    if asks_inputs {
        sources = sources.with(asking());
    }
    if asks_choices {
        sources = sources.choosing(Choices::asked(asking()));
    }
    let limits = Limits { interrupt, ..limits };
    let mut run = Run::new(Arc::clone(&program), limits, sources, options);
    let mut initial = true;
    loop {
        // The initial state is made before the first pause.
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
        follow(&record, &mut run);
        let faults = diagnose_record(&record, &mut run);
        let state = states.then(|| run.machine().locations());
        if let (Record::End(_), Turn::Steps(steps)) = (&record, &mut desk.borrow_mut().turn) {
            // Stay paused at the end of a run made step by step, so that the last step can be taken back.
            *steps = 0;
        }
        let is_due = due();
        if is_told || !faults.is_empty() || !matches!(record, Record::Step(_)) {
            port.add(RunEvent::Record { record: Box::new(record), steps: run.steps(), state, faults }, is_due);
        } else if is_due {
            port.mention(RunEvent::Progress(run.steps()));
        }
        if stops {
            return run.steps();
        }
    }
}
