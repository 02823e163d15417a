//! What a condition on two states came to, remembered by what it looked at.
//!
//! In: what a condition looked at, in order, with the values, and whether it was true. Out: the same of other states, as far as the values
//! are known ones. A condition whose reads have the same values looks at the same next, so that these make a tree. INVARIANT: what is
//! remembered is what evaluation would come to.

use rustc_hash::FxHashMap;

use crate::side::{Place, Side, StateId, ValueId};

/// LIMIT: so many nodes; what comes then is evaluated each time.
const NODES: usize = 1 << 20;

/// What was looked at: in which machine, where, and what was there.
pub(super) type Look = (usize, Place, ValueId);

#[derive(Debug, Clone, Copy)]
enum Node {
    /// It looks here next.
    Looks(usize, Place),
    /// It is true, or it is not.
    Comes(bool),
}

/// See the module.
#[derive(Debug, Default)]
pub(super) struct Remembered {
    nodes: Vec<Node>,
    branches: FxHashMap<(u32, ValueId), u32>,
}

impl Remembered {
    /// Whether it is true of two states, if that is known.
    #[inline]
    pub fn truth(&self, sides: &mut [Side<'_>; 2], states: [StateId; 2]) -> Option<bool> {
        let mut at = 0;
        loop {
            match *self.nodes.get(at as usize)? {
                Node::Comes(truth) => return Some(truth),
                Node::Looks(side, place) => {
                    let value = sides[side].value_at(states[side], place);
                    at = *self.branches.get(&(at, value))?;
                }
            }
        }
    }

    /// Remembers what it came to.
    pub fn add(&mut self, looks: &[Look], truth: bool) {
        if self.nodes.len() + looks.len() >= NODES {
            return;
        }
        let mut at = 0;
        for (depth, (side, place, value)) in looks.iter().enumerate() {
            if at as usize == self.nodes.len() {
                self.nodes.push(Node::Looks(*side, *place));
            }
            let behind = match looks.get(depth + 1) {
                Some((side, place, _)) => Node::Looks(*side, *place),
                None => Node::Comes(truth),
            };
            at = *self.branches.entry((at, *value)).or_insert_with(|| {
                self.nodes.push(behind);
                self.nodes.len() as u32 - 1
            });
        }
        if self.nodes.is_empty() {
            self.nodes.push(Node::Comes(truth));
        }
    }
}
