//! A log of overwritten values, by which a machine goes back a few steps without a copy of its state.
//!
//! From the first [`crate::Mark`] on, each commit and each value set from outside logs the value that was there before.
//! Going back restores these values, the latest first. INVARIANT: restoring the entries from a mark on gives the state at
//! that mark; the numbers in them are those of the store.

use std::collections::VecDeque;

use program::DomainId;

use crate::layout::LocationIndex;
use crate::location::Location;
use crate::store::{Carrier, Store};
use crate::update::Updates;
use crate::value::Value;

#[derive(Debug, Default)]
pub(crate) struct Journal {
    entries: VecDeque<Entry>,
    /// The number of the first of them.
    first: u64,
}

#[derive(Debug)]
enum Entry {
    Value { location: LocationIndex, given: u32, before: Value },
    Carrier { domain: DomainId, before: Carrier },
}

impl Journal {
    /// Notes what a step is about to overwrite.
    pub fn note_step(&mut self, store: &Store, updates: &Updates) {
        for update in &updates.stack {
            self.note(store, update.location);
        }
        for (domain, _) in updates.created() {
            let before = store.carriers[domain.0 as usize].clone();
            self.entries.push_back(Entry::Carrier { domain: *domain, before });
        }
    }

    /// Notes a location that is about to be overwritten.
    pub fn note(&mut self, store: &Store, location: LocationIndex) {
        let before = store.values[location as usize].clone();
        self.entries.push_back(Entry::Value { location, given: store.given[location as usize], before });
    }

    /// The locations of the entries, so that they can be renumbered.
    pub fn locations(&self, store: &Store) -> Vec<Location> {
        let location = |entry: &Entry| match entry {
            Entry::Value { location, .. } => Some(store.location(*location)),
            Entry::Carrier { .. } => None,
        };
        self.entries.iter().filter_map(location).collect()
    }

    /// Takes the store's new numbers of these locations.
    pub fn renumber(&mut self, store: &mut Store, locations: &[Location]) {
        let mut locations = locations.iter();
        for entry in &mut self.entries {
            if let Entry::Value { location, .. } = entry
                && let Some(known) = locations.next()
            {
                *location = store.number(known.function, &known.arguments);
            }
        }
    }

    /// The number that the next entry gets.
    pub fn end(&self) -> u64 {
        self.first + self.entries.len() as u64
    }

    /// Restores the values from before this entry and those after it.
    pub fn go_back(&mut self, entry: u64, store: &mut Store) {
        assert!(self.first <= entry, "the mark was forgotten");
        while self.end() > entry
            && let Some(entry) = self.entries.pop_back()
        {
            match entry {
                Entry::Value { location, given, before } => {
                    store.values[location as usize] = before;
                    store.given[location as usize] = given;
                }
                Entry::Carrier { domain, before } => {
                    let count = before.count;
                    store.carriers[domain.0 as usize] = Carrier { fresh: count, ..before };
                }
            }
        }
    }

    /// Drops the entries before this one.
    pub fn forget_before(&mut self, entry: u64) {
        let count = entry.saturating_sub(self.first).min(self.entries.len() as u64);
        self.entries.drain(..count as usize);
        self.first += count;
    }
}
