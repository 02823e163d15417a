//! Who wins: whether the abstract machine can answer for ever whatever the concrete one does.
//!
//! In: a [`Product`]. Out: a [`Solution`]: which pairs are lost, in which order, and how. A pair is lost if the concrete machine can do
//! what only lost pairs answer (the greatest fixpoint), or if it can go on for ever while the abstract machine makes no step (the least
//! fixpoint within it: between any two diagrams with an abstract step there are finitely many without). INVARIANT: what is not known
//! counts for the abstract machine if the question is whether the refinement fails, and against it if the question is whether it holds.

use std::collections::VecDeque;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::product::{Node, NodeId, PairId, Product};

/// How a pair was lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Lost {
    /// When; of pairs that are lost together the same.
    pub rank: u32,
    /// The abstract machine could only wait for ever.
    pub waits: bool,
}

/// See the module.
#[derive(Debug)]
pub(crate) struct Solution {
    /// By pair.
    pub lost: Vec<Option<Lost>>,
    /// Whether each initial state is answered.
    pub won: bool,
    /// What is not known counts for the abstract machine.
    pub hopeful: bool,
}

impl Solution {
    /// Whether a node is won, given which pairs are: after so many abstract steps.
    pub fn wins(&self, product: &Product<'_>, node: NodeId, alive: &dyn Fn(PairId, u32) -> bool) -> bool {
        wins(product, node, self.hopeful, alive, &mut Known::default())
    }

    /// Whether a pair was still alive when this one was lost.
    pub fn outlives(&self, pair: PairId, m: u32, lost: Lost) -> bool {
        match self.lost[pair as usize] {
            None => true,
            Some(other) if other.rank == lost.rank => lost.waits && other.waits && m > 0,
            Some(other) => other.rank > lost.rank,
        }
    }
}

/// What nodes of long diagrams came to: several ways may lead to one.
type Known = FxHashMap<NodeId, bool>;

fn wins(
    product: &Product<'_>,
    node: NodeId,
    hopeful: bool,
    alive: &dyn Fn(PairId, u32) -> bool,
    known: &mut Known,
) -> bool {
    if let Some(known) = known.get(&node) {
        return *known;
    }
    let won = match &product.nodes[node as usize] {
        Node::Deeds(deeds) => deeds.iter().all(|(_, node)| wins(product, *node, hopeful, alive, known)),
        Node::Choice(ways) => ways.iter().any(|node| wins(product, *node, hopeful, alive, known)),
        Node::Answers(end) => {
            end.answers.iter().any(|(pair, m)| alive(*pair, *m)) || (hopeful && end.unclear.is_some())
        }
        Node::Fault => false,
        Node::Open(_) => hopeful,
    };
    if matches!(product.nodes[node as usize], Node::Deeds(_) | Node::Choice(_)) {
        known.insert(node, won);
    }
    won
}

/// Calls `visit` with each pair that a node ends in.
fn each_answer(product: &Product<'_>, node: NodeId, visit: &mut dyn FnMut(PairId, u32)) {
    let mut open = vec![node];
    let mut seen = FxHashSet::default();
    while let Some(node) = open.pop() {
        if !seen.insert(node) {
            continue;
        }
        match &product.nodes[node as usize] {
            Node::Deeds(deeds) => open.extend(deeds.iter().map(|(_, node)| *node)),
            Node::Choice(ways) => open.extend(ways),
            Node::Answers(end) => end.answers.iter().for_each(|(pair, m)| visit(*pair, *m)),
            Node::Fault | Node::Open(_) => {}
        }
    }
}

/// Decides all pairs.
pub(crate) fn solve(product: &Product<'_>, hopeful: bool) -> Solution {
    let count = product.pairs.len();
    let mut parents: Vec<Vec<PairId>> = vec![Vec::new(); count];
    let mut ever_waits = false;
    for (pair, tree) in (0..).zip(&product.trees) {
        let Some(tree) = tree else { continue };
        each_answer(product, *tree, &mut |answer, m| {
            ever_waits |= m == 0;
            let of = &mut parents[answer as usize];
            if of.last() != Some(&pair) {
                of.push(pair);
            }
        });
    }
    let mut lost: Vec<Option<Lost>> = vec![None; count];
    let mut rank = 0;
    let mut queue: VecDeque<PairId> = (0..count as PairId).collect();
    let mut queued = vec![true; count];
    loop {
        while let Some(pair) = queue.pop_front() {
            queued[pair as usize] = false;
            if lost[pair as usize].is_some() {
                continue;
            }
            let won = match product.trees[pair as usize] {
                Some(tree) => {
                    wins(product, tree, hopeful, &|pair, _| lost[pair as usize].is_none(), &mut Known::default())
                }
                None => hopeful,
            };
            if !won {
                rank += 1;
                lost[pair as usize] = Some(Lost { rank, waits: false });
                for parent in &parents[pair as usize] {
                    if !std::mem::replace(&mut queued[*parent as usize], true) {
                        queue.push_back(*parent);
                    }
                }
            }
        }
        let waiting = match ever_waits && !product.judge.coupling.waiting {
            true => waiting(product, hopeful, &lost, &parents),
            false => Vec::new(),
        };
        if waiting.is_empty() {
            break;
        }
        rank += 1;
        for pair in waiting {
            lost[pair as usize] = Some(Lost { rank, waits: true });
            for parent in &parents[pair as usize] {
                if !std::mem::replace(&mut queued[*parent as usize], true) {
                    queue.push_back(*parent);
                }
            }
        }
    }
    let won = wins(product, product.root, hopeful, &|pair, _| lost[pair as usize].is_none(), &mut Known::default());
    Solution { lost, won, hopeful }
}

/// The pairs from which the concrete machine can go on for ever while the abstract one makes no step.
fn waiting(product: &Product<'_>, hopeful: bool, lost: &[Option<Lost>], parents: &[Vec<PairId>]) -> Vec<PairId> {
    let count = product.pairs.len();
    let mut moves = vec![false; count];
    let mut queue: VecDeque<PairId> = (0..count as PairId).filter(|pair| lost[*pair as usize].is_none()).collect();
    while let Some(pair) = queue.pop_front() {
        if moves[pair as usize] || lost[pair as usize].is_some() {
            continue;
        }
        let won = match product.trees[pair as usize] {
            None => true,
            Some(tree) => {
                let alive = |pair: PairId, m: u32| match m {
                    0 => moves[pair as usize],
                    _ => lost[pair as usize].is_none(),
                };
                wins(product, tree, hopeful, &alive, &mut Known::default())
            }
        };
        if won {
            moves[pair as usize] = true;
            queue.extend(parents[pair as usize].iter().filter(|parent| !moves[**parent as usize]));
        }
    }
    (0..count as PairId).filter(|pair| lost[*pair as usize].is_none() && !moves[*pair as usize]).collect()
}
