//! Which functions a condition asks whether they are defined, definitions included.

use std::collections::BTreeSet;

use model::{FunctionId, Literal, Model, Term, TermKind};

/// The functions under `isDef`, `isUndef` or compared with undef.
pub(super) fn tested(model: &Model, condition: &Term) -> BTreeSet<FunctionId> {
    let mut found = BTreeSet::new();
    visit(model, condition, &mut found, &mut BTreeSet::new());
    found
}

fn visit(model: &Model, term: &Term, found: &mut BTreeSet<FunctionId>, seen: &mut BTreeSet<FunctionId>) {
    term.walk(&mut |term| match &term.kind {
        TermKind::Apply { function, arguments } => {
            let declared = model.function(*function);
            let undef = |term: &Term| matches!(term.kind, TermKind::Literal(Literal::Undef));
            let asks = match declared.name.as_str() {
                "isDef" | "isUndef" => true,
                "eq" | "neq" => arguments.iter().any(undef),
                _ => false,
            };
            if declared.library && asks {
                arguments.iter().for_each(|argument| read(model, argument, found));
            }
            if let Some(definition) = declared.definition.as_ref().filter(|_| seen.insert(*function)) {
                visit(model, &definition.body, found, seen);
            }
        }
        TermKind::Switch { subject, cases, .. } => {
            let undef = |(case, _): &(Term, Term)| matches!(case.kind, TermKind::Literal(Literal::Undef));
            if cases.iter().any(undef) {
                read(model, subject, found);
            }
        }
        _ => {}
    });
}

/// The functions whose value a term may be.
fn read(model: &Model, term: &Term, found: &mut BTreeSet<FunctionId>) {
    match &term.kind {
        TermKind::Apply { function, .. } => {
            if let Some(definition) = &model.function(*function).definition {
                read_in(model, &definition.body, found, 0);
            }
            found.insert(*function);
        }
        _ => read_in(model, term, found, 0),
    }
}

fn read_in(model: &Model, term: &Term, found: &mut BTreeSet<FunctionId>, depth: usize) {
    if depth > 16 {
        return;
    }
    match &term.kind {
        TermKind::Apply { function, .. } => {
            found.insert(*function);
            if let Some(definition) = &model.function(*function).definition {
                read_in(model, &definition.body, found, depth + 1);
            }
        }
        TermKind::If { branches, otherwise } => {
            let values = branches.iter().map(|(_, value)| value).chain(otherwise.as_deref());
            values.for_each(|value| read_in(model, value, found, depth + 1));
        }
        TermKind::Switch { cases, otherwise, .. } => {
            let values = cases.iter().map(|(_, value)| value).chain(otherwise.as_deref());
            values.for_each(|value| read_in(model, value, found, depth + 1));
        }
        TermKind::Let { body, .. } => read_in(model, body, found, depth + 1),
        _ => {}
    }
}
