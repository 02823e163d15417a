//! What functions of a machine are in its states: each is looked at once.
//!
//! In: a function with its arguments, and what it is in a state. Out: the number of that value. INVARIANT: equal numbers mean equal values,
//! or equal faults.

use machine::Value;
use program::FunctionId;
use rustc_hash::FxHashMap;

use super::StateId;

/// A function with its arguments, as a number.
pub(crate) type Place = u32;
/// What a function is in a state, as a number.
pub(crate) type ValueId = u32;

/// See the module.
#[derive(Default)]
pub(super) struct Columns {
    places: FxHashMap<(FunctionId, Vec<Value>), Place>,
    /// By number.
    told: Vec<(FunctionId, Vec<Value>)>,
    /// By place and state: one more than the number of the value; 0 where nobody has looked.
    columns: Vec<Vec<u32>>,
    numbers: FxHashMap<Result<Value, String>, ValueId>,
    /// By number: a value, or why there is none.
    values: Vec<Result<Value, String>>,
}

impl Columns {
    /// The number of a function with arguments.
    pub fn place(&mut self, function: FunctionId, arguments: Vec<Value>) -> Place {
        let next = self.told.len() as Place;
        let Columns { places, told, columns, .. } = self;
        *places.entry((function, arguments)).or_insert_with_key(|key| {
            told.push(key.clone());
            columns.push(Vec::new());
            next
        })
    }

    /// What was found of a place in a state.
    pub fn get(&self, place: Place, state: StateId) -> Option<ValueId> {
        self.columns[place as usize].get(state as usize)?.checked_sub(1)
    }

    /// A place, as it was given.
    pub fn told(&self, place: Place) -> &(FunctionId, Vec<Value>) {
        &self.told[place as usize]
    }

    /// Notes what was found; there are so many states.
    pub fn note(&mut self, place: Place, state: StateId, states: usize, value: Result<Value, String>) -> ValueId {
        let next = self.values.len() as ValueId;
        let Columns { numbers, values, .. } = self;
        let number = *numbers.entry(value).or_insert_with_key(|value| {
            values.push(value.clone());
            next
        });
        let column = &mut self.columns[place as usize];
        if column.len() < states {
            column.resize(states, 0);
        }
        column[state as usize] = number + 1;
        number
    }

    /// The value of a number, or why there is none.
    pub fn value(&self, number: ValueId) -> &Result<Value, String> {
        &self.values[number as usize]
    }
}
