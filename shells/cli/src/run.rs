//! `groundstate run MODEL`: makes steps and prints them as text or as a trace.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use groundstate::job::{self, Cancel, RunEvent, RunRequest};
use groundstate::session::Evaluator;
use groundstate::simulate::{End, Header, Invariants, Options, Record, Violation};
use groundstate::tell::{Detail, Narrator};
use groundstate::{Loaded, Overlay};
use machine::{FaultKind, Location, Value};
use program::{FunctionKind, Program};
use syntax::{Diagnostic, Sources};
use wire::Wire;

use crate::engine::Engine;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::inputs::{self, Asks, Assembled};
use crate::interrupt;
use crate::load::load;
use crate::progress::{Progress, now_and_then};
use crate::prompt::{Desk, Looking, Saver, Steering};
use crate::shell::Shell;
use crate::tracefile::TraceFile;

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model
    model: PathBuf,
    /// The most steps to make; without it 100, or as many as you like with --interactive
    #[arg(long, short = 'n', value_name = "N", value_parser = crate::limits::count, allow_negative_numbers = true)]
    steps: Option<u64>,
    /// Ask for inputs, and wait where none is asked for: `?` at the prompt says what can be typed. The standard input may be a pipe
    #[arg(long, short = 'i')]
    interactive: bool,
    /// Stop when this term holds, the initial state included
    #[arg(long, value_name = "TERM")]
    until: Option<String>,
    /// Stop when a step has no updates
    #[arg(long)]
    stop_on_empty: bool,
    /// Stop when a step changes nothing
    #[arg(long)]
    stop_on_trivial: bool,
    /// Do not evaluate invariants
    #[arg(long, conflicts_with = "keep_going")]
    no_invariants: bool,
    /// Go on after a violated invariant
    #[arg(long)]
    keep_going: bool,
    /// Write the trace to a file
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// How much of the state is shown
    #[arg(long, value_enum, default_value_t = Show::Changed)]
    show: Show,
    /// The engine that makes the steps
    #[arg(long, value_enum, default_value_t)]
    engine: Engine,
    #[command(flatten)]
    inputs: inputs::InputArguments,
}

