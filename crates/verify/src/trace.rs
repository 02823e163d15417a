//! How a search came to a state: the steps of a shortest way, told one by one.
//!
//! In: what a search has found. Out: a [`Trace`] for each. No way is kept while searching; it is found again backwards,
//! level by level: of the states of the level before that lead to the state, the least in canonical order is taken, and of
//! its steps the first. So a trace does not depend on the number of workers, and a state costs no link to its parent. Where
//! states were not kept, ways are found by searching again ([`crate::lineage`]).

use std::ops::ControlFlow;

use explore::{Explorer, Orbits, Outcome, Path, Told};
use machine::{FaultClass, Location, Value};

use crate::heed::Heed;
use crate::search::{Found, Search, Stop, Target};
use crate::shard::Shard;
use crate::storage::Storage;
use crate::storage::disk::Lost;

/// So many states of a level are read at a time.
const LOADED: usize = 1 << 12;

/// A run from an initial state.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Trace {
    /// What the initial state took from outside.
    pub start: Told,
    /// The initial state.
    pub values: Vec<(Location, Value)>,
    /// The steps. The last one may be one that cannot be made, or one whose inputs violate a condition.
    pub steps: Vec<Told>,
    /// The step that the run goes back to after the last one, again and again; none for a run that ends.
    pub turn: Option<usize>,
    /// The violation is that of a tree of runs, of which this is one branch.
    pub branch: bool,
}

impl Search {
    /// A shortest run to each state found, in the order of `found`. Where files cannot be read, nothing was found.
    pub(crate) fn traces(&mut self, heed: &mut Heed<'_>) -> Vec<Trace> {
        // What was found is to be told, however long that takes.
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

    /// A run that has these representatives: each state is one that the state before leads to. From the representative before
    /// lead steps to a state that the next one represents; the permutation that leads from there to the run's own state leads
    /// to the run's next state, too.
    fn concrete(&mut self, chain: Vec<Box<[u64]>>) -> Vec<Box<[u64]>> {
        let Some(orbits) = self.orbits.clone() else { return chain };
        let explorer = &mut self.explorer;
        let starts: Vec<Box<[u64]>> = explorer.initial().iter().map(|(state, _)| state.clone()).collect();
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

/// The states on the way to each state found, of which all that is before it was looked at.
pub(crate) fn ways(
    explorer: &mut Explorer,
    shards: &mut [Shard],
    orbits: Option<&Orbits>,
    found: &[Found],
) -> Result<Vec<Vec<Box<[u64]>>>, Lost> {
    let mut chains: Vec<Vec<Box<[u64]>>> = found.iter().map(|found| vec![found.state.clone()]).collect();
    let deepest = found.iter().map(|found| found.depth).max().unwrap_or(0);
    for level in (0..deepest).rev() {
        let open: Vec<usize> = (0..chains.len()).filter(|index| found[*index].depth > level).collect();
        let wanted: Vec<Box<[u64]>> =
            open.iter().map(|index| chains[*index][chains[*index].len() - 1].clone()).collect();
        let parents = parents(explorer, shards, orbits, level, &wanted)?;
        for (index, parent) in open.into_iter().zip(parents) {
            chains[index].push(parent);
        }
    }
    chains.iter_mut().for_each(|chain| chain.reverse());
    Ok(chains)
}

/// For each state that is wanted the least state of a level that leads to it.
fn parents(
    explorer: &mut Explorer,
    shards: &mut [Shard],
    orbits: Option<&Orbits>,
    level: usize,
    wanted: &[Box<[u64]>],
) -> Result<Vec<Box<[u64]>>, Lost> {
    let mut least: Vec<Option<Box<[u64]>>> = vec![None; wanted.len()];
    let words = explorer.words();
    let mut successors = Vec::new();
    for Shard { store, levels, .. } in shards {
        let begin = if level == 0 { 0 } else { levels[level - 1] };
        for place in begin..levels[level] {
            if (place - begin) % LOADED == 0 && !store.load(place..levels[level].min(place + LOADED)) {
                return Err(Lost);
            }
            let state = store.state(place);
            successors.clear();
            if explorer.expand(state, &mut successors).is_err() {
                continue;
            }
            if let Some(orbits) = orbits {
                explorer.normalise(orbits, &mut successors);
            }
            for (wanted, least) in wanted.iter().zip(&mut least) {
                let leads = successors.chunks_exact(words).any(|successor| *successor == **wanted);
                if leads && least.as_deref().is_none_or(|former| explorer.compare(state, former).is_lt()) {
                    *least = Some(state.into());
                }
            }
        }
    }
    let found = least.into_iter().map(|state| state.expect("a state is met from one of the level before"));
    Ok(found.collect())
}

/// The first alternative of a state that is as wanted.
fn first_path(explorer: &mut Explorer, state: &[u64], wanted: &mut dyn FnMut(&Path) -> bool) -> Option<Path> {
    let mut first = None;
    let _ = explorer.paths_until(state, &mut |path| {
        if wanted(&path) {
            first = Some(path);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    first
}

/// The answers of the first alternative that leads from one state to another.
pub(crate) fn picks_between(explorer: &mut Explorer, from: &[u64], to: &[u64]) -> Vec<u32> {
    let mut leads = |path: &Path| matches!(&path.outcome, Outcome::Next(next) if **next == *to);
    first_path(explorer, from, &mut leads).expect("the step was made before").picks
}

/// The steps from an initial state along a chain of states.
pub(crate) fn tell_way(explorer: &mut Explorer, chain: &[Box<[u64]>]) -> Trace {
    let start = explorer.initial().iter().find(|(state, _)| *state == chain[0]).map(|(_, start)| *start);
    let start = start.map(|start| explorer.told_of_start(start)).unwrap_or_default();
    let mut trace = Trace { start, values: explorer.values(&chain[0]), steps: Vec::new(), turn: None, branch: false };
    for pair in chain.windows(2) {
        let picks = picks_between(explorer, &pair[0], &pair[1]);
        trace.steps.push(explorer.tell(&pair[0], &picks));
    }
    trace
}

pub(crate) fn tell(explorer: &mut Explorer, chain: &[Box<[u64]>], found: &Found) -> Trace {
    let mut trace = tell_way(explorer, chain);
    let last = &chain[chain.len() - 1];
    let path = match found.target {
        Target::Fault(class) => first_path(
            explorer,
            last,
            &mut |path| matches!(&path.outcome, Outcome::Fault(fault) if FaultClass::of(fault) as usize == class),
        ),
        Target::StepCondition(condition) => {
            first_path(explorer, last, &mut |path| path.failed.contains(&(condition as u32)))
        }
        Target::Rest | Target::Condition(_) => None,
    };
    if let Some(path) = path {
        trace.steps.push(explorer.tell(last, &path.picks));
    }
    trace
}
