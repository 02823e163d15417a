//! Does a recorded run come out the same?
//!
//! In: a model and a trace's file. Out: an [`Answer`]: the replay of [`super::replay`], with the reasons of its
//! differences.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use model::Loader;
use program::Program;
use syntax::{Severity, Sources};

use super::accept::{refusal, refused};
use super::defect::{self, Shown};
use super::difference::{Difference, What};
use super::excuse::Excuses;
use super::job::Answer;
use super::loader::Checkout;
use super::reason;
use super::replay::{Replayed, replay};
use super::trace::{self, Trace};

/// Replays and compares. What comes out as recorded is written to the folder of scripts, if one is named.
pub fn compare(checkout: &Checkout, path: &str, file: &str, scripts: Option<&str>) -> Answer {
    let trace = std::fs::read_to_string(file).map_err(|error| error.to_string()).and_then(|text| trace::read(&text));
    let (mut trace, source) = match (trace, checkout.source(path)) {
        (Ok(trace), Ok(source)) => (trace, source),
        (Err(reason), _) | (_, Err(reason)) => return Answer::Void { why: reason },
    };
    let checked = model::check(source, &mut checkout.clone());
    if let Some(fault) = checked.diagnostics.iter().find(|diagnostic| diagnostic.severity == Severity::Error) {
        return Answer::different(refusal(fault), refused(&checked.sources, fault));
    }
    let program = match program::lower(&checked.model) {
        Ok(program) => Arc::new(program),
        Err(faults) => {
            let fault = faults.first().map(|fault| refused(&checked.sources, fault)).unwrap_or_default();
            return Answer::different(None, fault);
        }
    };
    let own = elements_of_own_library(checkout, path, &program);
    let lists_own = trace.forget_elements(&own);
    let replayed = replay(&program, &checked.sources, &trace);
    if let (Some(folder), Some(script)) = (scripts, &replayed.script)
        && let Err(why) = script.write(Path::new(folder), path, Path::new(file))
    {
        return Answer::Panic { detail: why };
    }
    match judge(&program, &checked.sources, &trace, replayed) {
        Answer::Same { .. } if lists_own => Answer::different(
            Some(reason::OWN_LIBRARY),
            "agrees except for the elements that this explains".to_string(),
        ),
        Answer::Different { mut reasons, detail } if lists_own && !reasons.is_empty() => {
            reasons.push(reason::OWN_LIBRARY.to_string());
            Answer::Different { reasons, detail }
        }
        answer => answer,
    }
}

/// Elements, with their domains, that a copy of the standard library beside the model declares and the built-in one does
/// not.
fn elements_of_own_library(checkout: &Checkout, path: &str, program: &Program) -> Vec<(String, String)> {
    let copy = checkout.source(path).and_then(|root| checkout.clone().load(&root, "StandardLibrary"));
    let Ok(copy) = copy else { return Vec::new() };
    let declared = copy.text.lines().filter_map(|line| {
        let (name, domain) = line.trim().strip_prefix("static ")?.split_once(':')?;
        Some((domain.trim().to_string(), name.trim().to_string()))
    });
    let abstracts = |name: &str| {
        program.domains.iter().any(|d| d.name == name && matches!(d.kind, program::DomainKind::Abstract { .. }))
    };
    let known = |name: &str| program.functions.iter().any(|f| f.name == name && f.element.is_some());
    declared.filter(|(domain, name)| abstracts(domain) && !known(name)).collect()
}

fn judge(program: &Arc<Program>, sources: &Sources, trace: &Trace, replayed: Replayed) -> Answer {
    if replayed.difference.is_none() && replayed.reasons.is_empty() {
        return Answer::Same { note: note(&replayed) };
    }
    let first = replayed.difference.clone();
    let Shown { mut reasons, replayed } = defect::shown(program, sources, trace, replayed);
    reasons.extend(&replayed.reasons);
    let different = |reasons: BTreeSet<&'static str>, detail: String| Answer::Different {
        reasons: reasons.iter().map(ToString::to_string).collect(),
        detail,
    };
    let agrees = || "agrees except for the values that this explains".to_string();
    let line = |difference: Option<Difference>| difference.map_or_else(agrees, |difference| difference.line());
    let Some(difference) = &replayed.difference else { return different(reasons, line(first)) };
    let found = Excuses::new(program, trace).parting(&difference.what, difference.step);
    let initial =
        difference.step <= 1 && !replayed.beyond.is_empty() && matches!(difference.what, What::Violation { .. });
    let found = found.or_else(|| initial.then_some(reason::INITIAL_INPUTS));
    let unknown =
        replayed.cut && difference.step > 1 && matches!(difference.what, What::Value { .. } | What::Written { .. });
    let found = found.or_else(|| unknown.then_some(reason::CHOICES_UNKNOWN));
    let cut = if replayed.cut { " (the search for choices was cut off)" } else { "" };
    match found {
        Some(found) => {
            reasons.insert(found);
            different(reasons, format!("{}{cut}", difference.line()))
        }
        None => Answer::different(None, format!("{}{cut}", difference.line())),
    }
}

fn note(replayed: &Replayed) -> Option<String> {
    let mut notes = Vec::new();
    if !replayed.beyond.is_empty() {
        notes.push(format!("asks for {} as well", list(&replayed.beyond)));
    }
    if replayed.renamed {
        notes.push("new elements are numbered differently".to_string());
    }
    (!notes.is_empty()).then(|| notes.join("; "))
}

fn list(names: &BTreeSet<String>) -> String {
    let few: Vec<&str> = names.iter().map(String::as_str).take(4).collect();
    let more = if names.len() > few.len() { format!(" and {} more", names.len() - few.len()) } else { String::new() };
    format!("{}{more}", few.join(", "))
}
