//! Functions that have the same values in both machines: of each state a number for all of them.
//!
//! In: a function of both machines, the numbers of states. Out: a number for its values, as the joint model has them. INVARIANT: two states,
//! of whichever machine, have the same number exactly if the function has the same values in them; a value that the joint model does not
//! have is equal to none of the other machine.

use std::collections::BTreeMap;

use machine::Value;
use program::FunctionId;
use rustc_hash::FxHashMap;

use crate::SIDES;
use crate::coupling::{Conjunct, Coupling};
use crate::side::{Place, Side, StateId, ValueId};

/// What stands for an element without a name.
const UNNAMED: &str = "an element without a name";

/// A value that nothing of the other machine has.
fn own(side: usize, fault: &str) -> Value {
    Value::string(format!("{}: {fault}", SIDES[side]))
}

/// What a machine's value is in the joint model.
fn in_common(coupling: &Coupling, side: usize, value: &Result<Value, String>) -> Value {
    match value {
        Ok(value) => coupling.joint.bridges[side].over(value).unwrap_or_else(|| own(side, UNNAMED)),
        Err(fault) => own(side, fault),
    }
}

/// Numbers for values, as the joint model has them.
#[derive(Debug, Default)]
pub(super) struct Numbers {
    numbers: FxHashMap<Value, u32>,
    /// By side and number of a value there: one more than its number here; 0 where it was not looked up.
    over: [Vec<u32>; 2],
}

impl Numbers {
    fn number(&mut self, value: Value) -> u32 {
        let next = self.numbers.len() as u32;
        *self.numbers.entry(value).or_insert(next)
    }

    /// The number of a value that has another one in its machine.
    fn over(&mut self, coupling: &Coupling, of: &Side<'_>, side: usize, value: ValueId) -> u32 {
        let place = value as usize;
        if self.over[side].len() <= place {
            self.over[side].resize(place + 1, 0);
        }
        if let Some(known) = self.over[side][place].checked_sub(1) {
            return known;
        }
        let number = self.number(in_common(coupling, side, of.value(value)));
        self.over[side][place] = number + 1;
        number
    }
}

/// See the module.
#[derive(Debug, Default)]
pub(super) struct Same {
    /// The conjunct that says so.
    pub of: usize,
    /// By side: where the values are, if they can be listed; none at arguments that the machine does not have.
    places: [Option<Vec<Option<Place>>>; 2],
    /// By side and state: one more than the number; 0 where nobody has looked.
    signatures: [Vec<u32>; 2],
    all: FxHashMap<Vec<u32>, u32>,
}

impl Same {
    /// Of a conjunct.
    pub fn new(of: usize) -> Same {
        Same { of, ..Same::default() }
    }

    /// The number of a state.
    pub fn signature(
        &mut self,
        coupling: &Coupling,
        numbers: &mut Numbers,
        sides: &mut [Side<'_>; 2],
        side: usize,
        state: StateId,
    ) -> u32 {
        let known = self.signatures[side].get(state as usize);
        if let Some(known) = known.and_then(|known| known.checked_sub(1)) {
            return known;
        }
        let of = &mut sides[side];
        let values: Vec<u32> = match &coupling.conjuncts[self.of] {
            Conjunct::Same { functions, arguments: Some(all), .. } => {
                let places = self.places[side].get_or_insert_with(|| {
                    all.iter().map(|arguments| place(coupling, of, side, functions[side], arguments)).collect()
                });
                let number = |place: &Option<Place>| match place {
                    Some(place) => {
                        let value = of.value_at(state, *place);
                        numbers.over(coupling, of, side, value)
                    }
                    None => numbers.number(Value::Undef),
                };
                places.iter().map(number).collect()
            }
            Conjunct::Same { functions, arguments: None, .. } => {
                let located = located(coupling, of, side, functions[side], state);
                let values = located.into_iter().flat_map(|(arguments, value)| arguments.into_iter().chain([value]));
                values.map(|value| numbers.number(value)).collect()
            }
            Conjunct::Term { .. } => unreachable!("a term has no values"),
        };
        let next = self.all.len() as u32;
        let number = *self.all.entry(values).or_insert(next);
        let signatures = &mut self.signatures[side];
        if signatures.len() < of.count() {
            signatures.resize(of.count(), 0);
        }
        signatures[state as usize] = number + 1;
        number
    }
}

/// Where a machine has the value of a function at arguments of the joint model.
fn place(
    coupling: &Coupling,
    of: &mut Side<'_>,
    side: usize,
    function: FunctionId,
    arguments: &[Value],
) -> Option<Place> {
    let bridge = &coupling.joint.bridges[side];
    let there: Option<Vec<Value>> = arguments.iter().map(|value| bridge.back(value)).collect();
    there.map(|there| of.place(function, there))
}

/// The locations of a function that have a value in a state, as the joint model has them.
fn located(
    coupling: &Coupling,
    of: &mut Side<'_>,
    side: usize,
    function: FunctionId,
    state: StateId,
) -> BTreeMap<Vec<Value>, Value> {
    let bridge = &coupling.joint.bridges[side];
    let over = |(arguments, value): (Vec<Value>, Value)| {
        let arguments: Option<Vec<Value>> = arguments.iter().map(|value| bridge.over(value)).collect();
        (arguments.unwrap_or_else(|| vec![own(side, UNNAMED)]), in_common(coupling, side, &Ok(value)))
    };
    of.located(state, function).into_iter().map(over).collect()
}

/// The values of the function that a conjunct speaks of, by arguments, as the joint model has them.
pub(super) fn values(
    coupling: &Coupling,
    conjunct: usize,
    sides: &mut [Side<'_>; 2],
    side: usize,
    state: StateId,
) -> BTreeMap<Vec<Value>, Value> {
    let of = &mut sides[side];
    match &coupling.conjuncts[conjunct] {
        Conjunct::Same { functions, arguments: Some(all), .. } => {
            let value = |arguments: &Vec<Value>| {
                let value = match place(coupling, of, side, functions[side], arguments) {
                    Some(place) => {
                        let number = of.value_at(state, place);
                        in_common(coupling, side, of.value(number))
                    }
                    None => Value::Undef,
                };
                (arguments.clone(), value)
            };
            all.iter().map(value).collect()
        }
        Conjunct::Same { functions, arguments: None, .. } => located(coupling, of, side, functions[side], state),
        Conjunct::Term { .. } => BTreeMap::new(),
    }
}
