//! `groundstate generate-tests MODEL -o FOLDER`: writes scenarios that reach the goals of a model.
//!
//! Each scenario is run before it is kept. One that fails, because no scenario can express a choice of its run, is left
//! out and reported. Exit codes: 0 written, 3 written but the search did not finish, so goals may be missing.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use groundstate::job::{self, Cancel, TestsEvent, TestsRequest};
use groundstate::test_generation::{Goal, Method, Tests, passes_whatever_is_chosen};
use groundstate::verify::{Reason, Stop};
use groundstate::{Suite, own_files};
use syntax::FileId;
use wire::Place;

use crate::check::plural;
use crate::coverage;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{read_source, relative, write_text};
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;
use crate::verify::{Bounded, Teller, no_start};

/// Arguments of `generate-tests`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model
    model: PathBuf,
    /// The folder to write the scenarios to
    #[arg(long, short, value_name = "FOLDER")]
    output: PathBuf,
    /// Also reach goals in imported files
    #[arg(long)]
    imports: bool,
    /// Make this many random walks instead of searching all states
    #[arg(long, value_name = "N", value_parser = crate::limits::count)]
    random: Option<u64>,
    /// The steps of a random walk
    #[arg(long, value_name = "N", default_value_t = 50, requires = "random")]
    steps: usize,
    /// The seed of random walks
    #[arg(long, value_name = "N", default_value_t = 0, requires = "random")]
    seed: u64,
    #[command(flatten)]
    bounded: Bounded,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    if loaded.program.main.is_none() {
        return crate::run::no_main(shell, &loaded);
    }
    let mut sources = loaded.sources.clone();
    let Some(beside) = arguments.bounded.beside(shell, &loaded.program, &mut sources, &arguments.model)? else {
        return Ok(Exit::World);
    };
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    let program = Arc::clone(&loaded.program);
    let (bounded, by_default) = match arguments.random {
        // Random walks end by themselves.
        Some(_) => (arguments.bounded.clone(), false),
        None => arguments.bounded.with_end(),
    };
    let (options, mut watch) = bounded.options(shell, &program, &beside)?;
    let users = own_files(&sources);
    let is_told = |file: FileId| file == loaded.model.root || (arguments.imports && users(file));
    let request = TestsRequest {
        model: Arc::clone(&loaded.model),
        program: Arc::clone(&program),
        path: relative(&arguments.model, folder),
        options,
        method: match arguments.random {
            Some(walks) => Method::Random(walks, arguments.steps, arguments.seed),
            None => Method::Search,
        },
        files: sources.iter().map(|(file, _)| file).filter(|file| is_told(*file)).collect(),
    };
    let started = job::generate_tests(request, Cancel::from(interrupt::request().clone()));
    let job = started.map_err(|error| Failure::usage(format!("the search cannot be started: {error}")))?;
    while let Some(TestsEvent(progress)) = job.next_event() {
        watch.at(&progress);
    }
    let generated = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    let timed_out = watch.done();
    let teller = Teller::new(&program, &sources, timed_out);
    let tests = match generated {
        Ok(tests) => tests,
        Err(trouble) => return no_start(shell, &teller, trouble),
    };
    let mut suite = Suite::new();
    let left_out = write(shell, folder, &tests, &mut suite)?;
    told(shell, &teller, &tests)?;
    for (model, sources, items) in suite.coverage() {
        coverage::report(shell, model, sources, &items)?;
    }
    for name in &left_out {
        shell.note(&format!("{name} is left out: it needs a choice that no scenario can pick"))?;
    }
    let stopped = |reason: &Reason| matches!(reason, Reason::Stopped(Stop::States)) || timed_out;
    if by_default && tests.reasons.iter().any(stopped) {
        Bounded::at_end(shell)?;
    }
    let ended = tests.progress.is_none() || tests.reasons.is_empty();
    Ok(if ended { Exit::Good } else { Exit::Unknown })
}

/// Writes the scenarios that pass; returns the names of the others.
fn write(shell: &mut Shell, folder: &Path, tests: &Tests, suite: &mut Suite) -> Result<Vec<String>, Failure> {
    let limits = shell.global.limits.uninterrupted();
    let mut left_out = Vec::new();
    for scenario in &tests.scenarios {
        let path = folder.join(format!("{}.avalla", scenario.name));
        write_text(&path, &scenario.text)?;
        let source = read_source(&path, shell.global.limits.max_file_size)?;
        if !passes_whatever_is_chosen(suite, &source, &mut shell.disk(), limits.clone()) {
            std::fs::remove_file(&path).map_err(|error| Failure::of_file("write", &path, error))?;
            left_out.push(scenario.name.clone());
            continue;
        }
        if shell.json() {
            let path = path.display().to_string();
            shell.object(&wire::Generated::new(path, scenario.steps))?;
        } else if shell.talks() {
            writeln!(shell.out(), "wrote {}: {}", path.display(), plural(scenario.steps, "step"))?;
        }
    }
    Ok(left_out)
}

/// Reports which goals are reached and which are not.
fn told(shell: &mut Shell, teller: &Teller<'_>, tests: &Tests) -> Result<(), Failure> {
    let mut kinds: BTreeMap<&'static str, (usize, usize)> = BTreeMap::new();
    for goal in &tests.goals {
        let entry = kinds.entry(goal.kind.words().0).or_default();
        entry.0 += usize::from(goal.reached);
        entry.1 += 1;
    }
    let complete = tests.reasons.is_empty();
    let outcome = |goal: &Goal| match (goal.reached, complete) {
        (true, _) => "reached",
        (false, true) => "unreachable",
        (false, false) => "unknown",
    };
    if shell.json() {
        for goal in &tests.goals {
            let (kind, what) = goal.kind.words();
            let (of, at) = (goal.rule.as_str(), Place::new(teller.words.sources, goal.span));
            shell.object(&wire::Goal::new(kind, what, of, at, outcome(goal)))?;
        }
    } else if shell.talks() {
        writeln!(shell.out(), "\ngoals")?;
        for (kind, (reached, all)) in kinds {
            writeln!(shell.out(), "  {kind:<12} {reached:>4} of {all}")?;
        }
        for goal in tests.goals.iter().filter(|goal| !goal.reached) {
            let at = teller.words.sources.position(goal.span);
            let (kind, what) = goal.kind.words();
            let what = if what.is_empty() { kind } else { what };
            writeln!(shell.out(), "  {:<11} {at}: {what} of {}", outcome(goal), goal.rule)?;
        }
        if tests.progress.is_some() && !complete {
            let reasons: Vec<String> = tests.reasons.iter().map(|reason| teller.words.reason(reason)).collect();
            writeln!(shell.out(), "  unknown because: {}", reasons.join("; "))?;
        }
    }
    match &tests.progress {
        Some(progress) => teller.explored(shell, progress, complete),
        None => Ok(()),
    }
}
