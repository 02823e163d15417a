//! Formulas of unusual size: decided, or ended by a named limit.

use verify::graph::{Builder, Graph, Label};
use verify::temporal::FormulaVerdict;
use verify::temporal::budget::{Allowance, Budget, Spent};
use verify::temporal::checker::Checker;
use verify::temporal::fairness::Fairness;
use verify::temporal::formula::{CtlFormulas, FormulaId, Logic, LtlFormulas};
use verify::temporal::{decide_ctl, decide_ltl};

/// A ring: in state i only proposition i holds.
fn ring(states: usize) -> Graph {
    let mut builder = Builder::new(states);
    builder.initial();
    for state in 0..states {
        builder.edge(((state + 1) % states) as u32, Label(0));
        builder.state((0..states).map(|number| number == state));
    }
    builder.finish()
}

fn linear(graph: &Graph, limits: Allowance, formulas: &LtlFormulas, root: FormulaId) -> FormulaVerdict {
    let mut go_on = || false;
    let mut budget = Budget::new(limits, &mut go_on);
    let checker = Checker::new(graph, &Fairness::none(), &mut budget).unwrap();
    decide_ltl(&checker, formulas, root, &mut budget)
}

#[test]
fn deep_nesting_costs_no_stack() {
    let graph = ring(3);
    let mut formulas = LtlFormulas::default();
    let mut formula = formulas.proposition(1);
    for _ in 0..100_000 {
        formula = formulas.next(formula);
    }
    // Position 100 000 is state 1 of the ring.
    assert_eq!(linear(&graph, Allowance::default(), &formulas, formula), FormulaVerdict::Holds { vacuous: false });
    let mut formulas = CtlFormulas::default();
    let mut formula = formulas.proposition(1);
    for _ in 0..100_000 {
        formula = formulas.all_next(formula);
    }
    let mut go_on = || false;
    let mut budget = Budget::new(Allowance::default(), &mut go_on);
    let checker = Checker::new(&graph, &Fairness::none(), &mut budget).unwrap();
    let verdict = decide_ctl(&checker, &formulas, formula, &mut budget);
    assert_eq!(verdict, FormulaVerdict::Holds { vacuous: false });
}

#[test]
fn twenty_untils_that_happen_in_turn_are_decided() {
    let graph = ring(20);
    let mut formulas = LtlFormulas::default();
    let mut all = formulas.constant(true);
    for number in 0..20 {
        let proposition = formulas.proposition(number);
        let some_time = formulas.finally(proposition);
        let again = formulas.globally(some_time);
        all = formulas.and(all, again);
    }
    assert_eq!(linear(&graph, Allowance::default(), &formulas, all), FormulaVerdict::Holds { vacuous: false });
    let none = formulas.not(all);
    assert!(matches!(linear(&graph, Allowance::default(), &formulas, none), FormulaVerdict::Violated { .. }));
}

/// A state with an edge to itself, in which all of these propositions hold.
fn point(propositions: usize) -> Graph {
    let mut builder = Builder::new(propositions);
    builder.initial();
    builder.state(vec![true; propositions]);
    builder.finish()
}

/// Fails if any of twenty untils fails: each can be fulfilled now or be postponed.
fn many_obligations(formulas: &mut LtlFormulas) -> FormulaId {
    let mut all = formulas.constant(true);
    for number in 0..20 {
        let proposition = formulas.proposition(number);
        let next = formulas.next(proposition);
        let until = formulas.until(proposition, next);
        all = formulas.and(all, until);
    }
    formulas.not(all)
}

#[test]
fn too_many_obligations_end_at_a_limit_that_is_named() {
    let graph = point(20);
    let mut formulas = LtlFormulas::default();
    let formula = many_obligations(&mut formulas);
    let limits = Allowance { covers: 1000, ..Allowance::default() };
    let verdict = linear(&graph, limits, &formulas, formula);
    let of = "ways to satisfy a formula in one state";
    assert_eq!(verdict, FormulaVerdict::Spent(Spent::Limit { of, value: 1000 }));
    let mut formulas = LtlFormulas::default();
    let mut all = formulas.constant(true);
    let mut left = formulas.proposition(0);
    for number in 0..70 {
        let right = formulas.proposition(number % 20);
        let next = formulas.next(left);
        left = formulas.until(next, right);
        all = formulas.and(all, left);
    }
    let all = formulas.not(all);
    let verdict = linear(&graph, Allowance::default(), &formulas, all);
    assert_eq!(verdict, FormulaVerdict::Spent(Spent::Limit { of: "untils in a formula", value: 64 }));
}

/// The parts of a conjunction are decided one by one, so there may be more of them than untils in one formula.
#[test]
fn a_conjunction_may_have_many_parts() {
    let graph = point(20);
    let mut formulas = LtlFormulas::default();
    let mut all = formulas.constant(true);
    for number in 0..200 {
        let (left, right) = (formulas.proposition(number % 20), formulas.proposition(number % 19));
        let before = formulas.previous(left);
        let (sometimes, once) = (formulas.finally(right), formulas.weak_previous(before));
        let each = formulas.implies(once, sometimes);
        let next = formulas.next(each);
        all = formulas.and(all, next);
        let always = formulas.globally(each);
        all = formulas.and(all, always);
    }
    assert_eq!(linear(&graph, Allowance::default(), &formulas, all), FormulaVerdict::Holds { vacuous: false });
    let under = formulas.globally(all);
    assert_eq!(linear(&graph, Allowance::default(), &formulas, under), FormulaVerdict::Holds { vacuous: false });
    let wrong = formulas.proposition(0);
    let wrong = formulas.not(wrong);
    let all = formulas.and(all, wrong);
    assert!(matches!(linear(&graph, Allowance::default(), &formulas, all), FormulaVerdict::Violated { .. }));
}

#[test]
fn a_decision_can_be_stopped() {
    let graph = point(20);
    let mut formulas = LtlFormulas::default();
    let formula = many_obligations(&mut formulas);
    let limits = Allowance { covers: u64::MAX, ..Allowance::default() };
    let mut questions = 0;
    let mut stop = || {
        questions += 1;
        questions > 3
    };
    let mut budget = Budget::new(limits, &mut stop);
    let checker = Checker::new(&graph, &Fairness::none(), &mut budget).unwrap();
    assert_eq!(decide_ltl(&checker, &formulas, formula, &mut budget), FormulaVerdict::Spent(Spent::Stopped));
}
