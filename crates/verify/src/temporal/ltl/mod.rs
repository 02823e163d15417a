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
use crate::temporal::formula::{FormulaId, Logic, Ltl, LtlFormulas};
use crate::temporal::lasso::accepted_lasso;
use crate::temporal::run::Run;

pub use automaton::MOST_UNTILS;

/// A fair run from an initial state that violates the formula; `None` if the explored part has none. A path without a
/// turn violates the formula however it continues. The parts of a conjunction are decided one by one: together their
/// automata would multiply. Of their runs, the shortest is returned, a path rather than a lasso.
///
/// # Errors
/// The caller asked to stop, or a limit was reached, and no other part is violated.
pub fn violating_run(
    checker: &Checker<'_>,
    formulas: &LtlFormulas,
    formula: FormulaId,
    budget: &mut Budget<'_>,
) -> Result<Option<Run>, Spent> {
    let mut table = formulas.clone();
    let (mut found, mut spent): (Option<Run>, Option<Spent>) = (None, None);
    for part in conjuncts(&mut table, formula) {
        match violating_part(checker, &table, part, budget) {
            Ok(Some(run)) => {
                let length = |run: &Run| (run.turn.is_some(), run.edges.len());
                if found.as_ref().is_none_or(|other| length(&run) < length(other)) {
                    found = Some(run);
                }
            }
            Ok(None) => {}
            Err(Spent::Stopped) => return Err(Spent::Stopped),
            Err(limit) => _ = spent.get_or_insert(limit),
        }
    }
    if let Some(run) = &found {
        check(checker, formulas, formula, run);
    }
    match (found, spent) {
        (None, Some(limit)) => Err(limit),
        (found, _) => Ok(found),
    }
}

/// Formulas that hold together where this one does: the parts of a conjunction, and of one that always holds. Parts without temporal
/// operators stay together.
fn conjuncts(table: &mut LtlFormulas, formula: FormulaId) -> Vec<FormulaId> {
    let mut all = Vec::new();
    for part in parts(table, formula) {
        let Some(always) = held_always(table, part) else {
            all.push(part);
            continue;
        };
        let (temporal, plain): (Vec<FormulaId>, Vec<FormulaId>) =
            parts(table, always).into_iter().partition(|part| is_temporal(table, *part));
        let together = plain.into_iter().reduce(|left, right| table.and(left, right));
        for part in temporal.into_iter().chain(together) {
            all.push(table.globally(part));
        }
    }
    all
}

/// The operands of nested conjunctions, from the left.
fn parts(table: &LtlFormulas, formula: FormulaId) -> Vec<FormulaId> {
    let (mut open, mut found) = (vec![formula], Vec::new());
    while let Some(formula) = open.pop() {
        match table.node(formula) {
            Ltl::And(left, right) => open.extend([right, left]),
            _ => found.push(formula),
        }
    }
    found
}

/// What always holds if this formula does: of `G p`, which is `not (true U not p)`, the formula `p`.
fn held_always(table: &mut LtlFormulas, formula: FormulaId) -> Option<FormulaId> {
    let Ltl::Not(some_time) = table.node(formula) else { return None };
    let Ltl::Until(left, right) = table.node(some_time) else { return None };
    matches!(table.node(left), Ltl::Constant(true)).then(|| table.not(right))
}

fn is_temporal(table: &LtlFormulas, formula: FormulaId) -> bool {
    let (mut open, mut seen) = (vec![formula], BTreeSet::new());
    while let Some(formula) = open.pop() {
        match table.node(formula) {
            Ltl::Next(_) | Ltl::Until(..) | Ltl::Previous(_) | Ltl::Since(..) => return true,
            Ltl::Constant(_) | Ltl::Proposition(_) | Ltl::Not(_) | Ltl::And(..) => {}
        }
        if seen.insert(formula) {
            open.extend(table.node(formula).parts());
        }
    }
    false
}

/// The same for a formula that is taken as one.
fn violating_part(
    checker: &Checker<'_>,
    formulas: &LtlFormulas,
    formula: FormulaId,
    budget: &mut Budget<'_>,
) -> Result<Option<Run>, Spent> {
    let mut automaton = Automaton::new(Normal::of(formulas, formula, false))?;
    let letters = Letters::of(checker.graph(), propositions(formulas, formula), budget)?;
    let (product, made) = Product::make(checker, &mut automaton, &letters, budget)?;
    Ok(match made {
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
    })
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
