//! Packed states with numbers, in the order in which they are met.
//!
//! In: states of so many words. Out: the number of each, from 0 on. INVARIANT: no state has two numbers.

use hashbrown::HashTable;

use crate::table::hash;

/// See the module.
#[derive(Debug)]
pub struct Numbered {
    words: usize,
    /// The states, one after the other.
    pub(super) all: Vec<u64>,
    numbers: HashTable<u32>,
}

impl Numbered {
    /// No states yet.
    pub fn new(words: usize) -> Numbered {
        Numbered { words, all: Vec::new(), numbers: HashTable::new() }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.all.len() / self.words
    }

    /// The state with a number.
    #[inline]
    pub fn get(&self, number: u32) -> &[u64] {
        let start = number as usize * self.words;
        &self.all[start..start + self.words]
    }

    /// The number of a state, if it has one.
    pub fn find(&self, state: &[u64]) -> Option<u32> {
        self.numbers.find(hash(state), |number| self.get(*number) == state).copied()
    }

    /// Gives a state a number that has none.
    pub fn push(&mut self, state: &[u64]) -> u32 {
        let number = self.len() as u32;
        self.all.extend_from_slice(state);
        let Numbered { words, all, numbers } = self;
        let of = |number: &u32| hash(&all[*number as usize * *words..][..*words]);
        numbers.insert_unique(hash(state), number, of);
        number
    }

    /// How many bytes they take.
    pub fn bytes(&self) -> usize {
        8 * self.all.capacity() + 8 * self.numbers.capacity()
    }
}
