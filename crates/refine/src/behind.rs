//! Steps of the concrete machine that cannot be made, behind what is not clear.
//!
//! In: a product in which all pairs were looked at, and some answers are not clear. Out: a run of the concrete machine to a step that it
//! cannot make, a shortest one. Whatever the abstract machine may answer on the way, such a step refutes the refinement; behind an
//! unclear answer no pair leads to it. INVARIANT: where nothing is found, nothing is said.

use std::collections::VecDeque;

use rustc_hash::FxHashMap;

use crate::CONCRETE;
use crate::product::{Node, Product};
use crate::side::{Goal, Move, StateId, Stopped};

/// LIMIT: so many states of the concrete machine are looked at.
const STATES: usize = 1 << 14;

/// A run of the concrete machine: its start, and its steps, of which the last cannot be made.
#[derive(Debug)]
pub(crate) struct Broken {
    pub begun: usize,
    pub steps: Vec<(StateId, Move)>,
}

/// Whether anything was not clear.
pub(crate) fn is_unclear(product: &Product<'_>) -> bool {
    product.nodes.iter().any(|node| match node {
        Node::Answers(end) => end.unclear.is_some(),
        Node::Open(_) => true,
        Node::Begins(_) | Node::Steps(..) | Node::Inputs(_) | Node::Choice(_) | Node::Fault | Node::Endless => false,
    })
}

/// A run to a step that cannot be made.
///
/// # Errors
/// Whoever waits has had enough, or states need more room.
pub(crate) fn broken(product: &mut Product<'_>) -> Result<Option<Broken>, Stopped> {
    let begun: Vec<StateId> = product.begun.iter().map(|(_, state, _)| *state).collect();
    let mut before: FxHashMap<StateId, Option<(StateId, Move)>> = begun.iter().map(|state| (*state, None)).collect();
    let mut queue: VecDeque<StateId> = begun.iter().copied().collect();
    let mut looked = 0;
    while let Some(state) = queue.pop_front() {
        looked += 1;
        if looked > STATES || product.sides[CONCRETE].steps.0 >= product.sides[CONCRETE].most {
            return Ok(None);
        }
        for made in product.concrete_moves(state)?.iter() {
            match made.goal {
                Goal::State(next) if !before.contains_key(&next) => {
                    before.insert(next, Some((state, *made)));
                    queue.push_back(next);
                }
                Goal::State(_) | Goal::Open(_) => {}
                Goal::Fault(_) => {
                    let mut steps = vec![(state, *made)];
                    let mut first = state;
                    while let Some(Some((earlier, step))) = before.get(&first) {
                        steps.push((*earlier, *step));
                        first = *earlier;
                    }
                    steps.reverse();
                    let begun = begun.iter().position(|start| *start == first);
                    return Ok(begun.map(|begun| Broken { begun, steps }));
                }
            }
        }
    }
    Ok(None)
}
