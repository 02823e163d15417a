//! What shows a verdict: both runs side by side to the first step that nothing matches, or the diagrams that the answers use.
//!
//! In: a solved game. Out: a [`Refutation`]. The concrete machine plays so that it wins soonest, the abstract one so that it loses latest.
//! INVARIANT: both runs are runs of their machines, and the states at the ends of the diagrams told correspond.

use std::collections::{BTreeMap, VecDeque};

use explore::Told;
use machine::{Location, Show, Value};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::behind::Broken;
use crate::circles::Lasso;
use crate::coupling::is_fair;
use crate::game::{Alive, Lost, Solution};
use crate::product::{Answers, Node, NodeId, PairId, Product};
use crate::readings::Readings;
use crate::side::{Move, StateId};
use crate::why::{Differs, Part, why};
use crate::{ABSTRACT, CONCRETE};

/// LIMIT: so many of the best candidates are told.
const TRIED: usize = 3;

/// A run of one machine.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Run {
    /// The inputs and choices of the initial state.
    pub start: Told,
    /// The initial state.
    pub values: Vec<(Location, Value)>,
    /// The steps; of a fault the last one cannot be made.
    pub steps: Vec<Told>,
}

/// A diagram of the runs: so many steps of each machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Segment {
    /// Of the abstract machine.
    pub m: usize,
    /// Of the concrete machine.
    pub n: usize,
}

/// What the abstract machine could have done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tried {
    /// Its steps.
    pub steps: Vec<Told>,
    /// The parts of the coupling that do not hold then; none if it comes too late: a diagram may not have so many steps.
    pub parts: Vec<Part>,
}

/// How the runs end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Ended {
    /// No run of the abstract machine matches the concrete steps behind the last diagram.
    Unmatched {
        /// Inputs at which the concrete machine did not look.
        inputs: Differs,
        /// The best candidates.
        tried: Vec<Tried>,
        /// Why steps of the abstract machine cannot be made.
        faults: Vec<String>,
    },
    /// The concrete machine's last step cannot be made.
    Fault,
    /// The concrete machine goes on for ever from the diagram of this index, and the abstract one makes no step.
    Waits(usize),
    /// The concrete machine's segment never ends: behind its last step it goes on as from the step of this index.
    Endless(usize),
}

/// Why the concrete machine does not refine the abstract one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refutation {
    /// The abstract and the concrete run.
    pub runs: [Run; 2],
    /// Their diagrams, in order; concrete steps behind the last of them are those that nothing matches.
    pub segments: Vec<Segment>,
    /// How they end.
    pub ended: Ended,
}

/// How long the abstract machine survives from a node that it loses; none if it wins.
fn survival(
    product: &Product<'_>,
    solution: &Solution,
    node: NodeId,
    alive: Alive<'_>,
    known: &mut FxHashMap<NodeId, Option<u32>>,
) -> Option<u32> {
    if let Some(known) = known.get(&node) {
        return *known;
    }
    if solution.wins(product, node, alive) {
        known.insert(node, None);
        return None;
    }
    let survives = match &product.nodes[node as usize] {
        Node::Begins(all) | Node::Steps(_, all) | Node::Inputs(all) => {
            all.iter().filter_map(|node| survival(product, solution, *node, alive, known)).min()
        }
        Node::Choice(ways) => ways.iter().filter_map(|node| survival(product, solution, *node, alive, known)).max(),
        Node::Answers(end) => {
            let rank = |(pair, _): &(PairId, u32)| solution.lost[*pair as usize].map_or(u32::MAX, |lost| lost.rank);
            Some(end.answers.iter().map(rank).max().unwrap_or(0))
        }
        Node::Fault | Node::Endless | Node::Open(_) => Some(0),
    };
    known.insert(node, survives);
    survives
}

/// What the concrete machine does from a node that it wins: its steps, and where the diagram ends if it does.
struct Play<'p> {
    /// The place of its initial state among all.
    start: Option<usize>,
    steps: Vec<(StateId, Move)>,
    end: Option<&'p Answers>,
    /// The segment never ends.
    is_endless: bool,
}

