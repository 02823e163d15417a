//! Terms: applications by the kind of their function, library operations, binding constructs.

use expect_test::expect;

use crate::check;

#[test]
fn operations_follow_the_domains_of_their_operands() {
    check(
        "controlled j: Integer\n controlled k: Natural\n controlled r: Real\n controlled c: Complex\n
         controlled s: String\n controlled h: Char\n controlled b: Boolean",
        "main rule r_Main = par
            j := j + k * 2 - (-3)
            k := 4n mod 3n
            r := r + 1.5 - j / 2
            r := max(r, 2.0) ^ 2.0
            c := c + r
            s := s + toString(h)
            b := (j < 3 and r >= 0.5) or not (h < 'c') xor b
            b := r = j implies k > j
            j := idiv(abs(j), 2) + size(s)
         endpar",
        expect![[r#"
            asm x
            controlled j: Integer
            controlled k: Natural
            controlled r: Real
            controlled c: Complex
            controlled s: String
            controlled h: Char
            controlled b: Boolean
            rule r_Main#0 main
              par
                j := IntSub(IntAdd(j, IntMul(k, 2)), -3)
                k := IntMod(4, 3)
                r := RealSub(RealAdd(r, 1.5), IntDiv(j, 2))
                r := RealPower(RealMax(r, 2.0), 2.0)
                c := ComplexAdd(c, Complex(r))
                s := StringConcat(s, ToString(h))
                b := Xor(Or(And(Lt(j, 3), Ge(r, 0.5)), Not(Lt(h, 'c'))), b)
                b := Implies(Eq(r, Real(j)), Gt(k, j))
                j := IntAdd(IntQuotient(IntAbs(j), 2), StringSize(s))
        "#]],
    );
}

#[test]
fn constants_take_their_sign_and_form() {
    check(
        "controlled j: Integer\n controlled r: Real\n controlled c: Complex",
        "main rule r_Main = par
            j := -5
            j := - - 5
            j := +5
            j := -j
            r := -0.0
            r := -3
            c := 2
         endpar",
        expect![[r#"
            asm x
            controlled j: Integer
            controlled r: Real
            controlled c: Complex
            rule r_Main#0 main
              par
                j := -5
                j := 5
                j := 5
                j := IntNeg(j)
                r := 0.0
                r := -3.0
                c := (2.0 + i0.0)
        "#]],
    );
}

#[test]
fn collections_select_their_operations() {
    check(
        "controlled s: Powerset(Integer)\n controlled q: Seq(Integer)\n controlled g: Bag(Integer)\n
         controlled m: Map(String, Integer)\n controlled t: Prod(Integer, String)\n controlled n: Integer\n
         controlled b: Boolean",
        r#"main rule r_Main = par
            s := union(including(s, 1), {2, 3})
            q := append(union(q, [1 : 3]), first(q))
            n := at(q, 0n) + indexOf(q, 2) + size(s) + length(q)
            g := union(g, <1, 1>)
            b := contains(s, 1) and contains(q, 1) and contains(g, 1) and isEmpty(q)
            n := at(m, "a") + first(t) + first((1, "b"))
            m := assign(m, "a", 1)
            m := {"a" -> 1, "b" -> 2}
            s := {$x in s, $y in asSet(q) | $x < $y : $x * $y}
            q := [$x in q : $x]
            g := asBag(q)
         endpar"#,
        expect![[r#"
            asm x
            controlled s: Powerset(Integer)
            controlled q: Seq(Integer)
            controlled g: Bag(Integer)
            controlled m: Map(String,Integer)
            controlled t: Prod(Integer,String)
            controlled n: Integer
            controlled b: Boolean
            rule r_Main#0 main
              par
                s := SetUnion(SetIncluding(s, 1), Set{2, 3})
                q := Append(SeqConcat(q, Seq{1 : 3}), First(q))
                n := IntAdd(IntAdd(IntAdd(SeqAt(q, 0), SeqIndexOf(q, 2)), SetSize(s)), SeqLength(q))
                g := BagUnion(g, Bag{1, 1})
                b := And(And(And(SetContains(s, 1), SeqContains(q, 1)), BagContains(g, 1)), SeqIsEmpty(q))
                n := IntAdd(IntAdd(MapAt(m, "a"), t.0), (1, "b").0)
                m := MapAssign(m, "a", 1)
                m := Map{("a", 1), ("b", 2)}
                s := Set{$x@0 in s, $y in AsSet(q) | Lt($x@0, $y) : IntMul($x@0, $y)}
                q := Seq{$x@2 in q : $x@2}
                g := AsBag(q)
        "#]],
    );
}

#[test]
fn binding_and_branching_terms() {
    check(
        "domain Small subsetof Integer\n controlled n: Integer\n derived both: Prod(Integer, Integer) -> Boolean\n
         derived f: Integer -> Integer",
        "domain Small = {0 : 8, 2}
         function both($a in Integer, $b in Integer) = n = $a and n = $b
         function f($x in Integer) =
            let ($y = $x + 1, $z = $y * 2) in if $z > n then $y else if $z = n then $x endif endif endlet
         main rule r_Main = par
            if (forall $x in Small, $y in Small with both($x, $y)) then n := f(n) endif
            if (exists unique $x in Small with $x = n) then n := switch n case 1: 2 case 2: 3 otherwise 4 endswitch endif
         endpar",
        expect![[r#"
            asm x
            domain Small subsetof Integer = Set{0 : 8, 2}
            controlled n: Integer
            derived both: Integer, Integer -> Boolean ($a, $b) = And(Eq(n, $a), Eq(n, $b))
            derived f: Integer -> Integer ($x) = (let $y = IntAdd($x, 1) in (let $z = IntMul($y, 2) in (if Gt($z, n) then $y else (if Eq($z, n) then $x))))
            rule r_Main#0 main
              par
                if (forall $x@0 in Small, $y in Small with both($x@0, $y))
                  n := f(n)
                if (exists unique $x@2 in Small with Eq($x@2, n))
                  n := (switch n case 1: 2 case 2: 3 otherwise 4)
        "#]],
    );
}

#[test]
fn statics_without_meaning_are_missing_and_elements_are_numbered() {
    check(
        "abstract domain Node\n domain Inner subsetof Node\n static root: Node\n static left: Inner\n static right: Inner\n
         static weight: Node -> Integer\n static limit: Integer\n controlled at: Node",
        "main rule r_Main = if weight(right) = limit then at := left endif",
        expect![[r#"
            asm x
            abstract Node {root, left, right}
            domain Inner subsetof Node {left, right}
            static root: Node element 0
            static left: Inner element 1
            static right: Inner element 2
            static weight: Node -> Integer
            static limit: Integer
            controlled at: Node
            rule r_Main#0 main
              if Eq(missing weight, missing limit)
                at := left
        "#]],
    );
}

#[test]
fn deep_terms_need_little_stack() {
    let sum = vec!["n"; 900].join(" + ");
    let nested = "abs(".repeat(100) + "n" + &")".repeat(100);
    let definitions = format!("main rule r_Main = par n := {sum}\n n := {nested} endpar");
    let model = crate::model("controlled n: Integer", &definitions);
    let length = std::thread::scope(|scope| {
        let small = std::thread::Builder::new().stack_size(256 * 1024);
        let dump = || program::dump(&crate::lowered(&model)).len();
        small.spawn_scoped(scope, dump).expect("a thread").join().expect("no overflow")
    });
    assert!(length > 9 * 900);
}
