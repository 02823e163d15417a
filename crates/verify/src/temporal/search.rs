//! Finds short paths: from a node to the nearest edge of some kind, and around a component so that a run is accepted.
//!
//! In: edges with marks. Out: lists of edges. Paths between two nodes are shortest; a cycle is composed of shortest
//! paths and need not be shortest as a whole.

use std::ops::Range;

use crate::temporal::budget::{Budget, Spent};
use crate::temporal::component::{Acceptance, Component, Edges, Marks};

/// A breadth-first search that can be repeated on one graph.
pub struct Finder<'a, E> {
    edges: &'a E,
    /// For each node, the search that visited it last.
    visited: Vec<u32>,
    searches: u32,
    /// For each node, its predecessor in the search.
    from: Vec<u32>,
    by: Vec<u64>,
    /// The number of nodes visited by all searches.
    pub work: u64,
}

impl<'a, E: Edges> Finder<'a, E> {
    /// A search of this graph.
    pub fn new(edges: &'a E) -> Finder<'a, E> {
        let nodes = edges.nodes();
        Finder { edges, visited: vec![0; nodes], searches: 0, from: vec![0; nodes], by: vec![0; nodes], work: 0 }
    }

    /// The edges of a shortest path, at least one, from one of the nodes to a wanted edge, over allowed edges only.
    /// Also returns the first node.
    ///
    /// # Errors
    /// The caller asked to stop.
    pub fn path(
        &mut self,
        starts: &[u32],
        budget: &mut Budget<'_>,
        allowed: impl Fn(usize, u32) -> bool,
        wanted: impl Fn(usize, u32) -> bool,
    ) -> Result<Option<(u32, Vec<usize>)>, Spent> {
        self.searches += 1;
        let mut queue: Vec<u32> = starts.to_vec();
        starts.iter().for_each(|start| self.visited[*start as usize] = self.searches);
        let mut next = 0;
        while let Some(node) = queue.get(next).copied() {
            next += 1;
            self.work += 1;
            budget.work()?;
            for edge in self.edges.edges_of(node) {
                let target = self.edges.target(edge);
                if !allowed(edge, target) {
                    continue;
                }
                if wanted(edge, target) {
                    return Ok(Some(self.back(starts, node, edge)));
                }
                if std::mem::replace(&mut self.visited[target as usize], self.searches) != self.searches {
                    (self.from[target as usize], self.by[target as usize]) = (node, edge as u64);
                    queue.push(target);
                }
            }
        }
        Ok(None)
    }

    fn back(&self, starts: &[u32], mut node: u32, last: usize) -> (u32, Vec<usize>) {
        let mut path = vec![last];
        while !starts.contains(&node) {
            path.push(self.by[node as usize] as usize);
            node = self.from[node as usize];
        }
        path.reverse();
        (node, path)
    }
}

/// A cycle in an accepting component, from one of its nodes back to it, with all marks that must occur.
///
/// # Errors
/// The caller asked to stop.
///
/// # Panics
/// The component is not accepting, or does not contain the node.
pub fn turn<E: Edges>(
    finder: &mut Finder<'_, E>,
    component: &Component,
    acceptance: &Acceptance,
    start: u32,
    budget: &mut Budget<'_>,
) -> Result<Vec<usize>, Spent> {
    let edges = finder.edges;
    let allowed = |edge: usize, target: u32| {
        !edges.marks(edge).meets(component.avoided) && component.nodes.binary_search(&target).is_ok()
    };
    let mut turn: Vec<usize> = Vec::new();
    let mut met = Marks::NONE;
    let mut wanted = acceptance.again;
    loop {
        while wanted.without(met) != Marks::NONE {
            let missing = wanted.without(met);
            let here = turn.last().map_or(start, |edge| edges.target(*edge));
            let (_, path) = finder
                .path(&[here], budget, allowed, |edge, _| edges.marks(edge).meets(missing))?
                .expect("an accepting component has every mark that is asked for");
            met = path.iter().fold(met, |met, edge| met | edges.marks(*edge));
            turn.extend(path);
        }
        let here = turn.last().map_or(start, |edge| edges.target(*edge));
        let mut home = Vec::new();
        if turn.is_empty() || here != start {
            let found = finder.path(&[here], budget, allowed, |_, target| target == start)?;
            home = found.expect("a component is strongly connected").1;
        }
        let marks = home.iter().fold(met, |met, edge| met | edges.marks(*edge));
        let open = acceptance.open_pairs(marks);
        if open == Marks::NONE {
            turn.extend(home);
            return Ok(turn);
        }
        let seconds = acceptance.pairs.iter().filter(|(first, _)| open.meets(*first));
        wanted = seconds.fold(wanted, |wanted, (_, second)| wanted | *second);
    }
}

/// A graph with marks given by a function.
pub struct Marked<'a, F> {
    /// The graph.
    pub graph: &'a crate::graph::Graph,
    /// The marks of an edge.
    pub marks: F,
}

impl<F: Fn(usize) -> Marks> Edges for Marked<'_, F> {
    fn nodes(&self) -> usize {
        self.graph.states()
    }
    fn edges_of(&self, node: u32) -> Range<usize> {
        self.graph.edges_of(node)
    }
    fn target(&self, edge: usize) -> u32 {
        self.graph.target(edge)
    }
    fn marks(&self, edge: usize) -> Marks {
        (self.marks)(edge)
    }
}
