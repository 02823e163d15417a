//! LTL: a run that is found violates the formula, and if none is found, no short lasso does.

use verify::graph::{Builder, Graph, Label};
use verify::temporal::budget::{Allowance, Budget};
use verify::temporal::checker::Checker;
use verify::temporal::fairness::Fairness;
use verify::temporal::formula::{FormulaId, Logic, LtlFormulas};
use verify::temporal::ltl::meaning::holds_on_lasso;
use verify::temporal::run::Run;
use verify::temporal::{FormulaVerdict, decide_ltl};

use crate::temporal::naive::{Evaluation, Word, each_lasso, is_fair, states};
use crate::temporal::random::{Constraint, Operators, Random, constraints, fairness, formula, sample};

pub fn decide(graph: &Graph, fairness: &Fairness, formulas: &LtlFormulas, root: FormulaId) -> FormulaVerdict {
    let mut go_on = || false;
    let mut budget = Budget::new(Allowance::default(), &mut go_on);
    let checker = Checker::new(graph, fairness, &mut budget).expect("few constraints");
    decide_ltl(&checker, formulas, root, &mut budget)
}

/// A random case, compared with all lassos up to a length; returns whether the formula holds.
fn case(seed: u64, operators: Operators, with_fairness: bool) -> bool {
    let random = &mut Random::new(seed);
    let sample = sample(random, 4, 2);
    let graph = sample.graph(&[]);
    let constraints = if with_fairness { constraints(random, sample.states) } else { Vec::new() };
    let mut formulas = LtlFormulas::default();
    let depth = 1 + random.below(4);
    let mut root = formula(random, &mut formulas, operators, depth);
    // A conjunction, which is decided part by part: under an operator that holds always, beside another formula, or both.
    if random.below(3) == 0 {
        let other = formula(random, &mut formulas, operators, depth);
        let both = formulas.and(root, other);
        let always = formulas.globally(both);
        let beside = formula(random, &mut formulas, operators, 1);
        root = match random.below(3) {
            0 => both,
            1 => always,
            _ => formulas.and(beside, always),
        };
    }
    let verdict = decide(&graph, &fairness(&graph, &constraints), &formulas, root);
    let mut any = false;
    each_lasso(&graph, 6, &mut |start, edges, turn| {
        if !is_fair(&graph, &constraints, &edges[turn..]) {
            return;
        }
        any = true;
        let word = Word { graph: &graph, states: states(&graph, start, edges), turn };
        let holds = Evaluation::new(&formulas, word).holds(root, 0);
        match &verdict {
            FormulaVerdict::Holds { vacuous } => {
                assert!(holds && !vacuous, "seed {seed}: {start} {edges:?} {turn} violates")
            }
            FormulaVerdict::Violated { run: Run { turn: None, edges: path, start: from }, .. } => {
                let through = *from == start && (0..path.len()).all(|i| at(edges, turn, i) == path[i]);
                assert!(!(through && holds), "seed {seed}: the path {path:?} can be made good by {edges:?} {turn}");
            }
            FormulaVerdict::Violated { .. } => {}
            other => panic!("seed {seed}: {other:?}"),
        }
    });
    match verdict {
        FormulaVerdict::Holds { vacuous } => {
            assert_eq!(vacuous, !any, "seed {seed}");
            true
        }
        FormulaVerdict::Violated { run, whole } => {
            assert!(whole && run.is_run_of(&graph), "seed {seed}");
            if let Some(turn) = run.turn {
                assert!(is_fair(&graph, &constraints, &run.edges[turn..]), "seed {seed}: {run:?} is not fair");
                let word = Word { graph: &graph, states: states(&graph, run.start, &run.edges), turn };
                assert!(!Evaluation::new(&formulas, word).holds(root, 0), "seed {seed}: {run:?} does not violate");
            }
            false
        }
        other => panic!("seed {seed}: {other:?}"),
    }
}

fn at(edges: &[usize], turn: usize, position: usize) -> usize {
    if position < edges.len() { edges[position] } else { edges[turn + (position - turn) % (edges.len() - turn)] }
}

fn cases(operators: Operators, with_fairness: bool, number: u64) {
    let holding = (1..=number).filter(|seed| case(*seed, operators, with_fairness)).count();
    assert!(holding as u64 * 10 > number && holding as u64 * 10 < number * 9, "{holding} of {number} hold");
}

#[test]
fn future_formulas_agree_with_all_short_lassos() {
    cases(Operators::Future, false, 1000);
}

#[test]
fn formulas_with_past_agree_with_all_short_lassos() {
    cases(Operators::All, false, 1500);
}

#[test]
fn fair_runs_alone_count() {
    cases(Operators::Future, true, 500);
    cases(Operators::All, true, 1000);
}

#[test]
fn the_meaning_on_a_lasso_is_that_of_the_definition() {
    for seed in 1..3000 {
        let random = &mut Random::new(seed);
        let graph = sample(random, 4, 2).graph(&[]);
        let mut formulas = LtlFormulas::default();
        let root = formula(random, &mut formulas, Operators::All, 5);
        each_lasso(&graph, 4, &mut |start, edges, turn| {
            let states = states(&graph, start, edges);
            let holds = |number: u32, position: usize| graph.proposition(number as usize).contains(states[position]);
            let found = holds_on_lasso(&formulas, root, states.len(), turn, holds);
            let word = Word { graph: &graph, states: states.clone(), turn };
            assert_eq!(found, Evaluation::new(&formulas, word).holds(root, 0), "seed {seed}");
        });
    }
}

/// 0 → 1 → 0 …, and 1 → 1; proposition 0 holds in 0 only.
fn two() -> Graph {
    let mut builder = Builder::new(1);
    builder.initial();
    builder.edge(1, Label(0));
    builder.state([true]);
    builder.edge(0, Label(0));
    builder.edge(1, Label(1));
    builder.state([false]);
    builder.finish()
}

#[test]
fn a_lasso_is_shortest_where_it_is_easy() {
    let graph = two();
    let mut formulas = LtlFormulas::default();
    let p = formulas.proposition(0);
    let some_time = formulas.finally(p);
    let again = formulas.globally(some_time);
    let FormulaVerdict::Violated { run, .. } = decide(&graph, &Fairness::none(), &formulas, again) else { panic!() };
    assert_eq!(run, Run { start: 0, edges: vec![0, 2], turn: Some(1) });
    let fair = fairness(&graph, &[Constraint::Justice(vec![true, false])]);
    assert_eq!(decide(&graph, &fair, &formulas, again), FormulaVerdict::Holds { vacuous: false });
    let always = formulas.globally(p);
    let FormulaVerdict::Violated { run, .. } = decide(&graph, &fair, &formulas, always) else { panic!() };
    assert_eq!(run, Run { start: 0, edges: vec![0], turn: None });
}

#[test]
fn without_a_fair_run_a_formula_holds_of_nothing() {
    let graph = two();
    let mut formulas = LtlFormulas::default();
    let never = formulas.constant(false);
    let fair = fairness(&graph, &[Constraint::Compassion(vec![true, true], vec![false, false])]);
    assert_eq!(decide(&graph, &fair, &formulas, never), FormulaVerdict::Holds { vacuous: true });
}
