//! The states of a search packed anew, while it goes on.
//!
//! In: the shards of a search between two rounds, and an explorer whose fields are narrower or wider than theirs. Out: shards with the same
//! states on the same levels, findings and edges. Each state goes to the worker that owns it now. INVARIANT: on each level those
//! come first whose steps were made, and their edges are in the order of the states.

use std::ops::Range;

use explore::{Explorer, Unlike};

use crate::explicit::edges::{Edges, LEFT_OUT};
use crate::explicit::shard::{Shard, owner};
use crate::storage::Store;
use crate::table::Table;
use crate::target::Found;

/// States of one worker on one level, all expanded or none.
struct Group {
    shard: usize,
    states: Range<usize>,
}

/// Where a state stands: its owner, and its index there.
type Place = (u8, u32);

/// The same shards as another explorer packs their states.
///
/// # Errors
/// The explorers have other fields, the states are not stored as they are, or there is no memory for all of them.
pub(crate) fn packed_anew(from: &Explorer, to: &mut Explorer, shards: Vec<Shard>) -> Result<Vec<Shard>, Unlike> {
    let tables: Option<Vec<&Table>> = shards.iter().map(|shard| table(&shard.store)).collect();
    let tables = tables.ok_or(Unlike)?;
    let (count, words) = (shards.len(), to.words());
    let mut places: Vec<Vec<Place>> = tables.iter().map(|table| vec![(0, 0); table.len()]).collect();
    let mut stored: Vec<Table> = (0..count).map(|_| Table::new(words)).collect();
    let mut levels: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut next = vec![0; count];
    let depth = shards[0].levels.len();
    let mut mover = to.mover(from)?;
    let mut expanded = Vec::new();
    for level in 0..=depth {
        let (done, open) = groups(&shards, level);
        for (group, is_done) in done.iter().map(|group| (group, true)).chain(open.iter().map(|group| (group, false))) {
            for index in group.states.clone() {
                let state = mover.state(to, tables[group.shard].state(index))?;
                let now = owner(state, count);
                stored[now].insert_each(state, &mut |_| {}, &mut |place| {
                    places[group.shard][index] = (now as u8, place);
                });
                if is_done {
                    next[now] = stored[now].len();
                }
            }
        }
        expanded.extend(done);
        if level < depth {
            levels.iter_mut().zip(&stored).for_each(|(levels, table)| levels.push(table.len()));
        }
    }
    if stored.iter().any(Table::is_full) {
        return Err(Unlike);
    }
    let mut edges = moved_edges(&shards, &places, &expanded);
    let mut moved = Vec::with_capacity(count);
    for (((shard, table), levels), next) in shards.into_iter().zip(stored).zip(levels).zip(next) {
        let mut found = Vec::with_capacity(shard.found.len());
        for one in shard.found {
            let state = mover.state(to, &one.state)?.into();
            found.push(Found { state, ..one });
        }
        let edges = edges.as_mut().map(|edges| std::mem::take(&mut edges[moved.len()]));
        moved.push(Shard { store: Store::Exact(table), levels, next, found, edges, ..shard });
    }
    Ok(moved)
}

fn table(store: &Store) -> Option<&Table> {
    match store {
        Store::Exact(table) => Some(table),
        Store::Spilled(_) | Store::Compact(_) => None,
    }
}

/// The states of a level, one worker after the other: those that were expanded, and the others.
fn groups(shards: &[Shard], level: usize) -> (Vec<Group>, Vec<Group>) {
    let (mut done, mut open) = (Vec::new(), Vec::new());
    for (index, shard) in shards.iter().enumerate() {
        let start = level.checked_sub(1).map_or(0, |before| shard.levels[before]);
        let end = shard.levels.get(level).copied().unwrap_or(shard.store.len());
        let middle = shard.next.clamp(start, end);
        done.push(Group { shard: index, states: start..middle });
        open.push(Group { shard: index, states: middle..end });
    }
    (done, open)
}

/// The edges from where states stand now to where they stand now; none if they were not kept.
fn moved_edges(shards: &[Shard], places: &[Vec<Place>], expanded: &[Group]) -> Option<Vec<Edges>> {
    let kept: Vec<&Edges> = shards.iter().map(|shard| shard.edges.as_ref()).collect::<Option<_>>()?;
    let mut moved: Vec<Edges> = vec![Edges::default(); shards.len()];
    let put = |edges: &mut Edges, owner: u8, target: u32| {
        let (owner, target) =
            if target == LEFT_OUT { (owner, target) } else { places[usize::from(owner)][target as usize] };
        edges.owners.push(owner);
        edges.targets.push(target);
    };
    // Only the first worker knows what leads to the initial states.
    for place in 0..kept[0].roots {
        put(&mut moved[0], kept[0].owners[place], kept[0].targets[place]);
    }
    moved[0].roots = kept[0].roots;
    for group in expanded {
        let edges = kept[group.shard];
        for state in group.states.clone() {
            let now = &mut moved[usize::from(places[group.shard][state].0)];
            let start = state.checked_sub(1).map_or(edges.roots, |before| edges.ends[before] as usize);
            for place in start..edges.ends[state] as usize {
                put(now, edges.owners[place], edges.targets[place]);
            }
            now.ends.push(now.owners.len() as u64);
            now.besides.push(edges.besides[state]);
        }
    }
    Some(moved)
}
