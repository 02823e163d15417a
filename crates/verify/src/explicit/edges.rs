//! The edges that one worker of a search has walked, kept for the properties of runs.
//!
//! In: how many successors each expanded state has, which worker owns each, and, once that worker has taken them in, where
//! they stand there. Out: compressed rows, in the order in which the worker's states were expanded. INVARIANT: between two rounds there is
//! a place for each successor. [`crate::walk`] joins the edges of all workers.

use std::ops::Deref;

use explore::Expansion;

/// LIMIT: with more workers no edges are kept.
pub(crate) const OWNERS: usize = 1 << 8;
/// In place of an index: an assumption leaves the successor out.
pub(crate) const LEFT_OUT: u32 = u32::MAX;

/// What else the alternatives of a state come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Besides(u8);

impl Besides {
    const STAYS: u8 = 1;
    const FAULTS: u8 = 2;
    const CUT: u8 = 4;

    fn of(expansion: &Expansion) -> Besides {
        let bit = |is: bool, bit: u8| if is { bit } else { 0 };
        let faults = bit(expansion.faults != [0; 3], Besides::FAULTS);
        Besides(bit(expansion.stayed > 0, Besides::STAYS) | faults | bit(expansion.unbounded > 0, Besides::CUT))
    }

    /// Some leave the state as it is.
    pub fn stays(self) -> bool {
        self.0 & Besides::STAYS != 0
    }

    /// Some are faults.
    pub fn faults(self) -> bool {
        self.0 & Besides::FAULTS != 0
    }

    /// Some cannot be gone through.
    pub fn is_cut(self) -> bool {
        self.0 & Besides::CUT != 0
    }
}

/// See the module.
#[derive(Debug, Clone, Default)]
pub(crate) struct Edges {
    /// How many of the first edges lead to the initial states, from nowhere.
    pub roots: usize,
    /// By expanded state, where its edges end.
    pub ends: Vec<u64>,
    /// By expanded state.
    pub besides: Vec<Besides>,
    /// By edge, the worker that owns the successor.
    pub owners: Vec<u8>,
    /// By edge, the successor's index there, or [`LEFT_OUT`].
    pub targets: Vec<u32>,
}

impl Edges {
    /// Adds an edge to each initial state.
    pub fn begin(&mut self, owners: impl Iterator<Item = usize>) {
        self.owners.extend(owners.map(|owner| owner as u8));
        self.roots = self.owners.len();
    }

    /// Adds an edge to a successor of the state that is being expanded.
    #[inline]
    pub fn leads_to(&mut self, owner: usize) {
        self.owners.push(owner as u8);
    }

    /// The state that was being expanded came to this.
    pub fn end(&mut self, expansion: &Expansion) {
        self.ends.push(self.owners.len() as u64);
        self.besides.push(Besides::of(expansion));
    }

    /// Adds the places of the successors of a round: of each worker, in the order in which they were sent to it.
    pub fn arrive<P: Deref<Target = Vec<u32>>>(&mut self, places: &[P]) {
        let mut next = vec![0; places.len()];
        for owner in &self.owners[self.targets.len()..] {
            let owner = usize::from(*owner);
            self.targets.push(places[owner][next[owner]]);
            next[owner] += 1;
        }
        debug_assert!(
            next.iter().zip(places).all(|(next, places)| *next == places.len()),
            "a place for each successor"
        );
    }

    /// How many bytes they take.
    pub fn bytes(&self) -> usize {
        9 * self.ends.capacity() + self.owners.capacity() + 4 * self.targets.capacity()
    }
}
