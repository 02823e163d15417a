//! Formatting: the canonical layout of a messy model and scenario, and that faulty texts stay as they are.

use expect_test::{ExpectFile, expect_file};
use syntax::{FileId, Parse, assert_invariants, format, parse_asmetal, parse_avalla, parse_chart, parse_term};

const FILE: FileId = FileId(0);

fn check(text: &str, grammar: fn(FileId, &str) -> Parse, expected: ExpectFile) {
    let parse = grammar(FILE, text);
    assert_eq!(parse.diagnostics, []);
    expected.assert_eq(&format(&parse));
    assert_invariants(text.as_bytes());
}

#[test]
fn a_messy_model() {
    check(include_str!("format/messy.asm"), parse_asmetal, expect_file!["format/neat.asm"]);
}

#[test]
fn a_messy_scenario() {
    check(include_str!("format/messy.avalla"), parse_avalla, expect_file!["format/neat.avalla"]);
}

#[test]
fn a_term() {
    assert_eq!(format(&parse_term(FILE, " f( 1,2 )=not(a)and -x in{1 :3} ")), "f(1, 2) = not (a) and -x in {1 : 3}");
}

#[test]
fn a_faulty_text_stays() {
    let text = "asm a signature:\n\n\n\ndefinitions: main rule r_Main=par x = 1 endpar";
    assert_eq!(format(&parse_asmetal(FILE, text)), text);
}

#[test]
fn a_file_of_comments_alone() {
    let text = "// one\n\n\n\n/* two */\n";
    assert_eq!(format(&parse_asmetal(FILE, text)), "// one\n\n/* two */\n");
    let indented = "\t// one\n\t// two\n";
    assert_invariants(indented.as_bytes());
    assert_eq!(format(&parse_asmetal(FILE, indented)), "// one\n// two\n");
    let on_one_line = " /* one */ // two\n";
    assert_invariants(on_one_line.as_bytes());
    assert_eq!(format(&parse_asmetal(FILE, on_one_line)), "/* one */\n// two\n");
    assert_eq!(format(&parse_asmetal(FILE, "")), "");
}

#[test]
fn comments_before_the_first_token() {
    for (grammar, rest) in [
        (parse_asmetal as fn(FileId, &str) -> Parse, "asm A\n\nsignature:\n\ndefinitions:\n\trule r_a =\n\t\tskip\n"),
        (parse_avalla, "scenario a\nload A.asm\n"),
        (parse_chart, "chart A\n"),
    ] {
        let formatted = |text: &str| {
            assert_invariants(text.as_bytes());
            format(&grammar(FILE, text))
        };
        assert_eq!(formatted(&format!("\t// x\n{rest}")), format!("// x\n{rest}"));
        assert_eq!(formatted(&format!("  /* x */ {rest}")), format!("/* x */\n{rest}"));
        assert_eq!(formatted(&format!("\n\t// x\n\n\n// y\n {rest}")), format!("// x\n\n// y\n{rest}"));
        assert_eq!(formatted(&format!("// x\n\t\t// y\n{rest}")), format!("// x\n// y\n{rest}"));
    }
}

#[test]
fn a_comment_never_swallows_a_token() {
    for text in [
        "asm a // 1\nsignature: // 2\n// 3\ndefinitions: // 4\nmain // 5\nrule // 6\nr_a // 7\n= // 8\nx // 9\n:= // 10\n1 // 11\n+ // 12\n2",
        "asm a signature: definitions: function f = // 1\n{ // 2\n1 // 3\n, // 4\n2 /* 5 */ } /* 6 */ function g = 1 // 7",
        "asm a signature: definitions: main rule r_a = if // 1\na // 2\nthen // 3\nskip // 4\nelse // 5\nskip // 6\nendif // 7",
    ] {
        assert_invariants(text.as_bytes());
        let formatted = format(&parse_asmetal(FILE, text));
        assert_eq!(formatted.matches("//").count(), text.matches("//").count(), "{formatted}");
    }
}
