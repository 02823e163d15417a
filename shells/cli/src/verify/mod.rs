//! `groundstate verify MODEL|CHART`: explores every state; prints a verdict for each check; writes counterexamples as traces
//! and scenarios.
//!
//! Exit codes: 0 all hold, 1 something is violated, 3 nothing is violated but something is unknown.

mod aside;
pub mod beside;
mod bounded;
mod conflict;
pub mod counterexample;
mod disk;
mod idle;
mod live;
mod operators;
mod proof_coverage;
mod reduced;
mod system;
mod tell;
pub mod watch;

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use groundstate::VerifiedSystem;
use groundstate::inputs::verification::Verification;
use groundstate::job::{self, Cancel};
use groundstate::verify::solver::Method;
use groundstate::verify::temporal::fairness::AgentFairness;
use groundstate::verify::{Disk, NoStart, Options, Outcome, Reason, Report, Request};
use groundstate::{Loaded, Overlay, Said, own_files};

use program::{Expression, PropertyKind};

use crate::checkpoint::Checkpoint;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;
use crate::solver::Process;
pub use bounded::Bounded;
use disk::Folder;
use live::Live;
pub use tell::Teller;

/// Arguments of `verify`.
#[derive(Debug, Clone, Args)]
pub struct Arguments {
    /// The model, or a chart with a system
    model: PathBuf,
    /// How to explore the states
    #[arg(long, value_enum, default_value_t)]
    engine: Engine,
    /// The SMT solver: a program or `none`. Default: z3 or cvc5 from the PATH
    #[arg(long, value_name = "PROGRAM")]
    solver: Option<PathBuf>,
    /// What to store of each state; unless that is all of it, no check is proved
    #[arg(long, value_enum, default_value_t)]
    storage: Storage,
    /// The size of the array of --storage bitstate, in MiB
    #[arg(long, value_name = "MIB", default_value_t = 64, value_parser = clap::value_parser!(u64).range(1..=1 << 20))]
    array: u64,
    /// Choose another hash for --storage compact and bitstate, which omits other states, if any
    #[arg(long, value_name = "N", default_value_t = 0)]
    hash_seed: u64,
    /// Save the search to this file regularly, and when a limit or Ctrl-C ends it; continue from the file if it exists;
    /// it is removed when the search has finished
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// When memory is full, store states in files of this folder
    #[arg(long, value_name = "FOLDER")]
    disk: Option<PathBuf>,
    /// If the main rule chooses who moves: make independent moves in one order instead of all
    #[arg(long, value_enum, default_value_t, value_name = "HOW")]
    partial_order: Switch,
    /// Treat states as one if they differ only by a permutation of interchangeable elements
    #[arg(long, value_enum, default_value_t, value_name = "HOW")]
    symmetry: Switch,
    /// The number of workers. Default: the number of processors
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=256))]
    workers: Option<u64>,
    /// An additional invariant; may be repeated
    #[arg(long = "invariant", value_name = "TERM")]
    invariants: Vec<String>,
    /// An additional formula with operators of CTL; may be repeated
    #[arg(long, value_name = "FORMULA")]
    ctl: Vec<String>,
    /// An additional formula with operators of LTL; may be repeated
    #[arg(long, value_name = "FORMULA")]
    ltl: Vec<String>,
    /// An additional assumption, as INVAR: skip states in which it is false, or steps if it reads inputs; may be
    /// repeated
    #[arg(long = "assume", value_name = "TERM")]
    assumptions: Vec<String>,
    /// Of a chart's system: verify also what the components' machines decide. Default: if a property speaks of it
    #[arg(long)]
    data: bool,
    /// Stop at the first violation
    #[arg(long)]
    first: bool,
    /// States in which this term holds are no deadlocks
    #[arg(long, value_name = "TERM")]
    terminal: Option<String>,
    /// Fairness of agents in temporal properties: weak, an agent that can always move moves eventually; strong, an
    /// agent that can move again and again moves eventually
    #[arg(long, value_enum, value_name = "HOW")]
    fair: Option<Fair>,
    /// Also report unreachable rules in imported files
    #[arg(long)]
    imports: bool,
    /// Then replace each part of the properties that hold, and report parts without which they hold as well
    #[arg(long, conflicts_with_all = ["first", "checkpoint", "disk"])]
    vacuity: bool,
    /// Then tell what the properties that hold depend on, and which functions and updates none of them depends on
    #[arg(long)]
    coverage: bool,
    /// Write counterexamples: a scenario (FILE.avalla), a trace (FILE.trace), or both for each violation into a folder; of a
    /// CHART, scenarios alone
    #[arg(long, value_name = "PATH")]
    counterexample: Option<PathBuf>,
    #[command(flatten)]
    bounded: Bounded,
    /// Make every step by the machine and remember none: slower, for comparison
    #[arg(long, hide = true)]
    forgetful: bool,
}

