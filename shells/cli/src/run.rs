//! `groundstate run MODEL`: steps, told as text or as a trace.

use std::cell::Cell;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use groundstate::simulate::{End, Header, Invariants, Options, Record, Run, Violation};
use groundstate::{Loaded, Overlay};
use machine::{FaultKind, Location};
use program::{FunctionKind, Program};
use syntax::Sources;
use wire::Wire;

use crate::engine::Engine;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::inputs::{self, Assembled};
use crate::interrupt;
use crate::load::load;
use crate::narrate::{Detail, Narrator};
use crate::progress::Progress;
use crate::shell::Shell;
use crate::tracefile::TraceFile;

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model
    model: PathBuf,
    /// The most steps to make
    #[arg(long, short = 'n', value_name = "N", default_value_t = 100, value_parser = crate::limits::count, allow_negative_numbers = true)]
    steps: u64,
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
    #[arg(long, value_enum, default_value_t = Detail::Changed)]
    show: Detail,
    /// What makes the steps
    #[arg(long, value_enum, default_value_t)]
    engine: Engine,
    #[command(flatten)]
    inputs: inputs::InputArguments,
}

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
    let Overlay { mut sources, program, .. } = asked;
    let assembled = inputs::assemble(shell, &arguments.inputs, &mut sources, &program)?;
    let Assembled { inputs, interactive, told: look } = match assembled {
        Ok(assembled) => assembled,
        Err(faults) => {
            shell.diagnostics(&sources, &faults)?;
            return Ok(Exit::World);
        }
    };
    let header = header(arguments, &program, &loaded.sources);
    let mut trace = match &arguments.trace {
        Some(path) => Some(TraceFile::create(path, interactive)?),
        None => None,
    };
    let told = shell.json() || shell.talks() && arguments.show != Detail::None || trace.is_some();
    let options = Options {
        until,
        keep: told,
        history: if interactive { 1_000 } else { 0 },
        engine: arguments.engine.choice(),
        ..options(&header)
    };
    let mut run = Run::new(Arc::clone(&program), shell.global.limits.machine(), inputs, options);
    let teller = Teller::new(shell, &program, &sources, arguments.show, header.until.clone());
    teller.begin(shell, &header)?;
    if let Some(trace) = &mut trace {
        trace.write(&Wire::header(&header))?;
    }
    interrupt::listen();
    let busy = interactive || shell.global.quiet || std::io::IsTerminal::is_terminal(&std::io::stdout());
    let mut progress = Progress::new(Some(arguments.steps), busy);
    let mut exit = Exit::Good;
    while let Some(record) = run.advance() {
        if let Some(trace) = &mut trace {
            trace.write(&teller.wire.record(&record, run.steps()))?;
        }
        exit = exit.max(teller.tell(shell, &record, &mut run)?);
        if interactive {
            let mut look = look.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            teller.narrator.look(&mut look, &record, run.machine());
            shell.flush()?;
        }
        progress.at(run.steps());
        if interrupt::asked() {
            run.stop(End::Interrupted);
        }
    }
    progress.done();
    if let Some(trace) = trace {
        trace.finish()?;
    }
    Ok(exit)
}

pub fn no_main(shell: &mut Shell, loaded: &Loaded) -> Result<Exit, Failure> {
    shell.diagnostic(&loaded.sources, &groundstate::diagnose_no_main(&loaded.model))?;
    Ok(Exit::Model)
}

