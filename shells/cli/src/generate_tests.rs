//! `groundstate generate-tests MODEL -o FOLDER`: writes scenarios that reach the goals of a model.
//!
//! Each scenario is run before it is kept. One that fails or goes another way, because no scenario can express a choice of its run, is left
//! out and reported. Exit codes: 0 written, 3 written but the search did not finish, so goals may be missing.

use std::collections::BTreeMap;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use groundstate::job::{self, Cancel, TestsEvent, TestsRequest};
use groundstate::scenario::Options;
use groundstate::test_generation::{Generated, Method, Tests, Trial};
use groundstate::verify::{Reason, Stop};
use groundstate::{SeededChoices, Suite, own_files};
use syntax::{FileId, SourceFile};
use wire::Place;

use crate::check::plural;
use crate::coverage;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{relative, write_text};
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
    let mut tests = match generated {
        Ok(tests) => tests,
        Err(trouble) => return no_start(shell, &teller, trouble),
    };
    let mut suite = Suite::new();
    let kept = write(shell, folder, &mut tests, &mut suite)?;
    told(shell, &teller, &tests, &kept)?;
    for (model, sources, items) in suite.coverage() {
        coverage::report(shell, model, sources, &items)?;
    }
    let left_out = tests.scenarios.iter().enumerate().filter(|(index, _)| !kept.contains(index));
    for (_, Generated { name, .. }) in left_out {
        shell.note(&format!("{name} is left out: it needs a choice that no scenario can pick"))?;
    }
    let stopped = |reason: &Reason| matches!(reason, Reason::Stopped(Stop::States)) || timed_out;
    if by_default && tests.reasons.iter().any(stopped) {
        Bounded::at_end(shell)?;
    }
    let ended = tests.progress.is_none() || tests.reasons.is_empty();
    Ok(if ended { Exit::Good } else { Exit::Unknown })
}

/// Writes the scenarios that do what they were made for; returns their numbers.
fn write(shell: &mut Shell, folder: &Path, tests: &mut Tests, suite: &mut Suite) -> Result<Vec<usize>, Failure> {
    let limits = shell.global.limits.uninterrupted();
    let (mut kept, mut trial) = (Vec::new(), Trial::default());
    for index in 0..tests.scenarios.len() {
        let scenario = &tests.scenarios[index];
        let path = folder.join(format!("{}.avalla", scenario.name));
        let source = SourceFile::new(path.display().to_string(), scenario.text.as_str());
        let shown = trial.shown(scenario, &source, &mut shell.disk(), &limits);
        if !shown.is_some_and(|shown| tests.settle(index, shown, &kept)) {
            // An earlier one of its name is as little worth keeping.
            match std::fs::remove_file(&path) {
                Err(error) if error.kind() != ErrorKind::NotFound => {
                    return Err(Failure::of_file("write", &path, error));
                }
                _ => continue,
            }
        }
        let scenario = &tests.scenarios[index];
        write_text(&path, &scenario.text)?;
        let options = Options { limits: limits.clone(), coverage: true, ..Options::default() };
        suite.test(source, &mut shell.disk(), options, &mut SeededChoices::new(0));
        kept.push(index);
        if shell.json() {
            let path = path.display().to_string();
            shell.object(&wire::Generated::new(path, scenario.steps))?;
        } else if shell.talks() {
            writeln!(shell.out(), "wrote {}: {}", path.display(), plural(scenario.steps, "step"))?;
        }
    }
    Ok(kept)
}

/// Reports which goals are reached and which are not.
fn told(shell: &mut Shell, teller: &Teller<'_>, tests: &Tests, kept: &[usize]) -> Result<(), Failure> {
    let reached = tests.reached_by(kept);
    let mut kinds: BTreeMap<&'static str, (usize, usize)> = BTreeMap::new();
    for (goal, reached) in tests.goals.iter().zip(&reached) {
        let entry = kinds.entry(goal.kind.words().0).or_default();
        entry.0 += usize::from(*reached);
        entry.1 += 1;
    }
    let complete = tests.reasons.is_empty();
    let outcomes = tests.goals.iter().zip(&reached).map(|(goal, reached)| match (reached, goal.reached, complete) {
        (true, ..) => "reached",
        (false, true, _) => "untested",
        (false, false, true) => "unreachable",
        (false, false, false) => "unknown",
    });
    let goals: Vec<_> = tests.goals.iter().zip(outcomes).collect();
    if shell.json() {
        for (goal, outcome) in goals {
            let (kind, what) = goal.kind.words();
            let (of, at) = (goal.rule.as_str(), Place::new(teller.words.sources, goal.span));
            shell.object(&wire::Goal::new(kind, what, of, at, outcome))?;
        }
    } else if shell.talks() {
        writeln!(shell.out(), "\ngoals")?;
        for (kind, (reached, all)) in kinds {
            writeln!(shell.out(), "  {kind:<12} {reached:>4} of {all}")?;
        }
        for (goal, outcome) in goals.into_iter().filter(|(_, outcome)| *outcome != "reached") {
            let at = teller.words.sources.position(goal.span);
            let (kind, what) = goal.kind.words();
            let what = if what.is_empty() { kind } else { what };
            writeln!(shell.out(), "  {outcome:<11} {at}: {what} of {}", goal.rule)?;
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