/// How to explore the states.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, clap::ValueEnum)]
enum Engine {
    /// The one that will probably finish first
    #[default]
    Auto,
    /// One state after another
    Explicit,
    /// Sets of states, by binary decision diagrams
    Bdd,
    /// Bounded model checking by an SMT solver: finds violations, proves nothing
    Bmc,
    /// k-induction by an SMT solver
    Induction,
    /// Property-directed reachability (IC3) by the Horn engine of z3
    Pdr,
}

impl Engine {
    fn chosen(self) -> groundstate::verify::EngineKind {
        match self {
            Engine::Auto => groundstate::verify::EngineKind::Automatic,
            Engine::Explicit => groundstate::verify::EngineKind::Explicit,
            Engine::Bdd => groundstate::verify::EngineKind::Symbolic,
            Engine::Bmc => groundstate::verify::EngineKind::Solver(Method::Bounded),
            Engine::Induction => groundstate::verify::EngineKind::Solver(Method::Induction),
            Engine::Pdr => groundstate::verify::EngineKind::Solver(Method::Reachability),
        }
    }
}

/// On or off.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, clap::ValueEnum)]
enum Switch {
    /// Do it
    On,
    /// Do not
    #[default]
    Off,
}

/// What to store of each state.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, clap::ValueEnum)]
enum Storage {
    /// All of it
    #[default]
    Exact,
    /// A hash of 61 bits: 9 to 14 bytes per state, however large it is
    Compact,
    /// Three bits of an array
    #[value(name = "bitstate")]
    BitState,
}

/// The fairness of the main rule's choice of who moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Fair {
    /// An agent that can always move moves eventually
    Weak,
    /// An agent that can move again and again moves eventually
    Strong,
}

