//! Evidence that a CTL formula is violated: one run, as far as a single run can show it.
//!
//! The negated formula is followed from the state on: a path for E X and E U, a lasso for E G; if the end of a path
//! must show more, the run continues there. A single run cannot show what quantifies over all runs, or what must hold
//! in several states at once. Then the evidence is a branch of a tree, and says so.

use crate::graph::{StateId, StateSet};
use crate::temporal::budget::{Budget, Spent};
use crate::temporal::checker::{Bracket, Checker};
use crate::temporal::formula::{Ctl, CtlFormulas, FormulaId};
use crate::temporal::lasso::accepted_lasso;
use crate::temporal::run::Run;
use crate::temporal::search::Finder;

/// A run as evidence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Evidence {
    /// The run.
    pub run: Run,
    /// Whether the run shows the violation by itself; otherwise it is one branch of a tree.
    pub whole: bool,
}

/// The evidence that a formula is false in a state.
///
/// # Errors
/// The caller asked to stop.
///
/// # Panics
/// The formula may be true there.
pub fn evidence_against(
    checker: &Checker<'_>,
    formulas: &CtlFormulas,
    truths: &[Bracket],
    formula: FormulaId,
    state: StateId,
    budget: &mut Budget<'_>,
) -> Result<Evidence, Spent> {
    assert!(!truths[formula.index()].may.contains(state), "the formula fails in the state");
    let mut explanation = Explanation { checker, formulas, truths, temporal: temporal(formulas) };
    explanation.follow(formula, state, budget)
}

/// For each formula, whether it contains a temporal operator.
fn temporal(formulas: &CtlFormulas) -> Vec<bool> {
    let mut temporal: Vec<bool> = Vec::with_capacity(formulas.nodes().len());
    for node in formulas.nodes() {
        temporal.push(match node {
            Ctl::Constant(_) | Ctl::Proposition(_) => false,
            Ctl::Not(p) => temporal[p.index()],
            Ctl::And(p, q) => temporal[p.index()] || temporal[q.index()],
            Ctl::ExistsNext(_) | Ctl::ExistsUntil(..) | Ctl::ExistsGlobally(_) => true,
        });
    }
    temporal
}

struct Explanation<'a, 'g> {
    checker: &'a Checker<'g>,
    formulas: &'a CtlFormulas,
    truths: &'a [Bracket],
    temporal: Vec<bool>,
}

impl Explanation<'_, '_> {
    fn must(&self, formula: FormulaId) -> &StateSet {
        &self.truths[formula.index()].must
    }

    fn fails(&self, formula: FormulaId, state: StateId) -> bool {
        !self.truths[formula.index()].may.contains(state)
    }

    fn follow(&mut self, formula: FormulaId, state: StateId, budget: &mut Budget<'_>) -> Result<Evidence, Spent> {
        let mut evidence = Evidence { run: Run::at(state), whole: true };
        // What to show about the last state of the run: that the formula holds, or that it fails.
        let (mut formula, mut holds) = (formula, false);
        loop {
            let state = evidence.run.last(self.checker.graph());
            match (self.formulas.node(formula), holds) {
                (Ctl::Constant(_) | Ctl::Proposition(_), _) => return Ok(evidence),
                (Ctl::Not(p), _) => (formula, holds) = (p, !holds),
                (Ctl::And(p, q), true) => {
                    evidence.whole &= !(self.temporal[p.index()] && self.temporal[q.index()]);
                    formula = if self.temporal[p.index()] { p } else { q };
                }
                (Ctl::And(p, q), false) => {
                    let simple = |part: &FormulaId| !self.temporal[part.index()];
                    let mut failing = [p, q].into_iter().filter(|part| self.fails(*part, state));
                    let first = failing.next().unwrap_or(p);
                    formula = if simple(&first) { first } else { failing.find(simple).unwrap_or(first) };
                }
                (Ctl::ExistsNext(p), true) => {
                    let goal = |target: StateId| self.must(p).contains(target) && self.fair(target);
                    let edge =
                        self.checker.graph().edges_of(state).find(|edge| goal(self.checker.graph().target(*edge)));
                    let edge = edge.expect("a state with EX p has an edge to one with p");
                    evidence.run.edges.push(edge);
                    formula = p;
                }
                (Ctl::ExistsUntil(p, q), true) => {
                    let path = self.path(state, p, q, budget)?;
                    evidence.whole &= path.is_empty() || !self.temporal[p.index()];
                    evidence.run.edges.extend(path);
                    formula = q;
                }
                (Ctl::ExistsGlobally(p), true) => {
                    evidence.whole &= !self.temporal[p.index()];
                    evidence.run = evidence.run.then(self.lasso(state, p, budget)?);
                    return Ok(evidence);
                }
                (Ctl::ExistsNext(_) | Ctl::ExistsUntil(..) | Ctl::ExistsGlobally(_), false) => {
                    evidence.whole = false;
                    return Ok(evidence);
                }
            }
        }
    }

    fn fair(&self, state: StateId) -> bool {
        self.checker.fair().must.contains(state)
    }

    /// A shortest path through states with `p` to one with `q`.
    fn path(&self, state: StateId, p: FormulaId, q: FormulaId, budget: &mut Budget<'_>) -> Result<Vec<usize>, Spent> {
        let goal = |state: StateId| self.must(q).contains(state) && self.fair(state);
        if goal(state) {
            return Ok(Vec::new());
        }
        let edges = self.checker.edges();
        let allowed = |_: usize, target: StateId| goal(target) || self.must(p).contains(target);
        let found = Finder::new(&edges).path(&[state], budget, allowed, |_, target| goal(target))?;
        Ok(found.expect("a state with E[p U q] has a path to one with q").1)
    }

    fn lasso(&self, state: StateId, p: FormulaId, budget: &mut Budget<'_>) -> Result<Run, Spent> {
        let edges = self.checker.edges();
        let found = accepted_lasso(&edges, &[state], self.must(p), self.checker.acceptance(), budget)?;
        let lasso = found.expect("a state with EG p has a fair run in it");
        Ok(Run::lasso(lasso.start, lasso.stem, lasso.turn))
    }
}
