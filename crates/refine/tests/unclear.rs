//! What is said where some answers are not clear, and where bounds leave out initial states.

use std::sync::Arc;

use machine::Value;
use program::Program;
use refine::{ABSTRACT, CONCRETE, Ended, Vacuous, Verdict, Why};

use crate::small::{bounded, machine, refuted, report};

const N: &str = "domain N subsetof Integer controlled n: N";

fn counts(rule: &str) -> Arc<Program> {
    machine(N, &format!("domain N = {{0:3}} main rule r_Main = {rule}"), "function n = 0")
}

/// Its steps look at a number that may be any.
fn open() -> Arc<Program> {
    let signature = format!("monitored any: Integer {N}");
    let rule = "domain N = {0:3} main rule r_Main = if any > 0 then n := 1 endif";
    machine(&signature, rule, "function n = 0")
}

#[test]
fn a_step_that_cannot_be_made_refutes_behind_what_is_not_clear() {
    let free = Some("same n; free abstract.any;");
    let found = report(&open(), &counts("if n < 1 then n := n + 1 endif"), free);
    assert!(matches!(&found.verdict, Verdict::Unknown(why) if matches!(why[..], [Why::Unbounded(ABSTRACT, _)])));
    let far = "if n < 2 then n := n + 1 else choose $x in N with true do n := $x + 2 endif";
    let refutation = refuted(report(&open(), &counts(far), free));
    assert!(matches!(refutation.ended, Ended::Fault), "{:?}", refutation.ended);
    let steps = &refutation.runs[CONCRETE].steps;
    assert_eq!(steps.len(), 3);
    assert!(steps[2].fault.is_some() && steps[..2].iter().all(|step| step.fault.is_none()), "{steps:?}");
    // Nobody gets there.
    let never = "if n < 2 then n := n + 1 elseif n = 3 then n := n + 2 endif";
    let found = report(&open(), &counts(never), free);
    assert!(matches!(found.verdict, Verdict::Unknown(_)), "{:?}", found.verdict);
    // A clear answer that is wrong is told first.
    let wrong = Some("same n; couple concrete.n = 0; free abstract.any;");
    assert!(!matches!(report(&counts("n := 0"), &counts(far), Some("same n;")).verdict, Verdict::Refines));
    refuted(report(&open(), &counts(far), wrong));
}

#[test]
fn initial_states_that_an_assumption_over_inputs_leaves_out_looked_at_inputs_too() {
    let signature = "domain Level subsetof Integer monitored level: Level monitored late: Boolean \
                     controlled last: Level controlled odd: Boolean";
    let begun = |invar: &str, last: &str| {
        let rule = format!("domain Level = {{0:3}} {invar} main rule r_Main = odd := not odd");
        machine(signature, &rule, &format!("function odd = false function last = {last}"))
    };
    let late = begun("INVAR not late or last > 1", "if late then level else 0 endif");
    let zero = begun("", "0");
    let free = "same last, odd; free abstract.level, abstract.late;";
    let low: &[Value] = &[Value::Integer(0), Value::Integer(1)];
    let high: &[Value] = &[Value::Integer(0), Value::Integer(2)];
    let unknown = |side: usize| {
        let input = late.find_function("level", 0).expect("an input");
        Verdict::Unknown(vec![Why::Bounded(side, input)])
    };
    // The start with 2 has no counterpart; with 0 and 1 the assumption leaves out all late ones.
    assert!(!matches!(bounded([&zero, &late], free, [&[], &[]]), Verdict::Refines | Verdict::Unknown(_)));
    assert_eq!(bounded([&zero, &late], free, [&[], &[("level", low)]]), unknown(CONCRETE));
    assert!(!matches!(
        bounded([&zero, &late], free, [&[], &[("level", high)]]),
        Verdict::Refines | Verdict::Unknown(_)
    ));
    // The start of the abstract machine that corresponds may be one of those.
    let two = begun("", "2");
    assert_eq!(bounded([&late, &two], free, [&[], &[]]), Verdict::Refines);
    assert_eq!(bounded([&late, &two], free, [&[("level", low)], &[]]), unknown(ABSTRACT));
}

#[test]
fn a_single_state_may_be_one_of_several_without_bounds() {
    let rule = "if go then h := not h else n := 0 endif";
    let signature = format!("monitored go: Boolean controlled h: Boolean {N}");
    let of = |rule: &str| {
        machine(
            &signature,
            &format!("domain N = {{0:3}} main rule r_Main = {rule}"),
            "function n = 0 function h = false",
        )
    };
    let (one, text) = (of(rule), "same n; free abstract.go;");
    let never: &[(&str, &[Value])] = &[("go", &[Value::Boolean(false)])];
    assert_eq!(bounded([&one, &one], text, [&[], &[]]), Verdict::Vacuous(Vacuous::Total));
    // With the other value there is a second state, and the coupling tells nothing apart.
    assert_eq!(bounded([&one, &one], text, [never, &[]]), Verdict::Unknown(vec![Why::Undistinguished(2)]));
    // A machine that looks at no input has one state, whatever is tried.
    let still = of("n := 0");
    assert_eq!(bounded([&still, &one], text, [never, &[]]), Verdict::Refines);
}
