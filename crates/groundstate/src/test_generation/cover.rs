//! Selects few and short walks that together meet every need that some walk meets.
//!
//! In: walks. Out: some of them, each cut after the last step that it is needed for. The choice is greedy (V. Chvátal,
//! *A greedy heuristic for the set-covering problem*, 1979): take the walk that meets the most open needs; of equals
//! the shortest, then the first. Then leave out or cut each walk that the others make superfluous.

use std::collections::BTreeSet;

use program::Program;
use verify::Trace;
use verify::survey::Walk;

use crate::test_generation::goals::{Need, needs_met};

/// A walk and the needs that its steps meet.
#[derive(Debug)]
pub(super) struct Candidate {
    trace: Trace,
    /// By step.
    meets: Vec<BTreeSet<Need>>,
}

impl Candidate {
    pub fn new(program: &Program, walk: Walk, wanted: &BTreeSet<Need>) -> Candidate {
        let of_step = |happens: Vec<machine::Observation>| {
            let needs = happens.into_iter().flat_map(|observation| needs_met(program, observation));
            needs.filter(|need| wanted.contains(need)).collect()
        };
        Candidate { trace: walk.trace, meets: walk.happens.into_iter().map(of_step).collect() }
    }

    pub fn meets(&self, need: &Need) -> bool {
        self.meets.iter().any(|step| step.contains(need))
    }

    pub fn trace(&self) -> &Trace {
        &self.trace
    }

    pub fn all(&self) -> BTreeSet<Need> {
        self.meets.iter().flatten().copied().collect()
    }

    /// Cuts the steps after the last one that meets a need that nothing else meets.
    fn cut(&mut self, others: &BTreeSet<Need>) {
        let mut met = others.clone();
        let mut length = 0;
        for (index, step) in self.meets.iter().enumerate() {
            if !step.is_subset(&met) {
                met.extend(step);
                length = index + 1;
            }
        }
        self.meets.truncate(length);
        self.trace.steps.truncate(length);
    }
}

/// See the module.
pub(super) fn cover(candidates: Vec<Candidate>) -> Vec<Candidate> {
    let mut open: BTreeSet<Need> = candidates.iter().flat_map(Candidate::all).collect();
    let all: Vec<BTreeSet<Need>> = candidates.iter().map(Candidate::all).collect();
    let mut chosen: Vec<usize> = Vec::new();
    while !open.is_empty() {
        let gain = |index: &usize| all[*index].intersection(&open).count();
        let best = (0..candidates.len())
            .max_by_key(|index| (gain(index), std::cmp::Reverse((candidates[*index].meets.len(), *index))));
        let Some(best) = best else { break };
        open.retain(|need| !all[best].contains(need));
        chosen.push(best);
    }
    chosen.sort_unstable();
    let mut kept: Vec<Candidate> =
        candidates.into_iter().enumerate().filter(|(index, _)| chosen.contains(index)).map(|(_, one)| one).collect();
    // The longest first, so that short ones stay.
    let mut order: Vec<usize> = (0..kept.len()).collect();
    order.sort_by_key(|index| std::cmp::Reverse(kept[*index].meets.len()));
    for index in order {
        let others: BTreeSet<Need> =
            kept.iter().enumerate().filter(|(other, _)| *other != index).flat_map(|(_, one)| one.all()).collect();
        kept[index].cut(&others);
    }
    kept.retain(|candidate| !candidate.meets.is_empty());
    kept
}
