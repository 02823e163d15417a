//! Prepares a graph with fairness: computes once what every formula needs.

use std::ops::ControlFlow;
use std::rc::Rc;

use crate::graph::{Graph, Predecessors, StateId, StateSet};
use crate::temporal::budget::{Budget, Spent};
use crate::temporal::component::{Acceptance, Marks, accepting_components};
use crate::temporal::fairness::{EdgeMarks, Fairness};
use crate::temporal::search::Marked;

/// The first mark used for fairness; lower marks belong to a formula.
const FIRST_MARK: usize = 64;

/// Lower and upper bound of the states in which something holds.
#[derive(Debug, Clone)]
pub struct Bracket {
    /// It holds, whatever the unexplored states lead to.
    pub must: Rc<StateSet>,
    /// It holds for some continuation of the unexplored states. On a complete graph, the same set.
    pub may: Rc<StateSet>,
}

/// Which of the two sets to compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Must,
    May,
}

impl Bracket {
    /// A known set, as both bounds.
    pub(crate) fn known(set: StateSet) -> Bracket {
        let set = Rc::new(set);
        Bracket { must: Rc::clone(&set), may: set }
    }

    pub(crate) fn side(&self, side: Side) -> &StateSet {
        match side {
            Side::Must => &self.must,
            Side::May => &self.may,
        }
    }
}

/// A graph and its fair runs.
#[derive(Debug)]
pub struct Checker<'g> {
    graph: &'g Graph,
    pub(crate) predecessors: Predecessors,
    acceptance: Acceptance,
    marks: EdgeMarks,
    fair: Bracket,
}

impl<'g> Checker<'g> {
    /// Prepares a graph.
    ///
    /// # Errors
    /// The caller asked to stop, or there are too many constraints.
    pub fn new(graph: &'g Graph, fairness: &Fairness, budget: &mut Budget<'_>) -> Result<Checker<'g>, Spent> {
        let most = 128 - FIRST_MARK;
        budget.within(fairness.marks(), most as u64, "fairness constraints, a compassion counting twice")?;
        let all = Bracket::known(StateSet::all(graph.states()));
        let mut checker = Checker {
            graph,
            predecessors: graph.predecessors(),
            acceptance: fairness.acceptance(FIRST_MARK),
            marks: fairness.marks_of_edges(graph, FIRST_MARK),
            fair: all.clone(),
        };
        if !fairness.is_empty() {
            checker.fair = checker.both(|side| checker.staying(all.side(side), side, budget))?;
        }
        Ok(checker)
    }

    /// The graph.
    pub fn graph(&self) -> &'g Graph {
        self.graph
    }

    /// The states in which a fair run starts.
    pub fn fair(&self) -> &Bracket {
        &self.fair
    }

    /// The acceptance condition of fair runs.
    pub fn acceptance(&self) -> &Acceptance {
        &self.acceptance
    }

    /// The marks of the graph's edges for fairness.
    pub fn marks(&self) -> &EdgeMarks {
        &self.marks
    }

    /// All marks that fairness may use.
    pub(crate) fn all_marks(&self) -> Marks {
        Marks::below(128).without(Marks::below(FIRST_MARK))
    }

    /// The graph with its marks.
    pub(crate) fn edges(&self) -> Marked<'_, impl Fn(usize) -> Marks> {
        Marked { graph: self.graph, marks: |edge| self.marks.of(edge) }
    }

    /// Computes both sets; on a complete graph one serves as both.
    pub(crate) fn both(&self, mut compute: impl FnMut(Side) -> Result<StateSet, Spent>) -> Result<Bracket, Spent> {
        let must = compute(Side::Must)?;
        if self.graph.is_complete() {
            return Ok(Bracket::known(must));
        }
        Ok(Bracket { must: Rc::new(must), may: Rc::new(compute(Side::May)?) })
    }

    /// The unexplored states, for the side on which anything may follow them.
    pub(crate) fn open(&self, side: Side) -> Option<&StateSet> {
        (side == Side::May && !self.graph.is_complete()).then(|| self.graph.unexplored())
    }

    /// The states from which a fair run stays within a set forever.
    pub(crate) fn staying(&self, always: &StateSet, side: Side, budget: &mut Budget<'_>) -> Result<StateSet, Spent> {
        let mut found = StateSet::none(self.graph.states());
        if let Some(open) = self.open(side) {
            found.unite(open);
            found.intersect(always);
        }
        accepting_components(&self.edges(), always, &self.acceptance, budget, |component| {
            component.nodes.iter().for_each(|node| {
                found.insert(*node);
            });
            ControlFlow::Continue(())
        })?;
        self.backward(&mut found, always, budget)?;
        Ok(found)
    }

    /// Adds every state of `through` from which a path within it leads to the set.
    pub(crate) fn backward(
        &self,
        set: &mut StateSet,
        through: &StateSet,
        budget: &mut Budget<'_>,
    ) -> Result<(), Spent> {
        let mut open: Vec<StateId> = set.iter().collect();
        while let Some(state) = open.pop() {
            budget.work()?;
            for before in self.predecessors.of(state) {
                if through.contains(*before) && set.insert(*before) {
                    open.push(*before);
                }
            }
        }
        Ok(())
    }
}
