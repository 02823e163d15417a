//! The encoding of the inputs that an initial state keeps for its first step.
//!
//! In: which they are ([`Kept`]). Out: their fields and codes; where they have none they belong to the rest of the state.

use std::collections::{BTreeMap, BTreeSet};

use machine::{Location, Machine, Value};
use program::{FunctionId, Program};

use crate::packed::codes::Codes;
use crate::packed::encoding::{BITS, Encoding};
use crate::packed::interner::{Rest, View};
use crate::packed::kept::Kept;
use crate::packed::words::{Field, Overwrite, REST};

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
            match machine.store().find(location.function, &location.arguments) {
                Some(index) if (index as usize) < of_location.len() => {
                    by_function.entry(location.function).or_default().push((location, index));
                }
                _ => _ = in_rest.insert(location),
            }
        }
        for (function, locations) in by_function {
            let codomain = program.function(function).codomain;
            let given = initial.iter().flat_map(|state| locations.iter().map(|(_, index)| &state[*index as usize]));
            let (codes, bits) = Codes::of(program, &self.constant, machine, codomain, given, true);
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
            let found = machine.store().find(location.function, &location.arguments);
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
            field.put(self.no_input(field, view), words);
            written[field.word as usize] |= field.mask();
        }
    }

    /// What stands in the fields of kept inputs in a state that keeps none.
    pub fn without_inputs(&self, view: &mut View) -> Vec<Overwrite> {
        let without = |index: &u32| {
            let field = self.fields[*index as usize];
            let set = self.no_input(field, view) << field.shift;
            Overwrite { word: field.word, clear: field.mask(), set, from: 0, turn: 0 }
        };
        self.kept.fields.iter().map(without).collect()
    }

    /// The code that says that an input is not kept.
    fn no_input(&self, field: Field, view: &mut View) -> u64 {
        self.code(field, &Value::Undef, view).expect("a kept input has a code for none")
    }

    /// Adds the inputs of a start that have no field to the rest of its state.
    pub fn add_inputs(&self, rest: &mut Rest, inputs: &[(Location, Value)]) {
        let here = inputs.iter().filter(|(location, _)| self.kept.in_rest.contains(location));
        rest.locations.extend(here.cloned());
        rest.locations.sort_unstable();
    }
}
