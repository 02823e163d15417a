//! Inputs of the abstract machine that are computed from the concrete one, its state or its inputs.

use std::sync::Arc;

use program::Program;
use refine::{CONCRETE, Coupling, Ended, Gap, Verdict};
use syntax::SourceFile;

use crate::enumerated::Enumerated;
use crate::induction::{coupled, outside, proved_by, refines, refines_by, stuck};
use crate::small::{lamp, machine, refuted, report};

const BUTTON: &str = "enum domain Button = {UP | DOWN | NONE} monitored button: Button controlled on: Boolean";

fn button(rule: &str) -> Arc<Program> {
    machine(BUTTON, &format!("main rule r_Main = {rule}"), "function on = false")
}

#[test]
fn an_input_may_be_computed_from_one_of_another_domain() {
    let one = lamp("if pressed then on := not on endif");
    let coupling = Some("same on; input abstract.pressed = (concrete.button != NONE);");
    assert_eq!(report(&one, &button("if button != NONE then on := not on endif"), coupling).verdict, Verdict::Refines);
    // An answer that is taken for another: where any value is allowed, nobody sees it.
    let wrong = [
        "if button = UP then on := not on endif",
        "if button = NONE then on := not on endif",
        "on := not on",
        "if button = DOWN or button = NONE then on := not on endif",
    ];
    for rule in wrong {
        let other = button(rule);
        let refutation = refuted(report(&one, &other, coupling));
        // Where it waits for ever the abstract machine must not: it has the value that says so.
        if let Ended::Unmatched { inputs, .. } = &refutation.ended {
            assert!(matches!(&inputs[..], [(name, _)] if name == "pressed"), "{rule}: {inputs:?}");
        }
        // The run has the input that makes the difference, though the machine may ignore it.
        assert!(refutation.runs[CONCRETE].steps.iter().all(|told| !told.inputs.is_empty()), "{rule}");
        let free = report(&one, &other, Some("same on; free abstract.pressed;"));
        assert_eq!(free.verdict, Verdict::Refines, "{rule}");
    }
}

#[test]
fn an_input_may_be_computed_from_states_and_inputs() {
    let one = lamp("if pressed then on := not on endif");
    let signature = format!("{BUTTON} controlled armed: Boolean");
    let armed = |rule: &str| {
        let rule = format!("main rule r_Main = par armed := not armed {rule} endpar");
        machine(&signature, &rule, "function on = false function armed = false")
    };
    let coupling = Some("same on; input abstract.pressed = (concrete.armed and concrete.button = DOWN);");
    let right = armed("if armed then if button = DOWN then on := not on endif endif");
    assert_eq!(report(&one, &right, coupling).verdict, Verdict::Refines);
    refuted(report(&one, &armed("if button = DOWN then on := not on endif"), coupling));
    // Numbers from truths.
    let sum = machine(
        "domain Level subsetof Integer monitored level: Level controlled all: Level",
        "domain Level = {0:2} main rule r_Main = all := level",
        "function all = 0",
    );
    let two = |rule: &str| {
        let signature =
            "domain Level subsetof Integer monitored left: Boolean monitored right: Boolean controlled all: Level";
        machine(signature, &format!("domain Level = {{0:2}} main rule r_Main = all := {rule}"), "function all = 0")
    };
    let right = two("if left and right then 2 elseif left or right then 1 else 0 endif");
    let one_for = |name: &str| format!("(if concrete.{name} then 1 else 0 endif)");
    let text = format!("same all; input abstract.level = {} + {};", one_for("left"), one_for("right"));
    assert_eq!(report(&sum, &right, Some(&text)).verdict, Verdict::Refines);
    refuted(report(&sum, &two("if left and right then 2 else 0 endif"), Some(&text)));
    // 3 is no level: no step of the abstract machine has it as input.
    refuted(report(&sum, &two("0"), Some("same all; input abstract.level = (if concrete.left then 3 else 0 endif);")));
    let fits = "same all; input abstract.level = (if concrete.left then 3 else 4 endif) mod 3;";
    refuted(report(&sum, &two("if left then 1 else 0 endif"), Some(fits)));
    assert_eq!(report(&sum, &two("if left then 0 else 1 endif"), Some(fits)).verdict, Verdict::Refines);
    // Nor is what cannot be evaluated.
    let broken =
        "same all; input abstract.level = (if concrete.left then 0 mod (concrete.all - concrete.all) else 0 endif);";
    refuted(report(&sum, &two("0"), Some(broken)));
}

