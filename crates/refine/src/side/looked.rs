//! What functions of a machine are in its states: each is looked at once. States are rows, so that what one comparison looks at lies together.
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
pub(super) struct Looked {
    places: FxHashMap<(FunctionId, Vec<Value>), Place>,
    /// By number.
    told: Vec<(FunctionId, Vec<Value>)>,
    /// By state, for so many places: one more than the number of the value; 0 where nobody has looked.
    cells: Vec<u32>,
    width: usize,
    numbers: FxHashMap<Result<Value, String>, ValueId>,
    /// By number: a value, or why there is none.
    values: Vec<Result<Value, String>>,
}

impl Looked {
    /// The number of a function with arguments.
    pub fn place(&mut self, function: FunctionId, arguments: Vec<Value>) -> Place {
        let next = self.told.len() as Place;
        let Looked { places, told, .. } = self;
        let place = *places.entry((function, arguments)).or_insert_with_key(|key| {
            told.push(key.clone());
            next
        });
        if self.told.len() > self.width {
            self.widen();
        }
        place
    }

    /// Makes room for twice as many places.
    fn widen(&mut self) {
        let width = (2 * self.width).max(8);
        let mut cells = Vec::with_capacity(self.cells.len() / self.width.max(1) * width);
        for row in self.cells.chunks_exact(self.width.max(1)) {
            cells.extend_from_slice(row);
            cells.resize(cells.len() + width - row.len(), 0);
        }
        (self.cells, self.width) = (cells, width);
    }

    /// What was found of a place in a state.
    #[inline]
    pub fn get(&self, place: Place, state: StateId) -> Option<ValueId> {
        self.cells.get(state as usize * self.width + place as usize)?.checked_sub(1)
    }

    /// A place, as it was given.
    pub fn told(&self, place: Place) -> &(FunctionId, Vec<Value>) {
        &self.told[place as usize]
    }

    /// Notes what was found; there are so many states.
    pub fn note(&mut self, place: Place, state: StateId, states: usize, value: Result<Value, String>) -> ValueId {
        let next = self.values.len() as ValueId;
        let Looked { numbers, values, .. } = self;
        let number = *numbers.entry(value).or_insert_with_key(|value| {
            values.push(value.clone());
            next
        });
        if self.cells.len() < states * self.width {
            self.cells.resize(states * self.width, 0);
        }
        self.cells[state as usize * self.width + place as usize] = number + 1;
        number
    }

    /// The value of a number, or why there is none.
    pub fn value(&self, number: ValueId) -> &Result<Value, String> {
        &self.values[number as usize]
    }
}
