//! Segments that never end: the concrete machine goes on for ever through states in which none does.
//!
//! In: a state within a segment. Out: whether the machine can go on so, and meet each condition of fairness again and again; then nothing
//! that `diagrams` allows is enough. It asks where a segment has as many steps as a diagram may have. INVARIANT: what is not known to be
//! endless may end.

use rustc_hash::FxHashSet;

use crate::CONCRETE;
use crate::circles::{Circles, Edge, Lasso};
use crate::product::Product;
use crate::side::{Goal, StateId, Stopped};

/// LIMIT: so many states within one segment are looked at.
const STATES: usize = 1 << 14;

/// What is known of segments without an end.
#[derive(Debug, Default)]
pub(crate) struct Endless {
    looked: FxHashSet<StateId>,
    endless: FxHashSet<StateId>,
}

impl Product<'_> {
    /// Whether a segment that has come to this state may never end, fairly.
    ///
    /// # Errors
    /// Whoever waits has had enough, or states need more room.
    pub fn never_ends(&mut self, state: StateId) -> Result<bool, Stopped> {
        if !self.endless.looked.contains(&state) {
            let Some((circles, looked)) = self.circles_within(state)? else { return Ok(false) };
            self.endless.endless.extend(looked.iter().filter(|state| circles.has(**state)));
            self.endless.looked.extend(looked);
        }
        Ok(self.endless.endless.contains(&state))
    }

    /// A shortest way into a circle without an end of a segment, from the state in which the segment begins.
    pub fn lasso(&mut self, state: StateId) -> Option<Lasso> {
        self.circles_within(state).ok()??.0.lasso(state)
    }

    /// The circles that can be reached from a state without an end, and the states there; none if there are too many.
    fn circles_within(&mut self, state: StateId) -> Result<Option<(Circles, Vec<StateId>)>, Stopped> {
        let conditions = self.fair();
        let (mut found, mut seen) = (vec![state], FxHashSet::from_iter([state]));
        let (mut edges, mut next) = (Vec::new(), 0);
        while let Some(from) = found.get(next).copied() {
            next += 1;
            if next > STATES || self.sides[CONCRETE].steps.0 >= self.sides[CONCRETE].most {
                return Ok(None);
            }
            for made in self.concrete_moves(from)?.iter() {
                let Goal::State(to) = made.goal else { continue };
                if self.judge.ends(&mut self.sides, to) {
                    continue;
                }
                let meets = (0..conditions).map(|fair| self.meets_in(made, fair)).collect();
                edges.push(Edge { from, to, made: *made, meets });
                if seen.insert(to) {
                    found.push(to);
                }
            }
        }
        Ok(Some((Circles::of(edges, conditions), found)))
    }
}
