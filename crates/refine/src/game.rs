//! Who wins: whether the abstract machine can answer for ever whatever the concrete one does.
//!
//! In: a [`Product`]. Out: a [`Solution`]: which pairs are lost, in which order, and how. A pair is lost if the concrete machine can do
//! what only lost pairs answer (the greatest fixpoint), or if it can go on for ever while the abstract machine makes no step (the least
//! fixpoint within it: between any two diagrams with an abstract step there are finitely many without). With conditions of fairness it
//! has to meet each of them again and again meanwhile; the abstract machine may stand still as long as some condition is not met (a
//! greatest fixpoint for each condition within the least one: Piterman, Pnueli and Sa'ar, 2006). INVARIANT: what is not known
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
        end.n == 0 || (self.least_m <= m && m <= self.most_m && end.n <= self.most_n)
    }
}

/// See the module.
#[derive(Debug)]
pub(crate) struct Solution {
    /// By pair.
    pub lost: Vec<Option<Lost>>,
    /// By place of a condition of fairness and pair: of pairs that are lost since the abstract machine waits for ever, how soon the concrete
    /// machine can meet the condition, in an order without a unit.
    pub turns: Vec<Vec<u32>>,
    /// The conditions of fairness that count, by their place in `turns`.
    pub fair: Vec<usize>,
    /// Whether each initial state is answered.
    pub won: bool,
    /// What was played by.
    pub rules: Rules,
}

impl Solution {
    /// Whether a node is won, given which pairs are: after so many abstract steps.
    pub fn wins(&self, product: &Product<'_>, node: NodeId, alive: Alive<'_>) -> bool {
        wins(product, node, &self.rules, alive)
    }

    /// Whether the abstract machine waits from one pair to another while a condition of fairness is not met and comes no nearer.
    pub fn evades(
        &self,
        product: &Product<'_>,
        end: &Answers,
        (from, to): (PairId, PairId),
        m: u32,
        fair: usize,
    ) -> bool {
        let Some(turns) = self.turns.get(fair).filter(|_| m == 0) else { return false };
        let [before, after] = [from, to].map(|pair| self.lost[pair as usize]);
        let stays = before.is_some_and(|lost| lost.waits) && before == after;
        stays && !self.meets(product, end, fair) && turns[to as usize] >= turns[from as usize]
    }

