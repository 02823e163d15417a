//! Finds runs to states when earlier states were not stored.
//!
//! In: a search with a compact store that has ended. Out: for each found state, the states of a shortest run to it. The
//! search is repeated, and each state carries an ancestor: the one on the last level whose number is a multiple of some
//! distance. So a pass yields, for each wanted state, an ancestor that far away; the next pass, with half the distance,
//! yields the states between. INVARIANT: each pass visits the same states in the same order, since what a worker
//! receives depends only on the number of workers. So the runs are those of the first search.

use std::collections::BTreeMap;

use machine::Interrupt;

use crate::explicit::crew::Crew;
use crate::explicit::lineage::{At, Lineage, Wanted};
use crate::explicit::search::Search;
use crate::explicit::shard::Shard;
use crate::explicit::tally::{Decision, Tally};
use crate::explorers::representatives;
use crate::progress::{Progress, Stop};
use crate::storage::Store;
use crate::target::Found;

/// The known states on the way to one, by level.
type Way = BTreeMap<usize, Box<[u64]>>;

impl Search {
    /// The states on the way to each found state.
    pub(crate) fn chains_again(&mut self, watch: &mut dyn FnMut(&Progress) -> bool) -> Vec<Vec<Box<[u64]>>> {
        let deepest = self.found.iter().map(|found| found.depth).max().unwrap_or(0);
        let way = |found: &Found| Way::from([(found.depth, found.state.clone())]);
        let mut ways: Vec<Way> = self.found.iter().map(way).collect();
        let mut every = (deepest + 1).next_power_of_two() / 2;
        let depths: Vec<usize> = self.found.iter().map(|found| found.depth).collect();
        while ways.iter().zip(&depths).any(|(way, depth)| way.len() <= *depth) {
            let before = |level: usize| (level - 1) / every * every;
            let asked = |way: &Way| {
                let all = way.iter().map(|(level, state)| (*level, state.clone()));
                all.filter(|(level, _)| *level > 0 && !way.contains_key(&before(*level))).collect::<Vec<At>>()
            };
            let asked: Vec<_> = ways.iter().map(asked).collect();
            let mut wanted = Wanted::new();
            for (level, state) in asked.iter().flatten() {
                wanted.entry(*level).or_default().insert(state.clone());
            }
            let ancestors = self.pass(every, wanted, watch);
            for (way, asked) in ways.iter_mut().zip(asked) {
                for (level, state) in asked {
                    let ancestor = ancestors.get(&(level, state)).expect("a search comes to the same states again");
                    way.insert(before(level), ancestor.clone());
                }
            }
            every = (every / 2).max(1);
        }
        ways.into_iter().map(|way| way.into_values().collect()).collect()
    }

    /// Searches again, only for ancestors.
    fn pass(
        &mut self,
        every: usize,
        wanted: Wanted,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> BTreeMap<At, Box<[u64]>> {
        let mut plan = self.plan.clone();
        (plan.wanted, plan.wanted_steps, plan.terminal) = (Vec::new(), Vec::new(), None);
        plan.settings.interrupt = Interrupt::default();
        let words = self.explorer.words();
        let count = self.shards.len();
        // Frees the states of the first search.
        self.shards.clear();
        let lineage = Lineage { every, wanted, ancestors: Vec::new() };
        let mut shards: Vec<Shard> = (0..count)
            .map(|_| {
                let mut shard =
                    Shard::new(Store::new(words, plan.storage, plan.seed, count).with_more(words), &self.reduction);
                shard.lineage = Some(lineage.clone());
                shard.orbits.clone_from(&self.orbits);
                shard
            })
            .collect();
        let starts = representatives(&mut self.explorer, self.orbits.as_deref());
        let starts: Vec<u64> = starts.chunks_exact(words).flat_map(|state| [state, state].concat()).collect();
        let deepest = lineage.wanted.last_key_value().map_or(0, |(level, _)| *level as u64);
        let mut decide = |reports: &[Tally], depth: u64| {
            let progress = Tally::progress(reports, depth);
            // Findings are reported however long that takes.
            watch(&progress);
            let broken = reports.iter().any(|report| report.narrow || report.broken);
            match reports.iter().any(|report| report.left > 0) {
                _ if broken => Decision::Stop(None),
                true => Decision::Round,
                false if depth >= deepest => Decision::Stop(Some(Stop::Depth)),
                false => Decision::Level,
            }
        };
        let maker = self.maker.clone().tireless();
        let crew = Crew { plan: &plan, explore: &|| maker.explorer() };
        crew.work(&mut self.explorer, &mut shards, &starts, 2 * words, &mut decide);
        let ancestors = shards.into_iter().filter_map(|shard| shard.lineage).flat_map(|lineage| lineage.ancestors);
        let ancestors = ancestors.collect();
        self.shards = (0..count)
            .map(|_| Shard::new(Store::new(words, plan.storage, plan.seed, count), &self.reduction))
            .collect();
        ancestors
    }
}
