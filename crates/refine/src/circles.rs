//! Circles of the concrete machine in which each condition of fairness is met: what it can do for ever.
//!
//! In: steps between some of its states. Out: from which of them it can go on for ever so that each condition is met again and again
//! (Emerson and Lei, 1986: the greatest set of states of which each reaches a step that meets each condition, by steps within the set);
//! and a short way from a state into a circle. INVARIANT: a state counts for the steps that are given alone.

use std::collections::VecDeque;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::side::{Move, StateId};

/// A step between two states.
#[derive(Debug, Clone)]
pub(crate) struct Edge {
    pub from: StateId,
    pub to: StateId,
    pub made: Move,
    /// By condition, whether it is met.
    pub meets: Vec<bool>,
}

/// A way into a circle, and the circle.
#[derive(Debug, Default)]
pub(crate) struct Lasso {
    pub way: Vec<(StateId, Move)>,
    pub circle: Vec<(StateId, Move)>,
}

/// See the module.
#[derive(Debug, Default)]
pub(crate) struct Circles {
    edges: Vec<Edge>,
    conditions: usize,
    /// By state, the places of its edges.
    from: FxHashMap<StateId, Vec<usize>>,
    into: FxHashMap<StateId, Vec<usize>>,
    /// The states from which it can go on for ever.
    endless: FxHashSet<StateId>,
}

impl Circles {
    /// Those of steps, with so many conditions.
    pub fn of(edges: Vec<Edge>, conditions: usize) -> Circles {
        let mut circles = Circles { conditions, ..Circles::default() };
        for (place, edge) in edges.iter().enumerate() {
            circles.from.entry(edge.from).or_default().push(place);
            circles.into.entry(edge.to).or_default().push(place);
        }
        circles.endless = circles.from.keys().copied().collect();
        circles.edges = edges;
        loop {
            let before = circles.endless.len();
            for condition in 0..conditions.max(1) {
                circles.endless = circles.reaching(condition);
            }
            if circles.endless.len() == before {
                return circles;
            }
        }
    }

    /// Whether the machine can go on for ever from a state.
    pub fn has(&self, state: StateId) -> bool {
        self.endless.contains(&state)
    }

    /// Whether it can from any.
    pub fn any(&self) -> bool {
        !self.endless.is_empty()
    }

    fn is_within(&self, edge: &Edge) -> bool {
        self.has(edge.from) && self.has(edge.to)
    }

    /// Without conditions, each step meets the only one there is.
    fn meets(&self, edge: &Edge, condition: usize) -> bool {
        self.conditions == 0 || edge.meets[condition]
    }

    /// The states that reach a step which meets a condition.
    fn reaching(&self, condition: usize) -> FxHashSet<StateId> {
        let met = self.edges.iter().filter(|edge| self.is_within(edge) && self.meets(edge, condition));
        let mut open: Vec<StateId> = met.map(|edge| edge.from).collect();
        let mut reaching = FxHashSet::default();
        while let Some(state) = open.pop() {
            if reaching.insert(state) {
                let before = self.into.get(&state).into_iter().flatten().map(|place| &self.edges[*place]);
                open.extend(before.filter(|edge| self.is_within(edge)).map(|edge| edge.from));
            }
        }
        reaching
    }

    /// A shortest way within a set from a state to a step that is wanted, with that step.
    fn way(
        &self,
        from: StateId,
        inside: &dyn Fn(StateId) -> bool,
        wanted: &dyn Fn(&Edge) -> bool,
    ) -> Option<Vec<usize>> {
        let mut before: FxHashMap<StateId, Option<usize>> = FxHashMap::from_iter([(from, None)]);
        let mut queue = VecDeque::from([from]);
        while let Some(state) = queue.pop_front() {
            for place in self.from.get(&state).into_iter().flatten() {
                let edge = &self.edges[*place];
                if !inside(edge.to) {
                    continue;
                }
                if wanted(edge) {
                    let mut way = vec![*place];
                    let mut at = state;
                    while let Some(Some(place)) = before.get(&at) {
                        way.push(*place);
                        at = self.edges[*place].from;
                    }
                    way.reverse();
                    return Some(way);
                }
                before.entry(edge.to).or_insert_with(|| {
                    queue.push_back(edge.to);
                    Some(*place)
                });
            }
        }
        None
    }

    /// The states from which there is a way to a state, by steps of which it can go on for ever.
    fn back_to(&self, state: StateId) -> FxHashSet<StateId> {
        let mut back = FxHashSet::default();
        let mut open = vec![state];
        while let Some(state) = open.pop() {
            for place in self.into.get(&state).into_iter().flatten() {
                let edge = &self.edges[*place];
                if self.is_within(edge) && back.insert(edge.from) {
                    open.push(edge.from);
                }
            }
        }
        back
    }

    /// A circle through a state that meets each condition; none if the state is on none.
    fn circle(&self, state: StateId) -> Option<Vec<usize>> {
        let back = self.back_to(state);
        if !back.contains(&state) {
            return None;
        }
        // From the state back to it: all states on the way are on circles through it.
        let inside = |state: StateId| back.contains(&state);
        let mut circle: Vec<usize> = Vec::new();
        let mut at = state;
        for condition in 0..self.conditions {
            if circle.iter().any(|place| self.edges[*place].meets[condition]) {
                continue;
            }
            let way = self.way(at, &inside, &|edge| edge.meets[condition])?;
            at = way.last().map_or(at, |place| self.edges[*place].to);
            circle.extend(way);
        }
        if circle.is_empty() || at != state {
            circle.extend(self.way(at, &inside, &|edge| edge.to == state)?);
        }
        Some(circle)
    }

    /// A way from a state into the nearest circle.
    pub fn lasso(&self, from: StateId) -> Option<Lasso> {
        let told = |places: Vec<usize>| {
            places.iter().map(|place| (self.edges[*place].from, self.edges[*place].made)).collect()
        };
        let mut seen = FxHashSet::from_iter([from]);
        let mut queue = VecDeque::from([from]);
        while let Some(state) = queue.pop_front() {
            if let Some(circle) = self.circle(state) {
                let way = if state == from {
                    Vec::new()
                } else {
                    self.way(from, &|state| self.has(state), &|edge| edge.to == state)?
                };
                return Some(Lasso { way: told(way), circle: told(circle) });
            }
            for place in self.from.get(&state).into_iter().flatten() {
                let edge = &self.edges[*place];
                if self.has(edge.to) && seen.insert(edge.to) {
                    queue.push_back(edge.to);
                }
            }
        }
        None
    }
}
