//! Rules.

use expect_test::expect;

use crate::check;

#[test]
fn parallel_rules_see_the_old_state() {
    check(
        "signature:
            controlled x: Integer
            controlled y: Integer
        definitions:
            main rule r_Main = par x := y y := x endpar
        default init s: function x = 1 function y = 2",
        2,
        expect![[r#"
            1: x=2 y=1
            2: x=1 y=2
        "#]],
    );
}

#[test]
fn a_clash_names_both_values() {
    check(
        "signature:
            controlled x: Integer
        definitions:
            main rule r_Main = par x := 1 x := 1 x := 2 endpar",
        2,
        expect![[r#"
            1: inconsistent update: x is set to 1 and to 2 in one step
        "#]],
    );
}

#[test]
fn undef_against_a_value_clashes() {
    check(
        "signature:
            controlled x: Integer
        definitions:
            main rule r_Main = par x := undef x := 2 endpar",
        1,
        expect![[r#"
            1: inconsistent update: x is set to undef and to 2 in one step
        "#]],
    );
}

#[test]
fn a_sequence_is_seen_by_its_own_parts_only() {
    check(
        "signature:
            controlled x: Integer
            controlled y: Integer
            controlled z: Integer
        definitions:
            main rule r_Main = par
                seq x := x + 1 y := x x := x + 1 endseq
                z := x
            endpar
        default init s: function x = 0",
        2,
        expect![[r#"
            1: x=2 y=1 z=0
            2: x=4 y=3 z=2
        "#]],
    );
}

#[test]
fn sequences_in_parallel_clash_by_their_net_effect() {
    check(
        "signature:
            controlled x: Integer
        definitions:
            main rule r_Main = par
                seq x := 1 x := 5 endseq
                seq x := 2 x := 5 endseq
                x := 5
            endpar",
        1,
        expect![[r#"
            1: x=5
        "#]],
    );
    check(
        "signature:
            controlled x: Integer
        definitions:
            main rule r_Main = par
                seq x := 1 x := 5 endseq
                seq x := 5 x := 6 endseq
            endpar",
        1,
        expect![[r#"
            1: inconsistent update: x is set to 5 and to 6 in one step
        "#]],
    );
}

#[test]
fn a_sequence_may_end_where_it_began() {
    // Writing the old value back is an update still: it clashes with another value.
    check(
        "signature:
            controlled x: Integer
        definitions:
            main rule r_Main = par
                seq x := 1 x := 0 endseq
                x := 7
            endpar
        default init s: function x = 0",
        1,
        expect![[r#"
            1: inconsistent update: x is set to 0 and to 7 in one step
        "#]],
    );
}

#[test]
fn nested_sequences() {
    check(
        "signature:
            controlled x: Integer
            controlled y: Integer
        definitions:
            main rule r_Main = seq
                x := 1
                par
                    seq x := x + 1 x := x * 10 endseq
                    y := x
                endpar
                x := x + y
            endseq",
        1,
        expect![[r#"
            1: x=21 y=1
        "#]],
    );
}

#[test]
fn while_and_iterate_and_whilerec() {
    check(
        "signature:
            controlled x: Integer
            controlled y: Integer
            controlled z: Integer
        definitions:
            main rule r_Main = par
                while x < 10 do x := x + 3
                iterate if y < 5 then y := y + 1 endif enditerate
                whilerec z < 4 do z := z + 1
            endpar
        default init s: function x = 0 function y = 0 function z = 0",
        2,
        expect![[r#"
            1: x=12 y=5 z=4
            2: 
        "#]],
    );
}

#[test]
fn macro_rules_are_called_by_name() {
    check(
        "signature:
            controlled x: Integer
            controlled y: Integer
        definitions:
            macro rule r_m($a in Integer) = seq x := x + 1 y := $a endseq
            macro rule r_set($l in Integer, $v in Integer) = $l := $v
            main rule r_Main = seq r_m[x] r_set[y, y + x] endseq
        default init s: function x = 0",
        2,
        expect![[r#"
            1: x=1 y=2
            2: x=2 y=4
        "#]],
    );
}

#[test]
fn turbo_rules_recurse_and_return() {
    check(
        "signature:
            controlled t: Integer
        definitions:
            turbo rule r_fac($n in Integer) in Integer =
                if $n <= 1 then result := 1
                else local f: Integer [ skip ] seq f <- r_fac($n - 1) result := f * $n endseq endif
            main rule r_Main = t <- r_fac(5)",
        1,
        expect![[r#"
            1: t=120
        "#]],
    );
}

#[test]
fn local_functions_leave_no_trace() {
    check(
        "signature:
            controlled x: Integer
        definitions:
            turbo rule r_sum($n in Integer) =
                local s: Integer [ s := 0 ]
                seq
                    while s < $n do s := s + 1
                    x := s
                endseq
            main rule r_Main = r_sum(4)",
        1,
        expect![[r#"
            1: x=4
        "#]],
    );
}

#[test]
fn choose_and_ifnone() {
    check(
        "signature:
            domain Small subsetof Integer
            controlled x: Integer
            controlled y: Integer
        definitions:
            domain Small = {1:9}
            main rule r_Main = par
                choose $a in Small, $b in Small with $a * $b = 12 do x := $a * 10 + $b
                choose $a in Small with $a > 9 do y := 1 ifnone y := 2
            endpar",
        1,
        expect![[r#"
            1: x=62 y=2
        "#]],
    );
}

#[test]
fn forall_over_domains_and_collections() {
    check(
        "signature:
            enum domain Colour = {RED | GREEN | BLUE}
            controlled f: Colour -> Integer
            controlled s: Integer
        definitions:
            main rule r_Main = par
                forall $c in Colour with $c != GREEN do f($c) := 1
                forall $i in [3, 1, 2] with $i > 2 do s := $i
            endpar",
        1,
        expect![[r#"
            1: f(RED)=1 f(BLUE)=1 s=3
        "#]],
    );
}

#[test]
fn extend_makes_elements_seen_from_the_next_state() {
    check(
        "signature:
            dynamic abstract domain Node
            controlled n: Integer
            controlled last: Node
            controlled label: Node -> Integer
        definitions:
            main rule r_Main = par
                extend Node with $a, $b do par label($a) := 1 label($b) := 2 last := $b endpar
                n := size({$x in Node: $x})
            endpar",
        2,
        expect![[r#"
            1: n=0 last=node!2 label(node!1)=1 label(node!2)=2
            2: n=2 last=node!4 label(node!3)=1 label(node!4)=2
        "#]],
    );
}

#[test]
fn extend_is_seen_by_the_next_part_of_a_sequence() {
    check(
        "signature:
            dynamic abstract domain Node
            controlled n: Integer
            controlled m: Integer
        definitions:
            main rule r_Main = par
                seq
                    extend Node with $a do skip
                    n := size(Node)
                endseq
                m := size(Node)
            endpar",
        2,
        expect![[r#"
            1: n=1 m=0
            2: n=2 m=1
        "#]],
    );
}

#[test]
fn agents_run_their_programs_as_self() {
    check(
        "signature:
            domain Robot subsetof Agent
            static r1: Robot
            static r2: Robot
            controlled count: Robot -> Integer
            controlled who: Agent
        definitions:
            macro rule r_go = count(self) := count(self) + 1
            main rule r_Main = par
                forall $r in Robot do program($r)
                who := self
            endpar
        default init s:
            function count($r in Robot) = if $r = r1 then 10 else 0 endif
            agent Robot: r_go[]",
        2,
        expect![[r#"
            1: count(r1)=11 count(r2)=1
            2: count(r1)=12 count(r2)=2
        "#]],
    );
}

#[test]
fn rules_are_values() {
    check(
        "signature:
            controlled x: Integer
            controlled todo: Rule(Integer)
        definitions:
            macro rule r_a($n in Integer) = x := $n
            main rule r_Main = if isUndef(todo) then todo := <<r_a(Integer)>> else todo[7] endif",
        2,
        expect![[r#"
            1: todo=<<r_a>>
            2: x=7
        "#]],
    );
}

#[test]
fn switch_and_let_and_elseif() {
    check(
        "signature:
            controlled x: Integer
            controlled y: Integer
        definitions:
            main rule r_Main = par
                switch x case 0: x := 1 case 1: x := 5 otherwise x := 0 endswitch
                let ($a = x + 1, $b = $a * 2) in
                    if $b = 2 then y := 1 elseif $b = 4 then y := 2 else y := 3 endif
                endlet
            endpar
        default init s: function x = 0",
        3,
        expect![[r#"
            1: x=1 y=1
            2: x=5 y=2
            3: x=0 y=3
        "#]],
    );
}

#[test]
fn a_number_is_drawn_where_nothing_guards_it() {
    check(
        "signature:
            controlled a: Integer
            controlled b: Real
            controlled c: Boolean
        definitions:
            main rule r_Main = par
                choose $x in Integer, $y in Boolean do par a := $x c := $y endpar
                choose $r in Real with true do b := $r
            endpar
        default init s0: function a = 5",
        1,
        expect![[r#"
            1: a=0 b=0.0 c=true
        "#]],
    );
}

#[test]
fn the_location_stands_in_the_place_of_result() {
    let model = |rules: &str, main: &str| {
        format!(
            "signature:
                domain Small subsetof Integer
                controlled k: Integer
                controlled n: Small
                controlled f: Integer -> Integer
                derived doubled: Integer
            definitions:
                domain Small = {{0 : 9}}
                function doubled = 2 * k
                {rules}
                main rule r_Main = {main}
            default init s: function k = 1 function n = 1 function f($i in Integer) = $i"
        )
    };
    // Overwritten within the `seq`, as any other update of the location would be.
    check(
        &model("turbo rule r_t in Integer = seq k := 5 result := 7 endseq", "k <- r_t()"),
        1,
        expect![[r#"
            1: k=7
        "#]],
    );
    check(
        &model("turbo rule r_t in Integer = seq result := 7 k := 5 endseq", "k <- r_t()"),
        1,
        expect![[r#"
            1: k=5
        "#]],
    );
    // What reads `result` reads the location, and what reads the location reads what was written.
    check(
        &model("turbo rule r_t in Integer = seq result := result + 1 f(1) := doubled endseq", "k <- r_t()"),
        2,
        expect![[r#"
            1: k=2 f(1)=4
            2: k=3 f(1)=6
        "#]],
    );
    // Through a macro rule and another turbo rule; the arguments of the location have the values they had at the call.
    check(
        &model(
            "turbo rule r_inner in Integer = seq f(2) := 8 result := result * 10 endseq
             macro rule r_more($x in Integer) = result := $x + result
             turbo rule r_t($a in Integer) in Integer =
                seq k := $a result <- r_inner() r_more[k] endseq",
            "f(k + 1) <- r_t(4)",
        ),
        1,
        expect![[r#"
            1: k=4 f(2)=84
        "#]],
    );
    // They are evaluated there, even if the rule sets no result.
    check(
        &model("turbo rule r_t in Integer = skip", "par k := 2 f(idiv(1, n - 1)) <- r_t() endpar"),
        1,
        expect![[r#"
            1: division by zero
        "#]],
    );
    // Beside each other they are two locations.
    check(
        &model(
            "turbo rule r_t($a in Integer) in Integer = seq result := $a result := result + 1 endseq",
            "par f(1) <- r_t(10) f(2) <- r_t(20) k <- r_t(30) endpar",
        ),
        1,
        expect![[r#"
            1: k=31 f(1)=11 f(2)=21
        "#]],
    );
    // An update of the result is one of the location, in its domain each time.
    check(
        &model("turbo rule r_t in Small = seq result := 0 - 1 result := 7 endseq", "n <- r_t()"),
        1,
        expect![[r#"
            1: -1 is not in Small, the domain of n
        "#]],
    );
    check(
        &model("turbo rule r_t in Integer = par k := 5 result := 7 endpar", "k <- r_t()"),
        1,
        expect![[r#"
            1: inconsistent update: k is set to 5 and to 7 in one step
        "#]],
    );
}

#[test]
fn agents_are_found_by_name_and_other_elements_are_not() {
    check(
        "signature:
            domain Waiter subsetof Agent
            abstract domain Table
            static boss: Agent
            static anna: Waiter
            static corner: Table
            controlled found: String -> Agent
        definitions:
            main rule r_Main = par
                found(\"boss\") := getAgent(\"boss\")
                found(\"anna\") := getAgent(\"anna\")
                found(\"corner\") := getAgent(\"corner\")
            endpar
        default init s:",
        1,
        expect![[r#"
            1: found("anna")=anna found("boss")=boss
        "#]],
    );
}
