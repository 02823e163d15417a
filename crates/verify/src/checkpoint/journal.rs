//! Records which steps introduced new values, so that they can be repeated in order.

use std::sync::Arc;

use explore::Interner;

/// The states whose steps introduced new values.
#[derive(Debug)]
pub(crate) struct Journal {
    interner: Arc<Interner>,
    known: usize,
    /// The indices of the states.
    pub places: Vec<u64>,
}

impl Journal {
    /// A journal for values in this interner; the present ones are those of the initial states.
    pub fn new(interner: &Arc<Interner>) -> Journal {
        Journal { interner: Arc::clone(interner), known: interner.len(), places: Vec::new() }
    }

    /// Records that the steps of the state at this index were made.
    pub fn note(&mut self, place: usize) {
        let known = self.interner.len();
        if known > self.known {
            self.known = known;
            self.places.push(place as u64);
        }
    }
}
