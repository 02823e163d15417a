//! The plan of a search: which states and steps count, what to look for in them, and how far to go.

use std::sync::Arc;

use explore::{Expansion, Explorer, Settings, Truth};

use crate::storage::Storage;
use crate::storage::disk::Disk;

/// The plan of a search.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// Settings of explorers.
    pub settings: Settings,
    /// Conditions on states that are assumptions: states in which one is false are skipped.
    pub assumed: Vec<usize>,
    /// The condition for states that are no deadlocks.
    pub terminal: Option<usize>,
    /// Conditions on states whose violations are looked for.
    pub wanted: Vec<usize>,
    /// Conditions on steps whose violations are looked for.
    pub wanted_steps: Vec<usize>,
    /// The number of workers.
    pub workers: usize,
    /// End the search with the first level that contains a finding.
    pub first: bool,
    /// The largest number of states.
    pub max_states: u64,
    /// The largest number of steps from an initial state.
    pub max_depth: u64,
    /// The largest number of bytes for states.
    pub max_bytes: u64,
    /// When states take so many bytes, they are packed more tightly; see [`crate::explicit::search`] for the default.
    pub census: Option<u64>,
    /// The first of several workers does a round alone where it would leave fewer states to the others; by default 64.
    pub alone: Option<u64>,
    /// Whether to keep the edges walked, for properties of runs, where states are stored in full and there is memory.
    pub edges: bool,
    /// How states are stored.
    pub storage: Storage,
    /// Selects the hash, if states are not stored in full.
    pub seed: u64,
    /// Whether to use partial-order reduction.
    pub partial_order: bool,
    /// Whether to use symmetry reduction; not with `partial_order` or a checkpoint.
    pub symmetry: bool,
    /// Stores states when memory is full; only if they are stored in full, and without a checkpoint.
    pub disk: Option<Arc<dyn Disk>>,
}

impl Plan {
    /// Whether the assumptions leave no step of a state whose alternatives lead to these.
    pub fn leaves_no_step(&self, explorer: &mut Explorer, expansion: &Expansion, successors: &[u64]) -> bool {
        if expansion.stayed > 0 || expansion.faults != [0; 3] || expansion.unbounded > 0 {
            return false;
        }
        if expansion.moved == 0 {
            return expansion.excluded > 0;
        }
        let words = explorer.words();
        let mut admitted = |state: &[u64]| self.assumed.iter().all(|one| explorer.truth(*one, state) == Truth::True);
        !self.assumed.is_empty() && !successors.chunks_exact(words).any(&mut admitted)
    }
}