fn play<'p>(product: &'p Product<'_>, solution: &Solution, node: NodeId, alive: Alive<'_>) -> Play<'p> {
    let mut play = Play { start: None, steps: Vec::new(), end: None, is_endless: false };
    let mut at = node;
    let mut known = FxHashMap::default();
    loop {
        let mut of = |node: NodeId| survival(product, solution, node, alive, &mut known);
        match &product.nodes[at as usize] {
            node @ (Node::Begins(all) | Node::Steps(_, all) | Node::Inputs(all)) => {
                let best = all.iter().enumerate().filter_map(|(place, node)| Some((of(*node)?, place, *node)));
                let Some((_, place, next)) = best.min_by_key(|(survives, ..)| *survives) else { return play };
                match node {
                    Node::Begins(_) => play.start = Some(place),
                    Node::Steps(from, _) => {
                        play.steps.extend(product.sides[CONCRETE].made(*from).map(|moves| (*from, moves[place])));
                    }
                    _ => {}
                }
                at = next;
            }
            Node::Choice(ways) => {
                // The last of equals goes on.
                let best = ways.iter().filter_map(|node| Some((of(*node)?, *node)));
                let Some((_, next)) = best.max_by_key(|(survives, _)| *survives) else { return play };
                at = next;
            }
            Node::Answers(end) => {
                play.end = Some(end);
                return play;
            }
            end @ (Node::Fault | Node::Endless | Node::Open(_)) => {
                play.is_endless = matches!(end, Node::Endless);
                return play;
            }
        }
    }
}

/// Both runs as they are made.
struct Telling<'r, 'c> {
    product: &'r mut Product<'c>,
    runs: [Run; 2],
    segments: Vec<Segment>,
}

impl Telling<'_, '_> {
    fn begin(&mut self, side: usize, state: StateId, start: explore::Start) {
        let of = &mut self.product.sides[side];
        let packed = of.packed(state);
        self.runs[side].start = of.stepper.explorer.told_of_start(start);
        self.runs[side].values = of.stepper.explorer.values(&packed);
    }

    fn step(&mut self, side: usize, from: StateId, made: &Move) {
        self.runs[side].steps.extend(tell(self.product, side, from, made));
    }
}

fn tell(product: &mut Product<'_>, side: usize, from: StateId, made: &Move) -> Option<Told> {
    let given = if side == CONCRETE { product.given(from) } else { Vec::new() };
    let bridge = &product.judge.coupling.joint.bridges[side];
    product.sides[side].told(from, made, &given, &mut product.inputs, bridge)
}

/// The runs that show why the game is lost.
pub(crate) fn refutation(product: &mut Product<'_>, solution: &Solution) -> Refutation {
    let mut telling = Telling { product, runs: Default::default(), segments: Vec::new() };
    // The pairs at the ends of diagrams, from the first, each with the condition of fairness that is to be met next.
    let mut visited: Vec<(PairId, usize)> = Vec::new();
    let mut at: Option<PairId> = None;
    let mut fair = 0;
    loop {
        let product = &*telling.product;
        let lost = at.and_then(|pair| solution.lost[pair as usize]);
        let survives = |end: &Answers, pair: PairId, m: u32| match (at, lost) {
            (Some(at), Some(lost)) => {
                solution.outlives(pair, m, lost) || solution.evades(product, end, (at, pair), m, fair)
            }
            _ => solution.lost[pair as usize].is_none(),
        };
        let node = match at {
            None => product.root,
            Some(pair) => product.trees[pair as usize].unwrap_or(product.root),
        };
        let play = play(product, solution, node, &survives);
        let (start, steps, end, is_endless) = (play.start, play.steps, play.end.cloned(), play.is_endless);
        if let Some(start) = start {
            let (_, state, start) = telling.product.begun[start];
            telling.begin(CONCRETE, state, start);
        }
        if let (true, Some(at)) = (is_endless, at) {
            let (_, state) = telling.product.pairs[at as usize];
            if let Some(Lasso { way, circle }) = telling.product.lasso(state) {
                way.iter().chain(&circle).for_each(|(from, made)| telling.step(CONCRETE, *from, made));
                let Telling { runs, segments, .. } = telling;
                let again = runs[CONCRETE].steps.len() - circle.len();
                return Refutation { runs, segments, ended: Ended::Endless(again) };
            }
        }
        for (from, made) in &steps {
            telling.step(CONCRETE, *from, made);
        }
        let Some(end) = end else {
            let Telling { runs, segments, .. } = telling;
            return Refutation { runs, segments, ended: Ended::Fault };
        };
        let Some((pair, m)) = best(solution, &end, lost) else {
            let ended = unmatched(telling.product, at, &end);
            let Telling { mut runs, segments, .. } = telling;
            if at.is_none() {
                runs[ABSTRACT] = Run::default();
            }
            return Refutation { runs, segments, ended };
        };
        let (state, _) = telling.product.pairs[pair as usize];
        match at {
            None => {
                if let Some(start) = telling.product.begun_in(state, end.reads) {
                    telling.begin(ABSTRACT, state, start);
                }
            }
            Some(at) => {
                let (from, _) = telling.product.pairs[at as usize];
                for (from, made) in telling.product.abstract_way(from, state, m, end.reads) {
                    telling.step(ABSTRACT, from, &made);
                }
                telling.segments.push(Segment { m: m as usize, n: steps.len() });
            }
        }
        if m == 0 && end.n > 0 && !solution.turns.is_empty() && solution.meets(telling.product, &end, fair) {
            fair = (fair + 1) % solution.turns.len();
        }
        if let Some(turn) = visited.iter().position(|other| *other == (pair, fair)) {
            let Telling { runs, segments, .. } = telling;
            return Refutation { runs, segments, ended: Ended::Waits(turn) };
        }
        visited.push((pair, fair));
        at = Some(pair);
    }
}

