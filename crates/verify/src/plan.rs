//! What a search is to do: which states and steps count, what is looked for in them, and how far it goes.

use std::sync::Arc;

use explore::Settings;

use crate::storage::Storage;
use crate::storage::disk::Disk;

/// What the search is to do.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// What explorers are made with.
    pub settings: Settings,
    /// The conditions on states that are assumptions: states in which one does not hold are left out.
    pub assumed: Vec<usize>,
    /// The condition on states that may rest.
    pub terminal: Option<usize>,
    /// The conditions on states that are looked for where they do not hold.
    pub wanted: Vec<usize>,
    /// The conditions on steps that are looked for where they do not hold.
    pub wanted_steps: Vec<usize>,
    /// How many workers.
    pub workers: usize,
    /// The search ends with the first level in which something is found.
    pub first: bool,
    /// The most states.
    pub max_states: u64,
    /// The most steps from an initial state.
    pub max_depth: u64,
    /// The most bytes for states.
    pub max_bytes: u64,
    /// What is kept of each state.
    pub storage: Storage,
    /// Draws the hash, where less than the state is kept.
    pub seed: u64,
    /// Of moves that do not concern each other one order is enough.
    pub partial_order: bool,
    /// States that differ by a permutation of interchangeable elements are one; not with `partial_order`, nor where the search is
    /// kept.
    pub symmetry: bool,
    /// Where states go that memory has no room for; only where all of them is kept, and the search is not.
    pub disk: Option<Arc<dyn Disk>>,
}
