//! Finds the functions whose definedness a condition tests, including in definitions.

use std::collections::BTreeSet;

use model::Literal;
use program::{Builtin, Expression, FunctionId, Program, Term, TermId};

/// How deeply definitions are expanded to find the functions that a value may come from.
const DEPTH: usize = 16;

/// The functions under `isDef`, `isUndef` or compared with undef.
pub(super) fn tested(program: &Program, condition: &Expression) -> BTreeSet<FunctionId> {
    let mut found = BTreeSet::new();
    let (mut open, mut entered) = (vec![condition.body], BTreeSet::new());
    let undef = |id: &TermId| match program.term(*id) {
        Term::Constant(index) => program.constants[*index as usize] == Literal::Undef,
        _ => false,
    };
    while let Some(id) = open.pop() {
        match program.term(id) {
            Term::Builtin { builtin: Builtin::IsDef | Builtin::IsUndef, arguments } => {
                program.term_list(*arguments).iter().for_each(|term| read(program, *term, &mut found, 0));
            }
            Term::Builtin { builtin: Builtin::Eq | Builtin::Neq, arguments } => {
                let operands = program.term_list(*arguments);
                if operands.iter().any(undef) {
                    operands.iter().for_each(|term| read(program, *term, &mut found, 0));
                }
            }
            Term::Switch { subject, cases, .. } if program.term_list(*cases).iter().step_by(2).any(undef) => {
                read(program, *subject, &mut found, 0);
            }
            Term::Define { function, .. } if entered.insert(*function) => {
                open.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
            }
            _ => {}
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    found
}

/// The functions that a term's value may come from.
fn read(program: &Program, id: TermId, found: &mut BTreeSet<FunctionId>, depth: usize) {
    if depth > DEPTH {
        return;
    }
    match program.term(id) {
        Term::Read { function, .. } => _ = found.insert(*function),
        Term::Missing(function) => _ = found.insert(*function),
        Term::Define { function, .. } => {
            if let Some(definition) = &program.function(*function).definition {
                read(program, definition.body, found, depth + 1);
            }
        }
        Term::If { branches, otherwise } => {
            let values = program.term_list(*branches).iter().skip(1).step_by(2).chain(otherwise);
            values.for_each(|value| read(program, *value, found, depth + 1));
        }
        Term::Switch { cases, otherwise, .. } => {
            let values = program.term_list(*cases).iter().skip(1).step_by(2).chain(otherwise);
            values.for_each(|value| read(program, *value, found, depth + 1));
        }
        Term::Let { body, .. } => read(program, *body, found, depth + 1),
        Term::Coerce(operand) => read(program, *operand, found, depth + 1),
        _ => {}
    }
}
