//! Inputs that the initial state has asked for: its first step keeps them.
//!
//! In: what each start has asked for, and which of it a step or a condition may read, too. Out: where these inputs stand in
//! packed states, besides the locations of the state. INVARIANT: they stand in initial states alone; whatever a step comes
//! to, the next state has none, so that all inputs are asked for anew. What only initial values read has no place.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use program::{Expression, FunctionId, FunctionKind, Program, RuleId, Term, TermId};

use crate::execute::Core;
use crate::explore::branches::REST;
use crate::explore::encoding::{BITS, Codes, Encoding, Field};
use crate::explore::explorer::{Explorer, Settings};
use crate::explore::interner::{Rest, View};
use crate::explore::paths::Told;
use crate::explore::sets::Bits;
use crate::location::Location;
use crate::machine::Machine;
use crate::value::Value;

/// The inputs that first steps keep.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    /// The locations that have a field; at first those that may have one.
    pub in_fields: BTreeSet<Location>,
    /// The locations that stand in the rest of the state, one that may be undef among them.
    pub in_rest: BTreeSet<Location>,
    /// The numbers of the fields.
    pub fields: Vec<u32>,
}

impl Kept {
    /// Those of these starts that a step or a condition may read.
    pub fn new<'t>(program: &Program, settings: &Settings, starts: impl Iterator<Item = &'t Told>) -> Kept {
        let (mut kept, mut read) = (Kept::default(), None);
        for (location, value) in starts.flat_map(|told| &told.inputs) {
            if !is_input(program, location) {
                continue;
            }
            let read: &BTreeSet<FunctionId> = read.get_or_insert_with(|| inputs_of_steps(program, settings));
            let into = if value.is_undef() { &mut kept.in_rest } else { &mut kept.in_fields };
            if read.contains(&location.function) && !into.contains(location) {
                into.insert(location.clone());
            }
        }
        // Where undef is a value no field could say that there is none.
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
    terms.extend(formulas.map(|formula: &Expression| formula.body));
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

impl Encoding {
    /// Gives the inputs that are kept fields, as far as they have dense locations and there is room.
    pub fn place_inputs(
        &mut self,
        program: &Program,
        machine: &mut Machine,
        initial: &[Vec<Value>],
        kept: Kept,
        of_location: &mut [u32],
    ) {
        let Kept { in_fields: wanted, mut in_rest, .. } = kept;
        let (mut in_fields, mut fields, mut used) = (BTreeSet::new(), Vec::new(), 0);
        let mut by_function: BTreeMap<FunctionId, Vec<(Location, u32)>> = BTreeMap::new();
        for location in wanted {
            match machine.core.store.find(location.function, &location.arguments) {
                Some(index) if (index as usize) < of_location.len() => {
                    by_function.entry(location.function).or_default().push((location, index));
                }
                _ => _ = in_rest.insert(location),
            }
        }
        for (function, locations) in by_function {
            let codomain = program.function(function).codomain;
            let given = initial.iter().flat_map(|state| locations.iter().map(|(_, index)| &state[*index as usize]));
            let (codes, bits) = Codes::of(program, machine, codomain, given, true);
            used += bits * locations.len();
            if used > BITS {
                in_rest.extend(locations.into_iter().map(|(location, _)| location));
                continue;
            }
            self.codes[function.0 as usize] = Some(codes);
            for (location, index) in locations {
                let field = self.add_field(index, function, bits);
                of_location[index as usize] = field;
                fields.push(field);
                in_fields.insert(location);
            }
        }
        for location in &in_rest {
            let found = machine.core.store.find(location.function, &location.arguments);
            if let Some(place) = found.and_then(|index| of_location.get_mut(index as usize)) {
                *place = REST;
            }
        }
        self.kept = Kept { in_fields, in_rest, fields };
    }

    /// Takes the inputs that are kept out of packed words; the bits that it writes are added to `written`.
    pub fn drop_inputs(&self, words: &mut [u64], written: &mut [u64], view: &mut View) {
        for index in &self.kept.fields {
            let field = self.fields[*index as usize];
            Encoding::put(field, self.no_input(field, view), words);
            written[field.word as usize] |= field.mask();
        }
    }

    /// The code that says that an input is not kept.
    fn no_input(&self, field: Field, view: &mut View) -> u32 {
        self.code(field, &Value::Undef, view).expect("a kept input has a code for none")
    }

    /// Adds the inputs of a start that have no field to the rest of its state.
    pub fn add_inputs(&self, rest: &mut Rest, told: &Told) {
        let here = told.inputs.iter().filter(|(location, _)| self.kept.in_rest.contains(location));
        rest.locations.extend(here.cloned());
        rest.locations.sort_unstable();
    }
}

impl Explorer {
    /// Gives the machine the inputs that a packed state keeps.
    pub(super) fn keep_inputs(&mut self, state: &[u64]) {
        if self.encoding.kept.is_empty() {
            return;
        }
        let Explorer { machine, encoding, view, program, .. } = self;
        let core = &mut machine.core;
        for index in &encoding.kept.fields {
            let field = encoding.fields[*index as usize];
            let value = encoding.value(field, state, view);
            if !value.is_undef() {
                core.give(field.location, field.function, value);
            }
        }
        let Some(field) = encoding.rest.filter(|_| !encoding.kept.in_rest.is_empty()) else { return };
        for (location, value) in &view.rest(encoding.fields[field as usize].code(state)).locations {
            if is_input(program, location) {
                let index = core.store.number(location.function, &location.arguments);
                core.give(index, location.function, value.clone());
            }
        }
    }

    /// Leaves out initial states whose inputs an assumption rules out: no run has them.
    pub(super) fn leave_out_starts(&mut self) {
        // Those of another explorer were left out there.
        if self.encoding.kept.is_empty() || Arc::get_mut(&mut self.starts).is_none() {
            return;
        }
        let all = Arc::clone(&self.starts);
        let mut admitted =
            all.states.iter().map(|(state, _)| self.admits_inputs(state)).collect::<Vec<_>>().into_iter();
        drop(all);
        if let Some(starts) = Arc::get_mut(&mut self.starts) {
            starts.states.retain(|_| admitted.next() == Some(true));
        }
    }

    /// Whether no assumption is false of the inputs that a state keeps; one that asks for others is not decided by these.
    fn admits_inputs(&mut self, state: &[u64]) -> bool {
        for index in 0..self.settings.step_conditions.len() {
            let (formula, assumed) = self.settings.step_conditions[index].clone();
            if !assumed {
                continue;
            }
            self.branches.first();
            self.load(state);
            let truth = self.machine.evaluate(&formula, &mut self.branches);
            if self.branches.answers().is_empty() && truth == Ok(Value::Boolean(false)) {
                return false;
            }
        }
        true
    }

    /// Which of these fields hold an input that initial states keep.
    pub fn are_inputs(&self, fields: &[Bits]) -> Vec<bool> {
        let kept: Vec<Field> =
            self.encoding.kept.fields.iter().map(|index| self.encoding.fields[*index as usize]).collect();
        let is_kept = |bits: &Bits| kept.iter().any(|field| (field.word, field.shift) == (bits.word, bits.shift));
        fields.iter().map(is_kept).collect()
    }

    /// Whether a packed state is an initial one that keeps an input.
    pub fn keeps_inputs(&mut self, state: &[u64]) -> bool {
        let Explorer { encoding, view, program, .. } = self;
        let in_fields = encoding.kept.fields.iter().any(|index| {
            let field = encoding.fields[*index as usize];
            !encoding.value(field, state, view).is_undef()
        });
        let Some(field) = encoding.rest.filter(|_| !encoding.kept.in_rest.is_empty()) else { return in_fields };
        let rest = view.rest(encoding.fields[field as usize].code(state));
        in_fields || rest.locations.iter().any(|(location, _)| is_input(program, location))
    }
}

/// Whether a location is an input.
pub(super) fn is_input(program: &Program, location: &Location) -> bool {
    program.function(location.function).kind == FunctionKind::Monitored
}

impl Core {
    /// An input that was asked for before the step.
    fn give(&mut self, index: u32, function: FunctionId, value: Value) {
        self.store.values[index as usize] = value;
        self.store.given[index as usize] = self.epoch;
        self.inputs.push((index, function));
    }
}