/// The term reads what it needs, and no more: a function over numbers need not be gone through.
#[test]
fn a_term_over_inputs_looks_at_what_it_needs() {
    let one = lamp("if pressed then on := not on endif");
    let keys = |rule: &str| {
        machine(
            "monitored key: Integer -> Boolean controlled at: Integer controlled on: Boolean",
            &format!("main rule r_Main = par at := 1 - at {rule} endpar"),
            "function on = false function at = 0",
        )
    };
    let coupling = Some("same on; input abstract.pressed = concrete.key(concrete.at + 3);");
    let right = keys("if key(if at = 0 then 3 else 4 endif) then on := not on endif");
    assert_eq!(report(&one, &right, coupling).verdict, Verdict::Refines);
    refuted(report(&one, &keys("if key(3) then on := not on endif"), coupling));
    // An input that cannot be gone through is one at which the term looks only in steps that it does not match.
    let many = machine(
        "monitored far: Integer monitored near: Boolean controlled on: Boolean",
        "main rule r_Main = if near then on := not on endif",
        "function on = false",
    );
    let near = "same on; input abstract.pressed = (if true then concrete.near else concrete.far > 3 endif);";
    assert_eq!(report(&one, &many, Some(near)).verdict, Verdict::Refines);
    let far = "same on; input abstract.pressed = (if concrete.near then true else concrete.far > 3 endif);";
    let Verdict::Unknown(why) = report(&one, &many, Some(far)).verdict else { panic!() };
    assert!(matches!(why[..], [refine::Why::Unbounded(CONCRETE, _)]), "{why:?}");
}

/// The first step keeps an input that the initial state has looked at, for the term as well.
#[test]
fn a_term_over_inputs_sees_what_an_initial_state_has_seen() {
    let one = machine(
        "monitored pressed: Boolean controlled on: Boolean controlled first: Boolean",
        "main rule r_Main = par first := false on := pressed endpar",
        "function on = false function first = true",
    );
    let other = |rule: &str| {
        machine(
            &format!("{BUTTON} controlled begun: Button controlled first: Boolean"),
            &format!("main rule r_Main = par first := false on := {rule} endpar"),
            "function on = false function first = true function begun = button",
        )
    };
    let coupling = Some("same on, first; input abstract.pressed = (concrete.button != NONE);");
    let right = other("if first then begun != NONE else button != NONE endif");
    assert_eq!(report(&one, &right, coupling).verdict, Verdict::Refines);
    refuted(report(&one, &other("begun != NONE"), coupling));
}

#[test]
fn in_a_long_diagram_a_computed_input_has_a_value_that_it_had_in_it() {
    let one = lamp("if pressed then on := not on endif");
    let slow = |rule: &str| {
        machine(
            &format!("{BUTTON} controlled busy: Boolean controlled seen: Boolean"),
            &format!("main rule r_Main = par busy := not busy {rule} endpar"),
            "function on = false function busy = false function seen = false",
        )
    };
    let coupling = Some("same on; segment not concrete.busy; input abstract.pressed = (concrete.button != NONE);");
    let right = slow("if busy then if seen then on := not on endif else seen := button != NONE endif");
    assert_eq!(report(&one, &right, coupling).verdict, Verdict::Refines);
    refuted(report(
        &one,
        &slow("if busy then if not seen then on := not on endif else seen := button = UP endif"),
        Some(
            "same on; segment not concrete.busy; diagrams 1:2; input abstract.pressed = (concrete.button = UP and not concrete.busy);",
        ),
    ));
}

#[test]
fn an_input_is_a_term_of_its_domain_over_the_concrete_machine() {
    let one = lamp("if pressed then on := not on endif");
    let other = button("if button != NONE then on := not on endif");
    let check = |text: &str, at: &str, says: &str| {
        let coupling =
            Coupling::new([&one, &other], Some(SourceFile::new("c.refine", text)), &machine::Limits::default());
        let faulty = coupling.err().unwrap_or_else(|| panic!("{text}"));
        let fault = &faulty.faults[0];
        assert!(fault.message.contains(says), "{text}: {}", fault.message);
        assert_eq!(&text[fault.primary.span.range()], at, "{text}: {}", fault.message);
    };
    check("same on; input abstract.pressed = concrete.button;", "concrete.button", "Boolean");
    check("same on; input abstract.pressed = concrete.knob = UP;", "concrete.knob", "concrete.knob");
    check("same on; input abstract.pressed = concrete.button = LEFT;", "LEFT", "LEFT");
    check("same on; input abstract.push = concrete.button = UP;", "abstract.push", "no input `push`");
    check("same on; input abstract.on = concrete.button = UP;", "abstract.on", "no input `on`");
    let own = "concrete.button = UP and abstract.on";
    check(&format!("same on; input abstract.pressed = {own};"), "abstract.on", "by the concrete machine alone");
    let twice =
        "same on; input abstract.pressed = concrete.button = UP; input abstract.pressed = concrete.button = DOWN;";
    check(twice, "abstract.pressed", "no input `pressed` left");
    let free = "same on; input abstract.pressed = concrete.button = UP; free abstract.pressed;";
    check(free, "abstract.pressed", "no input `pressed` left");
    check("same on; couple concrete.button = UP;", "concrete.button", "is an input");
    check("same on; segment concrete.button = UP; free abstract.pressed;", "concrete.button", "is an input");
}

