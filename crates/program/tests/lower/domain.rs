//! Domains and the initial state.

use expect_test::expect;

use crate::check;

#[test]
fn domains_elements_and_initial_values() {
    check(
        "enum domain Colour = {RED | GREEN}\n dynamic abstract domain Lamp\n dynamic domain Lit subsetof Lamp\n
         domain Worker subsetof Agent\n static l1: Lamp\n static w1: Worker\n static boss: Agent\n
         controlled show: Lamp -> Colour\n controlled grid: Prod(Integer, Integer) -> Boolean",
        "main rule r_Main = skip
         init other: function show($l in Lamp) = GREEN
         default init s:
            domain Lit = {l1}
            function show($l in Lamp) = RED
            function grid($x in Integer, $y in Integer) = $x = $y",
        expect![[r#"
            asm x
            dynamic abstract Agent {w1, boss}
            enum Colour = RED | GREEN
            dynamic abstract Lamp {l1}
            dynamic domain Lit subsetof Lamp {} = Set{l1}
            domain Worker subsetof Agent {w1}
            static l1: Lamp element 0
            static w1: Worker element 0
            static boss: Agent element 1
            controlled show: Lamp -> Colour
            controlled grid: Integer, Integer -> Boolean
            rule r_Main#0 main
              skip
            initial show ($l) = RED
            initial grid ($x, $y) = Eq($x, $y)
        "#]],
    );
}

#[test]
fn an_only_initial_state_is_the_default_one() {
    check(
        "controlled n: Integer",
        "main rule r_Main = skip\n default init s: function n = 1",
        expect![[r#"
            asm x
            controlled n: Integer
            rule r_Main#0 main
              skip
            initial n = 1
        "#]],
    );
}
