//! The initial states that initial values which come up later are evaluated in.
//!
//! In: where the runs of a program may begin. Out: for each packed state the initial state that its run began in, where that
//! matters: some initial value is evaluated when it is first read, in the initial state, and there are several. INVARIANT: a
//! step never changes it.

use std::sync::Arc;

use machine::Machine;
use machine::inside::Store;

/// The initial states of runs, each once.
#[derive(Debug, Default)]
pub(crate) struct Origins {
    stores: Arc<Vec<Store>>,
    /// Which of them the machine has.
    current: usize,
}

impl Origins {
    /// These, whichever the machine has.
    pub fn of(stores: &Arc<Vec<Store>>) -> Origins {
        Origins { stores: Arc::clone(stores), current: 0 }
    }

    /// All of them.
    pub fn stores(&self) -> Arc<Vec<Store>> {
        Arc::clone(&self.stores)
    }

    /// The number of the initial state that the machine has just been started in; 0 where none is ever looked at again.
    pub fn number(&mut self, machine: &Machine) -> u32 {
        let Some(origin) = machine.origin() else { return 0 };
        let known = self.stores.iter().position(|store| store.is_like(origin));
        if known.is_none() {
            Arc::make_mut(&mut self.stores).push(origin.clone());
        }
        self.current = known.unwrap_or(self.stores.len() - 1);
        self.current as u32
    }

    /// Another one, for a machine that has this; none where it is the same.
    pub fn change(&mut self, origin: usize) -> Option<&Store> {
        (std::mem::replace(&mut self.current, origin) != origin).then(|| &self.stores[origin])
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.stores.len()
    }
}
