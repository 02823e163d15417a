//! Reference implementations by the definitions, for tiny graphs.

use std::collections::BTreeMap;

use verify::graph::{Graph, StateId};
use verify::temporal::fairness::AgentFairness;
use verify::temporal::formula::{FormulaId, Ltl, LtlFormulas};

use crate::temporal::random::Constraint;

/// Whether a run with exactly these edges infinitely often is fair.
pub fn is_fair(graph: &Graph, constraints: &[Constraint], again: &[usize]) -> bool {
    let source = |edge: usize| (0..graph.states() as u32).find(|s| graph.edges_of(*s).contains(&edge)).unwrap();
    let meets = |set: &[bool]| again.iter().any(|edge| set[source(*edge) as usize]);
    constraints.iter().all(|constraint| match constraint {
        Constraint::Justice(set) => meets(set),
        Constraint::Compassion(first, second) => !meets(first) || meets(second),
        Constraint::Agent(agent, kind) => {
            let moves = |edge: usize| graph.label(edge).0 == *agent && graph.target(edge) != source(edge);
            let able = |state: StateId| graph.edges_of(state).any(moves);
            let acts = again.iter().any(|edge| moves(*edge));
            acts || match kind {
                AgentFairness::Weak => again.iter().any(|edge| !able(source(*edge))),
                AgentFairness::Strong => again.iter().all(|edge| !able(source(*edge))),
            }
        }
    })
}

/// An infinite word: the states of a lasso.
pub struct Word<'a> {
    pub graph: &'a Graph,
    pub states: Vec<StateId>,
    pub turn: usize,
}

impl Word<'_> {
    fn state(&self, position: usize) -> StateId {
        match position < self.states.len() {
            true => self.states[position],
            false => self.states[self.turn + (position - self.turn) % (self.states.len() - self.turn)],
        }
    }
}

/// Evaluates by looking far enough ahead and back to the beginning.
pub struct Evaluation<'a> {
    pub formulas: &'a LtlFormulas,
    pub word: Word<'a>,
    known: BTreeMap<(FormulaId, usize), bool>,
}

impl<'a> Evaluation<'a> {
    pub fn new(formulas: &'a LtlFormulas, word: Word<'a>) -> Evaluation<'a> {
        Evaluation { formulas, word, known: BTreeMap::new() }
    }

    pub fn holds(&mut self, formula: FormulaId, at: usize) -> bool {
        if let Some(known) = self.known.get(&(formula, at)) {
            return *known;
        }
        let truth = match self.formulas.node(formula) {
            Ltl::Constant(truth) => truth,
            Ltl::Proposition(number) => self.word.graph.proposition(number as usize).contains(self.word.state(at)),
            Ltl::Not(p) => !self.holds(p, at),
            Ltl::And(p, q) => self.holds(p, at) && self.holds(q, at),
            Ltl::Next(p) => self.holds(p, at + 1),
            Ltl::Previous(p) => at > 0 && self.holds(p, at - 1),
            Ltl::Until(p, q) => {
                // Truth values are stable after a few turns, and repeat from then on.
                let horizon = at.max(8 * self.word.states.len()) + 2 * self.word.states.len();
                let end = (at..=horizon).find(|later| self.holds(q, *later));
                end.is_some_and(|end| (at..end).all(|before| self.holds(p, before)))
            }
            Ltl::Since(p, q) => {
                let begin = (0..=at).rev().find(|earlier| self.holds(q, *earlier));
                begin.is_some_and(|begin| (begin + 1..=at).all(|after| self.holds(p, after)))
            }
        };
        self.known.insert((formula, at), truth);
        truth
    }
}

/// Calls `visit` with the edges and the turn of each lasso with at most this many edges from an initial state.
pub fn each_lasso(graph: &Graph, most: usize, visit: &mut dyn FnMut(StateId, &[usize], usize)) {
    fn extend(
        graph: &Graph,
        most: usize,
        states: &mut Vec<StateId>,
        edges: &mut Vec<usize>,
        visit: &mut dyn FnMut(StateId, &[usize], usize),
    ) {
        let here = *states.last().unwrap();
        for turn in 0..edges.len() {
            if states[turn] == here {
                visit(states[0], edges, turn);
            }
        }
        if edges.len() == most {
            return;
        }
        for edge in graph.edges_of(here) {
            edges.push(edge);
            states.push(graph.target(edge));
            extend(graph, most, states, edges, visit);
            states.pop();
            edges.pop();
        }
    }
    for state in graph.initial() {
        extend(graph, most, &mut vec![*state], &mut Vec::new(), visit);
    }
}

/// The states of a run with these edges; for a lasso, without the one it returns to.
pub fn states(graph: &Graph, start: StateId, edges: &[usize]) -> Vec<StateId> {
    let targets = edges.iter().map(|edge| graph.target(*edge));
    std::iter::once(start).chain(targets).take(edges.len()).collect()
}

/// For each state, whether a fair run stays within a set forever; tries every set of edges as those taken infinitely
/// often.
pub fn fair_within(graph: &Graph, constraints: &[Constraint], within: &[bool]) -> Vec<bool> {
    let source = |edge: usize| (0..graph.states() as u32).find(|s| graph.edges_of(*s).contains(&edge)).unwrap();
    let inside: Vec<usize> = (0..graph.edges())
        .filter(|edge| within[source(*edge) as usize] && within[graph.target(*edge) as usize])
        .collect();
    assert!(inside.len() <= 12, "the graph is tiny");
    let mut found = vec![false; graph.states()];
    for subset in 1u32..1 << inside.len() {
        let taken: Vec<usize> =
            inside.iter().enumerate().filter(|(i, _)| subset >> i & 1 == 1).map(|(_, e)| *e).collect();
        let nodes: Vec<StateId> = taken.iter().flat_map(|edge| [source(*edge), graph.target(*edge)]).collect();
        let connected = nodes.iter().all(|from| {
            let mut reached = vec![false; graph.states()];
            let mut open = vec![*from];
            while let Some(node) = open.pop() {
                for edge in taken.iter().filter(|edge| source(**edge) == node) {
                    if !std::mem::replace(&mut reached[graph.target(*edge) as usize], true) {
                        open.push(graph.target(*edge));
                    }
                }
            }
            nodes.iter().all(|node| reached[*node as usize])
        });
        if connected && is_fair(graph, constraints, &taken) {
            nodes.iter().for_each(|node| found[*node as usize] = true);
        }
    }
    loop {
        let before = found.clone();
        for edge in &inside {
            found[source(*edge) as usize] |= before[graph.target(*edge) as usize];
        }
        if before == found {
            return found;
        }
    }
}
