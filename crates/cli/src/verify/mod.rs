//! `groundstate verify MODEL`: every state explored, a verdict for each check, counterexamples as traces and scenarios.
//!
//! Exit codes: 0 all hold, 1 something is violated, 3 nothing is violated but something is not known.

mod bound;
mod counterexample;
mod tell;
mod watch;

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use groundstate::verify::temporal::fairness::AgentFairness;
use groundstate::verify::{NoStart, Options, Outcome, Report, verify_fair};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;
use tell::Teller;
use watch::Watch;

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model
    model: PathBuf,
    /// How states are gone through
    #[arg(long, value_enum, default_value_t)]
    engine: Engine,
    /// How many workers search; as many as there are processors if not said
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=256))]
    workers: Option<u64>,
    /// Stop at the first violation
    #[arg(long)]
    first: bool,
    /// The values that an input is tried with, as NAME=LOW..HIGH or NAME=VALUE,VALUE; may be repeated
    #[arg(long = "bound", value_name = "BOUND")]
    bounds: Vec<String>,
    /// States in which this term holds may rest
    #[arg(long, value_name = "TERM")]
    terminal: Option<String>,
    /// In temporal properties every agent that can move for ever moves at last: weak if it can move all the time,
    /// strong if it can move again and again
    #[arg(long, value_enum, value_name = "HOW")]
    fair: Option<Fair>,
    /// Write counterexamples: a scenario (FILE.avalla), a trace (FILE.trace), or both for each violation into a folder
    #[arg(long, value_name = "PATH")]
    counterexample: Option<PathBuf>,
    /// The most states
    #[arg(long, value_name = "N", value_parser = crate::limits::count)]
    max_states: Option<u64>,
    /// The most steps from an initial state
    #[arg(long, value_name = "N", value_parser = crate::limits::count)]
    depth: Option<u64>,
    /// The most memory for states, in MiB
    #[arg(long, value_name = "MIB", default_value_t = 8192)]
    max_memory: u64,
    /// The most time, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = crate::limits::count)]
    time: Option<u64>,
    /// Make every step by the machine, remember none: slower, to compare
    #[arg(long, hide = true)]
    forgetful: bool,
}

/// How states are gone through.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, clap::ValueEnum)]
enum Engine {
    /// Whatever is likely to end first
    #[default]
    Auto,
    /// One state after the other
    Explicit,
    /// Sets of states, by binary decision diagrams
    Bdd,
}

impl Engine {
    fn chosen(self) -> groundstate::verify::Engine {
        match self {
            Engine::Auto => groundstate::verify::Engine::Automatic,
            Engine::Explicit => groundstate::verify::Engine::Explicit,
            Engine::Bdd => groundstate::verify::Engine::Symbolic,
        }
    }
}

/// How the main rule's choice of who moves is fair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Fair {
    /// Who can move all the time moves at last
    Weak,
    /// Who can move again and again moves at last
    Strong,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let mut loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    if loaded.program.main.is_none() {
        return crate::run::no_main(shell, &loaded);
    }
    let terminal = match &arguments.terminal {
        None => None,
        Some(text) => match loaded.condition("--terminal", text) {
            Ok(term) => Some(term),
            Err(faults) => {
                shell.diagnostics(&loaded.sources, &faults)?;
                return Ok(Exit::World);
            }
        },
    };
    let program = Arc::new(loaded.program);
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let options = Options {
        limits: shell.global.limits.machine(),
        engine: arguments.engine.chosen(),
        workers: arguments.workers.map_or(processors, |workers| workers as usize),
        first: arguments.first,
        max_states: arguments.max_states.unwrap_or(u64::MAX),
        max_depth: arguments.depth.unwrap_or(u64::MAX),
        max_bytes: arguments.max_memory.saturating_mul(1 << 20),
        bounds: bound::read(&program, &arguments.bounds)?,
        terminal,
        forgetful: arguments.forgetful,
    };
    interrupt::listen();
    let mut watch = Watch::new(arguments.time, shell.global.quiet || shell.json());
    let agents = arguments.fair.map(|fair| match fair {
        Fair::Weak => AgentFairness::Weak,
        Fair::Strong => AgentFairness::Strong,
    });
    let outcome = verify_fair(&program, &options, agents, &mut |progress| watch.at(progress));
    let timed_out = watch.done();
    let teller = Teller { program: &program, sources: &loaded.sources, timed_out };
    let report = match outcome {
        Ok(report) => report,
        Err(NoStart::Fault(fault)) => {
            shell.diagnostic(&loaded.sources, &groundstate::diagnose_fault(&fault, &program))?;
            return Ok(Exit::Model);
        }
        Err(NoStart::Unbounded(unbounded)) => {
            shell.diagnostic(&loaded.sources, &teller.unbounded(&unbounded))?;
            return Ok(Exit::Unknown);
        }
    };
    teller.report(shell, &report)?;
    if let Some(path) = &arguments.counterexample {
        let model = &arguments.model;
        counterexample::write(shell, path, model, &program, &loaded.sources, &report)?;
    }
    Ok(exit(&report))
}

fn exit(report: &Report) -> Exit {
    let any = |of: fn(&Outcome) -> bool| report.verdicts.iter().any(|verdict| of(&verdict.outcome));
    if any(|outcome| matches!(outcome, Outcome::Violated(_))) {
        Exit::Model
    } else if any(|outcome| matches!(outcome, Outcome::Unknown(_))) {
        Exit::Unknown
    } else {
        Exit::Good
    }
}