/// The answer that survives longest; where the abstract machine waits for ever, one that waits on.
fn best(solution: &Solution, end: &Answers, lost: Option<Lost>) -> Option<(PairId, u32)> {
    let rank = |pair: PairId| solution.lost[pair as usize].map_or(u32::MAX, |lost| lost.rank);
    let waits = |(pair, m): &&(PairId, u32)| {
        let other = solution.lost[*pair as usize];
        *m == 0 && lost.is_some_and(|lost| lost.waits && other == Some(lost))
    };
    let waiting = end.answers.iter().find(waits);
    waiting.or_else(|| end.answers.iter().max_by_key(|(pair, _)| rank(*pair))).copied()
}

/// What the abstract machine could have done from a pair, none of which matches; or at the beginning.
fn unmatched(product: &mut Product<'_>, at: Option<PairId>, end: &Answers) -> Ended {
    let at = at.map(|at| product.pairs[at as usize]);
    let mut inputs = Vec::new();
    let mut tried = Vec::new();
    let mut faults = Vec::new();
    let candidates: Vec<(StateId, u32)> = match at {
        None => product.initial.iter().map(|(_, state, _)| (*state, 0)).collect(),
        Some((from, _)) => {
            let most = product.judge.coupling.diagrams.most_abstract(end.n).unwrap_or(1);
            match product.abstract_runs(from, end.reads, most) {
                Ok(found) => {
                    faults.extend(found.faults);
                    let free = found.runs.into_iter().filter(|run| run.needs.is_empty());
                    free.map(|run| (run.to, run.m)).collect()
                }
                Err(_) => Vec::new(),
            }
        }
    };
    let mut judged: Vec<(usize, u32, StateId, Vec<usize>)> = Vec::new();
    // An answer that a diagram allows is not hidden by one to the same state that none does.
    let allows = |product: &Product<'_>, m: u32| at.is_none() || product.judge.coupling.diagrams.allows(m, end.n);
    let (allowed, others): (Vec<_>, Vec<_>) = candidates.into_iter().partition(|(_, m)| allows(product, *m));
    for (state, m) in allowed.into_iter().chain(others) {
        if judged.iter().any(|(_, _, other, _)| *other == state) {
            continue;
        }
        let failing = product.judge.failing(&mut product.sides, [state, end.to]);
        judged.push((failing.len(), m, state, failing));
    }
    // The fewest parts fail; of equals one that is allowed is a better try, and an abstract step a better one than none.
    judged.sort_by_key(|(count, m, ..)| (*count, !allows(product, *m), *m == 0, *m));
    judged.truncate(TRIED);
    for (_, m, state, failing) in judged {
        let mut steps = Vec::new();
        if let Some((from, _)) = at {
            for (from, made) in product.abstract_way(from, state, m, end.reads) {
                steps.extend(tell(product, ABSTRACT, from, &made));
            }
        }
        let parts =
            failing.into_iter().map(|index| why(&mut product.judge, &mut product.sides, index, [state, end.to]));
        let mut parts: Vec<Part> = parts.collect();
        if let (0, Some((from, begun)), Some(text)) = (m, at, product.judge.coupling.variant()) {
            let (before, after) = ([from, begun], [from, end.to]);
            if !product.judge.descends(&mut product.sides, before, after) {
                let values = product.judge.descent(&mut product.sides, before, after);
                let values = ["before", "after"].map(str::to_string).into_iter().zip(values).collect();
                let trouble = Some("is negative or does not decrease".to_string());
                parts.push(Part { text: format!("variant {text}"), values, trouble, ..Part::default() });
            }
        }
        tried.push(Tried { steps, parts });
    }
    let program = &product.judge.coupling.joint.program;
    for (location, values) in product.readings.get(end.reads) {
        let (input, arguments) = &product.inputs.told[*location as usize];
        if is_fair(*input) {
            continue;
        }
        let name = &product.judge.coupling.programs[ABSTRACT].functions[*input as usize].name;
        let shown: Vec<String> = arguments.iter().map(|value| value.show(program).to_string()).collect();
        let shown = if shown.is_empty() { name.clone() } else { format!("{name}({})", shown.join(",")) };
        let values: Vec<String> =
            values.iter().map(|value| product.inputs.told_values[*value as usize].show(program).to_string()).collect();
        inputs.push((shown, values.join(" or ")));
    }
    Ended::Unmatched { inputs, tried, faults }
}

