//! `groundstate test PATH…`: runs scenarios; prints a line for each, details of failures, and a summary.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use clap::Args;
use groundstate::Tested;
use groundstate::job::{self, Cancel, TestEvent};
use groundstate::scenario::{Judgement, Options};
use syntax::{Diagnostic, SourceFile};
use wire::{Answer, Fault, Junit, ScenarioResult, Told};

use crate::check::plural;
use crate::coverage;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{Disk, collect, write_text};
use crate::inputs::Chosen;
use crate::interrupt;
use crate::render;
use crate::shell::Shell;

/// Arguments of `test`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Scenarios (.avalla), or folders of them
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Report what the scenarios covered of their models
    #[arg(long)]
    coverage: bool,
    /// Show the run of each scenario that fails: inputs, choices and changes of each step
    #[arg(long)]
    runs: bool,
    /// Write the results as JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Which candidate a choose rule takes if no pick decides
    #[arg(long, value_enum, default_value_t = Chosen::Random, value_name = "HOW")]
    choose: Chosen,
    /// Seed of random choices
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Steps after which a `step until` without `within` fails
    #[arg(long, value_name = "N", default_value_t = Options::default().bound)]
    until_bound: u64,
}

/// How many scenarios had which result.
#[derive(Debug, Default)]
struct Tally {
    passed: usize,
    failed: usize,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let files = collect(&arguments.paths, &["avalla"])?;
    interrupt::listen();
    let limits = shell.global.limits.machine();
    let options = Options { limits, bound: arguments.until_bound, coverage: arguments.coverage, story: arguments.runs };
    let seed = (arguments.choose == Chosen::Random).then_some(arguments.seed);
    let unread = Arc::new(Mutex::new(None));
    let scenarios = Scenarios { files: files.clone().into_iter(), disk: shell.disk(), unread: Arc::clone(&unread) };
    let started = job::test(scenarios, shell.disk(), options, seed, Cancel::from(interrupt::request().clone()));
    let job = started.map_err(|error| Failure::usage(format!("the scenarios cannot be started: {error}")))?;
    let mut tally = Tally::default();
    let mut junit = Junit::default();
    let mut seen = BTreeSet::new();
    for path in &files {
        let Some(TestEvent(tested)) = job.next_event() else { break };
        let failures = tested.failures();
        if tested.passed() {
            tally.passed += 1
        } else {
            tally.failed += 1
        }
        let render = |fault: &Diagnostic| render::diagnostic(&tested.sources, fault, false);
        junit.case(&path.display().to_string(), &tested, &failures, &render);
        report(shell, path, &tested, &failures, &mut seen)?;
    }
    let suite = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    if let Some(failure) = unread.lock().unwrap_or_else(PoisonError::into_inner).take() {
        return Err(failure);
    }
    if arguments.coverage {
        for (model, sources, items) in suite.coverage() {
            coverage::report(shell, model, sources, &items)?;
        }
    }
    if let Some(path) = &arguments.junit {
        write_text(path, &junit.finish())?;
    }
    summary(shell, &tally, files.len())
}

/// Reads the scenarios one by one, up to the first file that cannot be read.
struct Scenarios {
    files: std::vec::IntoIter<PathBuf>,
    disk: Disk,
    unread: Arc<Mutex<Option<Failure>>>,
}

impl Iterator for Scenarios {
    type Item = SourceFile;

    fn next(&mut self) -> Option<SourceFile> {
        let path = self.files.next()?;
        let read = match path.extension().is_some_and(|extension| extension == "asm") {
            true => {
                let instead = "`groundstate run` runs models; scenarios are .avalla files";
                Err(crate::load::another(&path, "model", instead))
            }
            false => self.disk.root(&path),
        };
        let mut unread = self.unread.lock().unwrap_or_else(PoisonError::into_inner);
        read.map_err(|failure| *unread = Some(failure)).ok()
    }
}

fn report(
    shell: &mut Shell,
    path: &Path,
    tested: &Tested,
    failures: &[Diagnostic],
    seen: &mut BTreeSet<String>,
) -> Result<(), Failure> {
    let sources = &tested.sources;
    if shell.json() {
        let faults = failures.iter().map(|failure| Fault::new(sources, failure)).collect();
        let told = tested.story().map(|(program, story)| Told::story(program, story));
        return shell.object(&ScenarioResult::new(path.display().to_string(), tested, faults, told));
    }
    let passed = tested.passed();
    if shell.talks() {
        let line = line(shell, path, tested, passed);
        writeln!(shell.out(), "{line}")?;
    }
    if let Some((program, story)) = tested.story().filter(|_| shell.talks()) {
        let run = groundstate::tell::story(program, story);
        shell.out().write_all(run.as_bytes())?;
    }
    // Many scenarios load the same model; its faults are shown only once. A fault of a run is shown for each scenario,
    // even if others have the same one.
    let key = |found: &Diagnostic| format!("{} {}", sources.position(found.primary.span), found.message);
    let new = |found: &&Diagnostic| tested.verdict.is_some() || seen.insert(key(found));
    let new: Vec<Diagnostic> = failures.iter().filter(new).cloned().collect();
    if new.is_empty() && !failures.is_empty() && shell.talks() {
        writeln!(shell.out(), "its faults are shown above")?;
    }
    shell.details(sources, &new)?;
    let remarks = tested.verdict.iter().flat_map(|verdict| &verdict.remarks);
    for remark in remarks {
        shell.details(sources, &[groundstate::diagnose_remark(remark)])?;
    }
    Ok(())
}

fn line(shell: &Shell, path: &Path, tested: &Tested, passed: bool) -> String {
    let (word, color) = if passed { ("ok  ", "\x1b[32m") } else { ("FAIL", "\x1b[31m") };
    let word = if shell.color_out() { format!("{color}{word}\x1b[0m") } else { word.to_string() };
    let what = match &tested.verdict {
        None => "not run: it has faults".to_string(),
        Some(verdict) => {
            let (held, broken) = verdict.checks;
            let steps = plural(verdict.steps as usize, "step");
            let checks = match held + broken {
                0 => "nothing checked".to_string(),
                checks => plural(checks as usize, "check"),
            };
            let expected = match verdict.judgement {
                Judgement::FailedAsExpected(_) => ", failed as expected",
                _ => "",
            };
            format!("{steps}, {checks}{expected}")
        }
    };
    format!("{word} {} ({}): {what}", tested.name, path.display())
}

fn summary(shell: &mut Shell, tally: &Tally, files: usize) -> Result<Exit, Failure> {
    let not_run = files - tally.passed - tally.failed;
    if shell.json() {
        let object = Answer::Tested { passed: tally.passed, failed: tally.failed, not_run };
        shell.object(&object)?;
    } else if shell.talks() {
        if not_run > 0 {
            writeln!(shell.out(), "interrupted: {} not run", plural(not_run, "scenario"))?;
        }
        writeln!(shell.out(), "{} passed, {} failed", tally.passed, tally.failed)?;
    }
    Ok(match (tally.failed, not_run) {
        (0, 0) => Exit::Good,
        (0, _) => Exit::Unknown,
        _ => Exit::Model,
    })
}
