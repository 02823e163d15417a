//! The product of a graph with an automaton: the runs of the graph that the automaton reads.
//!
//! A node is a state of the graph, which the automaton is about to read, and a state of the automaton. Only states in
//! which a fair run starts occur. The product is built breadth-first and stored in compressed rows. When the automaton
//! has no more obligations, every fair run from there on is accepted, and the path there is a shortest one.

use std::ops::Range;

use hashbrown::HashMap;
use rustc_hash::FxBuildHasher;

use super::automaton::{Automaton, StateNumber};
use super::letters::Letters;
use crate::graph::StateId;
use crate::temporal::budget::{Budget, Spent};
use crate::temporal::checker::Checker;
use crate::temporal::component::{Edges, Marks};
use crate::temporal::run::Run;

/// The product.
#[derive(Debug, Default)]
pub struct Product {
    nodes: Vec<(StateId, StateNumber)>,
    /// The number of initial nodes, which come first.
    initial: u32,
    /// For each node, its predecessor in the search; an initial node is its own.
    met_from: Vec<u32>,
    /// For each node, and one more, where its edges begin.
    first_edge: Vec<u64>,
    targets: Vec<u32>,
    /// For each edge, the class of its marks.
    classes: Vec<u32>,
    marks: Vec<Marks>,
}

/// How building a product ended.
#[derive(Debug)]
pub enum Made {
    /// At this node the automaton has no more obligations.
    Satisfied(u32),
    /// The product is complete.
    Whole,
}

impl Product {
    /// Builds the product of a graph with the automaton.
    ///
    /// # Errors
    /// The caller asked to stop, or a limit was reached.
    pub fn make(
        checker: &Checker<'_>,
        automaton: &mut Automaton,
        letters: &Letters,
        budget: &mut Budget<'_>,
    ) -> Result<(Product, Made), Spent> {
        let mut making = Making::default();
        making.product.first_edge.push(0);
        let fair = &checker.fair().must;
        for state in checker.graph().initial() {
            if fair.contains(*state) {
                let node = making.node((*state, 0), None);
                if automaton.wants_nothing(0) {
                    return Ok((making.product, Made::Satisfied(node)));
                }
            }
        }
        making.product.initial = making.product.nodes.len() as u32;
        let mut next = 0;
        while let Some((state, reader)) = making.product.nodes.get(next).copied() {
            let letter = letters.at(state);
            let transitions = automaton.transitions(reader, letter, |number| letters.holds(letter, number), budget)?;
            for transition in transitions.iter() {
                for edge in checker.graph().edges_of(state) {
                    budget.work()?;
                    let target = checker.graph().target(edge);
                    if !fair.contains(target) {
                        continue;
                    }
                    let node = making.node((target, transition.target), Some(next as u32));
                    if automaton.wants_nothing(transition.target) {
                        return Ok((making.product, Made::Satisfied(node)));
                    }
                    making.edge(node, transition.marks | checker.marks().of(edge));
                }
            }
            making.product.first_edge.push(making.product.targets.len() as u64);
            budget.within(making.product.nodes.len(), budget.limits.product_states, "states of graph times formula")?;
            next += 1;
        }
        Ok((making.product, Made::Whole))
    }

    /// The initial nodes.
    pub fn initial(&self) -> Vec<u32> {
        (0..self.initial).collect()
    }

    /// The state of the graph at a node.
    pub fn state(&self, node: u32) -> StateId {
        self.nodes[node as usize].0
    }

    /// A shortest path after which the automaton has no more obligations, as at this node. The node's state of the
    /// graph, which is still to be read, is left out.
    pub fn satisfying_path(&self, checker: &Checker<'_>, node: u32) -> Run {
        let mut node = self.met_from[node as usize];
        let mut states = vec![self.state(node)];
        while self.met_from[node as usize] != node {
            node = self.met_from[node as usize];
            states.push(self.state(node));
        }
        states.reverse();
        let graph = checker.graph();
        let edges = states.windows(2).map(|pair| {
            let edge = graph.edges_of(pair[0]).find(|edge| graph.target(*edge) == pair[1]);
            edge.expect("the product follows edges of the graph")
        });
        Run { start: states[0], edges: edges.collect(), turn: None }
    }

    /// The edges of the graph that edges of the product represent; the first one leaves `node`.
    pub fn in_graph(&self, checker: &Checker<'_>, mut node: u32, edges: &[usize]) -> Vec<usize> {
        let graph = checker.graph();
        let mut found = Vec::with_capacity(edges.len());
        for edge in edges {
            let target = self.target(*edge);
            let marks = self.marks(*edge) & checker.all_marks();
            let same = |edge: &usize| graph.target(*edge) == self.state(target) && checker.marks().of(*edge) == marks;
            found.push(graph.edges_of(self.state(node)).find(same).expect("the product follows edges of the graph"));
            node = target;
        }
        found
    }
}

impl Edges for Product {
    fn nodes(&self) -> usize {
        self.nodes.len()
    }
    fn edges_of(&self, node: u32) -> Range<usize> {
        self.first_edge[node as usize] as usize..self.first_edge[node as usize + 1] as usize
    }
    fn target(&self, edge: usize) -> u32 {
        self.targets[edge]
    }
    fn marks(&self, edge: usize) -> Marks {
        self.marks[self.classes[edge] as usize]
    }
}

#[derive(Default)]
struct Making {
    product: Product,
    known: HashMap<(StateId, StateNumber), u32, FxBuildHasher>,
    classes: HashMap<Marks, u32, FxBuildHasher>,
}

impl Making {
    fn node(&mut self, node: (StateId, StateNumber), from: Option<u32>) -> u32 {
        let next = self.product.nodes.len() as u32;
        let number = *self.known.entry(node).or_insert(next);
        if number == next {
            self.product.nodes.push(node);
            self.product.met_from.push(from.unwrap_or(next));
        }
        number
    }

    fn edge(&mut self, target: u32, marks: Marks) {
        let next = self.product.marks.len() as u32;
        let class = *self.classes.entry(marks).or_insert(next);
        if class == next {
            self.product.marks.push(marks);
        }
        self.product.targets.push(target);
        self.product.classes.push(class);
    }
}
