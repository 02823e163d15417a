//! What an explicit search has walked, as one graph: its states in the order in which a single worker meets them, and where
//! each leads.
//!
//! In: the states and [`Edges`] of all workers. Out: a [`Walk`]. INVARIANT: for a search of the same program that makes its steps one
//! after the other, from the initial states on, it is the same graph with the same numbers. If several workers left some
//! states of a level, there is no such order, and no walk.

use std::collections::VecDeque;

use explore::Explorer;

use crate::explicit::edges::{Besides, Edges, LEFT_OUT};
use crate::explorers::Maker;
use crate::progress::Stop;
use crate::table::Table;

/// A state has no number yet.
const NONE: u32 = u32::MAX;

/// See the module.
#[derive(Debug)]
pub(crate) struct Walk {
    /// Makes explorers that pack states as the search did.
    pub maker: Maker,
    /// The one that the search began with.
    pub explorer: Explorer,
    /// Why not all states were expanded, if they were not.
    pub stop: Option<Stop>,
    pub graph: WalkedGraph,
}

/// The states, and where each leads.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct WalkedGraph {
    /// The states, one after the other.
    pub states: Vec<u64>,
    /// How many of the first are initial.
    pub initial: usize,
    /// By state, where its targets end.
    pub ends: Vec<usize>,
    /// By state; none of one that was not expanded.
    pub besides: Vec<Option<Besides>>,
    /// The states that a step leads to, in the order of the alternatives, without the state itself.
    pub targets: Vec<u32>,
}

impl WalkedGraph {
    /// Joins the edges of all workers, each with its states.
    pub fn of(words: usize, shards: &[(&Table, &Edges)]) -> WalkedGraph {
        let mut numbers: Vec<Vec<u32>> = shards.iter().map(|(table, _)| vec![NONE; table.len()]).collect();
        let mut met = WalkedGraph::default();
        let mut next: VecDeque<(usize, usize)> = VecDeque::new();
        let mut number_of = |shard: usize, index: u32, next: &mut VecDeque<_>, states: &mut Vec<u64>| {
            let number = &mut numbers[shard][index as usize];
            if *number == NONE {
                *number = (states.len() / words) as u32;
                states.extend_from_slice(shards[shard].0.state(index as usize));
                next.push_back((shard, index as usize));
            }
            *number
        };
        for (_, edges) in shards {
            for (owner, target) in edges.owners[..edges.roots].iter().zip(&edges.targets) {
                if *target != LEFT_OUT {
                    number_of(usize::from(*owner), *target, &mut next, &mut met.states);
                }
            }
        }
        met.initial = met.states.len() / words;
        while let Some((shard, index)) = next.pop_front() {
            let edges = shards[shard].1;
            met.besides.push(edges.besides.get(index).copied());
            if let Some(end) = edges.ends.get(index) {
                let start = if index == 0 { edges.roots } else { edges.ends[index - 1] as usize };
                for place in start..*end as usize {
                    let target = edges.targets[place];
                    if target != LEFT_OUT {
                        let owner = usize::from(edges.owners[place]);
                        met.targets.push(number_of(owner, target, &mut next, &mut met.states));
                    }
                }
            }
            met.ends.push(met.targets.len());
        }
        met
    }
}
