//! Lists in words what scenarios did not cover of a model.
//!
//! In: the things to cover. Out: those that were not covered, each with its place.

use scenario::{Forall, Item, Items};
use syntax::{Sources, Span};

/// Something that no scenario covered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Uncovered<'a> {
    /// Which part of the rule.
    pub what: String,
    /// The rule.
    pub rule: &'a str,
    /// Its place.
    pub span: Span,
}

/// What was not covered, in the order of the texts. Parts of a rule that never ran are left out.
pub fn uncovered<'a>(sources: &Sources, items: &'a Items) -> Vec<Uncovered<'a>> {
    let missing = |rule: &'a str, what: String, span: Span| Uncovered { what, rule, span };
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
    // The parts of a rule that never ran say nothing more.
    let place = |rule: &'a str, span: Span| (rule, span.file);
    let dead = items.rules.iter().filter(|item| !item.covered).map(|item| place(&item.rule, item.span));
    let dead: Vec<_> = dead.collect();
    all.retain(|missing| missing.what == "the whole" || !dead.contains(&place(missing.rule, missing.span)));
    all.sort_by_key(|missing| missing.span);
    all
}

fn one_line(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    let line = words.join(" ");
    if line.chars().count() > 60 { format!("{}…", line.chars().take(60).collect::<String>()) } else { line }
}
