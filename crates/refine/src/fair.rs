//! Whether the concrete machine has a fair run at all: without one, nothing is asked of it.
//!
//! In: a product whose pairs were all looked at, and the conditions that are needed. Out: whether some run meets each of them again and
//! again.

use crate::CONCRETE;
use crate::circles::{Circles, Edge};
use crate::product::Product;
use crate::side::{Goal, StateId};

/// See the module.
pub(crate) fn has_fair_run(product: &Product<'_>, needed: &[usize]) -> bool {
    let side = &product.sides[CONCRETE];
    let mut edges = Vec::new();
    for from in 0..side.count() as StateId {
        for made in side.made(from).iter().flat_map(|made| made.iter()) {
            if let Goal::State(to) = made.goal {
                let meets = needed.iter().map(|fair| product.meets_in(made, *fair)).collect();
                edges.push(Edge { from, to, made: *made, meets });
            }
        }
    }
    Circles::of(edges, needed.len()).any()
}
