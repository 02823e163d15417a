//! Verdicts on temporal properties.

use super::budget::{Budget, Spent};
use super::checker::Checker;
use super::formula::{CtlFormulas, FormulaId, LtlFormulas};
use super::run::Run;
use super::{ctl, ltl};

/// The verdict on a temporal property.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FormulaVerdict {
    /// It holds: on every fair run (LTL), in every initial state (CTL).
    Holds {
        /// Whether there is no fair run at all, so that every property holds.
        vacuous: bool,
    },
    /// It is violated.
    Violated {
        /// The run that shows it: a lasso, or a path that violates the property however it continues.
        run: Run,
        /// Whether the run shows it by itself; otherwise it is a branch of a tree that no single run can show.
        whole: bool,
    },
    /// Undecided: the graph is not complete, and what was explored contains no violation.
    Unexplored,
    /// Undecided: ended early.
    Spent(Spent),
}

/// Decides a CTL formula: whether it holds in every initial state.
pub fn decide_ctl(
    checker: &Checker<'_>,
    formulas: &CtlFormulas,
    formula: FormulaId,
    budget: &mut Budget<'_>,
) -> FormulaVerdict {
    let decide = || {
        let truths = ctl::label(checker, formulas, budget)?;
        let truth = &truths[formula.index()];
        let violated = checker.graph().initial().iter().find(|state| !truth.may.contains(**state));
        match violated {
            Some(state) => {
                let evidence = ctl::evidence_against(checker, formulas, &truths, formula, *state, budget)?;
                Ok(Some((evidence.run, evidence.whole)))
            }
            None => Ok(None),
        }
    };
    verdict(checker, decide)
}

/// Decides an LTL formula: whether it holds on every fair run.
pub fn decide_ltl(
    checker: &Checker<'_>,
    formulas: &LtlFormulas,
    formula: FormulaId,
    budget: &mut Budget<'_>,
) -> FormulaVerdict {
    verdict(checker, || Ok(ltl::violating_run(checker, formulas, formula, budget)?.map(|run| (run, true))))
}

fn verdict(checker: &Checker<'_>, violation: impl FnOnce() -> Result<Option<(Run, bool)>, Spent>) -> FormulaVerdict {
    let graph = checker.graph();
    let fair = &checker.fair().must;
    if !graph.initial().iter().any(|state| fair.contains(*state)) {
        // No run is fair, as far as is known.
        return match graph.is_complete() {
            true => FormulaVerdict::Holds { vacuous: true },
            false => FormulaVerdict::Unexplored,
        };
    }
    match violation() {
        Err(ended) => FormulaVerdict::Spent(ended),
        Ok(Some((run, whole))) => FormulaVerdict::Violated { run, whole },
        Ok(None) if !graph.is_complete() => FormulaVerdict::Unexplored,
        Ok(None) => FormulaVerdict::Holds { vacuous: false },
    }
}
