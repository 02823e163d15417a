//! What a search keeps of the states it has met.
//!
//! In: [`Storage`], as it is asked for. Out: a [`Store`], which says whether a state is new. All of a state ([`crate::table`]),
//! or only a hash or a few bits of it ([`compact`]), where states are too many to be kept. INVARIANT: a store that keeps less
//! than the state says how likely it is that it has taken a state for another.

pub(crate) mod compact;
mod fingerprint;

use crate::storage::compact::Compact;
use crate::table::Table;

/// What is kept of each state.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Storage {
    /// All of it.
    #[default]
    Exact,
    /// A hash of 61 bits.
    Compact,
    /// A few bits of an array of so many bytes.
    BitState(u64),
}

/// The states met, by their order of arrival.
#[derive(Debug)]
pub(crate) enum Store {
    Exact(Table),
    Compact(Box<Compact>),
}

impl Store {
    /// One of so many that share the work; `seed` draws the hash.
    pub fn new(words: usize, storage: Storage, seed: u64, workers: usize) -> Store {
        match storage {
            Storage::Exact => Store::Exact(Table::new(words)),
            Storage::Compact => Store::Compact(Box::new(Compact::hashes(words, seed))),
            Storage::BitState(bytes) => {
                Store::Compact(Box::new(Compact::bits(words, seed, bytes / workers.max(1) as u64)))
            }
        }
    }

    /// The same, in which so many words go with each state.
    pub fn with_more(self, more: usize) -> Store {
        match self {
            Store::Exact(_) => unreachable!("states that are kept need nothing that goes with them"),
            Store::Compact(compact) => Store::Compact(Box::new(compact.with_more(more))),
        }
    }

    /// How many states there are.
    pub fn len(&self) -> usize {
        match self {
            Store::Exact(table) => table.len(),
            Store::Compact(compact) => compact.len(),
        }
    }

    /// Whether no more states can be kept.
    pub fn is_full(&self) -> bool {
        match self {
            Store::Exact(table) => table.is_full(),
            Store::Compact(_) => false,
        }
    }

    /// How many bytes it takes.
    pub fn bytes(&self) -> usize {
        match self {
            Store::Exact(table) => table.bytes(),
            Store::Compact(compact) => compact.bytes(),
        }
    }

    /// A state by its place, one that was not forgotten.
    #[inline]
    pub fn state(&self, index: usize) -> &[u64] {
        match self {
            Store::Exact(table) => table.state(index),
            Store::Compact(compact) => compact.state(index),
        }
    }

    /// Adds states, one after the other; calls `new` with each that is.
    pub fn insert_all(&mut self, states: &[u64], new: &mut impl FnMut(&[u64])) {
        match self {
            Store::Exact(table) => table.insert_all(states, new),
            Store::Compact(compact) => compact.insert_all(states, new),
        }
    }

    /// States before this place need not be read again.
    pub fn forget_before(&mut self, index: usize) {
        if let Store::Compact(compact) = self {
            compact.forget_before(index);
        }
    }

    /// How many states are to be expected to have been taken for others, and so left out: no less than the probability
    /// that any was.
    pub fn omission(&self) -> f64 {
        match self {
            Store::Exact(_) => 0.0,
            Store::Compact(compact) => compact.omission(),
        }
    }
}