    /// Whether a condition of fairness, by its place, is met in a diagram.
    pub fn meets(&self, product: &Product<'_>, end: &Answers, fair: usize) -> bool {
        product.meets(end, self.fair[fair])
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

/// Whether a pair counts as won, at the end of a diagram with so many abstract steps.
pub(crate) type Alive<'a> = &'a dyn Fn(&Answers, PairId, u32) -> bool;

/// What nodes within a tree came to: several ways may lead to one.
type Known = FxHashMap<NodeId, bool>;

/// Whether a tree is won.
fn wins(product: &Product<'_>, tree: NodeId, rules: &Rules, alive: Alive<'_>) -> bool {
    let mut known = Known::default();
    match product.nodes[tree as usize].all() {
        // Nobody comes to it again.
        Some(all) => all.iter().all(|node| wins_within(product, *node, rules, alive, &mut known)),
        None => wins_within(product, tree, rules, alive, &mut known),
    }
}

fn wins_within(product: &Product<'_>, node: NodeId, rules: &Rules, alive: Alive<'_>, known: &mut Known) -> bool {
    let won = match &product.nodes[node as usize] {
        Node::Answers(end) => {
            let answered = |(pair, m): &(PairId, u32)| rules.allow(end, *m) && alive(end, *pair, *m);
            return end.answers.iter().any(answered) || (rules.hopeful && end.unclear.is_some());
        }
        Node::Fault | Node::Endless => return false,
        Node::Open(_) => return rules.hopeful,
        _ if known.contains_key(&node) => return known[&node],
        Node::Begins(all) | Node::Steps(_, all) | Node::Inputs(all) => {
            all.iter().all(|node| wins_within(product, *node, rules, alive, known))
        }
        Node::Choice(ways) => ways.iter().any(|node| wins_within(product, *node, rules, alive, known)),
    };
    known.insert(node, won);
    won
}

/// By pair, the pairs whose trees end in it.
#[derive(Debug)]
pub(crate) struct Parents {
    /// Where those of each pair begin, and where the last ones end.
    begins: Vec<u32>,
    all: Vec<PairId>,
    /// Some answer has no abstract step.
    waits: bool,
}

impl Parents {
    /// Those of all pairs.
    pub fn of(product: &Product<'_>) -> Parents {
        let mut begins = vec![0; product.pairs.len() + 1];
        let (mut links, mut waits) = (Vec::new(), false);
        let mut own = Vec::new();
        let mut open: Vec<NodeId> = Vec::new();
        let mut seen = FxHashSet::default();
        for (pair, tree) in (0..).zip(&product.trees) {
            own.clear();
            seen.clear();
            open.extend(tree);
            while let Some(node) = open.pop() {
                match &product.nodes[node as usize] {
                    Node::Answers(end) => {
                        waits |= end.answers.iter().any(|(_, m)| *m == 0);
                        own.extend(end.answers.iter().map(|(answer, _)| *answer));
                    }
                    node => open.extend(node.behind().iter().filter(|node| {
                        matches!(product.nodes[**node as usize], Node::Answers(_)) || seen.insert(**node)
                    })),
                }
            }
            own.sort_unstable();
            own.dedup();
            links.extend(own.iter().map(|answer| (*answer, pair)));
        }
        for (answer, _) in &links {
            begins[*answer as usize + 1] += 1;
        }
        for pair in 1..begins.len() {
            begins[pair] += begins[pair - 1];
        }
        let mut all = vec![0; links.len()];
        let mut next = begins.clone();
        for (answer, pair) in links {
            let place = &mut next[answer as usize];
            all[*place as usize] = pair;
            *place += 1;
        }
        Parents { begins, all, waits }
    }

    fn get(&self, pair: PairId) -> &[PairId] {
        &self.all[self.begins[pair as usize] as usize..self.begins[pair as usize + 1] as usize]
    }
}

/// Decides all pairs.
pub(crate) fn solve(product: &Product<'_>, parents: &Parents, rules: Rules) -> Solution {
    solve_fairly(product, parents, rules, (0..product.fair()).collect())
}

/// Decides all pairs, where of the conditions of fairness only these count.
pub(crate) fn solve_fairly(product: &Product<'_>, parents: &Parents, rules: Rules, fair: Vec<usize>) -> Solution {
    let count = product.pairs.len();
    let mut lost: Vec<Option<Lost>> = vec![None; count];
    let mut turns = vec![vec![0; count]; fair.len()];
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
                Some(tree) => wins(product, tree, &rules, &|_, pair, _| lost[pair as usize].is_none()),
                None => rules.hopeful,
            };
            if !won {
                rank += 1;
                lost[pair as usize] = Some(Lost { rank, waits: false });
                for parent in parents.get(pair) {
                    if !std::mem::replace(&mut queued[*parent as usize], true) {
                        queue.push_back(*parent);
                    }
                }
            }
        }
        let waiting = match parents.waits && !rules.waiting {
            true => Waiting::new(product, &rules, &lost, parents).pairs(&fair, &mut turns),
            false => Vec::new(),
        };
        if waiting.is_empty() {
            break;
        }
        rank += 1;
        for pair in waiting {
            lost[pair as usize] = Some(Lost { rank, waits: true });
            for parent in parents.get(pair) {
                if !std::mem::replace(&mut queued[*parent as usize], true) {
                    queue.push_back(*parent);
                }
            }
        }
    }
    let won = wins(product, product.root, &rules, &|_, pair, _| lost[pair as usize].is_none());
    Solution { lost, turns, fair, won, rules }
}

