//! However deep or long a text is, parsing ends, stays within the stack of a test thread, keeps the text, and reports
//! each limit once.

use syntax::{
    FileId, MAX_CHAIN, MAX_COMPOSITES, MAX_FAULTS, MAX_NESTING, Parse, SyntaxNode, parse_asmetal, parse_avalla,
    parse_term,
};

const FILE: FileId = FileId(0);

fn height(root: &SyntaxNode) -> usize {
    let (mut depth, mut highest) = (0, 0);
    for event in root.preorder() {
        match event {
            rowan::WalkEvent::Enter(_) => {
                depth += 1;
                highest = highest.max(depth);
            }
            rowan::WalkEvent::Leave(_) => depth -= 1,
        }
    }
    highest
}

fn reports(parse: &Parse, id: &str) -> usize {
    parse.diagnostics.iter().filter(|fault| fault.id == id).count()
}

/// The parse keeps the text and its height; gives how often the nesting is reported.
fn too_deep(parse: &Parse, text: &str) -> usize {
    assert!(parse.syntax().text() == text, "not lossless");
    let highest = height(&parse.syntax());
    assert!(highest <= 2 * (MAX_NESTING + MAX_CHAIN), "{highest} is too high");
    reports(parse, "nested-too-deeply")
}

fn term(text: &str) -> usize {
    too_deep(&parse_term(FILE, text), text)
}

fn rule(body: &str) -> usize {
    let text = format!("asm a signature: definitions: main rule r_Main = {body}");
    too_deep(&parse_asmetal(FILE, &text), &text)
}

#[test]
fn nested_brackets() {
    let check = |count: usize, open: &str, close: &str| {
        assert_eq!(term(&format!("{}1{}", open.repeat(count), close.repeat(count))), 1, "{open}");
        assert_eq!(term(&open.repeat(count)), 1, "{open}");
    };
    for (open, close) in [("(", ")"), ("{", "}"), ("[", "]"), ("<", ">"), ("f(", ")"), ("{$x in ", " : 1}")] {
        check(10_000, open, close);
    }
    check(1_000_000, "(", ")");
    assert_eq!(term(&format!("{}1{}", "(".repeat(200), ")".repeat(200))), 0);
}

#[test]
fn text_behind_a_construct_that_is_too_deep_is_read() {
    let deep = format!("{}1{}", "(".repeat(10_000), ")".repeat(10_000));
    let text = format!("asm a signature: definitions: main rule r_Main = par x := {deep} y = 3 endpar");
    let parse = parse_asmetal(FILE, &text);
    let ids: Vec<_> = parse.diagnostics.iter().map(|fault| fault.id).collect();
    assert_eq!(ids, ["nested-too-deeply", "equals-for-assign"]);
}

#[test]
fn nested_operators() {
    for open in ["not ", "-", "2^(", "a implies (", "let ($x = ", "if ", "switch ", "1 + - ", "(forall $x in "] {
        assert_eq!(term(&format!("{}1", open.repeat(20_000))), 1, "{open}");
    }
}

#[test]
fn chains() {
    for operator in [" + ", " and ", " = ", " implies ", "<-"] {
        let chain = |count: usize| format!("1{}", format!("{operator}1").repeat(count));
        assert_eq!(term(&chain(MAX_CHAIN - 10)), 0, "{operator}");
        assert_eq!(term(&chain(100_000)), 1, "{operator}");
    }
    // chains within parentheses within chains: their heights add up
    let chain = format!("({}", " + 1".repeat(900));
    assert_eq!(term(&format!("{}1{}", "(1 + ".repeat(100), " + 1".repeat(50) + ")")), 0);
    assert_eq!(term(&chain.repeat(100)), 1);
}

#[test]
fn nested_rules() {
    for open in [
        "par ",
        "seq ",
        "if true then ",
        "if true then skip else ",
        "forall $x in D do ",
        "choose $x in D do skip ifnone ",
        "let ($x = 1) in ",
        "while true do ",
        "extend D with $x do ",
        "iterate ",
        "switch x case 1: ",
        "local f: Integer [ ",
    ] {
        assert_eq!(rule(&format!("{}skip", open.repeat(20_000))), 1, "{open}");
    }
    assert_eq!(rule(&format!("par {} skip endpar", "if true then skip else skip endif ".repeat(20_000))), 0);
    assert_eq!(rule(&format!("if a then skip {} endif", "elseif b then skip ".repeat(20_000))), 0);
}

#[test]
fn nested_domains_and_blocks() {
    let text = format!("asm a signature: controlled f: {}Integer{}", "Seq(".repeat(20_000), ")".repeat(20_000));
    assert_eq!(too_deep(&parse_asmetal(FILE, &text), &text), 1);
    let text = format!("scenario a load b {}", "begin x ".repeat(20_000));
    assert_eq!(too_deep(&parse_avalla(FILE, &text), &text), 1);
}

#[test]
fn faults_are_limited() {
    for piece in ["? ", "endpar ", "x = 3 ", ") ", "rule ", "'", "\"\n", "asm ", "import ", "$ ", "/ * ", "<-", "else "]
    {
        for prefix in ["", "asm a signature: definitions: main rule r_Main = par "] {
            let text = format!("{prefix}{}", piece.repeat(20_000));
            for parse in [parse_asmetal(FILE, &text), parse_avalla(FILE, &text), parse_term(FILE, &text)] {
                assert!(parse.syntax().text() == text.as_str());
                assert!(parse.diagnostics.len() <= MAX_FAULTS + 1, "{piece}");
                assert!(!parse.diagnostics.is_empty(), "{piece}");
            }
        }
    }
}

#[test]
fn composite_states_in_one_another() {
    let deepest = |count: usize| {
        let text = format!(
            "chart C machine m {} state b {} state c endmachine",
            "composite state a ".repeat(count),
            "endstate ".repeat(count)
        );
        let parse = syntax::parse_chart(FILE, &text);
        assert!(parse.syntax().text() == text.as_str(), "not lossless");
        assert!(height(&parse.syntax()) < 2 * MAX_NESTING);
        (reports(&parse, "nested-too-deeply"), parse.diagnostics.len())
    };
    assert_eq!(deepest(MAX_COMPOSITES), (0, 0));
    assert_eq!(deepest(MAX_COMPOSITES + 1), (1, 1));
    assert_eq!(deepest(100_000), (1, 1));
}
