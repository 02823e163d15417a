//! Invariants, scenarios, coverage, and the facts of the run.

use crate::html::section;
use crate::markup::{Px, Text, put};
use crate::report::{Fact, Measure, Report, Scenario, Verdict};
use crate::time::count;

/// Writes the invariants.
pub(super) fn invariants(out: &mut String, report: &Report) {
    if report.invariants.is_empty() {
        return;
    }
    let lead = format!("Evaluated in every one of the {} states.", count(report.steps() + 1));
    section(out, "invariants", "Invariants", &lead);
    out.push_str("<ul class=\"checks\">\n");
    for invariant in &report.invariants {
        let (class, mark, what) = match &invariant.violated {
            None => ("good", '\u{2713}', "held".to_owned()),
            Some(place) => ("bad", '\u{2717}', format!("violated: {place}")),
        };
        put!(
            out,
            "<li class=\"{class}\"><span class=\"mark\" aria-hidden=\"true\">{mark}</span><b>{}</b> <span>{}</span> <small>{}</small></li>\n",
            Text(&invariant.name),
            Text(what),
            Text(&invariant.position)
        );
    }
    out.push_str("</ul>\n</section>\n");
}

/// Writes the scenarios: those that failed first.
pub(super) fn scenarios(out: &mut String, report: &Report) {
    if report.scenarios.is_empty() {
        return;
    }
    let caught = report.scenarios.iter().filter(|s| s.verdict == Verdict::FailedAsExpected).count();
    let mut lead = format!("{} of {} ended as they should.", report.passed(), report.scenarios.len());
    if caught > 0 {
        put!(lead, " {caught} of them had to fail, and did: a seeded fault was caught.");
    }
    section(out, "scenarios", "Scenarios", &lead);
    let failed: Vec<&Scenario> = report.scenarios.iter().filter(|s| matches!(s.verdict, Verdict::Failed(_))).collect();
    scenario_list(out, "", &failed);
    let good = report.scenarios.iter().filter(|scenario| !matches!(scenario.verdict, Verdict::Failed(_)));
    let folders = by_folder(good.collect());
    for (folder, scenarios) in &folders {
        scenario_list(out, if folders.len() > 1 { folder } else { "" }, scenarios);
    }
    out.push_str("</section>\n");
}

/// Fewer scenarios than this in a folder are listed under the folder above it.
const FEW: usize = 3;

fn by_folder(scenarios: Vec<&Scenario>) -> Vec<(&str, Vec<&Scenario>)> {
    let above = |path: &'_ str| path.rfind('/').unwrap_or(0);
    let folder = |scenario: &Scenario| above(&scenario.file);
    let mut folders: Vec<(&str, Vec<&Scenario>)> = Vec::new();
    for scenario in &scenarios {
        let own = &scenario.file[..folder(scenario)];
        let many = scenarios.iter().filter(|other| &other.file[..folder(other)] == own).count() >= FEW;
        let name = if many { own } else { &own[..above(own)] };
        match folders.iter_mut().find(|(known, _)| *known == name) {
            Some((_, listed)) => listed.push(scenario),
            None => folders.push((name, vec![scenario])),
        }
    }
    folders
}

fn scenario_list(out: &mut String, folder: &str, scenarios: &[&Scenario]) {
    if scenarios.is_empty() {
        return;
    }
    if !folder.is_empty() {
        put!(out, "<h3>{}</h3>\n", Text(folder));
    }
    out.push_str("<ul class=\"checks columns\">\n");
    scenarios.iter().for_each(|scenario| scenario_item(out, scenario));
    out.push_str("</ul>\n");
}

fn scenario_item(out: &mut String, scenario: &Scenario) {
    let (class, mark, what) = match &scenario.verdict {
        Verdict::Passed => ("good", '\u{2713}', ""),
        Verdict::FailedAsExpected => ("good", '\u{2713}', "fault caught"),
        Verdict::Failed(why) => ("bad", '\u{2717}', why.as_str()),
    };
    put!(
        out,
        "<li class=\"{class}\"><span class=\"mark\" aria-hidden=\"true\">{mark}</span><b title=\"{}\">{}</b> ",
        Text(&scenario.file),
        Text(&scenario.name)
    );
    if !what.is_empty() {
        put!(out, "<span>{}</span> ", Text(what));
    }
    let (checks, steps) = (counted(scenario.checks, "check"), counted(scenario.steps, "step"));
    put!(out, "<small>{checks}, {steps}</small></li>\n");
}

fn counted(number: u64, what: &str) -> String {
    format!("{} {what}{}", count(number), if number == 1 { "" } else { "s" })
}

/// Writes what was executed and what was not.
pub(super) fn coverage(out: &mut String, report: &Report) {
    let Some(coverage) = &report.coverage else { return };
    section(out, "coverage", "Coverage", &coverage.scope);
    for measure in coverage.measures.iter().filter(|measure| measure.total > 0) {
        bar(out, measure);
    }
    out.push_str("</section>\n");
}

fn bar(out: &mut String, measure: &Measure) {
    let part = 320.0 * measure.percent() / 100.0;
    put!(out, "<div class=\"measure\"><h3>{}</h3>", Text(&measure.what));
    put!(
        out,
        "<svg class=\"bar\" viewBox=\"0 0 320 12\" width=\"320\" height=\"12\" role=\"img\"><title>{:.1} % covered</title><rect class=\"rail\" y=\"2\" width=\"320\" height=\"8\"/><rect class=\"read\" y=\"2\" width=\"{}\" height=\"8\"/></svg>",
        measure.percent(),
        Px(part)
    );
    put!(out, "<p>{} of {}, {:.1}\u{202f}%</p>", count(measure.covered), count(measure.total), measure.percent());
    if measure.missed.is_empty() {
        out.push_str("</div>\n");
        return;
    }
    put!(out, "<details><summary>{} not covered</summary><ul class=\"missed\">\n", count(measure.missed.len() as u64));
    for (name, position) in &measure.missed {
        put!(out, "<li><code>{}</code> <small>{}</small></li>\n", Text(name), Text(position));
    }
    out.push_str("</ul></details></div>\n");
}

/// Writes the facts of the run.
pub(super) fn facts(out: &mut String, report: &Report) {
    list_facts(out, &report.facts);
}

/// Writes facts; none: nothing.
pub(super) fn list_facts(out: &mut String, facts: &[Fact]) {
    if facts.is_empty() {
        return;
    }
    section(out, "facts", "The run", "");
    out.push_str("<dl class=\"facts\">\n");
    for fact in facts {
        put!(out, "<div><dt>{}</dt><dd>{}</dd></div>\n", Text(&fact.label), Text(&fact.value));
    }
    out.push_str("</dl>\n</section>\n");
}
