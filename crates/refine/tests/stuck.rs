//! What is told where an induction fails since a step cannot be made.

use std::sync::Arc;

use machine::{Fault, FaultKind, Value};
use program::Program;
use refine::Gap;

use crate::enumerated::Enumerated;
use crate::induction::{coupled, proved_by};
use crate::small::{machine, text_of};

/// The faults that a failing obligation tells, by side, and the name of the obligation.
fn faults(one: &Arc<Program>, other: &Arc<Program>, text: &str) -> (String, [Vec<Fault>; 2]) {
    let report = proved_by(vec![Enumerated; 2], &coupled(one, other, text), 0);
    let proof = report.proof.expect("a proof");
    let Some(Gap::Stuck(index, stuck)) = proof.gap else { panic!("{:?} {:#?}", report.verdict, proof.gap) };
    (proof.obligations[index].name.clone(), stuck.faults)
}

/// A step that cannot be made is made again by the machine: the clash and its places are told.
#[test]
fn why_a_step_cannot_be_made_is_told() {
    const SMALL: &str =
        "domain N subsetof Integer monitored go: Boolean monitored by: N controlled n: N controlled m: N";
    const BEGUN: &str = "function n = 0 function m = 0";
    let domain_and = |rule: &str| format!("domain N = {{0:3}} main rule r_Main = {rule}");
    let small = |rule: &str| machine(SMALL, &domain_and(rule), BEGUN);
    let one = small("n := (n + 1) mod 4");
    let check = |rule: &str, is_it: &dyn Fn(&FaultKind) -> bool, at: &str| {
        let other = small(rule);
        let (name, [none, found]) = faults(&one, &other, "same n; allow waiting;");
        assert_eq!((&*name, none.len()), ("step 1 made", 0), "{rule}");
        assert!(!found.is_empty() && found.iter().all(|fault| is_it(&fault.kind)), "{rule}: {found:?}");
        // The text of the machine is that of `machine`, so the place tells the rule.
        let span = match &found[0].kind {
            FaultKind::InconsistentUpdate { second, .. } => second.span,
            _ => found[0].span,
        };
        let text = text_of(SMALL, &domain_and(rule), BEGUN);
        assert_eq!(&text[span.range()], at, "{rule}");
    };
    let clash = |kind: &FaultKind| matches!(kind, FaultKind::InconsistentUpdate { first, second, .. } if first.span != second.span);
    check("par n := (n + 1) mod 4 m := 1 if go and m = 2 then m := 3 endif endpar", &clash, "m := 3");
    check(
        "par n := (n + 1) mod 4 choose $x in N with $x != m do m := $x if by = 2 then m := 3 endif endpar",
        &clash,
        "m := 3",
    );
    check("par n := n m := m + by endpar", &|kind| matches!(kind, FaultKind::OutOfDomain { .. }), "m := m + by");
    check("m := 3 mod by", &|kind| matches!(kind, FaultKind::DivisionByZero), "3 mod by");
    // The abstract machine has one step that clashes, and the value of its input is the one that the term has.
    let wrong = small("par n := by if by = 2 then n := 3 endif endpar");
    let right = small("n := by");
    let (name, [found, none]) = faults(&wrong, &right, "same n; input abstract.by = concrete.by;");
    assert_eq!((&*name, none.len()), ("step 1 answered", 0));
    let [fault] = &found[..] else { panic!("{found:?}") };
    let FaultKind::InconsistentUpdate { first, second, .. } = &fault.kind else { panic!("{fault:?}") };
    assert_eq!([&first.value, &second.value], [&Value::Integer(2), &Value::Integer(3)]);
    let term = "same n; input abstract.by = (if concrete.go then 2 else concrete.by endif);";
    let other = small("n := if go then 2 else by endif");
    assert_eq!(faults(&wrong, &other, term).1[refine::ABSTRACT].len(), 1);
    // Where its step can be made, and does not correspond, there is none.
    let (name, found) = faults(&small("n := 3 - by"), &right, "same n;");
    assert_eq!((&*name, found), ("step 1 answered", Default::default()));
}
