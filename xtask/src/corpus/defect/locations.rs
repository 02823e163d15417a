//! Defects of the peer in reading locations, put into copies of a program: inputs asked for again within a step, initial
//! values evaluated when a location is first read.
//!
//! In: a program, the trace and the difference that is looked into. Out: copies, each with the defect at another place.
//! A second answer of the environment is the value of a *twin*: a function of the same name and place.

use std::collections::{BTreeMap, BTreeSet};

use program::{Builtin, Function, FunctionId, FunctionKind, Program, Term, TermId};

use super::super::difference::Difference;
use super::super::trace::{Step, Trace};
use super::graft::Graft;

/// The function is the twin of another, whose value is the environment's last answer in the step, not its first.
pub fn is_twin(program: &Program, function: FunctionId) -> bool {
    let this = program.function(function);
    let before = &program.functions[..function.0 as usize];
    before.iter().any(|other| other.span == this.span && other.name == this.name)
}

/// Inputs of the step that have several values in the record are read as last recorded: at one place, or at all of them.
pub fn asked_again(program: &Program, trace: &Trace, difference: &Difference) -> Vec<Program> {
    let step = difference.step.checked_sub(1).and_then(|index| trace.steps.get(index));
    let names = step.map(several).unwrap_or_default();
    let reads: Vec<(TermId, FunctionId)> = reads(program, &|id, function| {
        matches!(function.kind, FunctionKind::Monitored | FunctionKind::Shared)
            && names.contains(function.name.as_str())
            && !is_twin(program, id)
    });
    let all = [reads.as_slice()].into_iter().filter(|_| reads.len() != 1);
    let places = reads.iter().map(std::slice::from_ref).chain(all);
    places.flat_map(|places| read_as_twins(program, places)).collect()
}

fn read_as_twins(program: &Program, places: &[(TermId, FunctionId)]) -> Vec<Program> {
    let mut graft = Graft::of(program);
    for (place, function) in places {
        let of = program.function(*function);
        let known = graft.program.functions.iter().rposition(|other| other.span == of.span && other.name == of.name);
        let twin = match known.map(|index| FunctionId(index as u32)).filter(|known| known != function) {
            Some(twin) => twin,
            None => graft.function(of.clone()),
        };
        let Term::Read { arguments, .. } = *program.term(*place) else { continue };
        graft.replace(*place, |_, _| Term::Read { function: twin, arguments });
    }
    graft.done()
}

/// The functions of which the step has a location with several values.
fn several(step: &Step) -> BTreeSet<&str> {
    let mut first: BTreeMap<&str, &str> = BTreeMap::new();
    let again =
        step.inputs.iter().filter(|(location, value)| *first.entry(location).or_insert(value) != value.as_str());
    again.filter_map(|(location, _)| location.split('(').next()).collect()
}

/// The initial value of one function is evaluated anew wherever its location has none yet.
pub fn lazy_initial(program: &Program, _: &Trace, _: &Difference) -> Vec<Program> {
    let mut copies = Vec::new();
    for (index, initial) in program.initials.iter().enumerate() {
        let places = reads(program, &|id, _| id == initial.function);
        if places.is_empty() || program.reads(&initial.value).is_some_and(|reads| reads.is_empty()) {
            continue;
        }
        let mut graft = Graft::of(program);
        let value = Function {
            name: format!("initial {}", program.function(initial.function).name),
            kind: FunctionKind::Derived,
            definition: Some(initial.value.clone()),
            ..program.function(initial.function).clone()
        };
        let value = graft.function(value);
        for (place, _) in places {
            let Term::Read { arguments, .. } = *program.term(place) else { continue };
            graft.replace(place, |graft, read| {
                let defined = graft.builtin(Builtin::IsDef, &[read], place);
                let initial = graft.term(Term::Define { function: value, arguments }, place);
                Term::If { branches: graft.terms(&[defined, read]), otherwise: Some(initial) }
            });
        }
        graft.change(|program| drop(program.initials.remove(index)));
        copies.extend(graft.done());
    }
    copies
}

fn reads(program: &Program, wanted: &dyn Fn(FunctionId, &Function) -> bool) -> Vec<(TermId, FunctionId)> {
    let terms = program.terms.iter().enumerate();
    terms
        .filter_map(|(index, term)| match term {
            Term::Read { function, .. } if wanted(*function, program.function(*function)) => {
                Some((TermId(index as u32), *function))
            }
            _ => None,
        })
        .collect()
}
