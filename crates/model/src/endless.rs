//! Finds definitions that use themselves in every state, so that their evaluation never ends.
//!
//! In: the checked definitions of static and derived functions. Out: a warning for each circle of functions that
//! certainly evaluate each other. A use is certain unless it is in a branch, in the condition or body of a binder, or to the
//! right of a connective that its left side may decide. Any other recursion may end; only a run can tell.

use syntax::Span;

use crate::fault::{self, Faults};
use crate::id::FunctionId;
use crate::model::Model;
use crate::term::{Term, TermKind};

/// Warns of definitions whose evaluation never ends.
pub(crate) fn check(model: &Model, faults: &mut Faults) {
    let edges: Vec<Vec<(usize, Span)>> = model
        .functions
        .iter()
        .map(|function| {
            function.definition.as_ref().map(|definition| certain(model, &definition.body)).unwrap_or_default()
        })
        .collect();
    let mut done = vec![false; edges.len()];
    for start in 0..edges.len() {
        // Depth first with an explicit path, so that a long chain of functions needs no deep stack.
        let mut path: Vec<(usize, usize)> = vec![(start, 0)];
        while let Some((function, next)) = path.last_mut() {
            let function = *function;
            if done[function] || *next >= edges[function].len() {
                done[function] = true;
                path.pop();
                continue;
            }
            let (used, span) = edges[function][*next];
            *next += 1;
            if let Some(at) = path.iter().position(|(open, _)| *open == used) {
                let name = |index: usize| model.functions[index].name.clone();
                let mut cycle: Vec<String> = path[at..].iter().map(|(open, _)| name(*open)).collect();
                cycle.push(name(used));
                faults.push(fault::function::endless(span, &cycle, model.functions[used].span));
                // One circle through a function is enough.
                done[function] = true;
            } else if !done[used] {
                path.push((used, 0));
            }
        }
    }
}

/// The defined functions that every evaluation of a term uses, with the places.
fn certain(model: &Model, term: &Term) -> Vec<(usize, Span)> {
    let mut found = Vec::new();
    let mut open = vec![term];
    while let Some(term) = open.pop() {
        if let TermKind::Apply { function, .. } = &term.kind
            && model.function(*function).definition.is_some()
        {
            found.push((function.0 as usize, term.span));
        }
        match &term.kind {
            TermKind::Apply { function, arguments } if decided_by_left(model, *function) => {
                open.extend(arguments.first());
            }
            TermKind::If { branches, .. } => open.extend(branches.first().map(|(guard, _)| guard)),
            TermKind::Switch { subject, cases, .. } => {
                open.push(subject);
                open.extend(cases.first().map(|(case, _)| case));
            }
            TermKind::Comprehension { binders, .. } | TermKind::Quantified { binders, .. } => {
                open.extend(binders.first().map(|binder| &binder.range));
            }
            _ => term.parts(&mut |part| open.push(part)),
        }
    }
    found
}

/// A connective whose right side may not be evaluated.
fn decided_by_left(model: &Model, id: FunctionId) -> bool {
    let function = model.function(id);
    function.library && matches!(function.name.as_str(), "and" | "or" | "implies")
}
