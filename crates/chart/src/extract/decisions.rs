//! Questions about trees of decisions, and other trees made of them.

use std::collections::BTreeSet;

use super::graph::{Graph, Node};
use crate::symbolic::Reason;

/// What a control state does, if it does anything.
pub(super) type Tree = Option<usize>;

/// What is done in a case, and where it leads.
pub(super) type Leaf = (Vec<String>, usize);

impl Graph<'_> {
    /// Actions in a row before an end.
    pub(super) fn chain(&mut self, actions: &[String], end: usize) -> Result<usize, Reason> {
        actions.iter().rev().try_fold(end, |next, text| self.node(Node::Action(text.clone(), next)))
    }

    /// What is done and where it leads, if nothing is asked.
    pub(super) fn ending(&self, node: usize) -> Option<Leaf> {
        let mut actions = Vec::new();
        let mut node = node;
        loop {
            match &self.nodes[node] {
                Node::Action(text, next) => {
                    actions.push(text.clone());
                    node = *next;
                }
                Node::Target(_) | Node::Region(_) => return Some((actions, node)),
                Node::Guard(..) => return None,
            }
        }
    }

    /// The parts in which something is done or ends, each once, and the tests.
    fn parts(&self, node: usize) -> (Vec<usize>, BTreeSet<usize>) {
        let (mut leaves, mut tests, mut seen) = (Vec::new(), BTreeSet::new(), BTreeSet::new());
        let mut open = vec![node];
        while let Some(node) = open.pop() {
            if !seen.insert(node) {
                continue;
            }
            match &self.nodes[node] {
                Node::Guard(_, yes, no) => {
                    tests.insert(node);
                    open.extend(yes.iter().chain(no));
                }
                Node::Action(..) | Node::Target(_) | Node::Region(_) => leaves.push(node),
            }
        }
        (leaves, tests)
    }

    pub(super) fn leaves(&self, node: usize) -> Vec<Leaf> {
        self.parts(node).0.into_iter().filter_map(|leaf| self.ending(leaf)).collect()
    }

    pub(super) fn atoms(&self, tree: Tree) -> BTreeSet<String> {
        let tests = tree.map(|node| self.parts(node).1).unwrap_or_default();
        tests
            .into_iter()
            .filter_map(|node| match &self.nodes[node] {
                Node::Guard(atom, ..) => Some(atom.clone()),
                Node::Action(..) | Node::Target(_) | Node::Region(_) => None,
            })
            .collect()
    }

    /// Whether all ways lead somewhere.
    pub(super) fn is_closed(&self, node: usize) -> bool {
        let leads_on = |test: &usize| !matches!(&self.nodes[*test], Node::Guard(_, None, _) | Node::Guard(_, _, None));
        self.parts(node).1.iter().all(leads_on)
    }

    /// The same decisions with other ends.
    pub(super) fn mapped(&mut self, node: usize, end: &mut dyn FnMut(Leaf) -> Leaf) -> Result<usize, Reason> {
        if let Some(leaf) = self.ending(node) {
            let (actions, to) = end(leaf);
            return self.chain(&actions, to);
        }
        let Node::Guard(atom, yes, no) = self.nodes[node].clone() else { return Ok(node) };
        let yes = yes.map(|yes| self.mapped(yes, end)).transpose()?;
        let no = no.map(|no| self.mapped(no, end)).transpose()?;
        if yes == no { Ok(yes.unwrap_or(node)) } else { self.node(Node::Guard(atom, yes, no)) }
    }

    /// The same decisions with one test first; nothing if they do not depend on it.
    pub(super) fn asking(&mut self, tree: Option<usize>, atom: &str) -> Result<Option<usize>, Reason> {
        let (yes, no) = (self.knowing(tree, atom, true)?, self.knowing(tree, atom, false)?);
        if yes == no { Ok(None) } else { self.node(Node::Guard(atom.to_string(), yes, no)).map(Some) }
    }

    fn knowing(&mut self, tree: Option<usize>, atom: &str, holds: bool) -> Result<Option<usize>, Reason> {
        let Some(node) = tree else { return Ok(None) };
        match self.nodes[node].clone() {
            Node::Guard(test, yes, no) if test == atom => Ok(if holds { yes } else { no }),
            Node::Guard(test, yes, no) => {
                let (yes, no) = (self.knowing(yes, atom, holds)?, self.knowing(no, atom, holds)?);
                if yes == no { Ok(yes) } else { self.node(Node::Guard(test, yes, no)).map(Some) }
            }
            Node::Action(..) | Node::Target(_) | Node::Region(_) => Ok(tree),
        }
    }

    /// Whether a tree is that path, with one and the same `hole` wherever it leads nowhere.
    pub(super) fn fits(&self, path: Tree, tree: Tree, hole: &mut Option<Tree>) -> bool {
        let Some(node) = path else { return *hole.get_or_insert(tree) == tree };
        if path == tree && self.is_closed(node) {
            return true;
        }
        let Some(tree) = tree else { return false };
        match (&self.nodes[node], &self.nodes[tree]) {
            (Node::Guard(atom, yes, no), Node::Guard(test, tree_yes, tree_no)) => {
                atom == test && self.fits(*yes, *tree_yes, hole) && self.fits(*no, *tree_no, hole)
            }
            _ => false,
        }
    }

    /// A path with another one wherever it leads nowhere.
    pub(super) fn filled(&mut self, path: usize, rest: usize) -> Result<usize, Reason> {
        match self.nodes[path].clone() {
            Node::Guard(atom, yes, no) => {
                let mut filled = |tree: Tree| tree.map_or(Ok(rest), |node| self.filled(node, rest));
                let (yes, no) = (filled(yes)?, filled(no)?);
                self.node(Node::Guard(atom, Some(yes), Some(no)))
            }
            Node::Action(..) | Node::Target(_) | Node::Region(_) => Ok(path),
        }
    }
}
