//! CTL agrees with naive fixpoints, state by state.

use verify::graph::Graph;
use verify::temporal::budget::{Allowance, Budget};
use verify::temporal::checker::Checker;
use verify::temporal::ctl::{evidence_against, label};
use verify::temporal::fairness::Fairness;
use verify::temporal::formula::{Ctl, CtlFormulas, FormulaId};
use verify::temporal::run::Run;
use verify::temporal::{FormulaVerdict, decide_ctl};

use crate::temporal::naive::{fair_within, is_fair};
use crate::temporal::random::{Constraint, Operators, Random, constraints, fairness, formula, sample};

pub fn decide(graph: &Graph, fairness: &Fairness, formulas: &CtlFormulas, root: FormulaId) -> FormulaVerdict {
    let mut go_on = || false;
    let mut budget = Budget::new(Allowance::default(), &mut go_on);
    let checker = Checker::new(graph, fairness, &mut budget).expect("few constraints");
    decide_ctl(&checker, formulas, root, &mut budget)
}

/// For each formula and state.
pub fn naive(graph: &Graph, constraints: &[Constraint], formulas: &CtlFormulas) -> Vec<Vec<bool>> {
    let states = graph.states();
    let all = vec![true; states];
    let fair = fair_within(graph, constraints, &all);
    let mut truths: Vec<Vec<bool>> = Vec::new();
    for node in formulas.nodes() {
        let of = |formula: &FormulaId| truths[formula.index()].clone();
        let truth = match node {
            Ctl::Constant(truth) => vec![*truth; states],
            Ctl::Proposition(number) => {
                (0..states).map(|state| graph.proposition(*number as usize).contains(state as u32)).collect()
            }
            Ctl::Not(p) => of(p).iter().map(|truth| !truth).collect(),
            Ctl::And(p, q) => of(p).iter().zip(of(q)).map(|(p, q)| *p && q).collect(),
            Ctl::ExistsNext(p) => {
                let goal = |target: &u32| of(p)[*target as usize] && fair[*target as usize];
                (0..states as u32).map(|state| graph.successors(state).iter().any(goal)).collect()
            }
            Ctl::ExistsUntil(p, q) => {
                let (through, goal) = (of(p), of(q));
                let mut found: Vec<bool> = (0..states).map(|state| goal[state] && fair[state]).collect();
                for _ in 0..states {
                    for state in 0..states {
                        let on = graph.successors(state as u32).iter().any(|target| found[*target as usize]);
                        found[state] |= through[state] && on;
                    }
                }
                found
            }
            Ctl::ExistsGlobally(p) => fair_within(graph, constraints, &of(p)),
        };
        truths.push(truth);
    }
    truths
}

fn case(seed: u64, with_fairness: bool) -> bool {
    let random = &mut Random::new(seed);
    let sample = sample(random, 5, 2);
    let graph = sample.graph(&[]);
    let constraints = if with_fairness { constraints(random, sample.states) } else { Vec::new() };
    let mut formulas = CtlFormulas::default();
    let depth = 1 + random.below(4);
    let root = formula(random, &mut formulas, Operators::Ctl, depth);
    let expected = naive(&graph, &constraints, &formulas);
    let fairness = fairness(&graph, &constraints);
    let mut go_on = || false;
    let mut budget = Budget::new(Allowance::default(), &mut go_on);
    let checker = Checker::new(&graph, &fairness, &mut budget).unwrap();
    let found = label(&checker, &formulas, &mut budget).unwrap();
    for (formula, (found, expected)) in found.iter().zip(&expected).enumerate() {
        for (state, expected) in expected.iter().enumerate() {
            assert_eq!(found.must.contains(state as u32), *expected, "seed {seed}, formula {formula}, state {state}");
        }
    }
    for state in (0..graph.states() as u32).filter(|state| !expected[root.index()][*state as usize]) {
        let evidence = evidence_against(&checker, &formulas, &found, root, state, &mut budget).unwrap();
        assert!(evidence.run.start == state && evidence.run.is_run_of(&graph), "seed {seed}: {evidence:?}");
        if let Some(turn) = evidence.run.turn {
            assert!(is_fair(&graph, &constraints, &evidence.run.edges[turn..]), "seed {seed}: {evidence:?}");
        }
        if evidence.whole {
            let shown = shows(&graph, &formulas, &expected, root, &evidence.run);
            assert!(shown, "seed {seed}: {evidence:?} does not show it");
        }
    }
    let holds = graph.initial().iter().all(|state| expected[root.index()][*state as usize]);
    let fair = fair_within(&graph, &constraints, &vec![true; graph.states()]);
    let any = graph.initial().iter().any(|state| fair[*state as usize]);
    match decide_ctl(&checker, &formulas, root, &mut budget) {
        FormulaVerdict::Holds { vacuous } => assert!((holds || vacuous) && vacuous != any, "seed {seed}"),
        FormulaVerdict::Violated { run, .. } => {
            assert!(any && !holds && graph.initial().contains(&run.start), "seed {seed}")
        }
        other => panic!("seed {seed}: {other:?}"),
    }
    holds
}

/// Whether a run alone shows that a formula fails where it starts: everything to be shown about its states is found on
/// the rest of the run.
fn shows(graph: &Graph, formulas: &CtlFormulas, truths: &[Vec<bool>], root: FormulaId, run: &Run) -> bool {
    let states = run.states(graph);
    let last = states.len() - 1;
    shown(formulas, truths, &states, run.turn.is_some(), last, root, 0, false)
}

#[allow(clippy::too_many_arguments, reason = "a walk with a fixed surrounding")]
fn shown(
    formulas: &CtlFormulas,
    truths: &[Vec<bool>],
    states: &[u32],
    turns: bool,
    last: usize,
    formula: FormulaId,
    at: usize,
    holds: bool,
) -> bool {
    let again = |formula, at, holds| shown(formulas, truths, states, turns, last, formula, at, holds);
    let on = |at: usize, formula: FormulaId| truths[formula.index()][states[at] as usize];
    match (formulas.node(formula), holds) {
        (Ctl::Constant(_) | Ctl::Proposition(_), _) => on(at, formula) == holds,
        (Ctl::Not(p), _) => again(p, at, !holds),
        (Ctl::And(p, q), true) => again(p, at, true) && again(q, at, true),
        (Ctl::And(p, q), false) => again(p, at, false) || again(q, at, false),
        (Ctl::ExistsNext(p), true) => at < last && again(p, at + 1, true),
        (Ctl::ExistsUntil(p, q), true) => {
            (at..=last).any(|end| again(q, end, true) && (at..end).all(|before| again(p, before, true)))
        }
        (Ctl::ExistsGlobally(p), true) => turns && (at..=last).all(|place| again(p, place, true)),
        (_, false) => false,
    }
}

#[test]
fn labels_agree_with_naive_fixpoints() {
    let holding = (1..=6000).filter(|seed| case(*seed, false)).count();
    assert!((600..5400).contains(&holding), "{holding} hold");
}

#[test]
fn labels_under_fairness_agree_with_trying_every_set_of_edges() {
    let holding = (1..=3000).filter(|seed| case(*seed, true)).count();
    assert!((300..2700).contains(&holding), "{holding} hold");
}
