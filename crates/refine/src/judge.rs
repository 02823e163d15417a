//! Decides whether two states correspond.
//!
//! In: a coupling, the numbers of two states. Out: whether the relation holds of them, and if not, which parts fail. Terms are evaluated
//! by a machine of the joint model that asks the two sides for the values of their functions. INVARIANT: a part that is undefined or
//! cannot be evaluated does not hold.

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Choice, Environment, Limits, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Expression, FunctionId, Program, Slot, TermId};
use rustc_hash::FxHashMap;

use crate::coupling::{Conjunct, Coupling};
use crate::joint::Joint;
use crate::side::{Side, StateId};
use crate::{ABSTRACT, CONCRETE, SIDES};

/// What was read while a term was evaluated: the side, the function, its arguments, the value, all as the joint model has them.
pub(crate) type Read = (usize, FunctionId, Vec<Value>, Value);

/// The value of a variable.
pub(crate) type Bound = (Slot, Value);

/// Decides pairs of states.
pub(crate) struct Judge<'c> {
    pub coupling: &'c Coupling,
    machine: Machine,
    known: FxHashMap<(StateId, StateId), bool>,
    /// By conjunct, side and state: the number of its values.
    signatures: FxHashMap<(usize, usize, StateId), u32>,
    numbers: FxHashMap<Vec<(Vec<Value>, Value)>, u32>,
    /// Whether the relation was false of some pair.
    pub distinguishes: bool,
}

struct Both<'s> {
    joint: &'s Joint,
    sides: &'s mut [Side; 2],
    states: [StateId; 2],
    reads: Vec<Read>,
}

