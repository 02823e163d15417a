//! What a search has seen for the first time.

use machine::Observation;
use rustc_hash::FxHashSet;

/// Something that happened for the first time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sighting {
    /// What.
    pub observation: Observation,
    /// The answers that lead to the step.
    pub picks: Vec<u32>,
    /// The step can be made; it is no fault.
    pub made: bool,
}

/// By field of the packed states, the codes met.
#[derive(Debug, Clone, Default)]
pub struct Met {
    pub(super) codes: Vec<FxHashSet<u64>>,
    pub(super) last: Vec<u64>,
}
