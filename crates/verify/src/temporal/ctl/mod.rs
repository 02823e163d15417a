//! Computation tree logic over an explored graph, with fairness.
//!
//! The states in which a formula holds are computed for each part of it, smallest first: E U by backward search, E G by
//! the components in which a fair run can stay (Clarke, Grumberg, Peled, section 4.1; Baier, Katoen, sections 6.4 and
//! 6.5). Path quantifiers range over fair runs only. On a graph with unexplored states, two sets are computed for each
//! part: where it holds whatever follows them, and where it may hold (Bruns, Godefroid, *Model checking partial state
//! spaces*, 1999).

mod evidence;

use std::rc::Rc;

use crate::graph::{Graph, StateSet};
use crate::temporal::budget::{Budget, Spent};
use crate::temporal::checker::{Bracket, Checker, Side};
use crate::temporal::formula::{Ctl, CtlFormulas, FormulaId};

pub use evidence::{Evidence, evidence_against};

/// The states in which each formula of the table holds.
///
/// # Errors
/// The caller asked to stop.
pub fn label(checker: &Checker<'_>, formulas: &CtlFormulas, budget: &mut Budget<'_>) -> Result<Vec<Bracket>, Spent> {
    let graph = checker.graph();
    let mut truths: Vec<Bracket> = Vec::with_capacity(formulas.nodes().len());
    for node in formulas.nodes() {
        let of = |formula: &FormulaId| &truths[formula.index()];
        let truth = match node {
            Ctl::Constant(true) => Bracket::known(StateSet::all(graph.states())),
            Ctl::Constant(false) => Bracket::known(StateSet::none(graph.states())),
            Ctl::Proposition(number) => proposition(graph, *number as usize),
            Ctl::Not(p) if graph.is_complete() => Bracket::known(of(p).must.complement()),
            Ctl::Not(p) => Bracket { must: Rc::new(of(p).may.complement()), may: Rc::new(of(p).must.complement()) },
            Ctl::And(p, q) => checker.both(|side| Ok(intersection(of(p).side(side), of(q).side(side))))?,
            Ctl::ExistsNext(p) => checker.both(|side| next(checker, of(p).side(side), side, budget))?,
            Ctl::ExistsUntil(p, q) => {
                checker.both(|side| until(checker, of(p).side(side), of(q).side(side), side, budget))?
            }
            Ctl::ExistsGlobally(p) => checker.both(|side| checker.staying(of(p).side(side), side, budget))?,
        };
        truths.push(truth);
    }
    Ok(truths)
}

fn proposition(graph: &Graph, number: usize) -> Bracket {
    let holds = graph.proposition(number);
    if graph.is_complete() || graph.is_known_where_unexplored(number) {
        return Bracket::known(holds.clone());
    }
    let (mut must, mut may) = (holds.clone(), holds.clone());
    must.intersect(&graph.unexplored().complement());
    may.unite(graph.unexplored());
    Bracket { must: Rc::new(must), may: Rc::new(may) }
}

fn next(checker: &Checker<'_>, goal: &StateSet, side: Side, budget: &mut Budget<'_>) -> Result<StateSet, Spent> {
    let goal = intersection(goal, checker.fair().side(side));
    let mut found = checker.open(side).map_or_else(|| StateSet::none(checker.graph().states()), StateSet::clone);
    for state in goal.iter() {
        budget.work()?;
        checker.predecessors.of(state).iter().for_each(|before| {
            found.insert(*before);
        });
    }
    Ok(found)
}

fn until(
    checker: &Checker<'_>,
    through: &StateSet,
    goal: &StateSet,
    side: Side,
    budget: &mut Budget<'_>,
) -> Result<StateSet, Spent> {
    let mut found = intersection(goal, checker.fair().side(side));
    if let Some(open) = checker.open(side) {
        found.unite(&intersection(open, through));
    }
    checker.backward(&mut found, through, budget)?;
    Ok(found)
}

fn intersection(left: &StateSet, right: &StateSet) -> StateSet {
    let mut both = left.clone();
    both.intersect(right);
    both
}
