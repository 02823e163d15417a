//! Fairness: which infinite runs count.
//!
//! Justice (weak fairness): something occurs infinitely often. Compassion (strong fairness): if one thing occurs
//! infinitely often, so does another (Manna, Pnueli, *The Temporal Logic of Reactive and Concurrent Systems*, 1992).
//! Constraints are sets of edges; a set of states stands for the edges that leave them.

use crate::graph::{Graph, StateId, StateSet};
use crate::temporal::component::{Acceptance, Marks};

/// Fairness constraints; a run is fair if it satisfies all of them.
#[derive(Debug, Clone, Default)]
pub struct Fairness {
    justice: Vec<StateSet>,
    compassion: Vec<(StateSet, StateSet)>,
}

/// The assumed fairness of scheduling agents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AgentFairness {
    /// An agent that is always able to move from some time on moves infinitely often.
    Weak,
    /// An agent that is infinitely often able to move moves infinitely often.
    Strong,
}

/// LIMIT: the constraints of one property; a compassion counts twice.
pub const MOST_MARKS: usize = 64;

impl Fairness {
    /// No constraint: every run is fair.
    pub fn none() -> Fairness {
        Fairness::default()
    }

    /// Whether every run is fair.
    pub fn is_empty(&self) -> bool {
        self.justice.is_empty() && self.compassion.is_empty()
    }

    /// The number of marks that the constraints need.
    pub fn marks(&self) -> usize {
        self.justice.len() + 2 * self.compassion.len()
    }

    /// Requires that these states occur infinitely often.
    pub fn add_justice(&mut self, graph: &Graph, states: &StateSet) {
        self.justice.push(leaving(graph, states));
    }

    /// Requires that if the first states occur infinitely often, so do the second.
    pub fn add_compassion(&mut self, graph: &Graph, premise: &StateSet, conclusion: &StateSet) {
        self.compassion.push((leaving(graph, premise), leaving(graph, conclusion)));
    }

    /// Requires that an agent moves infinitely often if it can. `moves` tells, for a state and one of its edges,
    /// whether that is a step of the agent which changes something. Without such an edge the agent cannot move in that
    /// state.
    pub fn add_agent(&mut self, graph: &Graph, fairness: AgentFairness, moves: impl Fn(StateId, usize) -> bool) {
        let mut taken = StateSet::none(graph.edges());
        let mut enabled = StateSet::none(graph.states());
        for state in 0..graph.states() as StateId {
            for edge in graph.edges_of(state) {
                if moves(state, edge) {
                    taken.insert(edge as u32);
                    enabled.insert(state);
                }
            }
        }
        match fairness {
            AgentFairness::Weak => {
                taken.unite(&leaving(graph, &enabled.complement()));
                self.justice.push(taken);
            }
            AgentFairness::Strong => self.compassion.push((leaving(graph, &enabled), taken)),
        }
    }

    /// The acceptance condition for the marks of [`Fairness::marks_of_edges`], numbered from `from`.
    pub fn acceptance(&self, from: usize) -> Acceptance {
        let mut acceptance = Acceptance::default();
        for index in 0..self.justice.len() {
            acceptance.again |= Marks::one(from + index);
        }
        let from = from + self.justice.len();
        let pairs =
            (0..self.compassion.len()).map(|pair| (Marks::one(from + 2 * pair), Marks::one(from + 2 * pair + 1)));
        acceptance.pairs.extend(pairs);
        acceptance
    }

    /// The marks of each edge, numbered from `from`.
    pub fn marks_of_edges(&self, graph: &Graph, from: usize) -> EdgeMarks {
        if self.is_empty() {
            return EdgeMarks::default();
        }
        let pairs = self.compassion.iter().flat_map(|(premise, conclusion)| [premise, conclusion]);
        let sets: Vec<&StateSet> = self.justice.iter().chain(pairs).collect();
        let mut classes = Vec::with_capacity(graph.edges());
        let mut marks: Vec<Marks> = Vec::new();
        let mut known = std::collections::BTreeMap::new();
        for edge in 0..graph.edges() as u32 {
            let mut own = Marks::NONE;
            for (index, set) in sets.iter().enumerate() {
                if set.contains(edge) {
                    own |= Marks::one(from + index);
                }
            }
            classes.push(*known.entry(own).or_insert_with(|| {
                marks.push(own);
                marks.len() as u32 - 1
            }));
        }
        EdgeMarks { classes, marks }
    }
}

/// The edges that leave states of a set.
fn leaving(graph: &Graph, states: &StateSet) -> StateSet {
    let mut edges = StateSet::none(graph.edges());
    for state in states.iter() {
        graph.edges_of(state).for_each(|edge| {
            edges.insert(edge as u32);
        });
    }
    edges
}

/// The marks of a graph's edges; edges with the same marks form a class.
#[derive(Debug, Clone, Default)]
pub struct EdgeMarks {
    /// For each edge; empty if no edge is marked.
    classes: Vec<u32>,
    marks: Vec<Marks>,
}

impl EdgeMarks {
    /// The class of an edge.
    #[inline]
    pub fn class(&self, edge: usize) -> u32 {
        self.classes.get(edge).copied().unwrap_or(0)
    }

    /// The marks of a class.
    pub fn of_class(&self, class: u32) -> Marks {
        self.marks.get(class as usize).copied().unwrap_or(Marks::NONE)
    }

    /// The marks of an edge.
    #[inline]
    pub fn of(&self, edge: usize) -> Marks {
        self.of_class(self.class(edge))
    }
}
