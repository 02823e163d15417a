//! A run as a job that can be steered: stepped, paused, taken back, given inputs and choices.
//!
//! In: a [`RunRequest`], and [`Command`]s while it goes on. Out: a [`RunEvent`] for each record, with what is wrong in it as
//! diagnostics. Where an input or a choice is wanted that nobody gave, the run asks and waits for a command. INVARIANT: what it
//! does depends on the request and the commands alone, not on when they come, unless the run is not paused.
//!
//! A run makes hundreds of thousands of steps a second. So events go in batches, and a run whose records hold nothing
//! ([`Options::keep`]) tells of a step only where something is wrong in it.

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
    /// Whether inputs are asked for that no source has; else that is a fault.
    pub asks_inputs: bool,
    /// Whether choices are asked for, in place of those that `inputs` makes.
    pub asks_choices: bool,
    /// Whether it waits for a command before the first step.
    pub paused: bool,
    /// Whether each event holds the whole state.
    pub states: bool,
    /// Asked after each record: whether what has happened is to be told now, and not with what happens next. The clock is the shell's;
    /// [`at_once`] is for whoever looks at each record.
    pub due: Box<dyn FnMut() -> bool + Send>,
}

/// Every record is told when it is there.
pub fn at_once() -> Box<dyn FnMut() -> bool + Send> {
    Box::new(|| true)
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
    /// The input that is asked for has this value, this once.
    Answer(Value),
    /// The input that is asked for cannot be given: a fault, with this sentence.
    Withhold(String),
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
    /// So many steps have been made, where nobody is told of each.
    Progress(u64),
    /// An input is wanted: it goes on with [`Command::Answer`] or [`Command::Set`].
    AsksInput {
        /// The step that is being made, from 1; 0 while the initial state is made.
        step: u64,
        /// What is asked for.
        location: Location,
        /// The domain of its values.
        domain: DomainId,
        /// The first hundred of the values themselves, where they are known.
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
    let looked_at = cancel.interrupt().clone();
    let job = Job::start("run", cancel, move |port| go(request, Rc::new(port), commands, looked_at, &mut |_, _| {}))?;
    Ok((job, Remote(sender)))
}

/// Starts a run that is followed for its report: it is told and steered as any other, and its result is who followed it.
///
/// # Errors
/// The system gives no thread.
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

/// Inputs as commands gave them.
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

/// LIMIT: of a larger domain so many values are offered.
const OFFERED: usize = 100;

/// The values of a small domain.
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
        follow(&record, &mut run);
        let faults = diagnose_record(&record, &mut run);
        let state = states.then(|| run.machine().locations());
        if let (Record::End(_), Turn::Steps(steps)) = (&record, &mut desk.borrow_mut().turn) {
            // Whoever steps by hand may take the last step back.
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
