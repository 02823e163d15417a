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

/// The candidates of one state's choices that their guards refuse. What such a guard reads is read in the steps that take another candidate of
/// the same choice.
#[derive(Debug, Default)]
pub(crate) struct Refusals {
    /// The answers that lead to each, and what its guard reads that had not been seen.
    pub refused: Vec<(Vec<u32>, Vec<Observation>)>,
    /// The answers that lead to each step that can be made.
    pub made: Vec<Vec<u32>>,
    /// Something was read by a guard in no step that can be made.
    pub unmade: bool,
}

impl Refusals {
    /// Another state is looked at.
    pub fn begin(&mut self) {
        self.refused.clear();
        self.made.clear();
    }

    /// Whether a step with these answers is one in which a candidate was refused.
    pub fn is_of(refused: &[u32], made: &[u32]) -> bool {
        refused.split_last().is_some_and(|(_, before)| made.starts_with(before))
    }
}

/// By field of the packed states, the codes met.
#[derive(Debug, Clone, Default)]
pub struct Met {
    pub(super) codes: Vec<FxHashSet<u64>>,
    pub(super) last: Vec<u64>,
}
