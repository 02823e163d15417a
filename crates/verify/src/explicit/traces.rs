//! Makes shortest runs to the findings of a search.
//!
//! In: the findings of a search. Out: a [`Trace`] for each. The search stores no parent pointers; a run is rebuilt
//! backwards, level by level: of the states on the previous level that lead to the state, the least in canonical order
//! is taken, and of its steps the first. So a trace does not depend on the number of workers, and a state needs no link
//! to its parent. If states were not stored, the search is repeated ([`crate::explicit::ancestors`]).

use crate::explicit::search::Search;
use crate::explicit::ways::ways;
use crate::heed::Heed;
use crate::progress::Stop;
use crate::storage::Storage;
use crate::target::Found;
use crate::trace::{Trace, tell};

impl Search {
    /// A shortest run to each finding, in the order of `found`. If files cannot be read, there are no findings.
    pub(crate) fn traces(&mut self, heed: &mut Heed<'_>) -> Vec<Trace> {
        // Findings are reported however long that takes.
        self.explorer.ignore_interrupts();
        let told = |found: &Found| heed.told.get(&found.target).filter(|(depth, _)| *depth == found.depth);
        let known: Vec<Option<Trace>> = self.found.iter().map(|found| Some(told(found)?.1.clone())).collect();
        let untold: Vec<Found> = self
            .found
            .iter()
            .zip(&known)
            .filter(|(_, known)| known.is_none())
            .map(|(found, _)| found.clone())
            .collect();
        let chains = match self.plan.storage {
            Storage::Exact => ways(&mut self.explorer, &mut self.shards, self.orbits.as_deref(), &untold),
            _ => Ok(self.chains_again(&mut |progress| heed.at(progress))),
        };
        let Ok(chains) = chains else {
            self.found.clear();
            self.stop = Some(Stop::Disk);
            return Vec::new();
        };
        let chains: Vec<_> = chains.into_iter().map(|chain| self.concrete(chain)).collect();
        let explorer = &mut self.explorer;
        explorer.look_in_order();
        let mut traces = untold.iter().zip(&chains).map(|(found, chain)| tell(explorer, chain, found));
        known.into_iter().map(|known| known.unwrap_or_else(|| traces.next().expect("a way to each"))).collect()
    }

    /// Turns a chain of representatives into a real run. From each representative, steps lead to a state that the next
    /// one represents. The permutation that maps the representative to the run's own state also maps that state to the
    /// run's next state.
    fn concrete(&mut self, chain: Vec<Box<[u64]>>) -> Vec<Box<[u64]>> {
        let Some(orbits) = self.orbits.clone() else { return chain };
        let explorer = &mut self.explorer;
        let starts: Vec<Box<[u64]>> = explorer.initial().iter().map(|(state, _)| state.into()).collect();
        let mut represented = starts.into_iter().map(|state| {
            let (representative, permutation) = explorer.normalised(&orbits, &state);
            (state, representative, permutation)
        });
        let (start, _, permutation) =
            represented.find(|(_, representative, _)| *representative == chain[0]).expect("a run begins with it");
        drop(represented);
        // From the representative to the run's own state.
        let (mut way, mut back) = (vec![start], permutation.inverse());
        let words = explorer.words();
        for pair in chain.windows(2) {
            let mut successors = Vec::new();
            let _ = explorer.expand(&pair[0], &mut successors);
            let (successor, permutation) = successors
                .chunks_exact(words)
                .find_map(|state| {
                    let (representative, permutation) = explorer.normalised(&orbits, state);
                    (representative == pair[1]).then_some((state, permutation))
                })
                .expect("the step was made before");
            way.push(explorer.permuted(&orbits, successor, &back));
            back = permutation.inverse().then(&back);
        }
        way
    }
}
