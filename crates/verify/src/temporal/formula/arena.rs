//! Formulas as a table of nodes without duplicates, children before parents.
//!
//! In: nodes. Out: their numbers. INVARIANT: a node's children have smaller numbers, so a pass over the table in order
//! needs no recursion, however deep the formula.

use std::collections::BTreeMap;

/// The number of a formula in its table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FormulaId(pub u32);

impl FormulaId {
    /// The index of the formula in tables.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The table.
#[derive(Debug, Clone)]
pub struct Arena<N> {
    nodes: Vec<N>,
    known: BTreeMap<N, FormulaId>,
}

impl<N> Default for Arena<N> {
    fn default() -> Self {
        Arena { nodes: Vec::new(), known: BTreeMap::new() }
    }
}

impl<N: Copy + Ord> Arena<N> {
    /// The number of a node, which is added if it is new.
    pub fn add(&mut self, node: N) -> FormulaId {
        let next = FormulaId(self.nodes.len() as u32);
        let id = *self.known.entry(node).or_insert(next);
        if id == next {
            self.nodes.push(node);
        }
        id
    }

    /// The node of a number.
    pub fn node(&self, id: FormulaId) -> N {
        self.nodes[id.index()]
    }

    /// All nodes, in the order of their numbers.
    pub fn nodes(&self) -> &[N] {
        &self.nodes
    }
}
