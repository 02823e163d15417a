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

/// What a section says of a function: how it is declared, or how it is defined.
type Said = BTreeMap<(SyntaxKind, String), (String, Span)>;

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
    for (key, (new, _)) in &anew {
        match there.get(key) {
            Some((old, _)) if old == new => {}
            Some((_, span)) => {
                let message = format!("{} differs from what the chart is built to", name(key));
                faults.push(fault::system_differs(system.span, message, Some((*span, "the model's"))));
            }
            None => {
                let message = format!("the model lacks {}", name(key));
                faults.push(fault::system_differs(system.span, message, None));
            }
        }
    }
    faults
}

fn said(file: FileId, text: &str) -> Said {
    let root = syntax::parse_asmetal(file, text).syntax();
    let sections =
        root.children().filter(|node| matches!(node.kind(), SyntaxKind::SIGNATURE | SyntaxKind::DEFINITIONS));
    let items = sections.flat_map(|section| section.children());
    let functions = items.filter(|item| matches!(item.kind(), SyntaxKind::FUNCTION_DECL | SyntaxKind::FUNCTION_DEF));
    functions
        .filter_map(|item| Some(((item.kind(), named(&item)?), (normal(&item), Span::new(file, trimmed_range(&item))))))
        .collect()
}

/// The function that an item is about.
fn named(item: &SyntaxNode) -> Option<String> {
    let mut tokens = item.descendants_with_tokens().filter_map(|element| element.into_token());
    tokens.find(|token| token.kind() == SyntaxKind::FUNCTION_ID).map(|token| token.text().to_string())
}
