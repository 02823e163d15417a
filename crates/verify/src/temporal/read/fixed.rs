//! Finds terms that have the same value in every state.

use machine::{Closed, Machine, Show, Value};
use program::{DomainId, FunctionKind, Program, Slot, Term, TermId};

/// Whether a term's value depends only on the values of its variables.
pub fn is_fixed(program: &Program, term: TermId) -> bool {
    let constant = std::cell::LazyCell::new(|| program.constant_domains());
    // Formulas are read before any run starts.
    let is_known = |domain: DomainId| constant[domain.0 as usize] && !program.waits_for_start(domain);
    let mut entered = vec![false; program.functions.len()];
    let mut open = vec![term];
    while let Some(id) = open.pop() {
        match program.term(id) {
            Term::Read { function, .. } | Term::Define { function, .. } => {
                let declared = program.function(*function);
                if !matches!(declared.kind, FunctionKind::Static | FunctionKind::Derived) {
                    return false;
                }
                if !std::mem::replace(&mut entered[function.0 as usize], true) {
                    open.extend(declared.definition.as_ref().map(|definition| definition.body));
                }
            }
            Term::Domain(domain) if !is_known(*domain) => return false,
            Term::Builtin { builtin, .. } if !builtin.info().effect.is_none() => return false,
            Term::Constant(_)
            | Term::Slot(_)
            | Term::Builtin { .. }
            | Term::Domain(_)
            | Term::Tuple(_)
            | Term::Project { .. }
            | Term::Collection { .. }
            | Term::Range { .. }
            | Term::Comprehension { .. }
            | Term::Quantified { .. }
            | Term::If { .. }
            | Term::Switch { .. }
            | Term::Let { .. }
            | Term::Rule(_)
            | Term::Unbound
            | Term::Missing(_)
            | Term::Coerce(_) => {}
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    true
}

/// The elements of a fixed range, in canonical order.
///
/// # Errors
/// A sentence: the elements cannot be enumerated.
pub fn elements(
    machine: &mut Machine,
    range: TermId,
    frame: u32,
    bindings: &[(Slot, Value)],
) -> Result<Vec<Value>, String> {
    let program = std::sync::Arc::clone(machine.program());
    let sentence = |fault: machine::Fault| fault.show(&program).to_string();
    if let Term::Domain(domain) = program.term(range) {
        return machine.elements(*domain).map_err(sentence);
    }
    let value = machine.evaluate_with(range, frame, bindings, &mut Closed).map_err(sentence)?;
    Ok(match value {
        Value::Set(elements) | Value::Seq(elements) => elements.to_vec(),
        Value::Bag(elements) => elements.keys().cloned().collect(),
        other => return Err(format!("{} is no collection", other.show(&program))),
    })
}
