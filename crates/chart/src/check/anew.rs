//! What building a system anew would change in the declarations and definitions of its model.
//!
//! In: a chart with a system, the names that its imports declare, the model's text. Out: a fault for each function that building would declare
//! or define otherwise. What `system` compares as tables (elements, initial values, rules, invariants) is left to it.

use std::collections::BTreeMap;

use syntax::ast::trimmed_range;
use syntax::{Diagnostic, FileId, Span, SyntaxKind, SyntaxNode};

use super::ground::normal;
use crate::build::{Known, build};
use crate::chart::Chart;
use crate::fault;

/// What a section says of the functions of a name: how each is declared, or how each is defined.
type Said = BTreeMap<(SyntaxKind, String), Vec<(String, Span)>>;

/// The functions of which a model says something else than it would if it were built anew; `known` are the names of the chart's imports.
pub fn outdated(chart: &Chart, known: &Known, file: FileId, text: &str) -> Vec<Diagnostic> {
    let Some(system) = &chart.system else { return Vec::new() };
    // The faults of the text are told by who reads it.
    let Ok(built) = build(chart, known, Some(text)) else { return Vec::new() };
    let (there, anew) = (said(file, text), said(file, &built.text));
    let name = |(kind, name): &(SyntaxKind, String)| match kind {
        SyntaxKind::FUNCTION_DECL => format!("the declaration of `{name}`"),
        _ => format!("the definition of `{name}`"),
    };
    let mut faults = Vec::new();
    for (key, texts) in &anew {
        let known = there.get(key).map_or(&[][..], Vec::as_slice);
        if texts.iter().all(|(new, _)| known.iter().any(|(old, _)| old == new)) {
            continue;
        }
        // Of overloads, it is the one that building would no longer write so.
        let other = known.iter().find(|(old, _)| !texts.iter().any(|(new, _)| old == new));
        let message = match other {
            Some(_) => format!("{} differs from what the chart is built to", name(key)),
            None => format!("the model lacks {}", name(key)),
        };
        faults.push(fault::system_differs(system.span, message, other.map(|(_, span)| (*span, "the model's"))));
    }
    faults
}

fn said(file: FileId, text: &str) -> Said {
    let root = syntax::parse_asmetal(file, text).syntax();
    let sections =
        root.children().filter(|node| matches!(node.kind(), SyntaxKind::SIGNATURE | SyntaxKind::DEFINITIONS));
    let items = sections.flat_map(|section| section.children());
    let functions = items.filter(|item| matches!(item.kind(), SyntaxKind::FUNCTION_DECL | SyntaxKind::FUNCTION_DEF));
    let mut said = Said::new();
    for item in functions {
        if let Some(name) = named(&item) {
            let place = Span::new(file, trimmed_range(&item));
            said.entry((item.kind(), name)).or_default().push((normal(&item), place));
        }
    }
    said
}

/// The function that an item is about.
fn named(item: &SyntaxNode) -> Option<String> {
    let mut tokens = item.descendants_with_tokens().filter_map(|element| element.into_token());
    tokens.find(|token| token.kind() == SyntaxKind::FUNCTION_ID).map(|token| token.text().to_string())
}
