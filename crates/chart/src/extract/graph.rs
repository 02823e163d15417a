//! What a rule does in each control state, as a graph of tests and actions.
//!
//! In: the effects of a rule in one control state, with the tests that lead to them. Out: the root of a tree of decisions, whose leaves
//! are actions in a row and the control state that they lead to. Equal parts are one part.

use std::collections::{BTreeMap, BTreeSet};

use crate::symbolic::{Effect, Guarded, Path, Reason, consistent};

/// LIMIT: how many guards, actions and states a machine may have.
const MAX_SHAPES: usize = 1000;

/// An effect with its remaining tests.
type Open<'e> = (Path, &'e Guarded);

/// A shape, and what it leads to.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Node {
    /// A test, and where it leads if it holds, and if it does not; nowhere if nothing is done then.
    Guard(String, Option<usize>, Option<usize>),
    /// What is done.
    Action(String, usize),
    /// A value of the control variable; `undef` is the exit.
    Target(String),
    /// A composite state, by its number.
    Region(usize),
}

impl Node {
    /// What it leads to.
    pub(super) fn next(&self) -> impl Iterator<Item = usize> + use<> {
        match self {
            Node::Guard(_, yes, no) => [*yes, *no].into_iter().flatten(),
            Node::Action(_, next) => [Some(*next), None].into_iter().flatten(),
            Node::Target(_) | Node::Region(_) => [None, None].into_iter().flatten(),
        }
    }
}

/// Guards, actions and targets; equal nodes are shared.
pub(super) struct Graph<'c> {
    control: &'c str,
    pub(super) nodes: Vec<Node>,
    index: BTreeMap<Node, usize>,
    limit: usize,
}

impl<'c> Graph<'c> {
    pub(super) fn new(control: &'c str) -> Graph<'c> {
        Graph { control, nodes: Vec::new(), index: BTreeMap::new(), limit: MAX_SHAPES }
    }

    /// The same with room for parts that come and go.
    pub(super) fn roomy(&self) -> Graph<'c> {
        Graph { nodes: self.nodes.clone(), index: self.index.clone(), limit: 100 * MAX_SHAPES, ..*self }
    }

    /// What these roots lead to, and the roots in it.
    pub(super) fn only(&self, roots: &[usize]) -> Result<(Graph<'c>, Vec<usize>), Reason> {
        let mut is_used = vec![false; self.nodes.len()];
        let mut open = roots.to_vec();
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut is_used[node], true) {
                open.extend(self.nodes[node].next());
            }
        }
        let mut kept = Graph::new(self.control);
        let mut places = vec![0; self.nodes.len()];
        // A part stands behind those that it leads to.
        for (index, node) in self.nodes.iter().enumerate().filter(|(index, _)| is_used[*index]) {
            places[index] = kept.node(match node {
                Node::Guard(atom, yes, no) => {
                    Node::Guard(atom.clone(), yes.map(|yes| places[yes]), no.map(|no| places[no]))
                }
                Node::Action(text, next) => Node::Action(text.clone(), places[*next]),
                end => end.clone(),
            })?;
        }
        Ok((kept, roots.iter().map(|root| places[*root]).collect()))
    }

    pub(super) fn node(&mut self, node: Node) -> Result<usize, Reason> {
        if let Some(index) = self.index.get(&node) {
            return Ok(*index);
        }
        if self.nodes.len() >= self.limit {
            return Err(Reason::Large);
        }
        self.nodes.push(node.clone());
        self.index.insert(node, self.nodes.len() - 1);
        Ok(self.nodes.len() - 1)
    }

    /// The decisions and actions of some effects; empty if there are none. There are several trees only if one case
    /// sets the control location to several values: such updates clash, and so do the paths.
    pub(super) fn trees(&mut self, effects: &[Guarded], origin: &str) -> Result<Vec<usize>, Reason> {
        let effects: Vec<Open<'_>> = effects.iter().map(|guarded| (guarded.path.clone(), guarded)).collect();
        let mut found = Vec::new();
        while let Some(tree) = self.tree(&effects, origin, found.len())? {
            found.push(tree);
        }
        Ok(found)
    }

    fn tree(&mut self, effects: &[Open<'_>], origin: &str, layer: usize) -> Result<Option<usize>, Reason> {
        if effects.is_empty() {
            return Ok(None);
        }
        let Some((path, _)) = effects.iter().find(|(path, _)| !path.is_empty()) else {
            return self.leaf(effects, origin, layer);
        };
        let atom = path[0].0.clone();
        let side = |wanted: bool| -> Vec<Open<'_>> {
            let fits = effects.iter().filter(|(path, _)| consistent(path, &vec![(atom.clone(), wanted)]));
            fits.map(|(path, guarded)| (path.iter().filter(|(known, _)| *known != atom).cloned().collect(), *guarded))
                .collect()
        };
        let (yes, no) = (self.tree(&side(true), origin, layer)?, self.tree(&side(false), origin, layer)?);
        match (yes, no) {
            (yes, no) if yes == no => Ok(yes),
            (yes, no) => self.node(Node::Guard(atom, yes, no)).map(Some),
        }
    }

    /// What is done in one case. Further layers contain only the further values of the control location.
    fn leaf(&mut self, effects: &[Open<'_>], origin: &str, layer: usize) -> Result<Option<usize>, Reason> {
        let mut targets: Vec<&str> = Vec::new();
        let mut actions: Vec<String> = Vec::new();
        for (_, guarded) in effects {
            match &guarded.effect {
                Effect::Update { location, value, .. } if location == self.control => {
                    if !targets.contains(&value.as_str()) {
                        targets.push(value);
                    }
                }
                Effect::Update { location, value, .. } => actions.push(format!("{location} := {value}")),
                Effect::Rule(text) => actions.push(text.clone()),
            }
        }
        let target = targets.get(layer).copied().or((layer == 0).then_some(origin));
        let Some(target) = target else { return Ok(None) };
        let mut next = self.node(Node::Target(target.to_string()))?;
        let mut seen = BTreeSet::new();
        for action in actions.into_iter().rev().filter(|_| layer == 0) {
            if seen.insert(action.clone()) {
                next = self.node(Node::Action(action, next))?;
            }
        }
        Ok(Some(next))
    }
}
