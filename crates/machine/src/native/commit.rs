//! Applying an update set.
//!
//! INVARIANT: what [`apply`] leaves in the store and on the stack is what exchanging the values would.
#![allow(unsafe_code)]

use crate::store::Store;
use crate::update::Updates;
use crate::words::exchange;

/// Exchanges the value of each update with that of its location, where they differ; tells whether any did.
pub(crate) fn apply(store: &mut Store, updates: &mut Updates) -> bool {
    let mut changed = false;
    let mut compound = false;
    for update in &mut updates.stack {
        let value = &mut store.values[update.location as usize];
        changed |= exchange(value, &mut update.value, &mut compound);
    }
    updates.compound |= compound;
    changed
}

impl Updates {
    /// Empties the stack.
    pub fn clear_stack(&mut self) {
        if self.compound {
            self.stack.clear();
            self.compound = false;
        } else {
            // SAFETY: no value on the stack has memory of its own, so none needs to be dropped.
            unsafe { self.stack.set_len(0) };
        }
    }
}
