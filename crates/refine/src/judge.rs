//! Decides whether two states correspond.
//!
//! In: a coupling, the numbers of two states. Out: whether the relation holds of them, and if not, which parts fail. Terms are evaluated
//! by a machine of the joint model that asks the two sides for the values of their functions; what they came to is remembered by what they
//! looked at. INVARIANT: a part that is undefined or cannot be evaluated does not hold.

mod parts;
mod remembered;
mod same;

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Choice, Environment, Limits, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Expression, FunctionId, Program, Slot, TermId};

use crate::coupling::Coupling;
use crate::joint::Joint;
use crate::side::{Side, StateId};
use crate::{ABSTRACT, CONCRETE};
use parts::{Part, TermPart};
use remembered::{Look, Remembered};
use same::Numbers;

/// What was read while a term was evaluated: the side, the function, its arguments, the value, all as the joint model has them.
pub(crate) type Read = (usize, FunctionId, Vec<Value>, Value);

/// The value of a variable.
pub(crate) type Bound = (Slot, Value);

/// Decides pairs of states.
pub(crate) struct Judge<'c> {
    pub coupling: &'c Coupling,
    machine: Machine,
    /// The relation: all of them hold.
    parts: Vec<Part>,
    /// The one that failed last: of the next states it is asked first.
    failed: usize,
    /// Where a segment ends.
    segment: Remembered,
    numbers: Numbers,
    /// Whether the relation was false of some pair.
    pub distinguishes: bool,
}

struct Both<'s, 'c> {
    joint: &'s Joint,
    sides: &'s mut [Side<'c>; 2],
    states: [StateId; 2],
    reads: Vec<Read>,
    looks: Vec<Look>,
}

impl Environment for Both<'_, '_> {
    fn monitored(&mut self, _: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        let Some((side, function)) = self.joint.of.get(&location.function).copied() else {
            return Err("a function of neither machine".to_string());
        };
        let bridge = &self.joint.bridges[side];
        let there: Option<Vec<Value>> = location.arguments.iter().map(|value| bridge.back(value)).collect();
        // What the side does not have as an argument has no value there.
        let value = match there {
            None => Value::Undef,
            Some(arguments) => {
                let of = &mut self.sides[side];
                let place = of.place(function, arguments);
                let number = of.value_at(self.states[side], place);
                self.looks.push((side, place, number));
                let value = of.value(number).as_ref().map_err(String::clone)?;
                bridge.over(value).ok_or("an element without a name, which the other machine does not have")?
            }
        };
        self.reads.push((side, location.function, location.arguments.to_vec(), value.clone()));
        Ok(value)
    }

    fn choose(&mut self, _: &Program, _: &Choice<'_>) -> Result<usize, String> {
        Err("a coupling does not choose".to_string())
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Err("a coupling does not read the clock".to_string())
    }
}

