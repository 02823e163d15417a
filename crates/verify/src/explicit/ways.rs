//! Finds shortest runs to states among the stored states: see [`crate::explicit::traces`].

use explore::{Explorer, Orbits};

use crate::explicit::shard::Shard;
use crate::storage::disk::Lost;
use crate::target::Found;

/// How many states of a level are read at a time.
const LOADED: usize = 1 << 12;

/// The states on the way to each found state; all levels before it must be explored.
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

/// For each wanted state, the least state of a level that leads to it.
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
