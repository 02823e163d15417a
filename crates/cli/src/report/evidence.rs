//! What scenarios add to a report: their verdicts, and what they covered of the model.
//!
//! A thing is covered when any scenario, of whatever model, executed it at the same place of the same file: the
//! tests of a module count for every model that imports it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ::report::{Coverage, Measure, Report, Scenario, Verdict};
use groundstate::scenario::{Items, Judgement, Options};
use groundstate::{SeededChoices, Suite, Tested};
use syntax::{Severity, Sources, Span};

use crate::check::plural;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::collect;
use crate::interrupt;
use crate::progress::Progress;
use crate::shell::Shell;

/// Runs the scenarios below these paths as `test` does, and adds what they show.
pub fn add(shell: &Shell, report: &mut Report, model: &Path, paths: &[PathBuf], seed: u64) -> Result<Exit, Failure> {
    if paths.is_empty() {
        return Ok(Exit::Good);
    }
    let files = collect(paths, &["avalla"])?;
    let mut suite = Suite::new();
    let options = Options { limits: shell.global.limits.uninterrupted(), coverage: true, ..Options::default() };
    let mut progress = Progress::new(Some(files.len() as u64), shell.global.quiet);
    for (index, path) in files.iter().enumerate() {
        if interrupt::asked() {
            return Ok(Exit::Unknown);
        }
        let mut disk = shell.disk();
        let source = disk.root(path)?;
        let tested = suite.test(source, &mut disk, options, &mut SeededChoices::new(seed));
        report.scenarios.push(scenario(path, &tested));
        progress.at(index as u64 + 1);
    }
    progress.done();
    report.coverage = coverage(&suite, model, files.len());
    Ok(if report.passed() == files.len() { Exit::Good } else { Exit::Model })
}

fn scenario(path: &Path, tested: &Tested) -> Scenario {
    let (held, broken) = tested.verdict.as_ref().map_or((0, 0), |verdict| verdict.checks);
    let verdict = match tested.verdict.as_ref().map(|verdict| &verdict.judgement) {
        Some(Judgement::Passed) => Verdict::Passed,
        Some(Judgement::FailedAsExpected(_)) => Verdict::FailedAsExpected,
        _ => Verdict::Failed(why(tested)),
    };
    Scenario {
        name: tested.name.clone(),
        file: path.display().to_string(),
        steps: tested.verdict.as_ref().map_or(0, |verdict| verdict.steps),
        checks: held + broken,
        verdict,
    }
}

/// The first thing that is wrong, and where.
fn why(tested: &Tested) -> String {
    let failures = match (&tested.verdict, &tested.program) {
        (Some(verdict), Some(program)) => {
            verdict.failures().iter().flat_map(|failure| groundstate::diagnose_failure(failure, program)).collect()
        }
        _ => tested.diagnostics.clone(),
    };
    let first = failures.iter().find(|found| found.severity == Severity::Error).or(failures.first());
    first
        .map_or_else(String::new, |found| format!("{}: {}", tested.sources.position(found.primary.span), found.message))
}

/// A thing in a text, whatever model it was read for.
type Thing = (String, u32, u32, &'static str);

fn thing(sources: &Sources, span: Span, what: &'static str) -> Thing {
    (sources.file(span.file).name.clone(), span.start, span.end, what)
}

fn coverage(suite: &Suite, model: &Path, scenarios: usize) -> Option<Coverage> {
    let mut anywhere: BTreeMap<Thing, bool> = BTreeMap::new();
    let mut own: Option<(&Sources, Items)> = None;
    for (name, sources, items) in suite.coverage() {
        for (thing, covered) in things(sources, &items) {
            *anywhere.entry(thing).or_default() |= covered;
        }
        if same(Path::new(name), model) {
            own = Some((sources, items));
        }
    }
    let (sources, items) = own?;
    let covered = |span: Span, what| anywhere.get(&thing(sources, span, what)).copied().unwrap_or(false);
    let mut measures: Vec<Measure> = Vec::new();
    for (what, all) in [("rules", &items.rules), ("branches", &items.branches), ("updates", &items.updates)] {
        let mut measure = Measure { what: what.to_string(), total: all.len() as u64, ..Measure::default() };
        for item in all {
            if covered(item.span, item.what) {
                measure.covered += 1;
            } else {
                let name =
                    if item.what == "rule" { item.rule.clone() } else { format!("{} in {}", item.what, item.rule) };
                measure.missed.push((name, sources.position(item.span).to_string()));
            }
        }
        measures.push(measure);
    }
    measures.push(foralls(sources, &items, &covered));
    let scope = format!("What {} executed of the model and the modules it imports.", plural(scenarios, "scenario"));
    Some(Coverage { scope, measures })
}

const ELEMENTS: [&str; 3] = ["no element", "one element", "many elements"];

fn things(sources: &Sources, items: &Items) -> Vec<(Thing, bool)> {
    let single = items.rules.iter().chain(&items.branches).chain(&items.updates);
    let mut all: Vec<_> = single.map(|item| (thing(sources, item.span, item.what), item.covered)).collect();
    for forall in &items.foralls {
        all.extend(ELEMENTS.into_iter().zip(forall.seen).map(|(what, seen)| (thing(sources, forall.span, what), seen)));
    }
    all
}

fn foralls(sources: &Sources, items: &Items, covered: &dyn Fn(Span, &'static str) -> bool) -> Measure {
    let mut measure = Measure { what: "sizes of forall".to_string(), ..Measure::default() };
    for (forall, what) in items.foralls.iter().flat_map(|forall| ELEMENTS.map(|what| (forall, what))) {
        measure.total += 1;
        if covered(forall.span, what) {
            measure.covered += 1;
        } else {
            let name = format!("forall with {what} in {}", forall.rule);
            measure.missed.push((name, sources.position(forall.span).to_string()));
        }
    }
    measure
}

/// Whether two paths lead to one file.
fn same(one: &Path, other: &Path) -> bool {
    let whole = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    whole(one) == whole(other)
}