impl<'c> Judge<'c> {
    pub fn new(coupling: &'c Coupling, limits: &Limits) -> Judge<'c> {
        let mut machine = Machine::new(Arc::new(coupling.joint.program.clone()), limits.clone());
        machine.ignore_interrupts();
        // Nothing in the joint model has an initial value.
        let _ = machine.start(&mut machine::Closed);
        let parts = parts::parts(coupling, &mut machine);
        Judge {
            coupling,
            machine,
            parts,
            failed: 0,
            segment: Remembered::default(),
            numbers: Numbers::default(),
            distinguishes: false,
        }
    }

    /// Whether two states correspond.
    pub fn coupled(&mut self, sides: &mut [Side<'_>; 2], states: [StateId; 2]) -> bool {
        let count = self.parts.len();
        let holds = (0..count).all(|index| {
            let index = (self.failed + index) % count;
            let holds = self.holds(sides, index, states);
            if !holds {
                self.failed = index;
            }
            holds
        });
        self.distinguishes |= !holds;
        holds
    }

    /// The conjuncts of the relation that do not hold of two states.
    pub fn failing(&mut self, sides: &mut [Side<'_>; 2], states: [StateId; 2]) -> Vec<usize> {
        let failing: Vec<usize> = (0..self.parts.len()).filter(|index| !self.holds(sides, *index, states)).collect();
        let mut of: Vec<usize> = failing.iter().map(|index| self.parts[*index].of()).collect();
        of.dedup();
        of
    }

    /// Whether a part of the relation holds.
    fn holds(&mut self, sides: &mut [Side<'_>; 2], index: usize, states: [StateId; 2]) -> bool {
        let Judge { coupling, parts, numbers, .. } = self;
        let part = match &mut parts[index] {
            Part::Same(same) => {
                let mut signature = |side: usize| same.signature(coupling, numbers, sides, side, states[side]);
                return signature(ABSTRACT) == signature(CONCRETE);
            }
            Part::Term(part) => part,
        };
        if let Some(known) = part.known.truth(sides, states) {
            return known;
        }
        let (term, bound) = (part.term, part.bound.clone());
        let (value, _, looks) = self.looked(sides, term, &bound, states);
        let holds = value == Ok(Value::Boolean(true));
        if let Part::Term(TermPart { known, .. }) = &mut self.parts[index] {
            known.add(&looks, holds);
        }
        holds
    }

    /// The value of a term over two states, and what it read.
    pub fn evaluate(
        &mut self,
        sides: &mut [Side<'_>; 2],
        formula: &Expression,
        states: [StateId; 2],
    ) -> (Result<Value, String>, Vec<Read>) {
        self.evaluate_with(sides, (formula.body, formula.frame), &[], states)
    }

    /// The same of a part of a term, in a frame of so many slots, some of which have values.
    pub fn evaluate_with(
        &mut self,
        sides: &mut [Side<'_>; 2],
        (term, frame): (TermId, u32),
        bound: &[Bound],
        states: [StateId; 2],
    ) -> (Result<Value, String>, Vec<Read>) {
        let (value, reads, _) = self.looked(sides, (term, frame), bound, states);
        (value, reads)
    }

    fn looked(
        &mut self,
        sides: &mut [Side<'_>; 2],
        (term, frame): (TermId, u32),
        bound: &[Bound],
        states: [StateId; 2],
    ) -> (Result<Value, String>, Vec<Read>, Vec<Look>) {
        self.machine.forget_inputs();
        let joint = &self.coupling.joint;
        let mut both = Both { joint, sides, states, reads: Vec::new(), looks: Vec::new() };
        let value = self.machine.evaluate_with(term, frame, bound, &mut both);
        (value.map_err(|fault| fault.show(&joint.program).to_string()), both.reads, both.looks)
    }

    /// The elements of a domain of the joint model, if they can be listed.
    pub fn elements(&mut self, domain: DomainId) -> Option<Vec<Value>> {
        self.machine.elements(domain).ok()
    }

    /// The variant of two states, if there is one and it has a value there.
    fn variant(&mut self, sides: &mut [Side<'_>; 2], states: [StateId; 2]) -> Option<i64> {
        let (_, formula) = self.coupling.variant.as_ref()?;
        match self.evaluate(sides, formula, states).0 {
            Ok(Value::Integer(number)) => Some(number),
            _ => None,
        }
    }

    /// Whether a diagram without an abstract step may lead from one pair of states to another: the variant, if the coupling has one,
    /// is not negative and decreases.
    pub fn descends(&mut self, sides: &mut [Side<'_>; 2], from: [StateId; 2], to: [StateId; 2]) -> bool {
        if self.coupling.variant.is_none() {
            return true;
        }
        let (before, after) = (self.variant(sides, from), self.variant(sides, to));
        before.zip(after).is_some_and(|(before, after)| before >= 0 && after < before)
    }

    /// What the variant is before and after such a diagram.
    pub fn descent(&mut self, sides: &mut [Side<'_>; 2], from: [StateId; 2], to: [StateId; 2]) -> [String; 2] {
        [from, to].map(|states| self.variant(sides, states).map_or("undef".to_string(), |number| number.to_string()))
    }

    /// Whether a segment ends in a concrete state.
    pub fn ends(&mut self, sides: &mut [Side<'_>; 2], state: StateId) -> bool {
        let Some(formula) = &self.coupling.segment else { return true };
        if let Some(known) = self.segment.truth(sides, [0, state]) {
            return known;
        }
        let (value, _, looks) = self.looked(sides, (formula.body, formula.frame), &[], [0, state]);
        let ends = value == Ok(Value::Boolean(true));
        self.segment.add(&looks, ends);
        ends
    }

    /// Whether each concrete state is either the end of a segment or none: whether it is true or false there.
    pub fn marks_clearly(&mut self, sides: &mut [Side<'_>; 2]) -> bool {
        let Some(formula) = &self.coupling.segment else { return true };
        (0..sides[CONCRETE].count() as StateId)
            .all(|state| matches!(self.evaluate(sides, formula, [0, state]).0, Ok(Value::Boolean(_))))
    }

    /// The values of a function that is to be the same, by arguments, as the joint model has them.
    pub fn values_of(
        &mut self,
        sides: &mut [Side<'_>; 2],
        conjunct: usize,
        side: usize,
        state: StateId,
    ) -> BTreeMap<Vec<Value>, Value> {
        same::values(self.coupling, conjunct, sides, side, state)
    }
}
