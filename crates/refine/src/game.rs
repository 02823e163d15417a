//! Who wins: whether the abstract machine can answer for ever whatever the concrete one does.
//!
//! In: a [`Product`]. Out: a [`Solution`]: which pairs are lost, in which order, and how. A pair is lost if the concrete machine can do
//! what only lost pairs answer (the greatest fixpoint), or if it can go on for ever while the abstract machine makes no step (the least
//! fixpoint within it: between any two diagrams with an abstract step there are finitely many without). INVARIANT: what is not known
//! counts for the abstract machine if the question is whether the refinement fails, and against it if the question is whether it holds.

use std::collections::VecDeque;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::product::{Answers, Node, NodeId, PairId, Product};

/// How a pair was lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Lost {
    /// When; of pairs that are lost together the same.
    pub rank: u32,
    /// The abstract machine could only wait for ever.
    pub waits: bool,
}

/// What the game is played by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Rules {
    /// What is not known counts for the abstract machine.
    pub hopeful: bool,
    /// The abstract machine may make no step for ever.
    pub waiting: bool,
    /// The fewest and the most abstract steps of a diagram, and the most concrete ones; besides what the coupling allows.
    pub least_m: u32,
    pub most_m: u32,
    pub most_n: u32,
}

impl Rules {
    /// Those of the coupling.
    pub fn of(product: &Product<'_>, hopeful: bool) -> Rules {
        let waiting = product.judge.coupling.waiting;
        Rules { hopeful, waiting, least_m: 0, most_m: u32::MAX, most_n: u32::MAX }
    }

    fn allow(&self, end: &Answers, m: u32) -> bool {
        end.from.is_none() || (self.least_m <= m && m <= self.most_m && end.n <= self.most_n)
    }
}

/// See the module.
#[derive(Debug)]
pub(crate) struct Solution {
    /// By pair.
    pub lost: Vec<Option<Lost>>,
    /// Whether each initial state is answered.
    pub won: bool,
    /// What was played by.
    pub rules: Rules,
}

impl Solution {
    /// Whether a node is won, given which pairs are: after so many abstract steps.
    pub fn wins(&self, product: &Product<'_>, node: NodeId, alive: &dyn Fn(PairId, u32) -> bool) -> bool {
        wins(product, node, &self.rules, alive, &mut Known::default())
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
    rules: &Rules,
    alive: &dyn Fn(PairId, u32) -> bool,
    known: &mut Known,
) -> bool {
    if let Some(known) = known.get(&node) {
        return *known;
    }
    let won = match &product.nodes[node as usize] {
        Node::Deeds(deeds) => deeds.iter().all(|(_, node)| wins(product, *node, rules, alive, known)),
        Node::Choice(ways) => ways.iter().any(|node| wins(product, *node, rules, alive, known)),
        Node::Answers(end) => {
            let answered = |(pair, m): &(PairId, u32)| rules.allow(end, *m) && alive(*pair, *m);
            end.answers.iter().any(answered) || (rules.hopeful && end.unclear.is_some())
        }
        Node::Fault => false,
        Node::Open(_) => rules.hopeful,
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
pub(crate) fn solve(product: &Product<'_>, rules: Rules) -> Solution {
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
                    wins(product, tree, &rules, &|pair, _| lost[pair as usize].is_none(), &mut Known::default())
                }
                None => rules.hopeful,
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
        let waiting = match ever_waits && !rules.waiting {
            true => waiting(product, &rules, &lost, &parents),
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
    let won = wins(product, product.root, &rules, &|pair, _| lost[pair as usize].is_none(), &mut Known::default());
    Solution { lost, won, rules }
}

/// The pairs from which the concrete machine can go on for ever while the abstract one makes no step.
fn waiting(product: &Product<'_>, rules: &Rules, lost: &[Option<Lost>], parents: &[Vec<PairId>]) -> Vec<PairId> {
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
                wins(product, tree, rules, &alive, &mut Known::default())
            }
        };
        if won {
            moves[pair as usize] = true;
            queue.extend(parents[pair as usize].iter().filter(|parent| !moves[**parent as usize]));
        }
    }
    (0..count as PairId).filter(|pair| lost[*pair as usize].is_none() && !moves[*pair as usize]).collect()
}
