//! A worker's task in a pass that only looks for ancestors of some states: see [`crate::explicit::ancestors`].

use std::collections::BTreeMap;

use rustc_hash::FxHashSet;

use crate::storage::Store;

/// A worker's task in such a pass.
#[derive(Debug, Clone)]
pub(crate) struct Lineage {
    /// States on levels that are multiples of this become ancestors.
    pub every: usize,
    /// The states whose ancestors are wanted, by level.
    pub wanted: Wanted,
    /// The ancestors found.
    pub ancestors: Vec<(At, Box<[u64]>)>,
}

/// A state and its level.
pub(crate) type At = (usize, Box<[u64]>);
/// States by their level.
pub(crate) type Wanted = BTreeMap<usize, FxHashSet<Box<[u64]>>>;
impl Lineage {
    /// The ancestor that the successors of a state on this level carry.
    pub fn ancestor<'a>(&self, store: &'a Store, place: usize, level: usize) -> &'a [u64] {
        match store {
            Store::Compact(compact) if !level.is_multiple_of(self.every) => compact.more(place),
            store => store.state(place),
        }
    }

    /// Records the ancestor of a new state if it is wanted.
    pub fn meet(&mut self, level: usize, item: &[u64]) {
        let (state, ancestor) = item.split_at(item.len() / 2);
        if self.wanted.get(&level).is_some_and(|wanted| wanted.contains(state)) {
            self.ancestors.push(((level, state.into()), ancestor.into()));
        }
    }
}