/// The most steps, unless the user says otherwise.
const STEPS: u64 = 100;

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    if loaded.program.main.is_none() {
        return no_main(shell, &loaded);
    }
    let mut asked = loaded.overlay();
    let until = match &arguments.until {
        None => None,
        Some(text) => match asked.ask("--until", text) {
            Ok(term) => Some(term),
            Err(faults) => {
                shell.diagnostics(&asked.sources, &faults)?;
                return Ok(Exit::World);
            }
        },
    };
    let Overlay { mut sources, model, program } = asked;
    let whom = if arguments.interactive { Asks::Anyone } else { Asks::Terminal };
    let assembled = inputs::assemble(shell, &arguments.inputs, whom, &mut sources, &program)?;
    let Assembled { inputs, asks, interactive: has_inputs, draws } = match assembled {
        Ok(assembled) => assembled,
        Err(faults) => {
            shell.diagnostics(&sources, &faults)?;
            return Ok(Exit::World);
        }
    };
    let interactive = has_inputs || arguments.interactive;
    let header = header(arguments, draws, &program, &loaded.sources);
    let mut trace = match &arguments.trace {
        Some(path) => Some(TraceFile::create(path, interactive)?),
        None => None,
    };
    let told = interactive || shell.json() || shell.talks() && arguments.show != Show::None || trace.is_some();
    let options = Options {
        until,
        keep: told,
        history: if interactive { 1_000 } else { 0 },
        engine: arguments.engine.choice(),
        ..options(&header)
    };
    let teller = Teller::new(shell, &program, &sources, arguments.show, header.until.clone());
    teller.begin(shell, &header)?;
    if let Some(trace) = &mut trace {
        trace.write(&Wire::header(&header))?;
    }
    interrupt::listen();
    let request = RunRequest {
        program: Arc::clone(&program),
        limits: shell.global.limits.machine(),
        options,
        inputs,
        asks_inputs: asks,
        asks_choices: false,
        paused: interactive,
        states: shell.talks() && arguments.show == Show::All,
        frozen: interactive,
        due: if interactive { job::at_once() } else { now_and_then() },
    };
    let started = job::run(request, Cancel::from(interrupt::request().clone()));
    let (job, remote) = started.map_err(|error| Failure::usage(format!("the run cannot be started: {error}")))?;
    let busy = interactive || shell.global.quiet || std::io::IsTerminal::is_terminal(&std::io::stdout());
    let mut progress = Progress::new(header.steps, busy);
    let mut exit = Exit::Good;
    let steering = interactive.then(|| {
        let limits = shell.global.limits.machine();
        let evaluator = Evaluator::new(&sources, &model, &program, limits.clone());
        let narrator = Narrator::new(&program, Detail::Changed, None, false);
        let max_file_size = shell.global.limits.max_file_size;
        let saver = Saver { model: arguments.model.clone(), limits, max_file_size };
        let looking = Looking::new(&program, narrator, evaluator);
        Steering { looking, saver, waits: arguments.interactive, has_inputs }
    });
    let mut desk = Desk::new(&program, &remote, steering);
    while let Some(event) = job.next_event() {
        match event {
            RunEvent::Record { record, steps, state, frozen, faults } => {
                if let Some(trace) = &mut trace {
                    trace.write(&teller.wire.record(&record, steps))?;
                }
                exit = exit.max(teller.tell(shell, &record, steps, state.as_deref(), &faults)?);
                if interactive {
                    shell.flush()?;
                    desk.note(&record, steps, frozen.as_ref(), teller.updates(&record));
                }
                progress.at(steps);
            }
            RunEvent::Progress(steps) => progress.at(steps),
            other => desk.hear(other),
        }
    }
    progress.done();
    job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    if let Some(trace) = trace {
        trace.finish()?;
    }
    Ok(exit)
}

pub fn no_main(shell: &mut Shell, loaded: &Loaded) -> Result<Exit, Failure> {
    shell.diagnostic(&loaded.sources, &groundstate::diagnose_no_main(&loaded.model))?;
    Ok(Exit::Model)
}

fn header(arguments: &Arguments, draws: bool, program: &Program, sources: &Sources) -> Header {
    let inputs = &arguments.inputs;
    Header {
        model: program.name.clone(),
        path: arguments.model.display().to_string(),
        source: groundstate::fingerprint(sources),
        seed: draws.then_some(inputs.seed),
        steps: arguments.steps.or((!arguments.interactive).then_some(STEPS)),
        stop_on_empty: arguments.stop_on_empty,
        stop_on_trivial: arguments.stop_on_trivial,
        until: arguments.until.clone(),
        invariants: match (arguments.no_invariants, arguments.keep_going) {
            (true, _) => Invariants::Ignore,
            (_, true) => Invariants::Report,
            _ => Invariants::Stop,
        },
    }
}

/// The options of the run that a header describes.
pub fn options(header: &Header) -> Options {
    Options {
        steps: header.steps,
        stop_on_empty: header.stop_on_empty,
        stop_on_trivial: header.stop_on_trivial,
        invariants: header.invariants,
        ..Options::default()
    }
}

/// Prints a run's records, as text or as JSON, with the diagnostics of what went wrong.
pub struct Teller<'a> {
    narrator: Narrator<'a>,
    /// The run has a condition that should become true within its steps.
    has_until: bool,
    pub wire: Wire<'a>,
}

