//! `groundstate test PATH…`: scenarios, one line each, failures in detail, a summary.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use groundstate::scenario::{FirstCandidate, Judgement, Options, Story};
use groundstate::{SeededChoices, Suite, Tested};
use program::Program;
use syntax::{Diagnostic, Severity};
use wire::{Answer, Fault, ScenarioResult};

use crate::check::plural;
use crate::coverage;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{collect, write_text};
use crate::inputs::Chosen;
use crate::interrupt;
use crate::junit::Junit;
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
    /// Which candidate a choose rule takes where no pick says so
    #[arg(long, value_enum, default_value_t = Chosen::Random, value_name = "HOW")]
    choose: Chosen,
    /// Seed of random choices
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Steps after which a `step until` without `within` fails
    #[arg(long, value_name = "N", default_value_t = Options::default().bound)]
    until_bound: u64,
}

/// How many scenarios did what.
#[derive(Debug, Default)]
struct Tally {
    passed: usize,
    failed: usize,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let files = collect(&arguments.paths, &["avalla"])?;
    interrupt::listen();
    let mut suite = Suite::new();
    let mut tally = Tally::default();
    let mut junit = Junit::default();
    let mut seen = BTreeSet::new();
    for path in &files {
        if interrupt::asked() {
            break;
        }
        let tested = test_one(shell, arguments, &mut suite, path)?;
        if interrupt::asked() && !passed(&tested) {
            break;
        }
        let failures = failures(&tested);
        if passed(&tested) {
            tally.passed += 1
        } else {
            tally.failed += 1
        }
        junit.case(path, &tested, &failures);
        report(shell, path, &tested, &failures, &mut seen)?;
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

fn test_one(shell: &Shell, arguments: &Arguments, suite: &mut Suite, path: &Path) -> Result<Tested, Failure> {
    if path.extension().is_some_and(|extension| extension == "asm") {
        return Err(crate::load::another(path, "model", "`groundstate run` runs models; scenarios are .avalla files"));
    }
    let mut disk = shell.disk();
    let source = disk.root(path)?;
    let limits = shell.global.limits.machine();
    let options = Options { limits, bound: arguments.until_bound, coverage: arguments.coverage, story: arguments.runs };
    Ok(match arguments.choose {
        Chosen::First => suite.test(source, &mut disk, options, &mut FirstCandidate),
        Chosen::Random => suite.test(source, &mut disk, options, &mut SeededChoices::new(arguments.seed)),
    })
}

fn passed(tested: &Tested) -> bool {
    tested.verdict.as_ref().is_some_and(|verdict| verdict.passed())
}

/// What is wrong with a scenario that did not pass.
fn failures(tested: &Tested) -> Vec<Diagnostic> {
    let (Some(verdict), Some(program)) = (&tested.verdict, &tested.program) else {
        let errors = tested.diagnostics.iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
        return errors.cloned().collect();
    };
    verdict.failures().iter().flat_map(|failure| groundstate::diagnose_failure(failure, program)).collect()
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
        let told = story(tested).map(|(program, story)| crate::story::object(program, story));
        return shell.object(&ScenarioResult::new(path.display().to_string(), tested, faults, told));
    }
    let passed = passed(tested);
    if shell.talks() {
        let line = line(shell, path, tested, passed);
        writeln!(shell.out(), "{line}")?;
    }
    if let Some((program, story)) = story(tested).filter(|_| shell.talks()) {
        crate::story::tell(shell, program, story)?;
    }
    // Many scenarios load one model; the faults that keep it from running are shown with the first. What went wrong in a
    // run is that scenario's own reason, however many others have the same.
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

/// The run of a scenario that failed, where it was kept.
fn story(tested: &Tested) -> Option<(&Program, &Story)> {
    let verdict = tested.verdict.as_ref().filter(|verdict| !verdict.passed())?;
    Some((tested.program.as_deref()?, verdict.story.as_ref()?))
}

fn line(shell: &Shell, path: &Path, tested: &Tested, passed: bool) -> String {
    let (word, color) = if passed { ("ok  ", "\x1b[32m") } else { ("FAIL", "\x1b[31m") };
    let word = if shell.color_out() { format!("{color}{word}\x1b[0m") } else { word.to_string() };
    let what = match &tested.verdict {
        None => "not run: it has faults".to_string(),
        Some(verdict) => {
            let (held, broken) = verdict.checks;
            let steps = plural(verdict.steps as usize, "step");
            let checks = plural((held + broken) as usize, "check");
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