/// Inputs of infinite domains, from which that of the abstract machine is computed.
#[test]
fn an_input_may_be_computed_from_inputs() {
    let one = machine(
        "monitored warm: Boolean controlled times: Integer",
        "main rule r_Main = if warm and times < 1000000000 then times := times + 1 endif",
        "function times = 0",
    );
    let other = |guard: &str| {
        machine(
            "monitored inside: Integer monitored outside: Integer controlled offset: Integer controlled times: Integer",
            &format!("main rule r_Main = if {guard} and times < 1000000000 then times := times + 1 endif"),
            "function times = 0 function offset = 3",
        )
    };
    let coupling = "same times; couple concrete.offset = 3;
        input abstract.warm = (concrete.inside > 20 and concrete.outside > 20 - concrete.offset);";
    refines_by(&one, &other("inside >= 21 and outside >= 18"), coupling, &[(1, 1)]);
    stuck(&one, &other("inside > 21 and outside > 17"), coupling, "step 1 answered");
    stuck(&one, &other("inside > 20"), coupling, "step 1 answered");
    // Any value is an answer to all of them.
    for guard in ["inside > 21 and outside > 17", "inside > 20"] {
        refines(&one, &other(guard), "same times; free abstract.warm;");
    }
    let few = machine(FEW, "domain Few = {0, 2, 5} main rule r_Main = last := step", "function last = 0");
    let all = machine(
        "monitored raw: Integer -> Boolean controlled last: Integer",
        "main rule r_Main = last := if raw(3) then 2 else 0 endif",
        "function last = 0",
    );
    let over_all = "same last; input abstract.step = (if concrete.raw(3) then 2 else 0 endif);";
    outside(&few, &all, over_all, "over all of Integer");
}

const FEW: &str = "domain Few subsetof Integer monitored step: Few controlled last: Few";

/// What is computed is a value that the abstract machine's input may have, or none.
#[test]
fn a_computed_input_has_the_value_that_is_computed() {
    let few = machine(FEW, "domain Few = {0, 2, 5} main rule r_Main = last := step", "function last = 0");
    let raw = |rule: &str| {
        let signature =
            "domain Few subsetof Integer domain Raw subsetof Integer monitored raw: Raw controlled last: Few";
        let domains = "domain Few = {0, 2, 5} domain Raw = {0:12}";
        machine(signature, &format!("{domains} main rule r_Main = last := {rule}"), "function last = 0")
    };
    let at = |rule: &str, term: &str| {
        let text = format!("same last; input abstract.step = {term};");
        let report = proved_by(vec![Enumerated; 2], &coupled(&few, &raw(rule), &text), 0);
        let proof = report.proof.expect("a proof");
        match (report.verdict, proof.gap) {
            (Verdict::Refines, None) => "refines".to_string(),
            (Verdict::Unknown(_), Some(Gap::Stuck(index, _))) => proof.obligations[index].name.clone(),
            other => panic!("{other:?}"),
        }
    };
    let level = "if raw > 9 then 5 elseif raw > 3 then 2 else 0 endif";
    let same = "(if concrete.raw > 9 then 5 elseif concrete.raw > 3 then 2 else 0 endif)";
    assert_eq!(at(level, same), "refines");
    assert_eq!(at("if raw > 8 then 5 elseif raw > 3 then 2 else 0 endif", same), "step 1 answered");
    assert_eq!(at("0", same), "step 1 answered");
    // 1 is none of the values: no step of the abstract machine has it.
    assert_eq!(at("if raw = 4 then 5 else 0 endif", "(if concrete.raw = 4 then 5 else 1 endif)"), "step 1 answered");
    // Nor has it one where the term is not defined.
    assert_eq!(at("0", "0 * (6 mod concrete.raw)"), "step 1 answered");
    assert_eq!(
        at("if raw = 4 then 2 else 0 endif", "(if concrete.raw = 4 then 2 else 0 * (6 mod (concrete.raw + 1)) endif)"),
        "refines"
    );
    // The state before the step is the one that the term looks at.
    assert_eq!(
        at("if raw = last then 5 else 2 endif", "(if concrete.raw = concrete.last then 5 else 2 endif)"),
        "refines"
    );
    assert_eq!(at("if raw = last then 5 else 2 endif", "(if concrete.raw = 0 then 5 else 2 endif)"), "step 1 answered");
}
