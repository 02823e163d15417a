//! What a refinement is decided with: how each machine is explored, which values its inputs have, and what is enough.
//!
//! It is data alone. INVARIANT: a bound is either assumed, and then a verdict is about these values, or only tried.

use std::collections::{BTreeMap, BTreeSet};

use machine::{Bounds, Interrupt, Limits};
use program::FunctionId;

/// What a machine is explored with.
#[derive(Debug, Clone, Default)]
pub struct Extent {
    /// The machine's limits.
    pub limits: Limits,
    /// The values to try for inputs, if not all of their domains.
    pub bounds: Bounds,
    /// Inputs that may also be undef.
    pub undefined: BTreeSet<FunctionId>,
    /// Bounds that are assumed, not only tried: in words, and where that is said.
    pub assumed: BTreeMap<FunctionId, (String, String)>,
    /// Ends the search when raised.
    pub interrupt: Interrupt,
}

/// Options of a refinement check.
#[derive(Debug, Clone)]
pub struct Options {
    /// How the two machines are explored.
    pub extents: [Extent; 2],
    /// The most pairs of states.
    pub max_pairs: u64,
    /// The most steps of both machines together; looked at between pairs.
    pub max_steps: u64,
    /// How many threads make steps.
    pub workers: usize,
    /// So many pairs are looked at before others help. By default 512.
    pub alone: usize,
}

/// LIMIT: fewer pairs are not worth making threads, and compiling in each.
const ALONE: usize = 512;

impl Default for Options {
    fn default() -> Options {
        Options { extents: Default::default(), max_pairs: u64::MAX, max_steps: u64::MAX, workers: 1, alone: ALONE }
    }
}
