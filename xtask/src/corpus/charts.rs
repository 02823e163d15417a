//! In how many models of the corpus a control-state chart is found.
//!
//! In: a checkout. Out: `spec/charts-found.md`: counts, and for each model with a candidate and no chart the reason. A
//! candidate is a rule that sets a location over an enum to a literal or undef.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use model::{DomainKind, Literal, Model, RuleKind, Target, TermKind};
use syntax::Severity;

use super::loader::Checkout;
use crate::Failure;

/// What is found in one model.
enum Found {
    /// It has errors.
    Faulty,
    /// No rule sets a location over an enum to a literal.
    NoCandidate,
    /// Machines, so many.
    Charts(usize),
    /// Candidates, and why they are no machines.
    None(Vec<(String, String)>),
}

/// The page about all models of a checkout.
///
/// # Errors
/// A folder cannot be read.
pub fn page(checkout: &Path) -> Result<String, Failure> {
    let mut files = Vec::new();
    collect(checkout, checkout, &mut files)?;
    files.sort();
    let mut checkout = Checkout { root: checkout.to_path_buf() };
    let (mut faulty, mut without, mut with, mut machines) = (0, 0, 0, 0);
    let mut reasons: BTreeMap<String, usize> = BTreeMap::new();
    let mut rows = String::new();
    for file in &files {
        match found(&mut checkout, file)? {
            Found::Faulty => faulty += 1,
            Found::NoCandidate => without += 1,
            Found::Charts(count) => {
                with += 1;
                machines += count;
            }
            Found::None(rules) => {
                let Some((rule, reason)) = rules.first() else { continue };
                let _ = writeln!(rows, "| {file} | `{rule}` | {reason} |");
                *reasons.entry(reason.clone()).or_default() += 1;
            }
        }
    }
    let none: usize = reasons.values().sum();
    let mut out = format!(
        "# Charts found in the public corpus\n\nWritten by `make corpus CORPUS=path`. `groundstate chart extract` was \
         run on each of the {} models, without naming a control location.\n\n| | models |\n| --- | --- |\n\
         | with errors | {faulty} |\n| no rule sets a location over an enum to a literal or undef | {without} |\n\
         | a chart is found | {with}, with {machines} machines |\n| no chart is found | {none} |\n",
        files.len()
    );
    out.push_str("\n## Where no chart is found\n\nThe reason for the first rule of each model:\n\n| reason | models |\n| --- | --- |\n");
    for (reason, count) in &reasons {
        let _ = writeln!(out, "| {reason} | {count} |");
    }
    let _ = write!(out, "\n| model | first rule | reason |\n| --- | --- | --- |\n{rows}");
    Ok(out)
}

fn collect(root: &Path, folder: &Path, files: &mut Vec<String>) -> Result<(), Failure> {
    let wrap = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in std::fs::read_dir(folder).map_err(wrap)? {
        let path = entry.map_err(wrap)?.path();
        if path.is_dir() && !path.is_symlink() {
            collect(root, &path, files)?;
        } else if path.extension().is_some_and(|ending| ending == "asm") {
            files.extend(path.strip_prefix(root).ok().map(|path| path.display().to_string()));
        }
    }
    Ok(())
}

fn found(checkout: &mut Checkout, file: &str) -> Result<Found, Failure> {
    let source = checkout.source(file)?;
    let checked = model::check(source, checkout);
    if checked.diagnostics.iter().any(|found| found.severity == Severity::Error) {
        return Ok(Found::Faulty);
    }
    let model = &checked.model;
    let extracted = chart::extract(model, None, None);
    if !extracted.chart.machines.is_empty() {
        return Ok(Found::Charts(extracted.chart.machines.len()));
    }
    let mut rules = extracted.others;
    for (index, rule) in model.rules.iter().enumerate() {
        let own = rule.span.file == model.root && !rules.iter().any(|(name, _)| *name == rule.name);
        if own && sets_literal(model, index) {
            rules.push((rule.name.clone(), "what it does depends on no such location".to_string()));
        }
    }
    Ok(if rules.is_empty() { Found::NoCandidate } else { Found::None(rules) })
}

/// A rule itself sets a location over an enum to a literal or undef.
fn sets_literal(model: &Model, rule: usize) -> bool {
    let mut sets = false;
    model.rules[rule].body.walk(&mut |rule| {
        if let RuleKind::Update { target: Target::Location { function, .. }, value } = &rule.kind {
            let over_enum = matches!(model.domains.kind(model.function(*function).codomain), DomainKind::Enum { .. });
            sets |= over_enum && matches!(value.kind, TermKind::Literal(Literal::Enum(..) | Literal::Undef));
        }
    });
    sets
}
