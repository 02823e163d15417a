//! What a search keeps of the states it has met.
//!
//! In: [`Storage`], as it is asked for. Out: a [`Store`], which says whether a state is new. All of a state ([`crate::table`]),
//! in files where memory ends ([`spilled`]); or only a hash or a few bits of it ([`compact`]), where states are too many to be
//! kept. INVARIANT: a store that keeps less
//! than the state says how likely it is that it has taken a state for another.

pub(crate) mod compact;
pub(crate) mod disk;
mod fingerprint;
mod run;
mod spilled;

use std::ops::Range;
use std::sync::Arc;

use crate::storage::compact::Compact;
use crate::storage::disk::Disk;
use crate::storage::spilled::Spilled;
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
    Spilled(Box<Spilled>),
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

    /// One that keeps all of the states, in files where there is no room for them in so many bytes.
    pub fn with_disk(words: usize, disk: &Arc<dyn Disk>, room: u64) -> Store {
        Store::Spilled(Box::new(Spilled::new(words, disk, room)))
    }

    /// The same, in which so many words go with each state.
    pub fn with_more(self, more: usize) -> Store {
        match self {
            Store::Exact(_) | Store::Spilled(_) => {
                unreachable!("states that are kept need nothing that goes with them")
            }
            Store::Compact(compact) => Store::Compact(Box::new(compact.with_more(more))),
        }
    }

    /// How many states there are.
    pub fn len(&self) -> usize {
        match self {
            Store::Exact(table) => table.len(),
            Store::Spilled(spilled) => spilled.len(),
            Store::Compact(compact) => compact.len(),
        }
    }

    /// Whether no more states can be kept.
    pub fn is_full(&self) -> bool {
        match self {
            Store::Exact(table) => table.is_full(),
            Store::Spilled(_) | Store::Compact(_) => false,
        }
    }

    /// How many states have come in of which it is not known yet whether they are new.
    pub fn pending(&self) -> usize {
        match self {
            Store::Spilled(spilled) => spilled.pending(),
            Store::Exact(_) | Store::Compact(_) => 0,
        }
    }

    /// Files have met trouble, so that not all states are known.
    pub fn is_lost(&self) -> bool {
        matches!(self, Store::Spilled(spilled) if spilled.is_lost())
    }

    /// How many bytes of files it takes.
    pub fn spilled(&self) -> usize {
        match self {
            Store::Spilled(spilled) => spilled.spilled(),
            Store::Exact(_) | Store::Compact(_) => 0,
        }
    }

    /// How many bytes it takes.
    pub fn bytes(&self) -> usize {
        match self {
            Store::Exact(table) => table.bytes(),
            Store::Spilled(spilled) => spilled.bytes(),
            Store::Compact(compact) => compact.bytes(),
        }
    }

    /// A state by its place, one that was not forgotten, and that was loaded.
    #[inline]
    pub fn state(&self, index: usize) -> &[u64] {
        match self {
            Store::Exact(table) => table.state(index),
            Store::Spilled(spilled) => spilled.state(index),
            Store::Compact(compact) => compact.state(index),
        }
    }

    /// Makes the states of these places ready to be read, and no others; false where they cannot be read.
    pub fn load(&mut self, places: Range<usize>) -> bool {
        match self {
            Store::Spilled(spilled) => spilled.load(places),
            Store::Exact(_) | Store::Compact(_) => true,
        }
    }

    /// Adds states, one after the other; calls `new` with each that is known to be.
    pub fn insert_all(&mut self, states: &[u64], new: &mut impl FnMut(&[u64])) {
        match self {
            Store::Exact(table) => table.insert_all(states, new),
            Store::Spilled(spilled) => spilled.insert_all(states, new),
            Store::Compact(compact) => compact.insert_all(states, new),
        }
    }

    /// Finds out which of the pending states are new; calls `new` with them.
    pub fn settle(&mut self, new: &mut impl FnMut(&[u64])) {
        if let Store::Spilled(spilled) = self {
            spilled.settle(new);
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
            Store::Exact(_) | Store::Spilled(_) => 0.0,
            Store::Compact(compact) => compact.omission(),
        }
    }
}
