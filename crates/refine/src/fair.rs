//! Whether the concrete machine has a fair run at all: without one, nothing is asked of it.
//!
//! In: a product whose pairs were all looked at. Out: whether some run meets each condition of fairness again and again. From the states of
//! the greatest set of which each reaches a step that meets each condition, by steps within the set, there is one (Emerson and Lei, 1986).

use crate::CONCRETE;
use crate::product::Product;
use crate::side::{Goal, StateId};

/// A step between two states, by whether it meets each condition.
struct Edge {
    from: StateId,
    to: StateId,
    meets: Vec<bool>,
}

/// See the module.
pub(crate) fn has_fair_run(product: &Product<'_>) -> bool {
    let side = &product.sides[CONCRETE];
    let conditions = 0..product.fair();
    let mut edges = Vec::new();
    for from in 0..side.count() as StateId {
        for made in side.made(from).iter().flat_map(|made| made.iter()) {
            if let Goal::State(to) = made.goal {
                let meets = conditions.clone().map(|fair| product.meets_in(made, fair)).collect();
                edges.push(Edge { from, to, meets });
            }
        }
    }
    let mut into: Vec<Vec<StateId>> = vec![Vec::new(); side.count()];
    edges.iter().for_each(|edge| into[edge.to as usize].push(edge.from));
    let mut inside = vec![true; side.count()];
    let count = |inside: &[bool]| inside.iter().filter(|inside| **inside).count();
    loop {
        let before = count(&inside);
        for fair in conditions.clone() {
            let mut reaches = vec![false; side.count()];
            let within = |edge: &&Edge| inside[edge.from as usize] && inside[edge.to as usize];
            let meeting = edges.iter().filter(within).filter(|edge| edge.meets[fair]);
            let mut open: Vec<StateId> = meeting.map(|edge| edge.from).collect();
            while let Some(state) = open.pop() {
                if !std::mem::replace(&mut reaches[state as usize], true) {
                    open.extend(into[state as usize].iter().filter(|before| inside[**before as usize]));
                }
            }
            inside = reaches;
        }
        let after = count(&inside);
        if after == before {
            return after > 0;
        }
    }
}
