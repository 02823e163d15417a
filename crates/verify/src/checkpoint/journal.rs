//! Which steps made new values come up, so that they can be made again in their order.

use std::sync::Arc;

use explore::Interner;

/// Which states' steps made new values come up.
#[derive(Debug)]
pub(crate) struct Journal {
    interner: Arc<Interner>,
    known: usize,
    /// The places of the states.
    pub places: Vec<u64>,
}

impl Journal {
    /// A journal of a search whose values are numbered here, all of them so far being those of the initial states.
    pub fn new(interner: &Arc<Interner>) -> Journal {
        Journal { interner: Arc::clone(interner), known: interner.len(), places: Vec::new() }
    }

    /// The steps of the state of this place were made.
    pub fn note(&mut self, place: usize) {
        let known = self.interner.len();
        if known > self.known {
            self.known = known;
            self.places.push(place as u64);
        }
    }
}