/// The run of the concrete machine to a step that it cannot make, whatever the abstract machine answers.
pub(crate) fn breaks(product: &mut Product<'_>, broken: &Broken) -> Refutation {
    let (_, state, start) = product.begun[broken.begun];
    let mut telling = Telling { product, runs: Default::default(), segments: Vec::new() };
    telling.begin(CONCRETE, state, start);
    if let Some((state, start)) = telling.product.beside(broken.begun) {
        telling.begin(ABSTRACT, state, start);
    }
    for (from, made) in &broken.steps {
        telling.step(CONCRETE, *from, made);
    }
    let Telling { runs, segments, .. } = telling;
    Refutation { runs, segments, ended: Ended::Fault }
}

/// Why no initial states correspond.
pub(crate) fn no_initial_pair(product: &mut Product<'_>) -> Refutation {
    let (_, state, start) = product.begun[0];
    let end = Answers { to: state, reads: Readings::NONE, n: 0, answers: Box::default(), unclear: None };
    let ended = unmatched(product, None, &end);
    let mut telling = Telling { product, runs: Default::default(), segments: Vec::new() };
    telling.begin(CONCRETE, state, start);
    if let Some((_, state, start)) = telling.product.initial.first().copied() {
        telling.begin(ABSTRACT, state, start);
    }
    let Telling { runs, segments, .. } = telling;
    Refutation { runs, segments, ended }
}

/// How often the answers found use each diagram.
pub(crate) fn used(product: &Product<'_>, solution: &Solution) -> BTreeMap<(u32, u32), u64> {
    let alive = |_: &Answers, pair: PairId, _: u32| solution.lost[pair as usize].is_none();
    let mut used = BTreeMap::new();
    let mut seen = vec![false; product.pairs.len()];
    let mut trees = VecDeque::from([product.root]);
    // Trees share the nodes in which diagrams end alike; each tree counts its own.
    let (mut open, mut met) = (Vec::new(), FxHashSet::default());
    while let Some(tree) = trees.pop_front() {
        met.clear();
        open.push(tree);
        while let Some(node) = open.pop() {
            if !met.insert(node) {
                continue;
            }
            match &product.nodes[node as usize] {
                Node::Begins(all) | Node::Steps(_, all) | Node::Inputs(all) => open.extend(all.iter().rev()),
                Node::Choice(ways) => open.extend(ways.iter().find(|node| solution.wins(product, **node, &alive))),
                Node::Answers(end) => {
                    let fit = end.answers.iter().filter(|(pair, m)| alive(end, *pair, *m));
                    let Some((pair, m)) = fit.min_by_key(|(_, m)| (*m == 0, *m)) else { continue };
                    if end.n > 0 {
                        *used.entry((*m, end.n)).or_default() += 1;
                    }
                    if !std::mem::replace(&mut seen[*pair as usize], true) {
                        trees.extend(product.trees[*pair as usize]);
                    }
                }
                Node::Fault | Node::Endless | Node::Open(_) => {}
            }
        }
    }
    used
}
