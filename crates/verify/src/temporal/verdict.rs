//! Verdicts on temporal properties.

use super::budget::{Budget, Spent};
use super::checker::Checker;
use super::formula::{CtlFormulas, FormulaId, LtlFormulas};
use super::run::Run;
use super::{ctl, ltl};

/// What was found out about a temporal property.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FormulaVerdict {
    /// It holds on every fair run (LTL), in every initial state (CTL).
    Holds {
        /// There is no fair run at all: everything holds of all of them.
        vacuous: bool,
    },
    /// It does not hold.
    Violated {
        /// The run that shows it: a lasso, or a path that violates the property however it goes on.
        run: Run,
        /// The run shows it by itself; otherwise it is a branch of a tree that no single run can show.
        whole: bool,
    },
    /// Not found out: the graph is not complete, and no violation stands in what was explored.
    Unexplored,
    /// Not found out: ended early.
    Spent(Spent),
}

/// Decides a formula of computation tree logic: whether it holds in every initial state.
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

/// Decides a formula of linear temporal logic: whether it holds on every fair run.
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
    match violation() {
        Err(ended) => FormulaVerdict::Spent(ended),
        Ok(Some((run, whole))) => FormulaVerdict::Violated { run, whole },
        Ok(None) if !graph.is_complete() => FormulaVerdict::Unexplored,
        Ok(None) => {
            let fair = &checker.fair().must;
            FormulaVerdict::Holds { vacuous: !graph.initial().iter().any(|state| fair.contains(*state)) }
        }
    }
}