impl Environment for Both<'_> {
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
                let side_of = &mut self.sides[side];
                let read = side_of.read(self.states[side], function, &arguments);
                let program = Arc::clone(&side_of.program);
                let value = read.map_err(|fault| fault.show(&program).to_string())?;
                bridge.over(&value).ok_or("an element without a name, which the other machine does not have")?
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
        Judge {
            coupling,
            machine,
            known: FxHashMap::default(),
            signatures: FxHashMap::default(),
            numbers: FxHashMap::default(),
            distinguishes: false,
        }
    }

    /// Whether two states correspond.
    pub fn coupled(&mut self, sides: &mut [Side; 2], states: [StateId; 2]) -> bool {
        if let Some(known) = self.known.get(&(states[ABSTRACT], states[CONCRETE])) {
            return *known;
        }
        let holds = (0..self.coupling.conjuncts.len()).all(|index| self.holds(sides, index, states));
        self.distinguishes |= !holds;
        self.known.insert((states[ABSTRACT], states[CONCRETE]), holds);
        holds
    }

    /// The parts of the relation that do not hold of two states.
    pub fn failing(&mut self, sides: &mut [Side; 2], states: [StateId; 2]) -> Vec<usize> {
        (0..self.coupling.conjuncts.len()).filter(|index| !self.holds(sides, *index, states)).collect()
    }

    fn holds(&mut self, sides: &mut [Side; 2], index: usize, states: [StateId; 2]) -> bool {
        match &self.coupling.conjuncts[index] {
            Conjunct::Same { .. } => {
                let number = |judge: &mut Self, side: usize, sides: &mut [Side; 2]| {
                    judge.signature(sides, index, side, states[side])
                };
                number(self, ABSTRACT, sides) == number(self, CONCRETE, sides)
            }
            Conjunct::Term { formula, .. } => self.evaluate(sides, formula, states).0 == Ok(Value::Boolean(true)),
        }
    }

    /// The value of a term over two states, and what it read.
    pub fn evaluate(
        &mut self,
        sides: &mut [Side; 2],
        formula: &Expression,
        states: [StateId; 2],
    ) -> (Result<Value, String>, Vec<Read>) {
        self.evaluate_with(sides, (formula.body, formula.frame), &[], states)
    }

    /// The same of a part of a term, in a frame of so many slots, some of which have values.
    pub fn evaluate_with(
        &mut self,
        sides: &mut [Side; 2],
        (term, frame): (TermId, u32),
        bound: &[Bound],
        states: [StateId; 2],
    ) -> (Result<Value, String>, Vec<Read>) {
        self.machine.forget_inputs();
        let joint = &self.coupling.joint;
        let mut both = Both { joint, sides, states, reads: Vec::new() };
        let value = self.machine.evaluate_with(term, frame, bound, &mut both);
        (value.map_err(|fault| fault.show(&joint.program).to_string()), both.reads)
    }

    /// The elements of a domain of the joint model, if they can be listed.
    pub fn elements(&mut self, domain: DomainId) -> Option<Vec<Value>> {
        self.machine.elements(domain).ok()
    }

    /// The variant of two states, if there is one and it has a value there.
    fn variant(&mut self, sides: &mut [Side; 2], states: [StateId; 2]) -> Option<i64> {
        let (_, formula) = self.coupling.variant.as_ref()?;
        match self.evaluate(sides, formula, states).0 {
            Ok(Value::Integer(number)) => Some(number),
            _ => None,
        }
    }

    /// Whether a diagram without an abstract step may lead from one pair of states to another: the variant, if the coupling has one,
    /// is not negative and decreases.
    pub fn descends(&mut self, sides: &mut [Side; 2], from: [StateId; 2], to: [StateId; 2]) -> bool {
        if self.coupling.variant.is_none() {
            return true;
        }
        let (before, after) = (self.variant(sides, from), self.variant(sides, to));
        before.zip(after).is_some_and(|(before, after)| before >= 0 && after < before)
    }

    /// What the variant is before and after such a diagram.
    pub fn descent(&mut self, sides: &mut [Side; 2], from: [StateId; 2], to: [StateId; 2]) -> [String; 2] {
        [from, to].map(|states| self.variant(sides, states).map_or("undef".to_string(), |number| number.to_string()))
    }

    /// Whether a segment ends in a concrete state.
    pub fn ends(&mut self, sides: &mut [Side; 2], state: StateId) -> bool {
        let Some(formula) = &self.coupling.segment else { return true };
        self.evaluate(sides, formula, [0, state]).0 == Ok(Value::Boolean(true))
    }

    /// Whether each concrete state is either the end of a segment or none: whether it is true or false there.
    pub fn marks_clearly(&mut self, sides: &mut [Side; 2]) -> bool {
        let Some(formula) = &self.coupling.segment else { return true };
        (0..sides[CONCRETE].count() as StateId)
            .all(|state| matches!(self.evaluate(sides, formula, [0, state]).0, Ok(Value::Boolean(_))))
    }

    /// The values of a function that is to be the same, as the joint model has them.
    fn values(&mut self, sides: &mut [Side; 2], index: usize, side: usize, state: StateId) -> Vec<(Vec<Value>, Value)> {
        let Conjunct::Same { functions, arguments, .. } = &self.coupling.conjuncts[index] else { return Vec::new() };
        let bridge = &self.coupling.joint.bridges[side];
        // Nothing of the other machine has this value.
        let own = |fault: &str| Value::string(format!("{}: {fault}", SIDES[side]));
        match arguments {
            Some(all) => {
                let value = |arguments: &Vec<Value>| {
                    let there: Option<Vec<Value>> = arguments.iter().map(|value| bridge.back(value)).collect();
                    let Some(there) = there else { return (arguments.clone(), Value::Undef) };
                    let value = match sides[side].read(state, functions[side], &there) {
                        Ok(value) => bridge.over(&value).unwrap_or_else(|| own("an element without a name")),
                        Err(fault) => own(&fault.show(&sides[side].program).to_string()),
                    };
                    (arguments.clone(), value)
                };
                all.iter().map(value).collect()
            }
            None => {
                let located = sides[side].located(state, functions[side]);
                let over = |(arguments, value): (Vec<Value>, Value)| {
                    let arguments: Option<Vec<Value>> = arguments.iter().map(|value| bridge.over(value)).collect();
                    let value = bridge.over(&value).unwrap_or_else(|| own("an element without a name"));
                    (arguments.unwrap_or_else(|| vec![own("an element without a name")]), value)
                };
                let all: BTreeMap<Vec<Value>, Value> = located.into_iter().map(over).collect();
                all.into_iter().collect()
            }
        }
    }

    /// The same by arguments.
    pub fn values_of(
        &mut self,
        sides: &mut [Side; 2],
        index: usize,
        side: usize,
        state: StateId,
    ) -> BTreeMap<Vec<Value>, Value> {
        self.values(sides, index, side, state).into_iter().collect()
    }

    fn signature(&mut self, sides: &mut [Side; 2], index: usize, side: usize, state: StateId) -> u32 {
        if let Some(known) = self.signatures.get(&(index, side, state)) {
            return *known;
        }
        let values = self.values(sides, index, side, state);
        let next = self.numbers.len() as u32;
        let number = *self.numbers.entry(values).or_insert(next);
        self.signatures.insert((index, side, state), number);
        number
    }
}
