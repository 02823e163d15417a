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

/// Bits of one word that a step sets, whatever they were.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Overwrite {
    /// In which word.
    pub word: u32,
    /// Which bits.
    pub clear: u64,
    /// Those of them that become ones.
    pub set: u64,
}

/// What the words are after these overwrites.
#[inline]
pub(crate) fn apply(overwrites: &[Overwrite], words: &mut [u64]) {
    for Overwrite { word, clear, set } in overwrites {
        let word = &mut words[*word as usize];
        *word = *word & !clear | set;
    }
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
}

impl Field {
    /// The ones that cover the field in its word.
    #[inline]
    pub fn mask(&self) -> u64 {
        ((1u64 << self.bits) - 1) << self.shift
    }

    /// The code that stands in it.
    #[inline]
    pub fn code(&self, words: &[u64]) -> u32 {
        ((words[self.word as usize] & self.mask()) >> self.shift) as u32
    }

    /// Puts a code into it.
    #[inline]
    pub fn put(&self, code: u32, words: &mut [u64]) {
        let word = &mut words[self.word as usize];
        *word = *word & !self.mask() | u64::from(code) << self.shift;
    }
}
