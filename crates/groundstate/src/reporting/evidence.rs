//! What scenarios contribute to a report: their verdicts, and what they covered of the model.
//!
//! A thing is covered if any scenario, of any model, executed it at the same place of the same file. So the tests of a
//! module count for every model that imports it.

use std::collections::BTreeMap;

use report::{Coverage, Measure, Scenario, Verdict};
use scenario::{Items, Judgement};
use syntax::{Severity, Sources, Span};

use crate::{Suite, Tested, diagnose_failure};

/// The result of a scenario, as the report shows it; `file` is its path.
pub fn reported_scenario(file: String, tested: &Tested) -> Scenario {
    let (held, broken) = tested.verdict.as_ref().map_or((0, 0), |verdict| verdict.checks);
    let verdict = match tested.verdict.as_ref().map(|verdict| &verdict.judgement) {
        Some(Judgement::Passed) => Verdict::Passed,
        Some(Judgement::FailedAsExpected(_)) => Verdict::FailedAsExpected,
        _ => Verdict::Failed(why(tested)),
    };
    Scenario {
        name: tested.name.clone(),
        file,
        steps: tested.verdict.as_ref().map_or(0, |verdict| verdict.steps),
        checks: held + broken,
        verdict,
    }
}

/// The first fault, and its place.
fn why(tested: &Tested) -> String {
    let failures = match (&tested.verdict, &tested.program) {
        (Some(verdict), Some(program)) => {
            verdict.failures().iter().flat_map(|failure| diagnose_failure(failure, program)).collect()
        }
        _ => tested.diagnostics.clone(),
    };
    let first = failures.iter().find(|found| found.severity == Severity::Error).or(failures.first());
    first
        .map_or_else(String::new, |found| format!("{}: {}", tested.sources.position(found.primary.span), found.message))
}

/// A thing in a text, whichever model it was read for.
type Thing = (String, u32, u32, &'static str);

fn thing(sources: &Sources, span: Span, what: &'static str) -> Thing {
    (sources.file(span.file).name.clone(), span.start, span.end, what)
}

/// What the scenarios covered of the model whose file name `is_reported` accepts; `scenarios` is how many ran.
pub fn reported_coverage(suite: &Suite, is_reported: &dyn Fn(&str) -> bool, scenarios: usize) -> Option<Coverage> {
    let mut anywhere: BTreeMap<Thing, bool> = BTreeMap::new();
    let mut own: Option<(&Sources, Items)> = None;
    for (name, sources, items) in suite.coverage() {
        for (thing, covered) in things(sources, &items) {
            *anywhere.entry(thing).or_default() |= covered;
        }
        if is_reported(name) {
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
    let ending = if scenarios == 1 { "" } else { "s" };
    let scope = format!("What {scenarios} scenario{ending} executed of the model and the modules it imports.");
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
