//! Packed states with numbers, in the order in which they are met.
//!
//! In: states of so many words. Out: the number of each, from 0 on. INVARIANT: no state has two numbers.

use hashbrown::HashTable;

use super::words::hash;

/// See the module.
#[derive(Debug)]
pub struct Numbered {
    words: usize,
    count: usize,
    /// The states, one after the other.
    all: Vec<u64>,
    numbers: HashTable<u32>,
}

impl Numbered {
    /// No states yet; each has so many words.
    pub fn new(words: usize) -> Numbered {
        Numbered { words, count: 0, all: Vec::new(), numbers: HashTable::new() }
    }

    /// States that stand one after the other already, of which nobody will ask for a number.
    pub fn listed(words: usize, all: Vec<u64>) -> Numbered {
        Numbered { words, count: all.len() / words, all, numbers: HashTable::new() }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The states, one after the other.
    pub fn words(&self) -> &[u64] {
        &self.all
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
        let number = self.count as u32;
        self.count += 1;
        self.all.extend_from_slice(state);
        let Numbered { words, all, numbers, .. } = self;
        let of = |number: &u32| hash(&all[*number as usize * *words..][..*words]);
        numbers.insert_unique(hash(state), number, of);
        number
    }

    /// The number of a state, and whether it is new.
    pub fn number(&mut self, state: &[u64]) -> (u32, bool) {
        match self.find(state) {
            Some(known) => (known, false),
            None => (self.push(state), true),
        }
    }

    /// How many bytes they take.
    pub fn bytes(&self) -> usize {
        8 * self.all.capacity() + 8 * self.numbers.capacity()
    }
}
