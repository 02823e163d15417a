//! Stores the states that a search has discovered.
//!
//! In: the chosen [`Storage`]. Out: a [`Store`], which tells whether a state is new. It stores states in full
//! ([`crate::table`]), on the disk when memory is full ([`spilled`]); or only a hash or a few bits of each
//! ([`compact`]), if there are too many states. INVARIANT: a lossy store tells how likely it is to have mistaken a
//! state for another.

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

/// How states are stored.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Storage {
    /// In full.
    #[default]
    Exact,
    /// As hashes of 61 bits.
    Compact,
    /// As a few bits in an array of this many bytes.
    BitState(u64),
}

/// The discovered states, in the order of arrival.
#[derive(Debug)]
pub(crate) enum Store {
    Exact(Table),
    Spilled(Box<Spilled>),
    Compact(Box<Compact>),
}

impl Store {
    /// One of several stores that share the work; `seed` selects the hash.
    pub fn new(words: usize, storage: Storage, seed: u64, workers: usize) -> Store {
        match storage {
            Storage::Exact => Store::Exact(Table::new(words)),
            Storage::Compact => Store::Compact(Box::new(Compact::hashes(words, seed))),
            Storage::BitState(bytes) => {
                Store::Compact(Box::new(Compact::bits(words, seed, bytes / workers.max(1) as u64)))
            }
        }
    }

    /// A store of complete states that uses files when they exceed this many bytes of memory.
    pub fn with_disk(words: usize, disk: &Arc<dyn Disk>, room: u64) -> Store {
        Store::Spilled(Box::new(Spilled::new(words, disk, room)))
    }

    /// The same store, in which each state carries additional words.
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
            Store::Spilled(spilled) => spilled.is_full(),
            Store::Compact(compact) => compact.is_full(),
        }
    }

    /// How many states have arrived of which it is unknown whether they are new.
    pub fn pending(&self) -> usize {
        match self {
            Store::Spilled(spilled) => spilled.pending(),
            Store::Exact(_) | Store::Compact(_) => 0,
        }
    }

    /// Whether a file failed, so that not all states are known.
    pub fn is_lost(&self) -> bool {
        matches!(self, Store::Spilled(spilled) if spilled.is_lost())
    }

    /// The number of bytes in files.
    pub fn spilled(&self) -> usize {
        match self {
            Store::Spilled(spilled) => spilled.spilled(),
            Store::Exact(_) | Store::Compact(_) => 0,
        }
    }

    /// The number of bytes in memory.
    pub fn bytes(&self) -> usize {
        match self {
            Store::Exact(table) => table.bytes(),
            Store::Spilled(spilled) => spilled.bytes(),
            Store::Compact(compact) => compact.bytes(),
        }
    }

    /// The state at an index; it must be loaded and not forgotten.
    #[inline]
    pub fn state(&self, index: usize) -> &[u64] {
        match self {
            Store::Exact(table) => table.state(index),
            Store::Spilled(spilled) => spilled.state(index),
            Store::Compact(compact) => compact.state(index),
        }
    }

    /// Loads the states at these indices, and no others; `false` if they cannot be read.
    pub fn load(&mut self, places: Range<usize>) -> bool {
        match self {
            Store::Spilled(spilled) => spilled.load(places),
            Store::Exact(_) | Store::Compact(_) => true,
        }
    }

    /// Adds states one after another; calls `new` with each that is known to be new.
    pub fn insert_all(&mut self, states: &[u64], new: &mut impl FnMut(&[u64])) {
        match self {
            Store::Exact(table) => table.insert_all(states, new),
            Store::Spilled(spilled) => spilled.insert_all(states, new),
            Store::Compact(compact) => compact.insert_all(states, new),
        }
    }

    /// Determines which of the pending states are new; calls `new` with them.
    pub fn settle(&mut self, new: &mut impl FnMut(&[u64])) {
        if let Store::Spilled(spilled) = self {
            spilled.settle(new);
        }
    }

    /// Allows to forget the states before this index.
    pub fn forget_before(&mut self, index: usize) {
        if let Store::Compact(compact) = self {
            compact.forget_before(index);
        }
    }

    /// The expected number of states that were mistaken for others and omitted. It is an upper bound of the probability
    /// that any was.
    pub fn omission(&self) -> f64 {
        match self {
            Store::Exact(_) | Store::Spilled(_) => 0.0,
            Store::Compact(compact) => compact.omission(),
        }
    }
}
