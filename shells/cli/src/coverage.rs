//! What scenarios covered of a model, as text and JSON.

use std::io::Write;

use groundstate::scenario::{Forall, Item, Items};
use serde::Serialize;
use syntax::{Sources, Span};
use wire::Place;

use crate::failure::Failure;
use crate::shell::Shell;

/// Writes the coverage of one model.
pub fn report(shell: &mut Shell, model: &str, sources: &Sources, items: &Items) -> Result<(), Failure> {
    let uncovered = uncovered(sources, items);
    if shell.json() {
        let totals =
            items.totals().map(|(kind, coverage)| Total { kind, covered: coverage.covered, total: coverage.total });
        let object = Object { r#type: "coverage", model, totals, uncovered };
        return shell.object(&object);
    }
    if !shell.talks() {
        return Ok(());
    }
    writeln!(shell.out(), "\ncoverage of {model}")?;
    for (kind, coverage) in items.totals() {
        let (covered, total) = (coverage.covered, coverage.total);
        if let Some(percent) = (100 * covered).checked_div(total) {
            writeln!(shell.out(), "  {kind:<9} {covered:>4} of {total:<4} {percent:>3} %")?;
        }
    }
    if !uncovered.is_empty() {
        writeln!(shell.out(), "not covered")?;
        for missing in &uncovered {
            let at = sources.position(missing.span);
            writeln!(shell.out(), "  {at}: {} of {}", missing.what, missing.rule)?;
        }
    }
    Ok(())
}

#[derive(Serialize)]
struct Object<'a> {
    r#type: &'static str,
    model: &'a str,
    totals: [Total; 4],
    uncovered: Vec<Uncovered<'a>>,
}

#[derive(Serialize)]
struct Total {
    kind: &'static str,
    covered: usize,
    total: usize,
}

#[derive(Serialize)]
struct Uncovered<'a> {
    what: String,
    rule: &'a str,
    #[serde(flatten)]
    place: Place,
    #[serde(skip)]
    span: Span,
}

fn uncovered<'a>(sources: &Sources, items: &'a Items) -> Vec<Uncovered<'a>> {
    let missing =
        |rule: &'a str, what: String, span: Span| Uncovered { what, rule, place: Place::new(sources, span), span };
    let item = |item: &'a Item| {
        let what = match item.what {
            "rule" => "the whole".to_string(),
            "update" => format!("`{}`", one_line(sources.text(item.span))),
            branch => format!("branch `{branch}`"),
        };
        missing(&item.rule, what, item.span)
    };
    let single = items.rules.iter().chain(&items.branches).chain(&items.updates);
    let mut all: Vec<Uncovered<'a>> = single.filter(|item| !item.covered).map(item).collect();
    all.extend(items.foralls.iter().filter_map(|forall: &Forall| {
        let never: Vec<&str> = ["no element", "one element", "many elements"]
            .into_iter()
            .zip(forall.seen)
            .filter(|(_, seen)| !seen)
            .map(|(word, _)| word)
            .collect();
        (!never.is_empty()).then(|| missing(&forall.rule, format!("forall with {}", never.join(" or ")), forall.span))
    }));
    // What lies in a rule that never ran at all says nothing more.
    let dead: Vec<&str> = items.rules.iter().filter(|item| !item.covered).map(|item| item.rule.as_str()).collect();
    all.retain(|missing| missing.what == "the whole" || !dead.contains(&missing.rule));
    all.sort_by_key(|missing| missing.span);
    all
}

fn one_line(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    let line = words.join(" ");
    if line.chars().count() > 60 { format!("{}…", line.chars().take(60).collect::<String>()) } else { line }
}
