//! Runs of a graph as evidence: a path, or a lasso that repeats forever.

use crate::graph::{Graph, StateId};

/// A run that begins in a state. INVARIANT: each edge leaves the state that the previous one leads to; with a turn, the
/// last edge leads back to the state that edge number `turn` leaves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Run {
    /// The first state.
    pub start: StateId,
    /// The edges taken, by number in the graph.
    pub edges: Vec<usize>,
    /// The edge at which the loop begins; `None` for a path.
    pub turn: Option<usize>,
}

impl Run {
    /// The empty run in a state.
    pub fn at(start: StateId) -> Run {
        Run { start, edges: Vec::new(), turn: None }
    }

    /// A lasso in its shortest form: a loop that repeats itself becomes one turn, and an end of the stem that equals
    /// the end of the loop is removed.
    pub fn lasso(start: StateId, mut stem: Vec<usize>, mut cycle: Vec<usize>) -> Run {
        let turns = |length: &usize| cycle.chunks(*length).all(|part| *part == cycle[..*length]);
        if let Some(length) = (1..cycle.len()).find(turns) {
            cycle.truncate(length);
        }
        let shared = stem.iter().rev().zip(cycle.iter().rev().cycle()).take_while(|(a, b)| a == b).count();
        stem.truncate(stem.len() - shared);
        if !cycle.is_empty() {
            let shift = shared % cycle.len();
            cycle.rotate_right(shift);
        }
        let turn = Some(stem.len());
        stem.extend(cycle);
        Run { start, edges: stem, turn }
    }

    /// The states of the run: one more than edges; for a lasso, the last is the one it returns to.
    pub fn states(&self, graph: &Graph) -> Vec<StateId> {
        std::iter::once(self.start).chain(self.edges.iter().map(|edge| graph.target(*edge))).collect()
    }

    /// The state in which it ends, or to which it returns.
    pub fn last(&self, graph: &Graph) -> StateId {
        self.edges.last().map_or(self.start, |edge| graph.target(*edge))
    }

    /// Appends a run that starts where this path ends.
    pub fn then(mut self, next: Run) -> Run {
        debug_assert!(self.turn.is_none(), "a lasso has no end");
        self.turn = next.turn.map(|turn| turn + self.edges.len());
        self.edges.extend(next.edges);
        self
    }

    /// Whether the invariant of runs holds in a graph.
    pub fn is_run_of(&self, graph: &Graph) -> bool {
        let states = self.states(graph);
        let connected = states.iter().zip(&self.edges).all(|(state, edge)| graph.edges_of(*state).contains(edge));
        connected && self.turn.is_none_or(|turn| turn < self.edges.len() && states[turn] == self.last(graph))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Builder, Label};

    #[test]
    fn a_lasso_is_told_shortly() {
        let run = Run::lasso(0, vec![9, 1, 2], vec![1, 2, 1, 2]);
        assert_eq!(run, Run { start: 0, edges: vec![9, 1, 2], turn: Some(1) });
        let run = Run::lasso(0, vec![9, 2], vec![1, 2]);
        assert_eq!(run, Run { start: 0, edges: vec![9, 2, 1], turn: Some(1) });
        let run = Run::lasso(0, vec![1, 1, 1], vec![1]);
        assert_eq!(run, Run { start: 0, edges: vec![1], turn: Some(0) });
        let run = Run::lasso(0, vec![2, 1, 2], vec![1, 2]);
        assert_eq!(run, Run { start: 0, edges: vec![2, 1], turn: Some(0) });
    }

    #[test]
    fn paths_are_joined_and_checked() {
        let mut builder = Builder::new(0);
        builder.initial();
        builder.edge(1, Label(0));
        builder.state([]);
        builder.edge(0, Label(0));
        builder.edge(1, Label(1));
        builder.state([]);
        let graph = builder.finish();
        let path = Run { start: 0, edges: vec![0], turn: None };
        assert_eq!((path.last(&graph), Run::at(1).last(&graph)), (1, 1));
        let lasso = path.then(Run { start: 1, edges: vec![2], turn: Some(0) });
        assert_eq!(lasso, Run { start: 0, edges: vec![0, 2], turn: Some(1) });
        assert!(lasso.is_run_of(&graph));
        assert_eq!(lasso.states(&graph), [0, 1, 1]);
        assert!(!Run { start: 0, edges: vec![1], turn: None }.is_run_of(&graph));
        assert!(!Run { start: 0, edges: vec![0], turn: Some(0) }.is_run_of(&graph));
    }
}
