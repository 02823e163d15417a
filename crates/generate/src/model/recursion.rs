//! Finds what depends on itself: procedures that call themselves, definitions and initial values that read themselves.
//!
//! In: a program. Out: answers for the whole program, whichever run is made. Calls of rule values and agents' programs count as
//! calls of all that may run there.

use std::collections::{BTreeMap, BTreeSet};

use program::{FunctionId, ProcedureId, Program, Runs};

use crate::model::nesting::runnable;

/// The initial values in an order in which none reads a later one, and those for which there is no such order.
pub(crate) fn initial_order(program: &Program) -> (Vec<usize>, BTreeSet<usize>) {
    let mut order = Vec::new();
    let mut cyclic = BTreeSet::new();
    let mut state = vec![0u8; program.initials.len()];
    let of: BTreeMap<FunctionId, usize> =
        program.initials.iter().enumerate().map(|(index, initial)| (initial.function, index)).collect();
    fn visit(
        program: &Program,
        of: &BTreeMap<FunctionId, usize>,
        index: usize,
        state: &mut [u8],
        order: &mut Vec<usize>,
        cyclic: &mut BTreeSet<usize>,
    ) {
        state[index] = 1;
        for read in program.all_reads(&program.initials[index].value).0 {
            let Some(next) = of.get(&read) else { continue };
            match state[*next] {
                0 => visit(program, of, *next, state, order, cyclic),
                1 => {
                    cyclic.insert(*next);
                }
                _ => {}
            }
        }
        state[index] = 2;
        order.push(index);
    }
    for index in 0..program.initials.len() {
        if state[index] == 0 && of.get(&program.initials[index].function) == Some(&index) {
            visit(program, &of, index, &mut state, &mut order, &mut cyclic);
        }
    }
    (order, cyclic)
}

/// Whether a procedure calls itself, directly or through others.
pub(crate) fn is_recursive(program: &Program, id: ProcedureId) -> bool {
    let mut entered = vec![false; program.procedures.len()];
    let mut open = vec![id];
    while let Some(next) = open.pop() {
        let mut rules = vec![program.procedure(next).body];
        while let Some(rule) = rules.pop() {
            let called = match program.rule(rule).runs() {
                Runs::Procedure(procedure) => vec![procedure],
                Runs::Value { arguments } => {
                    let fits = |id: &ProcedureId| program.procedure(*id).parameters.len() == arguments.len as usize;
                    runnable(program).filter(fits).collect()
                }
                Runs::Agent => program.agents.iter().map(|agent| agent.procedure).collect(),
                Runs::Nothing => Vec::new(),
            };
            for procedure in called {
                if procedure == id {
                    return true;
                }
                if !std::mem::replace(&mut entered[procedure.0 as usize], true) {
                    open.push(procedure);
                }
            }
            program.each_child_of_rule(rule, &mut |child| rules.push(child));
        }
    }
    false
}

/// Whether a definition reads itself, directly or through others.
pub(crate) fn reads_itself(program: &Program, id: FunctionId) -> bool {
    let mut entered = vec![false; program.functions.len()];
    let mut open: Vec<_> = program.function(id).definition.iter().map(|definition| definition.body).collect();
    while let Some(term) = open.pop() {
        if let program::Term::Define { function, .. } = program.term(term) {
            if *function == id {
                return true;
            }
            if !std::mem::replace(&mut entered[function.0 as usize], true) {
                open.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
            }
        }
        program.each_child_of_term(term, &mut |child| open.push(child));
    }
    false
}
