//! Linear temporal logic with past over an explored graph, with fairness.
//!
//! The negated formula becomes an automaton (`automaton`). Its product with the graph is searched for a fair run that
//! the automaton accepts (Vardi, Wolper, *An automata-theoretic approach to automatic program verification*, 1986). The
//! run is checked against the definition of the formula ([`meaning`]) before it is returned.

mod automaton;
mod facts;
mod letters;
pub mod meaning;
mod normal;
mod product;
mod truths;

use std::collections::BTreeSet;

use automaton::Automaton;
use letters::Letters;
use normal::Normal;
use product::{Made, Product};

use crate::graph::StateSet;
use crate::temporal::budget::{Budget, Spent};
use crate::temporal::checker::Checker;
use crate::temporal::component::{Acceptance, Edges, Marks};
use crate::temporal::formula::{FormulaId, Ltl, LtlFormulas};
use crate::temporal::lasso::accepted_lasso;
use crate::temporal::run::Run;

pub use automaton::MOST_UNTILS;

/// A fair run from an initial state that violates the formula; `None` if the explored part has none. A path without a
/// turn violates the formula however it continues.
///
/// # Errors
/// The caller asked to stop, or a limit was reached.
pub fn violating_run(
    checker: &Checker<'_>,
    formulas: &LtlFormulas,
    formula: FormulaId,
    budget: &mut Budget<'_>,
) -> Result<Option<Run>, Spent> {
    let mut automaton = Automaton::new(Normal::of(formulas, formula, false))?;
    let letters = Letters::of(checker.graph(), propositions(formulas, formula), budget)?;
    let (product, made) = Product::make(checker, &mut automaton, &letters, budget)?;
    let run = match made {
        Made::Satisfied(node) => Some(product.satisfying_path(checker, node)),
        Made::Whole => {
            let acceptance =
                Acceptance { again: automaton.marks(), pairs: Vec::new() }.with(checker.acceptance().clone());
            let everywhere = StateSet::all(product.nodes());
            let found = accepted_lasso(&product, &product.initial(), &everywhere, &acceptance, budget)?;
            found.map(|lasso| {
                let turns_at = lasso.stem.last().map_or(lasso.start, |edge| product.target(*edge));
                let stem = product.in_graph(checker, lasso.start, &lasso.stem);
                let turn = product.in_graph(checker, turns_at, &lasso.turn);
                Run::lasso(product.state(lasso.start), stem, turn)
            })
        }
    };
    if let Some(run) = &run {
        check(checker, formulas, formula, run);
    }
    Ok(run)
}

/// The propositions of a formula, ascending.
pub fn propositions(formulas: &LtlFormulas, formula: FormulaId) -> Vec<u32> {
    let mut open = vec![formula];
    let mut seen = BTreeSet::new();
    let mut found = BTreeSet::new();
    while let Some(formula) = open.pop() {
        if seen.insert(formula) {
            let node = formulas.node(formula);
            open.extend(node.parts());
            if let Ltl::Proposition(number) = node {
                found.insert(number);
            }
        }
    }
    found.into_iter().collect()
}

/// Checks that a run is a fair run of the graph that violates the formula.
fn check(checker: &Checker<'_>, formulas: &LtlFormulas, formula: FormulaId, run: &Run) {
    let graph = checker.graph();
    assert!(run.is_run_of(graph) && graph.initial().contains(&run.start), "a counterexample is a run of the model");
    let Some(turn) = run.turn else { return };
    let states = run.states(graph);
    let holds = |number: u32, position: usize| graph.proposition(number as usize).contains(states[position]);
    let holds = meaning::holds_on_lasso(formulas, formula, run.edges.len(), turn, holds);
    assert!(!holds, "the formula fails on its counterexample");
    let marks = run.edges[turn..].iter().fold(Marks::NONE, |all, edge| all | checker.marks().of(*edge));
    assert!(checker.acceptance().accepts(marks), "a counterexample is a fair run");
}
