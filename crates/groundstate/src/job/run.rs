//! Runs a model as a job that can be steered: stepped, paused, taken back, given inputs and choices.
//!
//! In: a [`RunRequest`], and [`Command`]s while it runs. Out: a [`RunEvent`] for each record, with its faults as
//! diagnostics. If an input or a choice has no source, the run asks for it and waits for a command. INVARIANT: a paused
//! run depends only on the request and the commands, not on when they arrive.
//!
//! A run makes hundreds of thousands of steps a second. So events are sent in batches, and a run that keeps no records
//! ([`Options::keep`]) reports a step only if something is wrong in it; between two looks at the commands it makes as many steps as
//! the shell's clock leaves it time for.

use std::cell::RefCell;
use std::io;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

use machine::{Interrupt, Limits};
use program::Program;
use simulate::{Choices, End, Inputs, Options, Passed, RandomSource, Record, Run};
use syntax::Sources;

use crate::diagnose_record;
use crate::job::desk::{Asking, Command, Desk, Do, Frozen, Given, Remote, RunEvent, Turn};
use crate::job::{Cancel, Job, Port};
use crate::reporting::Reporter;

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
    /// Whether to ask for inputs that no source has, and how those are drawn that [`Command::Draw`] leaves to chance; otherwise such an
    /// input is a fault.
    pub asks_inputs: Option<RandomSource>,
    /// Whether to ask for choices, instead of making them as `inputs` says.
    pub asks_choices: bool,
    /// Whether to wait for a command before the first step.
    pub paused: bool,
    /// Whether each event contains the whole state.
    pub states: bool,
    /// Whether each event contains the state as one in which terms can be evaluated.
    pub frozen: bool,
    /// Called after each record: whether to send it now rather than with later ones. The clock is the shell's. Use
    /// [`at_once`] to send each record immediately.
    pub due: Box<dyn FnMut() -> bool + Send>,
}

/// LIMIT: so many steps are made between two looks at the commands, at most.
const TOGETHER: u64 = 4_096;

/// Sends every record immediately.
pub fn at_once() -> Box<dyn FnMut() -> bool + Send> {
    Box::new(|| true)
}

impl std::fmt::Debug for RunRequest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RunRequest").field("program", &self.program.name).field("options", &self.options).finish()
    }
}

/// A run; its result is the number of the last step.
pub type RunJob = Job<RunEvent, u64>;

/// Starts a run.
///
/// # Errors
/// The system cannot start a thread.
pub fn run(request: RunRequest, cancel: Cancel) -> io::Result<(RunJob, Remote)> {
    let (sender, commands) = channel();
    let looked_at = cancel.interrupt().clone();
    let job = Job::start("run", cancel, move |port| go(request, Rc::new(port), commands, looked_at, None))?;
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
        let follow = &mut |record: &Record, run: &mut Run| reporter.note(record, run, &sources);
        go(request, Rc::new(port), commands, looked_at, Some(follow));
        reporter
    })?;
    Ok((job, Remote(sender)))
}

/// What looks at each record of a run.
type Follow<'f> = &'f mut dyn FnMut(&Record, &mut Run);

fn go(
    request: RunRequest,
    port: Rc<Port<RunEvent>>,
    commands: Receiver<Command>,
    interrupt: Interrupt,
    mut follow: Option<Follow<'_>>,
) -> u64 {
    let RunRequest { program, limits, options, inputs, asks_inputs, asks_choices, paused, states, frozen, mut due } =
        request;
    let is_told = options.keep;
    // Nobody looks at single steps.
    let passes = !is_told && !states && !frozen && follow.is_none() && options.history == 0;
    let mut together = 1;
    let turn = if paused { Turn::Steps(0) } else { Turn::All };
    let desk = Rc::new(RefCell::new(Desk::new(Rc::clone(&port), commands, turn)));
    let mut sources = inputs(Inputs::new().with(Given(Rc::clone(&desk))));
    if let Some(random) = asks_inputs {
        sources = sources.with(Asking::at(&desk).drawing(random));
    }
    if asks_choices {
        sources = sources.choosing(Choices::asked(Asking::at(&desk)));
    }
    let limits = Limits { interrupt, ..limits };
    let mut run = Run::new(Arc::clone(&program), limits, sources, options);
    let mut initial = true;
    loop {
        // The initial state is made before the first pause.
        let what = if std::mem::take(&mut initial) { Do::Step } else { desk.borrow_mut().next() };
        let stops = what == Do::Stop;
        let turn = desk.borrow().turn;
        let record = match what {
            Do::Step if passes && turn == Turn::All => {
                let mut passed = Passed::default();
                let record = run.pass_to_record(together, &mut passed);
                if record.is_none() && passed.steps == together {
                    let is_due = due();
                    if is_due {
                        port.mention(RunEvent::Progress(run.steps()));
                    }
                    together = if is_due { (together / 2).max(1) } else { (together * 2).min(TOGETHER) };
                    continue;
                }
                record
            }
            Do::Step => run.advance(),
            Do::Back => {
                let back = run.take_back();
                if back.is_none() {
                    desk.borrow_mut().is_at_the_beginning();
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
        if let Some(follow) = &mut follow {
            follow(&record, &mut run);
        }
        let faults = diagnose_record(&record, &mut run);
        let state = states.then(|| run.machine().locations());
        let frozen = frozen.then(|| Frozen(Arc::new(run.machine().snapshot())));
        if let (Record::End(_), Turn::Steps(steps)) = (&record, &mut desk.borrow_mut().turn) {
            // Stay paused at the end of a run made step by step, so that the last step can be taken back.
            *steps = 0;
        }
        let is_due = due();
        if is_told || !faults.is_empty() || !matches!(record, Record::Step(_)) {
            port.add(RunEvent::Record { record: Box::new(record), steps: run.steps(), state, frozen, faults }, is_due);
        } else if is_due {
            port.mention(RunEvent::Progress(run.steps()));
        }
        if stops {
            return run.steps();
        }
    }
}
