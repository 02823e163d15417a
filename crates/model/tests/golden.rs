//! Golden dumps: what names, overloads and coercions resolve to. Update with `UPDATE_EXPECT=1 cargo test`.

use crate::support::{check_body, check_file, dump};
use expect_test::{Expect, expect};

fn check(body: &str, expected: Expect) {
    expected.assert_eq(&dump(&check_body(body)));
}

#[test]
fn declarations_of_every_kind() {
    check(
        "dynamic abstract domain Order
         enum domain Colour = {RED | GREEN, BLUE}
         domain Small subsetof Integer
         dynamic domain Open subsetof Order
         domain Robot subsetof Agent
         static arm: Robot
         static area: Prod(Integer, Integer) -> Integer
         derived busy: Robot -> Boolean
         controlled tasks: Robot -> Seq(Order)
         monitored colour: Colour
         shared grid: Prod(Small, Small) -> Map(Colour, Powerset(Integer))
         out log: String
         definitions:
         domain Small = {1 : 4}
         function area($w in Integer, $h in Integer) = $w * $h
         function busy($r in Robot) = length(tasks($r)) > 0
         rule r_Work = skip
         main rule r_Main = forall $r in Robot do program($r)
         default init s0:
         domain Open = {}
         function tasks($r in Robot) = []
         agent Robot: r_Work[]",
        expect![[r#"
            domain Order, dynamic
            domain Colour = {RED, GREEN, BLUE}
            domain Small ⊂ Integer = {1 : 4}
            domain Open ⊂ Order, dynamic
            domain Robot ⊂ Agent
            static arm: Robot
            static area: Integer × Integer -> Integer
              ($w: Integer, $h: Integer) = mult($w, $h)
            derived busy: Robot -> Boolean
              ($r: Robot) = gt(length(tasks($r)), 0)
            controlled tasks: Robot -> Seq(Order)
            monitored colour: Colour
            shared grid: Small × Small -> Map(Colour,Powerset(Integer))
            out log: String
            rule r_Work =
              skip
            rule r_Main =
              forall $r in Robot
                run agent $r
            default init s0
              domain Open = {}
              function tasks ($r: Robot) = []
              agent Robot: r_Work
            main r_Main
        "#]],
    );
}

#[test]
fn numbers_are_coerced_where_they_change_their_form() {
    check(
        "controlled n: Natural
         controlled j: Integer
         controlled r: Real
         controlled c: Complex
         controlled s: Seq(Real)
         controlled p: Prod(Natural, Real)
         controlled t: Seq(Natural)
         definitions:
         main rule r_Main = par
           n := 5
           n := 2 + 3
           n := n + 1
           j := n
           j := n - 1
           r := j
           r := 2
           c := r
           c := n + 2.5
           r := if j > 0 then j else 1.5 endif
           s := [1, 2.5, n]
           s := t
           p := (1, j)
           t := append(t, 3)
           t := [1, 2]
           j := indexOf(t, at(t, 0))
           r := max(j, r)
         endpar",
        expect![[r#"
            controlled n: Natural
            controlled j: Integer
            controlled r: Real
            controlled c: Complex
            controlled s: Seq(Real)
            controlled p: Prod(Natural,Real)
            controlled t: Seq(Natural)
            rule r_Main =
              par
                n := 5n
                n := plus(2, 3)
                n := plus(n, 1n)
                j := n
                j := minus(n, 1n)
                r := Real(j)
                r := 2.0
                c := Complex(r)
                c := Complex(plus(Real(n), 2.5))
                r := (if gt(j, 0) then Real(j) else 1.5)
                s := [1.0, 2.5, Real(n)]
                s := [$$0 in t : Real($$0)]
                p := (1n, Real(j))
                t := append(t, 3n)
                t := [1n, 2n]
                j := indexOf(t, at(t, 0n))
                r := max(Real(j), r)
            main r_Main
        "#]],
    );
}

#[test]
fn overloads_prefer_what_is_exact() {
    check(
        "abstract domain Animal
         domain Dog subsetof Animal
         enum domain Colour = {RED | GREEN}
         static rex: Dog
         static some: Animal
         static f: Animal -> Integer
         static f: Dog -> Real
         static f: Integer -> String
         derived eq: Prod(Colour, Colour) -> Boolean
         controlled j: Integer
         controlled r: Real
         controlled s: String
         controlled b: Boolean
         definitions:
         function eq($a in Colour, $b in Colour) = b
         function f($a in Animal) = 1
         function f($a in Dog) = 1.5
         function f($a in Integer) = toString($a)
         main rule r_Main = par
           j := f(some)
           r := f(rex)
           s := f(3)
           s := s + \"x\"
           b := (RED = GREEN)
           b := (j = undef)
           b := (rex = some)
         endpar",
        expect![[r#"
            domain Animal
            domain Dog ⊂ Animal
            domain Colour = {RED, GREEN}
            static rex: Dog
            static some: Animal
            static f: Animal -> Integer
              ($a: Animal) = 1
            static f: Dog -> Real
              ($a: Dog) = 1.5
            static f: Integer -> String
              ($a: Integer) = toString($a)
            derived eq: Colour × Colour -> Boolean
              ($a: Colour, $b: Colour) = b
            controlled j: Integer
            controlled r: Real
            controlled s: String
            controlled b: Boolean
            rule r_Main =
              par
                j := f(some)
                r := f(rex)
                s := f(3)
                s := plus(s, "x")
                b := eq(RED, GREEN)
                b := eq(j, undef)
                b := eq(rex, some)
            main r_Main
        "#]],
    );
}

#[test]
fn a_product_is_a_list_of_arguments() {
    check(
        "domain Cell subsetof Prod(Integer, Integer)
         controlled f: Prod(Integer, Integer) -> Integer
         controlled g: Cell -> Integer
         controlled p: Prod(Integer, Integer)
         controlled q: Integer -> Prod(Integer, Integer)
         controlled x: Integer
         static twice: Prod(Integer, Integer) -> Integer
         definitions:
         function twice($p in Prod(Integer, Integer)) = first($p) + second($p)
         main rule r_Main = let ($v = p) in par
           x := f(1, 2)
           x := f((1, 2))
           x := f($v)
           x := f(q(1))
           f(p) := 3
           f($v) := 4
           x := g(1, 2)
           x := first(p) + second(1, 2)
           x := twice(q(2))
         endpar endlet",
        expect![[r#"
            domain Cell ⊂ Prod(Integer,Integer)
            controlled f: Integer × Integer -> Integer
            controlled g: Cell -> Integer
            controlled p: Prod(Integer,Integer)
            controlled q: Integer -> Prod(Integer,Integer)
            controlled x: Integer
            static twice: Integer × Integer -> Integer
              ($$0: Integer, $$1: Integer) = (let $p = ($$0, $$1) in plus($p.0, $p.1))
            rule r_Main =
              let $v = p
                par
                  x := f(1, 2)
                  x := f(1, 2)
                  x := f($v.0, $v.1)
                  x := (let $$1 = q(1) in f($$1.0, $$1.1))
                  f(p.0, p.1) := 3
                  f($v.0, $v.1) := 4
                  x := g((1, 2))
                  x := plus(p.0, (1, 2).1)
                  x := (let $$3 = q(2) in twice($$3.0, $$3.1))
            main r_Main
        "#]],
    );
}

#[test]
fn every_rule() {
    check(
        "dynamic abstract domain Order
         enum domain Phase = {IDLE | BUSY}
         controlled phase: Phase
         controlled x: Integer
         controlled of: Order -> Integer
         controlled strategy: Rule(Integer)
         definitions:
         macro rule r_Inc($l in Integer) = $l := $l + 1
         turbo rule r_Sum($n in Integer) in Integer =
           if $n <= 0 then result := 0 else let ($rest = 0) in seq $rest <- r_Sum($n - 1) result := $rest + $n endseq endlet endif
         main rule r_Main = par
           skip
           r_Inc[x]
           r_Inc[of(undef)]
           x <- r_Sum(3)
           r_Sum(4)
           seq x := 1 x := 2 endseq
           if x > 0 then skip elseif x < 0 then x := 0 else x := 1 endif
           switch phase case IDLE: phase := BUSY case BUSY: phase := IDLE otherwise skip endswitch
           choose $o in Order, $p in Order with of($o) < of($p) do of($o) := 1 ifnone x := 9
           forall $i in {1 : 3} do x := $i
           extend Order with $a, $b do of($a) := of($b)
           while x < 10 do x := x + 1
           whilerec x < 10 do x := x + 1
           iterate x := x + 1 enditerate
           local y: Integer [ y := 0 ] local z: Integer -> Integer [ z(0) := y ] x := y + z(0)
           let ($i = 1, $k = $i + 1) in x := $k endlet
           strategy[x]
         endpar
         default init s0:
         function strategy = <<r_Inc(Integer)>>",
        expect![[r#"
            domain Order, dynamic
            domain Phase = {IDLE, BUSY}
            controlled phase: Phase
            controlled x: Integer
            controlled of: Order -> Integer
            controlled strategy: Rule(Integer)
            local $rest: Integer
            local y: Integer
            local z: Integer -> Integer
            rule r_Inc ($l: Integer) =
              $l := plus($l, 1)
            turbo rule r_Sum ($n: Integer) -> Integer =
              if le($n, 0)
                result := 0
              else
                local $rest: Integer
                  $rest := 0
                in
                  seq
                    $rest <- r_Sum(minus($n, 1))
                    result := plus($rest, $n)
            rule r_Main =
              par
                skip
                r_Inc[x]
                r_Inc[of(undef)]
                x <- r_Sum(3)
                r_Sum(4)
                seq
                  x := 1
                  x := 2
                if gt(x, 0)
                  skip
                elseif lt(x, 0)
                  x := 0
                else
                  x := 1
                switch phase
                case IDLE
                  phase := BUSY
                case BUSY
                  phase := IDLE
                otherwise
                  skip
                choose $o in Order, $p in Order with lt(of($o), of($p))
                  of($o) := 1
                ifnone
                  x := 9
                forall $i in {1 : 3}
                  x := $i
                extend Order with $a $b
                  of($a) := of($b)
                while lt(x, 10)
                  x := plus(x, 1)
                whilerec lt(x, 10)
                  x := plus(x, 1)
                iterate
                  x := plus(x, 1)
                local y: Integer
                  y := 0
                local z: Integer -> Integer
                  z(0) := y
                in
                  x := plus(y, z(0))
                let $i = 1, $k = plus($i, 1)
                  x := $k
                run strategy[x]
            default init s0
              function strategy = <<r_Inc>>
            main r_Main
        "#]],
    );
}

#[test]
fn every_term() {
    check(
        "enum domain Phase = {IDLE | BUSY}
         domain Small subsetof Integer
         controlled b: Boolean
         controlled s: Powerset(Integer)
         controlled q: Seq(Integer)
         controlled g: Bag(Integer)
         controlled m: Map(Integer, String)
         controlled x: Integer
         controlled of: Agent -> Integer
         controlled t: String
         controlled c: Complex
         controlled l: Char
         static alice: Agent
         definitions:
         domain Small = {1, 2, 3}
         main rule r_Main = par
           b := (forall $i in Small with $i > 0)
           b := (exists $i in Small, $j in {$i : 3} with $i < $j)
           b := (exists unique $p in Phase with $p = IDLE)
           b := 3 in s and 4 notin q
           b := not b implies b iff b xor b or b
           s := {$i in Small | $i > 1 : $i * 2}
           q := [$i in Small : $i]
           g := <1, 1, 2>
           m := {1 -> \"a\", 2 -> \"b\"}
           m := {->}
           m := {$i in Small : $i -> toString($i)}
           q := [10 : 2, 3]
           x := if b then 1 elseif not b then 2 endif
           x := switch x case 1: 10 otherwise 20 endswitch
           x := let ($y = x, $z = $y) in $y + $z endlet
           x := -x + - 3 mod 2
           x := self.of + alice.of
           t := \"a\\tb\\\"\"
           c := 1.5i2
           l := 'z'
           x := undef
           s := {}
           x := (if b then 1 else 2 endif)
         endpar",
        expect![[r#"
            domain Phase = {IDLE, BUSY}
            domain Small ⊂ Integer = {1, 2, 3}
            controlled b: Boolean
            controlled s: Powerset(Integer)
            controlled q: Seq(Integer)
            controlled g: Bag(Integer)
            controlled m: Map(Integer,String)
            controlled x: Integer
            controlled of: Agent -> Integer
            controlled t: String
            controlled c: Complex
            controlled l: Char
            static alice: Agent
            rule r_Main =
              par
                b := (forall $i in Small with gt($i, 0))
                b := (exists $i in Small, $j in {$i : 3} with lt($i, $j))
                b := (exists unique $p in Phase with eq($p, IDLE))
                b := and(contains(s, 3), not(contains(q, 4)))
                b := iff(implies(not(b), b), or(xor(b, b), b))
                s := {$i in Small | gt($i, 1) : mult($i, 2)}
                q := [$i in Small : $i]
                g := <1, 1, 2>
                m := {1 -> "a", 2 -> "b"}
                m := {}
                m := {$i in Small : $i -> toString($i)}
                q := [10 : 2, 3]
                x := (if b then 1 elseif not(b) then 2)
                x := (switch x case 1: 10 otherwise 20)
                x := (let $y = x, $z = $y in plus($y, $z))
                x := plus(minus(x), mod(-3, 2))
                x := plus(of(self), of(alice))
                t := "a\tb\""
                c := 1.5i2.0
                l := 'z'
                x := undef
                s := {}
                x := (if b then 1 else 2)
            main r_Main
        "#]],
    );
}

#[test]
fn shadowing_and_reuse_of_variables() {
    check(
        "controlled x: Integer
         definitions:
         main rule r_Main = par
           forall $i in {1 : 2} do forall $i in {3 : 4} do x := $i
           forall $i in {5 : 6} do x := $i
           let ($i = 1) in let ($i = $i + 1) in x := $i endlet endlet
         endpar",
        expect![[r#"
            controlled x: Integer
            rule r_Main =
              par
                forall $i in {1 : 2}
                  forall $i in {3 : 4}
                    x := $i
                forall $i in {5 : 6}
                  x := $i
                let $i = 1
                  let $i = plus($i, 1)
                    x := $i
            main r_Main
        "#]],
    );
}

#[test]
fn properties_and_the_temporal_libraries() {
    let text = "module t
        import ../any/CTLLibrary
        import LTLLibrary
        export *
        signature:
        monitored b: Boolean
        definitions:
        INVAR b
        JUSTICE b
        COMPASSION (b, not b)
        invariant inv_b over b: b
        invariant over b(): not b
        CTLSPEC ctlSpec_one: ag(b implies ef(not b))
        LTLSPEC g(f(b))";
    expect![[r#"
        monitored b: Boolean
        invar INVAR at line 8: b
        justice JUSTICE at line 9: b
        compassion COMPASSION at line 10: b ⇒ not(b)
        invariant inv_b: b
        invariant invariant at line 12: not(b)
        ctl ctlSpec_one: ag(implies(b, ef(not(b))))
        ltl LTLSPEC at line 14: g(f(b))
    "#]]
    .assert_eq(&dump(&check_file("t.asm", text, &[])));
}

#[test]
fn time_libraries_have_rules_and_definitions() {
    let text = "asm t
        import StandardLibrary
        import TimeLibrarySimple
        signature:
        static timer: Timer
        definitions:
        main rule r_Main = if expired(timer) then r_reset_timer[timer] endif
        default init s0:
        function duration($t in Timer) = 5
        function start($t in Timer) = currentTime($t)";
    expect![[r#"
        domain Timer
        derived currentTime: Timer -> Integer
          ($t: Timer) = mCurrTimeSecs
        derived expired: Timer -> Boolean
          ($t: Timer) = ge(currentTime($t), plus(start($t), duration($t)))
        static timer: Timer
        rule r_reset_timer ($t: Timer) =
          start($t) := currentTime($t)
        rule r_set_duration ($t: Timer, $duration: Integer) =
          duration($t) := $duration
        rule r_Main =
          if expired(timer)
            r_reset_timer[timer]
        default init s0
          function duration ($t: Timer) = 5
          function start ($t: Timer) = currentTime($t)
        main r_Main
    "#]]
    .assert_eq(&dump(&check_file("t.asm", text, &[])));
}
