//! On graphs that were not explored completely, a verdict agrees with that of every completion.

use verify::temporal::FormulaVerdict;
use verify::temporal::formula::{CtlFormulas, LtlFormulas};

use crate::temporal::random::{Operators, Random, constraints, fairness, formula, sample};
use crate::temporal::{ctl, ltl};

#[test]
fn a_violation_in_a_part_is_one_of_the_whole_and_a_part_never_holds() {
    let (mut violated, mut unknown) = (0, 0);
    for seed in 1..=6000 {
        let random = &mut Random::new(seed);
        let sample = sample(random, 5, 2);
        let mut cut: Vec<bool> = (0..sample.states).map(|_| random.chance(3)).collect();
        cut[random.below(sample.states)] = true;
        let (whole, part) = (sample.graph(&[]), sample.graph(&cut));
        let constraints = constraints(random, sample.states);
        let (whole_fairness, part_fairness) = (fairness(&whole, &constraints), fairness(&part, &constraints));
        let (mut linear, mut branching) = (LtlFormulas::default(), CtlFormulas::default());
        let line = formula(random, &mut linear, Operators::All, 3);
        let tree = formula(random, &mut branching, Operators::Ctl, 3);
        // Whether an agent can move is unknown where its moves were not explored, so these constraints may differ.
        let told =
            constraints.iter().all(|constraint| !matches!(constraint, crate::temporal::random::Constraint::Agent(..)));
        let verdicts = [
            (ltl::decide(&whole, &whole_fairness, &linear, line), ltl::decide(&part, &part_fairness, &linear, line)),
            (
                ctl::decide(&whole, &whole_fairness, &branching, tree),
                ctl::decide(&part, &part_fairness, &branching, tree),
            ),
        ];
        for (whole, part) in verdicts {
            match part {
                FormulaVerdict::Violated { run, .. } => {
                    let too = matches!(whole, FormulaVerdict::Violated { .. });
                    assert!(too || !told, "seed {seed}: {run:?} in the part only");
                    violated += 1;
                }
                FormulaVerdict::Unexplored => unknown += 1,
                other => panic!("seed {seed}: {other:?}"),
            }
        }
    }
    assert!(violated > 1000 && unknown > 1000, "{violated} violated, {unknown} unknown");
}
