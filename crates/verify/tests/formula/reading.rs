//! The formulas that properties are read as.

use expect_test::{Expect, expect};

use crate::formula::show::show;
use crate::formula::{lowered, model};

fn check(signature: &str, definitions: &str, expect: Expect) {
    let text = model(signature, definitions);
    let program = lowered(&text);
    let properties = verify::temporal::read::read(&program).expect("no faults");
    expect.assert_eq(&show(&program, &text, &properties));
}

const LEVEL: &str = "controlled level: Integer
    controlled ready: Boolean";

#[test]
fn operators_of_both_libraries() {
    check(
        LEVEL,
        "CTLSPEC ctlSpec_a: ag(level > 0 implies af(ready))
         CTLSPEC ctlSpec_b: eu(ready, exN(level = 3, 2n))
         LTLSPEC ltlSpec_a: g(ready implies o(level = 3))
         LTLSPEC ltlSpec_b: u(ready, v(level = 1, z(ready)))
         LTLSPEC ltlSpec_c: x(y(h(t(ready, s(ready, level = 1)))))",
        expect![[r#"
            ctlSpec_a: !E[true U (0 & EG !1)]
            ctlSpec_b: E[1 U EX EX 2]
            ltlSpec_a: !(true U (1 & !(true S 2)))
            ltlSpec_b: (1 U !(!3 U Y !1))
            ltlSpec_c: X Y !(true S (!1 S !(1 S 3)))
            0: level > 0
            1: ready
            2: level = 3
            3: level = 1
        "#]],
    );
}

#[test]
fn what_speaks_of_one_state_is_one_proposition() {
    check(
        LEVEL,
        "JUSTICE level = 0
         COMPASSION (level = 0, ready)
         LTLSPEC g(f(level = 0 and not(ready) or (exists $n in {1 : 2} with level = $n)))
         LTLSPEC f(true) and (2 > 1 implies g(ready))",
        expect![[r#"
            LTLSPEC at line 11: !(true U !(true U 2))
            LTLSPEC at line 12: !(true U !1)
            justice 0
            compassion 0 1
            0: level = 0
            1: ready
            2: level = 0 and not(ready) or (exists $n in {1 : 2} with level = $n)
        "#]],
    );
}

#[test]
fn quantifiers_conditionals_and_functions_are_written_out() {
    check(
        "enum domain Side = {LEFT, RIGHT}
         controlled at: Side -> Boolean
         controlled ready: Boolean
         static again: Boolean -> Boolean
         static follows: Prod(Boolean, Powerset(Boolean)) -> Boolean
         derived visits: Side -> Boolean",
        "function again($p in Boolean) = g(f($p))
         function follows($p in Boolean, $s in Powerset(Boolean)) = g($p implies (forall $e in $s with f($e)))
         function visits($s in Side) = again(at($s))
         LTLSPEC ltlSpec_a: (forall $a in Side, $b in Side with $a != $b implies g(at($a) implies f(at($b))))
         LTLSPEC ltlSpec_b: (forall $a in Side with visits($a))
         LTLSPEC ltlSpec_c: follows(ready, {at(LEFT), o(ready)})
         LTLSPEC ltlSpec_d: if ready then f(at(LEFT)) else g(at(RIGHT)) endif
         LTLSPEC ltlSpec_e: let ($a = LEFT) in f(at($a)) endlet
         LTLSPEC ltlSpec_f: (exists unique $a in Side with f(at($a)))",
        expect![[r#"
            ltlSpec_a: (!(true U (0 & !(true U 1))) & !(true U (!(true U 0) & 1)))
            ltlSpec_b: (!(true U !(true U 0)) & !(true U !(true U 1)))
            ltlSpec_c: !(true U (2 & !((true U 3) & (true U (true S 2)))))
            ltlSpec_d: !(!(2 & (true U 3)) & !(!2 & !(true U !4)))
            ltlSpec_e: (true U 0)
            ltlSpec_f: !(!((true U 0) & !(true U 1)) & !(!(true U 0) & (true U 1)))
            0: at($a) LEFT
            1: at($b) RIGHT
            2: ready
            3: at(LEFT)
            4: at(RIGHT)
        "#]],
    );
}

#[test]
fn deep_formulas_cost_no_stack() {
    let deep = format!("LTLSPEC {}ready{}", "g(not(".repeat(30), "))".repeat(30));
    let text = model(LEVEL, &deep);
    let program = lowered(&text);
    assert_eq!(verify::temporal::read::read(&program).expect("no faults").formulas.len(), 1);
}
