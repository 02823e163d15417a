//! Which functions are never undef, at any of their numbered locations, in any state that the machine can reach.
//!
//! In: a program and a started core. Out: a truth value a function; where it is true, compiled code reads no tag.
//! A function is *total* if it has an initial value everywhere and every rule that updates it writes a value that is
//! certainly defined. INVARIANT: whoever sets a location to undef from outside throws the compiled code away
//! ([`crate::Machine::set`]), and the machine makes none that relies on this again.

use program::{Builtin, FunctionId, FunctionKind, Program, Rule, Term, TermId};

use crate::execute::Core;
use crate::value::Value;

/// By function, whether it is total.
pub(super) fn total_functions(program: &Program, core: &Core) -> Vec<bool> {
    let mut total: Vec<bool> = (0..program.functions.len()).map(|index| starts_total(program, core, index)).collect();
    // What a rule writes may depend on another function's being total: the greatest solution is looked for.
    loop {
        let mut refuted = Vec::new();
        for initial in &program.initials {
            if !is_defined(program, core, &total, initial.value.body) {
                refuted.push(initial.function);
            }
        }
        for rule in &program.rules {
            match rule {
                Rule::Update { function, value, .. } if !is_defined(program, core, &total, *value) => {
                    refuted.push(*function);
                }
                Rule::Return { function, .. } => refuted.push(*function),
                Rule::Skip
                | Rule::Update { .. }
                | Rule::Call { .. }
                | Rule::TurboCall { .. }
                | Rule::RunValue { .. }
                | Rule::RunAgent { .. }
                | Rule::Par(_)
                | Rule::Seq(_)
                | Rule::If { .. }
                | Rule::Switch { .. }
                | Rule::Let { .. }
                | Rule::Choose { .. }
                | Rule::Forall { .. }
                | Rule::Extend { .. }
                | Rule::Iterate(_)
                | Rule::While { .. }
                | Rule::RecursiveWhile { .. }
                | Rule::Local { .. } => {}
            }
        }
        let before = total.iter().filter(|total| **total).count();
        for function in refuted {
            total[function.0 as usize] = false;
        }
        if total.iter().filter(|total| **total).count() == before {
            return total;
        }
    }
}

/// Whether a function has a value at each of its numbered locations now, and an initial value at all.
fn starts_total(program: &Program, core: &Core, index: usize) -> bool {
    let function = FunctionId(index as u32);
    matches!(program.function(function).kind, FunctionKind::Controlled | FunctionKind::Out)
        && !core.unset
        && !core.elsewhere.may_be_undef(function)
        && core.plain[index]
        && core.initials[index].is_some()
        && Some(function) != program.self_function
        && core.store.indices_of(function).iter().all(|location| {
            !core.store.values[*location as usize].is_undef() && core.store.given[*location as usize] != 0
        })
}

/// Whether a term has a value other than undef wherever it has one at all.
fn is_defined(program: &Program, core: &Core, total: &[bool], id: TermId) -> bool {
    let defined = |id: &TermId| is_defined(program, core, total, *id);
    match program.term(id) {
        Term::Constant(index) => core.constants[*index as usize] != Value::Undef,
        Term::Read { function, arguments } => {
            let element = program.function(*function).element.is_some();
            element || (arguments.len == 0 && total[function.0 as usize])
        }
        Term::Builtin { builtin, arguments } => match builtin {
            Builtin::Eq | Builtin::Neq | Builtin::IsDef | Builtin::IsUndef => true,
            Builtin::And | Builtin::Or | Builtin::Not => program.term_list(*arguments).iter().all(defined),
            Builtin::Lt | Builtin::Le | Builtin::Gt | Builtin::Ge => program.term_list(*arguments).iter().all(defined),
            Builtin::IntNeg | Builtin::IntAdd | Builtin::IntSub | Builtin::IntMul | Builtin::IntMod => {
                program.term_list(*arguments).iter().all(defined)
            }
            _ => false,
        },
        Term::If { branches, otherwise: Some(otherwise) } => {
            program.term_list(*branches).iter().chain([otherwise]).all(defined)
        }
        _ => false,
    }
}