/// The names under which messages show properties of the command line.
const OPTIONS: [&str; 3] = ["--invariant", "--ctl", "--ltl"];

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let is_chart = arguments.model.extension().is_some_and(|ending| ending == "chart");
    if let Some(option) = [("--vacuity", arguments.vacuity), ("--coverage", arguments.coverage)]
        .into_iter()
        .find_map(|(option, given)| (is_chart && given).then_some(option))
    {
        let about = "is about the properties of a model: verify the machines of a chart's system one by one";
        return Err(Failure::usage(format!("{option} {about}")));
    }
    let ending = arguments.counterexample.as_ref().and_then(|path| path.extension()?.to_str());
    if is_chart && ending == Some("trace") {
        let help = "name a FILE.avalla for the first one, or a folder for all; the model of `groundstate chart build` has traces";
        return Err(Failure::usage_with_help(
            "a counterexample of a chart is written as a scenario, not as a trace",
            help,
        ));
    }
    let mut rest = None;
    let system = match is_chart {
        true => match system(shell, arguments, &mut rest)? {
            Ok(system) => Some(system),
            Err(exit) => return Ok(exit),
        },
        false if arguments.data => {
            return Err(Failure::usage(
                "--data is about the system of a chart: a model is verified with its data anyway",
            ));
        }
        false => None,
    };
    let arguments = rest.as_ref().unwrap_or(arguments);
    let mut loaded = match &system {
        Some(system) => system.loaded.clone(),
        None => match load(shell, &arguments.model)? {
            Ok(loaded) => loaded,
            Err(exit) => return Ok(exit),
        },
    };
    if loaded.program.main.is_none() {
        return crate::run::no_main(shell, &loaded);
    }
    // Only the model's own texts count, so this comes before those of options are added.
    let fingerprint = groundstate::fingerprint(&loaded.sources);
    let bounded = &arguments.bounded;
    if arguments.counterexample.is_some() && arguments.model.as_os_str() == "-" {
        return Err(Failure::usage("a scenario cannot load standard input: write the model to a file"));
    }
    let Some(beside) = bounded.beside(shell, &loaded.program, &mut loaded.sources.clone(), &arguments.model)? else {
        return Ok(Exit::World);
    };
    let [_, ctl, ltl] = &beside.properties;
    let (ctl, ltl) = (!arguments.ctl.is_empty() || !ctl.is_empty(), !arguments.ltl.is_empty() || !ltl.is_empty());
    if system.is_none() {
        loaded = operators::import(shell, loaded, ctl, ltl);
    }
    let Some((asked, beside, terminal)) = ask(shell, arguments, &loaded)? else { return Ok(Exit::World) };
    let assumed = assumed(arguments, &beside);
    let (program, sources) = (Arc::clone(&asked.program), asked.sources.clone());
    let (root, users) = (loaded.model.root, own_files(&sources));
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let (options, watch) = bounded.options(shell, &program, &beside)?;
    if arguments.disk.is_some() {
        // The limit applies to the states in memory; the rest goes to files.
        interrupt::bound_memory(u64::MAX);
    }
    let folder = match &arguments.disk {
        Some(path) => Some(Folder::new(path)?),
        None => None,
    };
    let workers = arguments.workers.map_or(processors, |workers| workers as usize);
    let options = Options {
        engine: arguments.engine.chosen(),
        workers,
        first: arguments.first,
        terminal: terminal.clone(),
        forgetful: arguments.forgetful,
        storage: match arguments.storage {
            Storage::Exact => groundstate::verify::Storage::Exact,
            Storage::Compact => groundstate::verify::Storage::Compact,
            Storage::BitState => groundstate::verify::Storage::BitState(arguments.array << 20),
        },
        seed: arguments.hash_seed,
        partial_order: arguments.partial_order == Switch::On,
        symmetry: arguments.symmetry == Switch::On,
        disk: folder.clone().map(|folder| folder as Arc<dyn Disk>),
        ..options
    };
    let fair = match (arguments.fair, beside.fair.as_deref()) {
        (None, Some(text)) => {
            let fair = <Fair as clap::ValueEnum>::from_str(text, false);
            Some(fair.map_err(|_| Failure::usage(format!("`fair: {text}` is neither weak nor strong")))?)
        }
        (fair, _) => fair,
    };
    let agents = fair.map(|fair| match fair {
        Fair::Weak => AgentFairness::Weak,
        Fair::Strong => AgentFairness::Strong,
    });
    if arguments.coverage && agents.is_some() {
        let message = "--coverage does not know what fairness of agents rests on";
        return Err(Failure::usage_with_help(message, "leave it out, or the fairness"));
    }
    let (proved, watch) = match &system {
        Some(system) => {
            system::about(shell, system)?;
            system::sure_ages(shell, system)?;
            let sought = system::Sought { arguments, options: &options, agents };
            match system::general(shell, system, &sought, watch)? {
                system::General::Decided(exit) => return Ok(exit),
                system::General::Open(mut proved, mut watch) => {
                    proved.extend(system::timing(shell, system, &sought, &mut watch, &proved, !assumed.is_empty())?);
                    (proved, watch)
                }
            }
        }
        None => (system::Proved::new(), watch),
    };
    let again = arguments.vacuity.then(|| options.clone());
    let unbegun = system.is_some().then(|| options.clone());
    let request = Request::of(&program, options).fair(agents).kept(arguments.checkpoint.is_some()).build();
    let request = request.map_err(conflict::conflict)?;
    let solver = Process::find(arguments.solver.as_deref());
    let checkpoint = match &arguments.checkpoint {
        Some(path) => Some(Checkpoint::new(path, &[&fingerprint])?),
        None => None,
    };
    let limits = shell.global.limits.uninterrupted();
    let mut teller = Teller::new(&program, &sources, false);
    if let Some(system) = &system {
        teller.words.story = Some(system::story(system, limits.clone(), (&program, &sources)));
    }
    if shell.json() {
        teller.scenario = match &system {
            Some(system) => system::scripts(&arguments.model, system, (&program, &sources), &limits),
            None => counterexample::scripts(&arguments.model, &program, loaded.model.properties.len()),
        };
    }
    teller.assumed(shell, &assumed)?;
    let mut live = Live::new(shell, &teller, watch);
    let job = job::verify(request, Cancel::from(interrupt::request().clone()), solver, checkpoint, live::impatience());
    let job = job.map_err(|error| Failure::usage(format!("the search cannot be started: {error}")))?;
    while let Some(event) = job.next_event() {
        if !live.hear(&event) {
            job.cancel().cancel();
        }
    }
    let (outcome, checkpoint) = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    let (timed_out, told) = live.done()?;
    teller.words.timed_out = timed_out;
    let mut report = match outcome {
        Ok(report) => report,
        Err(NoStart::Refused(refusal)) => {
            return Err(checkpoint
                .map_or_else(|| Failure::usage("no checkpoint"), |kept| kept.refused(refusal, "other properties")));
        }
        Err(trouble) => match (trouble, &unbegun) {
            (NoStart::Stopped(stop), Some(options)) => groundstate::verify::unbegun(&program, options, stop),
            (trouble, _) => return no_start(shell, &teller, trouble),
        },
    };
    for verdict in &mut report.verdicts {
        if matches!(verdict.outcome, Outcome::Unknown(_))
            && let Some(more) = proved.get(&system::check(&teller.words, verdict.subject))
        {
            verdict.outcome = Outcome::Holds;
            teller.words.elsewhere.insert(verdict.subject, more);
        }
    }
    // Nobody wrote the rules of a model that is made of a chart.
    report
        .unreachable
        .retain(|span| system.is_none() && (span.file == root || (arguments.imports && users(span.file))));
    teller.report(shell, &report, &told)?;
    if arguments.coverage {
        proof_coverage::tell(shell, &teller, &report)?;
    }
    if let Some(options) = again {
        idle::tell(shell, arguments, &teller, &report, (options, agents))?;
    }
    match (&arguments.counterexample, &system) {
        (Some(path), Some(system)) => system::write(shell, path, &arguments.model, system, &asked, &limits, &report)?,
        (Some(path), None) => {
            let model = (arguments.model.as_path(), fingerprint.as_str());
            counterexample::write(shell, path, model, &asked, &report)?;
        }
        (None, _) => {}
    }
    checkpoint.map_or(Ok(()), Checkpoint::done)?;
    folder.map_or(Ok(()), |folder| folder.done())?;
    Ok(exit(&report))
}

