//! What a checkpoint keeps of the pairs: which there are, what may happen from each that was looked at, what inputs were in that.
//!
//! In: a product. Out: words; of words a product that has looked at the same pairs. INVARIANT: every number names something, and what is
//! behind a node comes before it.

use explore::Unbounded;
use explore::checkpoint::{Known, Refusal, Words};

use super::{Answers, Node, NodeId, Product, Unclear};
use crate::readings::Readings;
use crate::side::StateId;
use crate::{ABSTRACT, CONCRETE};

const BEGINS: u64 = 0;
const STEPS: u64 = 1;
const INPUTS: u64 = 2;
const CHOICE: u64 = 3;
const ANSWERS: u64 = 4;
const FAULT: u64 = 5;
const ENDLESS: u64 = 6;
const OPEN: u64 = 7;

const CLEAR: u64 = 0;
const UNBOUNDED: u64 = 1;
const LONG: u64 = 2;
const VALUATIONS: u64 = 3;
const BOUNDED: u64 = 4;

impl Product<'_> {
    /// What was found, as words of a checkpoint.
    pub fn keep(&self, words: &mut Vec<u64>) {
        self.readings.keep(words);
        words.push(self.pairs.len() as u64);
        words.extend(self.pairs.iter().flat_map(|(one, other)| [u64::from(*one), u64::from(*other)]));
        words.push(self.nodes.len() as u64);
        self.nodes.iter().for_each(|node| write_node(words, node));
        words.extend(self.trees.iter().map(|tree| tree.map_or(0, |tree| 1 + u64::from(tree))));
    }

    /// Takes over what was kept, before it has looked at a pair; so many were looked at then.
    ///
    /// # Errors
    /// The words are none of this product.
    pub fn take_over(&mut self, found: &[u64], looked_at: usize) -> Result<(), Refusal> {
        let mut words = Words::new(found);
        self.readings = Readings::again(&mut words, &self.inputs)?;
        let states = [ABSTRACT, CONCRETE].map(|side| self.sides[side].count());
        let pairs: Vec<(StateId, StateId)> =
            words.many(|words| Ok((words.below(states[ABSTRACT])?, words.below(states[CONCRETE])?)))?;
        self.numbers = pairs.iter().copied().zip(0..).collect();
        let (fresh, begun) = (self.numbers.len() == pairs.len(), self.nodes.len());
        self.pairs = pairs;
        self.ends.clear();
        let mut nodes = Vec::new();
        let _: Vec<()> = words.many(|words| {
            let node = self.read_node(words, nodes.len())?;
            if let Node::Answers(end) = &node {
                self.ends.insert(end.clone(), nodes.len() as NodeId);
            }
            nodes.push(node);
            Ok(())
        })?;
        self.trees = Vec::with_capacity(self.pairs.len());
        for _ in 0..self.pairs.len() {
            self.trees.push(words.below(nodes.len() + 1)?.checked_sub(1));
        }
        // How the runs begin has been found again.
        let is_begun = nodes.len() >= begun && matches!(nodes[self.root as usize], Node::Begins(_));
        self.nodes = nodes;
        let has_trees = self.trees.get(..looked_at).is_some_and(|trees| trees.iter().all(Option::is_some));
        if fresh && is_begun && has_trees { words.end() } else { Err(Refusal::Damaged) }
    }

    fn read_node(&self, words: &mut Words<'_>, before: usize) -> Result<Node, Refusal> {
        let states = self.sides[CONCRETE].count();
        Ok(match words.word()? {
            BEGINS => Node::Begins(words.many(|words| words.below(before))?),
            STEPS => Node::Steps(words.below(states)?, words.many(|words| words.below(before))?),
            INPUTS => Node::Inputs(words.many(|words| words.below(before))?),
            CHOICE => Node::Choice([words.below(before)?, words.below(before)?]),
            ANSWERS => Node::Answers(Answers {
                to: words.below(states)?,
                reads: words.below(self.readings.len())?,
                n: words.number()?,
                answers: words.many(|words| Ok((words.below(self.pairs.len())?, words.number()?)))?,
                unclear: self.read_unclear(words)?,
            }),
            FAULT => Node::Fault,
            ENDLESS => Node::Endless,
            OPEN => Node::Open(self.read_unclear(words)?.ok_or(Refusal::Damaged)?),
            _ => return Err(Refusal::Damaged),
        })
    }

    fn read_unclear(&self, words: &mut Words<'_>) -> Result<Option<Unclear>, Refusal> {
        Ok(Some(match words.word()? {
            CLEAR => return Ok(None),
            UNBOUNDED => {
                let side = words.below(2)? as usize;
                Unclear::Unbounded(side, Unbounded::of_words(words.take(5)?).ok_or(Refusal::Damaged)?)
            }
            LONG => Unclear::Long,
            VALUATIONS => Unclear::Valuations,
            BOUNDED => Unclear::Bounded(Known(&self.judge.coupling.programs[ABSTRACT]).function(words)?),
            _ => return Err(Refusal::Damaged),
        }))
    }
}

fn write_node(words: &mut Vec<u64>, node: &Node) {
    let all = |words: &mut Vec<u64>, nodes: &[NodeId]| {
        words.push(nodes.len() as u64);
        words.extend(nodes.iter().map(|node| u64::from(*node)));
    };
    match node {
        Node::Begins(nodes) => {
            words.push(BEGINS);
            all(words, nodes);
        }
        Node::Steps(state, nodes) => {
            words.extend([STEPS, u64::from(*state)]);
            all(words, nodes);
        }
        Node::Inputs(nodes) => {
            words.push(INPUTS);
            all(words, nodes);
        }
        Node::Choice([one, other]) => words.extend([CHOICE, u64::from(*one), u64::from(*other)]),
        Node::Answers(Answers { to, reads, n, answers, unclear }) => {
            words.extend([ANSWERS, u64::from(*to), u64::from(*reads), u64::from(*n), answers.len() as u64]);
            words.extend(answers.iter().flat_map(|(pair, m)| [u64::from(*pair), u64::from(*m)]));
            write_unclear(words, *unclear);
        }
        Node::Fault => words.push(FAULT),
        Node::Endless => words.push(ENDLESS),
        Node::Open(unclear) => {
            words.push(OPEN);
            write_unclear(words, Some(*unclear));
        }
    }
}

fn write_unclear(words: &mut Vec<u64>, unclear: Option<Unclear>) {
    match unclear {
        None => words.push(CLEAR),
        Some(Unclear::Unbounded(side, unbounded)) => {
            words.extend([UNBOUNDED, side as u64]);
            words.extend(unbounded.words());
        }
        Some(Unclear::Long) => words.push(LONG),
        Some(Unclear::Valuations) => words.push(VALUATIONS),
        Some(Unclear::Bounded(function)) => words.extend([BOUNDED, u64::from(function.0)]),
    }
}
