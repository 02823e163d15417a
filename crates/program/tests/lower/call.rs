//! Calls: by value, by name, shared, captured, updated.

use expect_test::expect;

use crate::{check, faults, lowered, model};

#[test]
fn simple_arguments_are_passed_by_value() {
    check(
        "enum domain Colour = {RED | GREEN}\n abstract domain Lamp\n controlled show: Lamp -> Colour\n
         controlled n: Integer\n static a: Lamp\n static five: Integer",
        "function five = 5
         rule r_show($l in Lamp, $c in Colour) = show($l) := $c
         rule r_add($x in Integer) = n := n + $x
         main rule r_Main = par
            r_show[a, RED]
            forall $l in Lamp do r_show[$l, GREEN]
            r_add[-1]
            r_add[five]
         endpar",
        expect![[r#"
            asm x
            enum Colour = RED | GREEN
            abstract Lamp {a}
            controlled show: Lamp -> Colour
            controlled n: Integer
            static a: Lamp element 0
            static five: Integer = 5
            rule r_Main#0 main
              par
                call r_show#1(a, RED)
                forall $l in Lamp
                  call r_show#1($l, GREEN)
                call r_add#2(-1)
                call r_add#2(five)
            rule r_show#1($l, $c)
              show($l) := $c
            rule r_add#2($x)
              n := IntAdd(n, $x)
        "#]],
    );
}

#[test]
fn other_arguments_are_substituted() {
    check(
        "controlled n: Integer\n controlled f: Integer -> Integer\n monitored m: Integer",
        "rule r_set($x in Integer, $y in Integer) = seq n := $y f($x) := $y + n endseq
         main rule r_Main = let ($i = 3) in par
            r_set[$i, f($i) + m]
            r_set[$i, f($i) + m]
            r_set[1, f($i) + m]
            r_set[1, f($i) + f($i)]
         endpar endlet",
        expect![[r#"
            asm x
            controlled n: Integer
            controlled f: Integer -> Integer
            monitored m: Integer
            rule r_Main#0 main
              let $i = 3
                par
                  call r_set#1($i, $i)
                  call r_set#1($i, $i)
                  call r_set#1(1, $i)
                  call r_set#2(1, $i)
            rule r_set#1($x, $i)
              seq
                n := IntAdd(f($i), m)
                f($x) := IntAdd(IntAdd(f($i), m), n)
            rule r_set#2($x, $i)
              seq
                n := IntAdd(f($i), f($i))
                f($x) := IntAdd(IntAdd(f($i), f($i)), n)
        "#]],
    );
}

#[test]
fn arguments_are_passed_on_through_several_calls() {
    check(
        "controlled n: Integer\n controlled f: Integer -> Integer",
        "rule r_c($z in Integer) = n := $z
         rule r_b($y in Integer) = par r_c[$y] r_c[$y * 2] endpar
         rule r_a($x in Integer) = r_b[$x]
         main rule r_Main = forall $i in {1 : 3} do r_a[f($i)]",
        expect![[r#"
            asm x
            controlled n: Integer
            controlled f: Integer -> Integer
            rule r_Main#0 main
              forall $i in Set{1 : 3}
                call r_a#1($i)
            rule r_a#1($i)
              call r_b#2($i)
            rule r_b#2($i)
              par
                call r_c#3($i)
                call r_c#4($i)
            rule r_c#3($i)
              n := f($i)
            rule r_c#4($i)
              n := IntMul(f($i), 2)
        "#]],
    );
}

#[test]
fn substitution_does_not_capture() {
    // The callee binds `$x` and `$y` around its parameter; the argument speaks of the caller's.
    check(
        "controlled n: Integer\n controlled f: Integer -> Integer",
        "rule r_inner($a in Integer) =
            forall $x in {1 : 2} do let ($y = $x) in n := $a + $x + $y endlet
         main rule r_Main =
            forall $x in {3 : 4}, $y in {5 : 6} do r_inner[f($x) + f($y)]",
        expect![[r#"
            asm x
            controlled n: Integer
            controlled f: Integer -> Integer
            rule r_Main#0 main
              forall $x in Set{3 : 4}, $y in Set{5 : 6}
                call r_inner#1($x, $y)
            rule r_inner#1($x@0, $y@1)
              forall $x@2 in Set{1 : 2}
                let $y@3 = $x@2
                  n := IntAdd(IntAdd(IntAdd(f($x@0), f($y@1)), $x@2), $y@3)
        "#]],
    );
}

#[test]
fn binders_of_an_argument_get_slots_wherever_it_is_evaluated() {
    check(
        "controlled n: Integer\n controlled f: Integer -> Integer",
        "rule r_twice($s in Powerset(Integer)) = par
            n := size($s)
            forall $k in $s do f($k) := size($s)
         endpar
         main rule r_Main = let ($low = 2) in r_twice[{$j in {1 : 9} | f($j) > $low : $j}] endlet",
        expect![[r#"
            asm x
            controlled n: Integer
            controlled f: Integer -> Integer
            rule r_Main#0 main
              let $low = 2
                call r_twice#1($low)
            rule r_twice#1($low)
              par
                n := SetSize(Set{$j@1 in Set{1 : 9} | Gt(f($j@1), $low) : $j@1})
                forall $k in Set{$j@2 in Set{1 : 9} | Gt(f($j@2), $low) : $j@2}
                  f($k) := SetSize(Set{$j@4 in Set{1 : 9} | Gt(f($j@4), $low) : $j@4})
        "#]],
    );
}

#[test]
fn updates_of_parameters_reach_the_location() {
    check(
        "controlled n: Integer\n controlled f: Prod(Integer, Integer) -> Integer",
        "turbo rule r_one in Integer = result := 1
         rule r_set($l in Integer, $v in Integer) = $l := $v
         rule r_more($l in Integer) = seq r_set[$l, $l + 1] $l <- r_one() endseq
         main rule r_Main = par
            r_more[n]
            forall $i in {1 : 2} do r_more[f(n, $i)]
         endpar",
        expect![[r#"
            asm x
            controlled n: Integer
            controlled f: Integer, Integer -> Integer
            rule r_Main#0 main
              par
                call r_more#1()
                forall $i in Set{1 : 2}
                  call r_more#2($i)
            rule r_more#1
              seq
                call r_set#3()
                n <- r_one#4()
            rule r_more#2($i)
              seq
                call r_set#5($i)
                f(n, $i) <- r_one#4()
            rule r_set#3
              n := IntAdd(n, 1)
            turbo r_one#4
              result := 1
            rule r_set#5($i)
              f(n, $i) := IntAdd(f(n, $i), 1)
        "#]],
    );
}

#[test]
fn turbo_rules_are_called_by_value_and_may_recurse() {
    check(
        "controlled n: Integer\n controlled f: Integer -> Integer",
        "turbo rule r_factorial($k in Integer) in Integer =
            if $k <= 1 then result := 1
            else seq f($k) <- r_factorial($k - 1) result := $k * f($k) endseq endif
         turbo rule r_clear($k in Integer) = f($k) := undef
         main rule r_Main = seq n <- r_factorial(f(5)) r_clear(n) endseq",
        expect![[r#"
            asm x
            controlled n: Integer
            controlled f: Integer -> Integer
            rule r_Main#0 main
              seq
                n <- r_factorial#1(f(5))
                turbo r_clear#2(n)
            turbo r_factorial#1($k)
              if Le($k, 1)
                result := 1
              else
                seq
                  f($k) <- r_factorial#3(IntSub($k, 1), $k)
                  result := IntMul($k, f($k))
            turbo r_clear#2($k)
              f($k) := undef
            turbo r_factorial#3($k, $$result)
              if Le($k, 1)
                f($$result) := 1
              else
                seq
                  f($k) <- r_factorial#3(IntSub($k, 1), $k)
                  f($$result) := IntMul($k, f($k))
        "#]],
    );
}

#[test]
fn a_location_for_a_result_may_bind_variables() {
    check(
        "controlled f: Integer -> Integer",
        "turbo rule r_twice($k in Integer) in Integer = seq result := $k result := result + $k endseq
         main rule r_Main = f(let ($a = 1) in $a + 1 endlet) <- r_twice(3)",
        expect![[r#"
            asm x
            controlled f: Integer -> Integer
            rule r_Main#0 main
              f((let $a = 1 in IntAdd($a, 1))) <- r_twice#1(3, (let $a = 1 in IntAdd($a, 1)))
            turbo r_twice#1($k, $$result)
              seq
                f($$result) := $k
                f($$result) := IntAdd(f($$result), $k)
        "#]],
    );
}

#[test]
fn rules_are_values_and_programs_of_agents() {
    check(
        "domain Worker subsetof Agent\n static w: Worker\n controlled job: Worker -> Rule(Integer)\n
         controlled n: Integer",
        "rule r_add($x in Integer) = n := n + $x
         rule r_work = job(self)[n]
         rule r_idle = skip
         main rule r_Main = par
            job(w) := <<r_add(Integer)>>
            forall $a in Worker do program($a)
            r_add[n]
         endpar
         default init s:
            agent Agent: r_idle[]
            agent Worker: r_work[]",
        expect![[r#"
            asm x
            dynamic abstract Agent {w}
            domain Worker subsetof Agent {w}
            static w: Worker element 0
            controlled job: Worker -> Rule(Integer)
            controlled n: Integer
            rule r_Main#0 main
              par
                job(w) := <<r_add#3>>
                forall $a in Worker
                  agent $a
                call r_add#4()
            rule r_idle#1
              skip
            rule r_work#2
              run job(self)(n)
            rule r_add#3($x)
              n := IntAdd(n, $x)
            rule r_add#4
              n := IntAdd(n, n)
            agent Worker: r_work#2
            agent Agent: r_idle#1
        "#]],
    );
}

#[test]
fn calls_of_one_shape_share_a_procedure() {
    let calls = |count: usize| "r_set[f(n) + 1]\n".repeat(count);
    let procedures = |count| {
        let definitions =
            format!("rule r_set($x in Integer) = n := $x\n main rule r_Main = par\n{}endpar", calls(count));
        lowered(&model("controlled n: Integer\n controlled f: Integer -> Integer", &definitions)).procedures.len()
    };
    assert_eq!((procedures(2), procedures(50)), (2, 2));
}

#[test]
fn a_value_cannot_be_assigned() {
    let found = faults(
        "controlled job: Rule(Integer)\n controlled n: Integer",
        "rule r_set($l in Integer) = $l := 1
         main rule r_Main = seq job := <<r_set(Integer)>> job[n] endseq",
    );
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].message, "$l stands for a value here, not for a location");
}
