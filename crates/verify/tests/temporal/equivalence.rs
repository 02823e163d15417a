//! Equivalences that the books prove, on random graphs with random fairness.

use program::TemporalOperator as T;
use verify::temporal::FormulaVerdict;
use verify::temporal::formula::{CtlFormulas, FormulaId, Logic, LtlFormulas};

use crate::temporal::random::{Operators, Random, constraints, fairness, formula, sample};
use crate::temporal::{ctl, ltl};

type Pair = fn(&mut LtlFormulas, FormulaId, FormulaId) -> (FormulaId, FormulaId);

fn op<L: Logic>(table: &mut L, operator: T, parts: &[FormulaId]) -> FormulaId {
    table.operator(operator, parts).expect("an operator of the logic")
}

/// Left and right agree on every run: so `left iff right` holds, and so does it after `g`.
#[test]
fn linear_equivalences_hold_on_every_graph() {
    let pairs: [(&str, Pair); 14] = [
        ("¬X p = X ¬p", |t, p, _| {
            let (next, not) = (t.next(p), t.not(p));
            (t.not(next), t.next(not))
        }),
        ("F p = true U p", |t, p, _| {
            let always = t.constant(true);
            (t.finally(p), t.until(always, p))
        }),
        ("p U q = q ∨ (p ∧ X(p U q))", |t, p, q| {
            let until = t.until(p, q);
            let later = t.next(until);
            let on = t.and(p, later);
            (until, t.or(q, on))
        }),
        ("p R q = q ∧ (p ∨ X(p R q))", |t, p, q| {
            let release = t.releases(p, q);
            let later = t.next(release);
            let on = t.or(p, later);
            (release, t.and(q, on))
        }),
        ("G F G p = F G p", |t, p, _| {
            let always = t.globally(p);
            let at_last = t.finally(always);
            (t.globally(at_last), at_last)
        }),
        ("G F p ∨ G F q = G F(p ∨ q)", |t, p, q| {
            let again = |t: &mut LtlFormulas, p| {
                let some = t.finally(p);
                t.globally(some)
            };
            let (first, second) = (again(t, p), again(t, q));
            let either = t.or(p, q);
            (t.or(first, second), again(t, either))
        }),
        ("F(p ∨ q) = F p ∨ F q", |t, p, q| {
            let either = t.or(p, q);
            let (first, second) = (t.finally(p), t.finally(q));
            (t.finally(either), t.or(first, second))
        }),
        ("X(p U q) = X p U X q", |t, p, q| {
            let until = t.until(p, q);
            let (first, second) = (t.next(p), t.next(q));
            (t.next(until), t.until(first, second))
        }),
        ("p S q = q ∨ (p ∧ Y(p S q))", |t, p, q| {
            let since = t.since(p, q);
            let before = t.previous(since);
            let on = t.and(p, before);
            (since, t.or(q, on))
        }),
        ("p T q = q ∧ (p ∨ Z(p T q))", |t, p, q| {
            let triggered = t.triggered(p, q);
            let before = t.weak_previous(triggered);
            let on = t.or(p, before);
            (triggered, t.and(q, on))
        }),
        ("Z p = ¬Y ¬p", |t, p, _| {
            let not = t.not(p);
            let before = t.previous(not);
            (t.weak_previous(p), t.not(before))
        }),
        ("p = X Y p", |t, p, _| {
            let before = t.previous(p);
            (p, t.next(before))
        }),
        ("F p = F(p ∧ Z H ¬p)", |t, p, _| {
            let not = t.not(p);
            let never = t.historically(not);
            let before = t.weak_previous(never);
            let first = t.and(p, before);
            (t.finally(p), t.finally(first))
        }),
        ("G(p → O q) = q R (p → q) in the first state", |t, p, q| {
            // For p and q without past. With past, both sides still read the same run from its first state on.
            let (once, now) = (t.once(q), t.implies(p, q));
            let answered = t.implies(p, once);
            (t.globally(answered), t.releases(q, now))
        }),
    ];
    for seed in 1..=150 {
        let random = &mut Random::new(seed);
        let sample = sample(random, 5, 2);
        let graph = sample.graph(&[]);
        let constraints = constraints(random, sample.states);
        let fairness = fairness(&graph, &constraints);
        for (name, pair) in &pairs {
            let mut formulas = LtlFormulas::default();
            let p = formula(random, &mut formulas, Operators::All, 2);
            let q = formula(random, &mut formulas, Operators::All, 1);
            let (left, right) = pair(&mut formulas, p, q);
            let same = formulas.iff(left, right);
            let verdict = ltl::decide(&graph, &fairness, &formulas, same);
            assert!(matches!(verdict, FormulaVerdict::Holds { .. }), "seed {seed}: {name}: {verdict:?}");
        }
    }
}

#[test]
fn one_path_quantifier_in_front_says_the_same_in_both_logics() {
    for seed in 1..=2000 {
        let random = &mut Random::new(seed);
        let sample = sample(random, 5, 2);
        let graph = sample.graph(&[]);
        let constraints = constraints(random, sample.states);
        let fairness = fairness(&graph, &constraints);
        let (mut linear, mut branching) = (LtlFormulas::default(), CtlFormulas::default());
        let pairs = [(T::Globally, T::Ag, 1), (T::Finally, T::Af, 1), (T::Next, T::Ax, 1), (T::Until, T::Au, 2)];
        for (line, tree, arity) in pairs {
            let lines: Vec<FormulaId> = (0..arity).map(|number| linear.proposition(number)).collect();
            let trees: Vec<FormulaId> = (0..arity).map(|number| branching.proposition(number)).collect();
            let (line, tree) = (op(&mut linear, line, &lines), op(&mut branching, tree, &trees));
            let left = ltl::decide(&graph, &fairness, &linear, line);
            let right = ctl::decide(&graph, &fairness, &branching, tree);
            let holds = |verdict: &FormulaVerdict| matches!(verdict, FormulaVerdict::Holds { .. });
            assert_eq!(holds(&left), holds(&right), "seed {seed}: {left:?} {right:?}");
        }
    }
}