/// Which pairs are lost since the abstract machine can only wait for ever.
struct Waiting<'w, 'c> {
    product: &'w Product<'c>,
    rules: &'w Rules,
    lost: &'w [Option<Lost>],
    parents: &'w Parents,
    /// By pair: the next abstract step comes, or some condition of fairness is no longer met.
    moves: Vec<bool>,
}

impl<'w, 'c> Waiting<'w, 'c> {
    fn new(
        product: &'w Product<'c>,
        rules: &'w Rules,
        lost: &'w [Option<Lost>],
        parents: &'w Parents,
    ) -> Waiting<'w, 'c> {
        Waiting { product, rules, lost, parents, moves: vec![false; product.pairs.len()] }
    }

    /// The pairs from which the concrete machine can go on for ever, and meet each condition of fairness again and again, while the
    /// abstract one makes no step. `turns` receives of each how soon.
    fn pairs(mut self, fair: &[usize], turns: &mut [Vec<u32>]) -> Vec<PairId> {
        let mut grown = self.all_open();
        loop {
            self.advance(grown);
            grown = Vec::new();
            for (fair, turns) in fair.iter().zip(turns.iter_mut()) {
                let kept = self.unfair(*fair, turns);
                kept.iter().for_each(|pair| self.moves[*pair as usize] = true);
                grown.extend(kept.iter().flat_map(|pair| self.parents.get(*pair)));
            }
            if grown.is_empty() {
                return self.all_open();
            }
        }
    }

    /// Whether it is open of a pair.
    fn is_open(&self, pair: PairId) -> bool {
        self.lost[pair as usize].is_none() && !self.moves[pair as usize]
    }

    fn all_open(&self) -> Vec<PairId> {
        (0..self.product.pairs.len() as PairId).filter(|pair| self.is_open(*pair)).collect()
    }

    /// Whether the abstract machine can bring about from a pair what counts as good at the end of a diagram without a step of it, or a
    /// step to a pair that is not lost.
    fn forces(&self, pair: PairId, good: &dyn Fn(&Answers, PairId) -> bool) -> bool {
        let Some(tree) = self.product.trees[pair as usize] else { return true };
        let alive = |end: &Answers, pair: PairId, m: u32| match m {
            0 => self.moves[pair as usize] || good(end, pair),
            _ => self.lost[pair as usize].is_none(),
        };
        wins(self.product, tree, self.rules, &alive)
    }

    /// Finds more pairs that lead to such from which it moves: the least fixpoint, begun at these pairs.
    fn advance(&mut self, begin: Vec<PairId>) {
        let mut queue = VecDeque::from(begin);
        while let Some(pair) = queue.pop_front() {
            if !self.is_open(pair) || !self.forces(pair, &|_, _| false) {
                continue;
            }
            self.moves[pair as usize] = true;
            queue.extend(self.parents.get(pair).iter().filter(|parent| self.is_open(**parent)));
        }
    }

    /// The pairs from which the abstract machine can wait so that a condition is met no more: the greatest fixpoint. Of the others `turns`
    /// receives when they dropped out.
    fn unfair(&self, fair: usize, turns: &mut [u32]) -> Vec<PairId> {
        let candidates = self.all_open();
        let mut kept = vec![false; self.product.pairs.len()];
        candidates.iter().for_each(|pair| kept[*pair as usize] = true);
        let mut queue = VecDeque::from(candidates.clone());
        let mut turn = 0;
        while let Some(pair) = queue.pop_front() {
            if !kept[pair as usize] {
                continue;
            }
            let unmet = |end: &Answers, next: PairId| kept[next as usize] && !self.product.meets(end, fair);
            if self.forces(pair, &unmet) {
                continue;
            }
            kept[pair as usize] = false;
            turn += 1;
            turns[pair as usize] = turn;
            queue.extend(self.parents.get(pair).iter().filter(|parent| kept[**parent as usize]));
        }
        candidates.into_iter().filter(|pair| kept[*pair as usize]).collect()
    }
}