/// Loads the system of a chart, and proves what it can on parts of it: `rest` is what is left to ask then. What is at fault in a question is told
/// before the first search.
fn system(
    shell: &mut Shell,
    arguments: &Arguments,
    rest: &mut Option<Arguments>,
) -> Result<Result<Box<VerifiedSystem>, Exit>, Failure> {
    let system = match system::load(shell, arguments, true)? {
        Ok(system) => system,
        Err(exit) => return Ok(Err(exit)),
    };
    let Some((asked, _, terminal)) = ask(shell, arguments, &system.loaded)? else { return Ok(Err(Exit::World)) };
    system::refuse(&system, &asked, system.loaded.program.properties.len(), terminal.as_ref())?;
    let left = without_proved(shell, arguments)?;
    let is_less = !left.bounded.proved.is_empty();
    let left = rest.insert(left);
    // What nobody asks for any more need not be followed.
    if is_less { system::load(shell, left, false) } else { Ok(Ok(system)) }
}

/// The arguments without what is proved of parts of the chart's system, and without the time that it took.
fn without_proved(shell: &mut Shell, arguments: &Arguments) -> Result<Arguments, Failure> {
    let begin = std::time::Instant::now();
    let proved = reduced::prove(shell, arguments)?;
    let mut rest = arguments.clone();
    for (kind, text) in &proved {
        let texts = [&mut rest.invariants, &mut rest.ctl, &mut rest.ltl];
        if let Some(texts) = texts.into_iter().nth(*kind) {
            texts.retain(|other| other != text);
        }
    }
    rest.bounded.proved = proved;
    let spent = begin.elapsed().as_secs();
    rest.bounded.time = rest.bounded.time.map(|seconds| seconds.saturating_sub(spent).max(1));
    Ok(rest)
}