fn header(arguments: &Arguments, program: &Program, sources: &Sources) -> Header {
    let inputs = &arguments.inputs;
    let random = inputs.random || inputs.choose == inputs::Chosen::Random;
    Header {
        model: program.name.clone(),
        path: arguments.model.display().to_string(),
        source: groundstate::fingerprint(sources),
        seed: random.then_some(inputs.seed),
        steps: Some(arguments.steps),
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

/// The options of the run that a header tells of.
pub fn options(header: &Header) -> Options {
    Options {
        steps: header.steps,
        stop_on_empty: header.stop_on_empty,
        stop_on_trivial: header.stop_on_trivial,
        invariants: header.invariants,
        ..Options::default()
    }
}

/// Tells a run's records: to people or as JSON, with the diagnostics of what went wrong.
pub struct Teller<'a> {
    narrator: Narrator<'a>,
    pub wire: Wire<'a>,
}

impl<'a> Teller<'a> {
    pub fn new(
        shell: &Shell,
        program: &'a Program,
        sources: &'a Sources,
        detail: Detail,
        until: Option<String>,
    ) -> Teller<'a> {
        let binders = if shell.talks() { groundstate::choice_variables(program) } else { Default::default() };
        let narrator = Narrator { detail, color: shell.color_out(), program, binders, until, quiet: Cell::new(None) };
        Teller { narrator, wire: Wire { program, sources } }
    }

    /// The header; people know what they started.
    pub fn begin(&self, shell: &mut Shell, header: &Header) -> Result<(), Failure> {
        if shell.json() { shell.object(&Wire::header(header)) } else { Ok(()) }
    }

    /// Tells a record and gives what it means for the exit code.
    pub fn tell(&self, shell: &mut Shell, record: &Record, run: &mut Run) -> Result<Exit, Failure> {
        if shell.json() {
            // What is wrong comes before the end, which is the last object.
            let exit = if let Record::End(_) = record { self.faults(shell, record, run)? } else { Exit::Good };
            shell.object(&self.wire.record(record, run.steps()))?;
            let more = if let Record::End(_) = record { Exit::Good } else { self.faults(shell, record, run)? };
            return Ok(exit.max(more));
        }
        if shell.talks() {
            self.narrator.record(shell.out(), record, run.machine())?;
        }
        self.faults(shell, record, run)
    }

    fn faults(&self, shell: &mut Shell, record: &Record, run: &mut Run) -> Result<Exit, Failure> {
        match record {
            Record::Initial { violations, .. } => self.violations(shell, violations, 0, run),
            Record::Step(step) | Record::Attempt(step) => self.violations(shell, &step.violations, step.step, run),
            Record::Back { .. } => Ok(Exit::Good),
            Record::End(end) => self.end(shell, end),
        }
    }

    fn violations(
        &self,
        shell: &mut Shell,
        violations: &[Violation],
        step: u64,
        run: &mut Run,
    ) -> Result<Exit, Failure> {
        for violation in violations {
            let diagnostic = groundstate::diagnose_violation(violation, step, run.machine_mut());
            shell.diagnostic(self.wire.sources, &diagnostic)?;
        }
        Ok(if violations.is_empty() { Exit::Good } else { Exit::Model })
    }

    fn is_input(&self, location: &Location) -> bool {
        self.wire.program.function(location.function).kind == FunctionKind::Monitored
    }

    fn end(&self, shell: &mut Shell, end: &End) -> Result<Exit, Failure> {
        match end {
            End::Fault(fault) => {
                let mut diagnostic = groundstate::diagnose_fault(fault, self.wire.program);
                let mut exit = Exit::Model;
                match &fault.kind {
                    FaultKind::Environment { .. } => {
                        diagnostic = diagnostic.with_help(inputs::HELP);
                        exit = Exit::World;
                    }
                    // The input is at fault, not the model.
                    FaultKind::OutOfDomain { location, domain, .. } if self.is_input(location) => {
                        let name = &self.wire.program.domain(*domain).name;
                        diagnostic = diagnostic.with_help(format!("give it a value in {name}"));
                        exit = Exit::World;
                    }
                    FaultKind::Interrupted(_) => {
                        diagnostic = diagnostic.with_help("if the model is right, raise --max-heap");
                    }
                    FaultKind::Limit { limit, .. } => {
                        if let Some(option) = crate::limits::Limits::option_for(limit) {
                            diagnostic = diagnostic.with_help(format!("if the model is right, raise {option}"));
                        }
                    }
                    _ => {}
                }
                shell.diagnostic(self.wire.sources, &diagnostic)?;
                Ok(exit)
            }
            End::Violation => Ok(Exit::Model),
            End::Interrupted => Ok(Exit::Unknown),
            End::Steps if self.narrator.until.is_some() => Ok(Exit::Unknown),
            End::Steps | End::Empty | End::Trivial | End::Until | End::Quit => Ok(Exit::Good),
        }
    }
}
