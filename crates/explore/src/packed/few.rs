//! Narrow fields for locations that take few of the values that they may have.
//!
//! The number of a value has 32 bits, though most locations over infinite domains only ever have a handful of values, and many
//! have one. A census of states that were found ([`crate::explorer::census`]) gives each such location just enough room;
//! its codes are then the numbers that its own [`Dictionary`] gives, from 0 on. For a value beyond the room the search
//! packs its states anew, with more of it. INVARIANT: a value of a location keeps its code, for all explorers of a search.

use hashbrown::HashMap;
use rustc_hash::FxBuildHasher;

/// LIMIT: codes of numbers below this one are found by place.
const NEAR: usize = 1 << 10;
/// A number below that has no code.
const NONE: u32 = u32::MAX;

/// The values that a location has taken, by the numbers that an interner gave them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Dictionary {
    /// By code.
    numbers: Vec<u32>,
    /// The codes of numbers below [`NEAR`], as far as one is known.
    near: Vec<u32>,
    /// Those of the others.
    far: HashMap<u32, u32, FxBuildHasher>,
}

impl Dictionary {
    /// How many values it has.
    pub fn len(&self) -> usize {
        self.numbers.len()
    }

    /// Its values, by code.
    pub fn numbers(&self) -> &[u32] {
        &self.numbers
    }

    /// The code of a value that it has.
    #[inline]
    pub fn code(&self, number: u32) -> Option<u32> {
        match self.near.get(number as usize) {
            Some(code) => (*code != NONE).then_some(*code),
            None if (number as usize) < NEAR => None,
            None => self.far.get(&number).copied(),
        }
    }

    /// The value of a code, if it has so many.
    pub fn number(&self, code: u64) -> Option<u32> {
        self.numbers.get(code as usize).copied()
    }

    /// The code of a value, a new one perhaps, if codes have so many bits.
    pub fn code_within(&mut self, number: u32, bits: u8) -> Option<u32> {
        self.code(number).or_else(|| {
            let code = self.numbers.len() as u32;
            (u64::from(code) < 1 << bits).then(|| self.add(number))
        })
    }

    /// Takes over what another has beyond it.
    pub fn renew(&mut self, other: &Dictionary) {
        for number in &other.numbers[self.numbers.len()..] {
            self.add(*number);
        }
    }

    /// Gives a value that it does not have the next code, however many there are.
    pub fn add(&mut self, number: u32) -> u32 {
        let code = self.numbers.len() as u32;
        self.numbers.push(number);
        let place = number as usize;
        if place < NEAR {
            self.near.resize(self.near.len().max(place + 1), NONE);
            self.near[place] = code;
        } else {
            self.far.insert(number, code);
        }
        code
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_given_as_long_as_there_is_room() {
        let (mut shared, mut mine) = (Dictionary::default(), Dictionary::default());
        assert_eq!(shared.code_within(7, 0), Some(0));
        assert_eq!(shared.code_within(9, 0), None);
        assert_eq!(shared.code_within(7, 0), Some(0));
        assert_eq!(shared.code_within(9, 1), Some(1));
        mine.renew(&shared);
        assert_eq!((mine.len(), mine.code(9), mine.number(0), mine.number(2)), (2, Some(1), Some(7), None));
        assert_eq!(mine.code_within(NEAR as u32 + 9, 2), Some(2));
        assert_eq!((mine.code(NEAR as u32 + 9), mine.code(8), mine.code(NEAR as u32)), (Some(2), None, None));
    }
}