/// A model with what is asked about it; what stands beside it; and the states that are no deadlocks.
type Asked = (Overlay, Verification, Option<Expression>);

/// Adds the properties and assumptions of the command line, and of the file beside the model. If they have faults, shows them and
/// returns `None`.
fn ask(shell: &mut Shell, arguments: &Arguments, loaded: &Loaded) -> Result<Option<Asked>, Failure> {
    let mut asked = loaded.overlay();
    let beside = arguments.bounded.beside(shell, &loaded.program, &mut asked.sources, &arguments.model)?;
    let Some(beside) = beside else { return Ok(None) };
    for text in assumed(arguments, &beside) {
        if let Err(faults) = asked.property(PropertyKind::Invar, "--assume", text) {
            shell.diagnostics(&asked.sources, &faults)?;
            return Ok(None);
        }
    }
    let said = [&arguments.invariants, &arguments.ctl, &arguments.ltl];
    let kinds = [PropertyKind::Invariant, PropertyKind::Ctl, PropertyKind::Ltl];
    for (((kind, option), said), beside) in kinds.into_iter().zip(OPTIONS).zip(said).zip(&beside.properties) {
        for text in beside.iter().map(Said::from).chain(said.iter().map(Said::from)) {
            if let Err(faults) = asked.property(kind, option, text) {
                shell.diagnostics(&asked.sources, &faults)?;
                return Ok(None);
            }
        }
    }
    let terminal = arguments.terminal.as_ref().map(Said::from).or(beside.terminal.as_ref().map(Said::from));
    let terminal = match terminal.map(|text| asked.ask("--terminal", text)) {
        None => None,
        Some(Ok(term)) => Some(term),
        Some(Err(faults)) => {
            shell.diagnostics(&asked.sources, &faults)?;
            return Ok(None);
        }
    };
    Ok(Some((asked, beside, terminal)))
}

/// The assumptions: those of the command line replace those of the file.
fn assumed<'a>(arguments: &'a Arguments, beside: &'a Verification) -> Vec<Said<'a>> {
    match &arguments.assumptions[..] {
        [] => beside.assumptions.iter().map(Said::from).collect(),
        said => said.iter().map(Said::from).collect(),
    }
}

/// Reports why there is no initial state.
pub fn no_start(shell: &mut Shell, teller: &Teller<'_>, trouble: NoStart) -> Result<Exit, Failure> {
    match trouble {
        NoStart::Refused(_) => unreachable!("a checkpoint is refused where there is one"),
        NoStart::Fault(fault) => {
            shell.diagnostic(teller.words.sources, &groundstate::diagnose_fault(&fault, teller.words.program))?;
            Ok(Exit::Model)
        }
        NoStart::Stopped(stop) => {
            shell.note(&format!(
                "not known: {} before all initial states were found",
                teller.words.reason(&Reason::Stopped(stop))
            ))?;
            Ok(Exit::Unknown)
        }
        NoStart::Unbounded(unbounded) => {
            shell.diagnostic(teller.words.sources, &teller.words.unbounded(&unbounded))?;
            Ok(Exit::Unknown)
        }
        NoStart::Outside(outside) => {
            shell.diagnostic(teller.words.sources, &groundstate::diagnose_outside(&outside))?;
            Ok(Exit::Unknown)
        }
        NoStart::NoSolver(reason) => {
            let help = "install z3 or cvc5, or name one with --solver";
            Err(Failure::usage_with_help(format!("--engine needs a solver, and {reason}"), help))
        }
    }
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
