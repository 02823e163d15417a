//! The words of a packed state: where a field stands in them, and what a step overwrites.

use program::FunctionId;

/// A location that no field holds belongs to the rest.
pub(crate) const REST: u32 = u32::MAX - 1;
/// A location that is no part of the state between steps.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// Where a field stands in the words of a packed state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Bits {
    /// In which word.
    pub word: u32,
    /// From which bit on, the lowest is 0.
    pub shift: u8,
    /// How many.
    pub bits: u8,
}

/// Bits of one word that a step sets, whatever they were, or that become what others of them were.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Overwrite {
    /// In which word.
    pub word: u32,
    /// How far to the right bits move.
    pub turn: u8,
    /// Which bits.
    pub clear: u64,
    /// Those of them that become ones.
    pub set: u64,
    /// Those of them that move.
    pub from: u64,
}

impl Overwrite {
    /// What a word is after it.
    #[inline(always)]
    pub fn of(&self, word: u64) -> u64 {
        word & !self.clear | self.set | (word & self.from).rotate_right(u32::from(self.turn))
    }
}

/// What the words are after these overwrites.
#[inline]
pub fn apply(overwrites: &[Overwrite], words: &mut [u64]) {
    for overwrite in overwrites {
        let word = &mut words[overwrite.word as usize];
        *word = overwrite.of(*word);
    }
}

/// The hash of a state.
#[inline]
pub fn hash(state: &[u64]) -> u64 {
    let mut hash = 0x9e37_79b9_7f4a_7c15u64;
    for word in state {
        hash = (hash ^ word).wrapping_mul(0xff51_afd7_ed55_8ccd);
        hash ^= hash >> 32;
    }
    hash = hash.wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    hash ^ hash >> 29
}

/// A field of the words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Field {
    /// The location whose value it holds; unused for the rest.
    pub location: u32,
    pub function: FunctionId,
    pub word: u32,
    pub shift: u8,
    pub bits: u8,
    /// Its codes are numbers of the few values that the location has taken, from 0 on ([`crate::packed::few`]).
    pub few: bool,
}

impl Field {
    /// The ones that cover the field in its word.
    #[inline]
    pub fn mask(&self) -> u64 {
        ((1u64 << self.bits) - 1) << self.shift
    }

    /// The code that stands in it.
    #[inline]
    pub fn code(&self, words: &[u64]) -> u64 {
        (words[self.word as usize] & self.mask()) >> self.shift
    }

    /// Puts a code into it.
    #[inline]
    pub fn put(&self, code: u64, words: &mut [u64]) {
        let word = &mut words[self.word as usize];
        *word = *word & !self.mask() | code << self.shift;
    }
}
