//! The library functions, by the values of terms.

use expect_test::expect;
use machine::EngineChoice;

use crate::{Counting, machine_of, run};

/// The value of a term of a domain.
#[track_caller]
fn value(domain: &str, term: &str, expect: expect_test::Expect) {
    let out = run(&format!("signature:\n controlled v: {domain}\ndefinitions:\n main rule r_Main = v := {term}"), 1);
    expect.assert_eq(out.trim_end().trim_start_matches("1: ").trim_start_matches("v="));
}

#[test]
fn numbers() {
    value("Integer", "7 mod 2 - idiv(-7, 2) * 8", expect!["25"]);
    value("Real", "2.0 ^ 10", expect!["1024.0"]);
    value("Real", "7 / 2", expect!["3.5"]);
    value("Integer", "floor(-1.5)", expect!["-2"]);
    value("Integer", "round(2.5) + rtoi(2.9)", expect!["5"]);
    value("Real", "1 + 2.5", expect!["3.5"]);
    value("Integer", "max(3, 4) - min(3, 4) + abs(-2)", expect!["3"]);
    value("Complex", "i2 * i2", expect!["-4.0+i0.0"]);
    value("Real", "1000000.0 * 1000000.0", expect!["1000000000000.0"]);
}

#[test]
fn strings() {
    value("String", "toUpper(\"ab\") + \"c\"", expect![[r#""ABc""#]]);
    value("Seq(String)", "split(\"a,b,c\", \",\")", expect![[r#"["a","b","c"]"#]]);
    value("String", "subString(\"hello\", 1, 3)", expect![[r#""el""#]]);
    value("Boolean", "contains(\"hello\", \"ell\")", expect!["true"]);
    value("String", "toString([1, 2])", expect![[r#""[1,2]""#]]);
}

#[test]
fn sets_sequences_bags_maps() {
    value("Powerset(Integer)", "union({1, 2}, {2, 3})", expect!["{1,2,3}"]);
    value("Powerset(Integer)", "difference({1, 2}, {2, 3})", expect!["{1}"]);
    value("Powerset(Integer)", "symmetricDifference({1, 2}, {2, 3})", expect!["{1,3}"]);
    value("Boolean", "3 in {1, 2} or 3 notin {1}", expect!["true"]);
    value("Seq(Integer)", "append(prepend(0, [1, 2]), 3)", expect!["[0,1,2,3]"]);
    value("Seq(Integer)", "replaceAt(insertAt([1, 2], 1n, 9), 0n, 8)", expect!["[8,9,2]"]);
    value("Integer", "indexOf([5, 6], 6) + length([1, 2, 3])", expect!["4"]);
    value("Seq(Integer)", "tail([1, 2, 3])", expect!["[2,3]"]);
    value("Map(Integer,String)", "assign({1 -> \"a\"}, 2, \"b\")", expect![[r#"{1->"a",2->"b"}"#]]);
    value("String", "at({1 -> \"a\"}, 1)", expect![[r#""a""#]]);
    value("Bag(Integer)", "including(<1, 2>, 1)", expect!["<1,1,2>"]);
    value("Powerset(Integer)", "{$x in {1:5} | $x mod 2 = 1: $x * $x}", expect!["{1,9,25}"]);
    value("Seq(Real)", "[0.0 : 0.3, 0.1]", expect!["[0.0,0.1,0.2,0.3]"]);
    value("Boolean", "(exists unique $x in {1:9} with $x * $x = 49)", expect!["true"]);
    value("Integer", "second((1, 2, 3))", expect!["2"]);
}

/// Where compiled code leaves an undefined element to the library, it has evaluated the written set already.
#[test]
fn an_element_is_chosen_once() {
    let text =
        "signature: domain Few subsetof Integer controlled n: Integer controlled b: Boolean controlled r: Integer
        definitions: domain Few = {1 : 3}
        main rule r_Main = par r := n b := contains({chooseone(Few), 7}, n) endpar
        default init s0: function b = false";
    for engine in [EngineChoice::Interpreted, EngineChoice::Compiled] {
        let mut machine = machine_of(text);
        machine.use_engine(engine);
        let mut environment = Counting::default();
        machine.start(&mut environment).expect("a start");
        for step in 1..4 {
            // Whether it can be made is the library's business.
            let _ = machine.step(&mut environment);
            assert_eq!(environment.chosen, step, "{engine:?}");
        }
    }
}
