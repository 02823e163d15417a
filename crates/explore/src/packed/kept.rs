//! Inputs that the initial state has asked for: its first step keeps them.
//!
//! In: what each start has asked for, and which of it a step or a condition may read, too. Out: where these inputs stand in
//! packed states, besides the locations of the state. INVARIANT: they stand in initial states alone; whatever a step comes
//! to, the next state has none, so that all inputs are asked for anew. What only initial values read has no place.

use std::collections::BTreeSet;

use machine::{Location, Value};
use program::{FunctionId, FunctionKind, Program, RuleId, Term, TermId};

use crate::settings::Settings;

/// The inputs that first steps keep.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Kept {
    /// The locations that have a field; at first those that may have one.
    pub in_fields: BTreeSet<Location>,
    /// The locations that stand in the rest of the state, one that may be undef among them.
    pub in_rest: BTreeSet<Location>,
    /// The numbers of the fields.
    pub fields: Vec<u32>,
}

impl Kept {
    /// Those of these that a step or a condition may read.
    pub fn new(program: &Program, settings: &Settings, inputs: &[(Location, Value)]) -> Kept {
        let (mut kept, mut read) = (Kept::default(), None);
        for (location, value) in inputs {
            if !is_input(program, location) {
                continue;
            }
            let read: &BTreeSet<FunctionId> = read.get_or_insert_with(|| inputs_of_steps(program, settings));
            let into = if value.is_undef() { &mut kept.in_rest } else { &mut kept.in_fields };
            if read.contains(&location.function) && !into.contains(location) {
                into.insert(location.clone());
            }
        }
        // If undef is a value, a field could not say that there is none.
        kept.in_fields.retain(|location| !kept.in_rest.contains(location));
        kept
    }

    /// Whether nothing is kept.
    pub fn is_empty(&self) -> bool {
        self.in_fields.is_empty() && self.in_rest.is_empty()
    }

    /// The functions of which some location stands in the rest.
    pub fn functions_in_rest(&self) -> BTreeSet<FunctionId> {
        self.in_rest.iter().map(|location| location.function).collect()
    }
}

/// The monitored functions that a rule reads, or a condition.
fn inputs_of_steps(program: &Program, settings: &Settings) -> BTreeSet<FunctionId> {
    let mut terms: Vec<TermId> = Vec::new();
    let mut rules: Vec<RuleId> = program.procedures.iter().map(|procedure| procedure.body).collect();
    while let Some(rule) = rules.pop() {
        program.each_child_of_rule(rule, &mut |child| rules.push(child));
        program.each_term_of_rule(rule, &mut |term| terms.push(term));
    }
    let formulas = settings.conditions.iter().chain(settings.step_conditions.iter().map(|(formula, _)| formula));
    let formulas = formulas.chain(&settings.read_in_steps);
    terms.extend(formulas.map(|formula| formula.body));
    let mut entered = vec![false; program.functions.len()];
    let mut seen = vec![false; program.terms.len()];
    let mut found = BTreeSet::new();
    while let Some(term) = terms.pop() {
        if std::mem::replace(&mut seen[term.0 as usize], true) {
            continue;
        }
        if let Term::Read { function, .. } | Term::Define { function, .. } = program.term(term) {
            if program.function(*function).kind == FunctionKind::Monitored {
                found.insert(*function);
            }
            if !std::mem::replace(&mut entered[function.0 as usize], true) {
                terms.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
            }
        }
        program.each_child_of_term(term, &mut |child| terms.push(child));
    }
    found
}

/// Whether a location is an input.
pub(crate) fn is_input(program: &Program, location: &Location) -> bool {
    program.function(location.function).kind == FunctionKind::Monitored
}