impl<'a> Teller<'a> {
    pub fn new(
        shell: &Shell,
        program: &'a Program,
        sources: &'a Sources,
        detail: Show,
        until: Option<String>,
    ) -> Teller<'a> {
        let has_until = until.is_some();
        let narrator = Narrator::new(program, detail.detail(), until, shell.color_out());
        Teller { narrator, has_until, wire: Wire { program, sources } }
    }

    /// Prints the header, as JSON only.
    pub fn begin(&self, shell: &mut Shell, header: &Header) -> Result<(), Failure> {
        if shell.json() { shell.object(&Wire::header(header)) } else { Ok(()) }
    }

    /// Prints a record and its faults, and returns the exit code that it leads to.
    pub fn tell(
        &self,
        shell: &mut Shell,
        record: &Record,
        steps: u64,
        state: Option<&[(Location, Value)]>,
        faults: &[Diagnostic],
    ) -> Result<Exit, Failure> {
        let is_end = matches!(record, Record::End(_));
        if shell.json() && !is_end {
            shell.object(&self.wire.record(record, steps))?;
        } else if shell.talks() {
            shell.out().write_all(self.narrator.record(record, steps, state).as_bytes())?;
        }
        for fault in faults {
            let told = self.advised(record, fault.clone());
            shell.diagnostic(self.wire.sources, &told)?;
        }
        // Faults come before the end, which is the last object.
        if shell.json() && is_end {
            shell.object(&self.wire.record(record, steps))?;
        }
        Ok(self.exit(record))
    }

    /// Whether each whole state is printed, not only what changed.
    pub fn wants_state(&self) -> bool {
        self.narrator.wants_state()
    }

    /// What a record changed, for the prompt.
    fn updates(&self, record: &Record) -> String {
        match record {
            Record::Step(step) => self.narrator.updates(step),
            _ => String::new(),
        }
    }

    fn is_input(&self, location: &Location) -> bool {
        self.wire.program.function(location.function).kind == FunctionKind::Monitored
    }

    /// Adds to the fault that ended a run what to do about it on the command line.
    fn advised(&self, record: &Record, diagnostic: Diagnostic) -> Diagnostic {
        let Record::End(End::Fault(fault)) = record else { return diagnostic };
        match &fault.kind {
            FaultKind::Environment { .. } => diagnostic.with_help(inputs::HELP),
            FaultKind::OutOfDomain { location, domain, .. } if self.is_input(location) => {
                let name = &self.wire.program.domain(*domain).name;
                diagnostic.with_help(format!("give it a value in {name}"))
            }
            FaultKind::Interrupted(_) => diagnostic.with_help("if the model is right, raise --max-heap"),
            FaultKind::Limit { limit, .. } => match crate::limits::Limits::option_for(limit) {
                Some(option) => diagnostic.with_help(format!("if the model is right, raise {option}")),
                None => diagnostic,
            },
            _ => diagnostic,
        }
    }

    fn exit(&self, record: &Record) -> Exit {
        let judged = |violations: &[Violation]| if violations.is_empty() { Exit::Good } else { Exit::Model };
        match record {
            Record::Initial { violations, .. } => judged(violations),
            Record::Step(step) | Record::Attempt(step) => judged(&step.violations),
            Record::Back { .. } => Exit::Good,
            Record::End(End::Fault(fault)) => match &fault.kind {
                FaultKind::Environment { .. } => Exit::World,
                // The input is at fault, not the model.
                FaultKind::OutOfDomain { location, .. } if self.is_input(location) => Exit::World,
                _ => Exit::Model,
            },
            Record::End(End::Violation) => Exit::Model,
            Record::End(End::Interrupted) => Exit::Unknown,
            Record::End(End::Steps) if self.has_until => Exit::Unknown,
            Record::End(End::Steps | End::Empty | End::Trivial | End::Until | End::Quit) => Exit::Good,
        }
    }
}

/// How much of the state is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Show {
    /// The whole state after every step
    All,
    /// The initial state, then what changed
    Changed,
    /// Only how the run ended
    None,
}

impl Show {
    fn detail(self) -> Detail {
        match self {
            Show::All => Detail::All,
            Show::Changed => Detail::Changed,
            Show::None => Detail::None,
        }
    }
}
