//! Faults: each ends the step and leaves the state as it was.

use expect_test::expect;

use crate::check;

/// The fault of one update.
#[track_caller]
fn fault(value: &str, expect: expect_test::Expect) {
    let text = format!(
        "signature:
            domain Small subsetof Integer
            controlled x: Integer
            controlled u: Integer
            controlled small: Small
            controlled n: Natural
            controlled s: Seq(Integer)
            controlled b: Boolean
        definitions:
            domain Small = {{1:9}}
            turbo rule r_deep($n in Integer) = r_deep($n + 1)
            main rule r_Main = {value}
        default init i: function x = 0 function s = []"
    );
    check(&text, 1, expect);
}

#[test]
fn arithmetic() {
    fault(
        "x := 1 idiv 0".replace("1 idiv 0", "idiv(1, x)").as_str(),
        expect![[r#"
        1: division by zero
    "#]],
    );
    fault(
        "x := 9223372036854775807 + 1",
        expect![[r#"
        1: integer overflow: 9223372036854775807 + 1 is beyond 64 bits
    "#]],
    );
    fault(
        "x := u + 1",
        expect![[r#"
        1: `+` of undef
    "#]],
    );
    fault(
        "x := at(s, 3)",
        expect![[r#"
        1: index 3 is outside a sequence of length 0
    "#]],
    );
}

#[test]
fn domains() {
    fault(
        "small := x + 10",
        expect![[r#"
        1: 10 is not in Small, the domain of small
    "#]],
    );
    fault(
        "forall $i in Integer with $i > 0 do x := $i",
        expect![[r#"
        1: the elements of Integer cannot be enumerated
    "#]],
    );
}

#[test]
fn guards() {
    fault(
        "if b then x := 1 endif",
        expect![[r#"
        1: the condition is undef, neither true nor false
    "#]],
    );
    fault(
        "if u > 3 then x := 1 endif",
        expect![[r#"
        1: `>` of undef
    "#]],
    );
}

#[test]
fn limits() {
    fault(
        "while true do x := x + 1",
        expect![[r#"
        1: the limit of 1000 iterations in one step is reached
    "#]],
    );
    fault(
        "r_deep(1)",
        expect![[r#"
        1: the limit of 200 nested calls is reached
    "#]],
    );
    fault(
        "s := [1:100000]",
        expect![[r#"
        1: the limit of 10000 elements of one collection is reached
    "#]],
    );
}

#[test]
fn a_fault_leaves_the_state_alone() {
    let mut machine = crate::machine_of(
        "signature:
            controlled x: Integer
            controlled y: Integer
        definitions:
            main rule r_Main = seq x := x + 1 y := idiv(1, 3 - x) endseq
        default init s: function x = 0",
    );
    let mut environment = crate::Counting::default();
    machine.start(&mut environment).unwrap();
    assert!(machine.step(&mut environment).is_ok());
    assert!(machine.step(&mut environment).is_ok());
    let before = machine.locations();
    assert!(machine.step(&mut environment).is_err());
    assert_eq!(machine.locations(), before);
    assert_eq!(machine.steps(), 2);
}
