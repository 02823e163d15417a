//! The pages in spec/ say the truth: each example parses, and each fault has a page whose example shows it.
//!
//! A block ```` ```asmetal ```` is a file, ```` ```asmetal rule ```` and ```` ```asmetal term ```` are fragments,
//! ```` ```avalla ```` is a scenario, ```` ```chart ```` a chart; the word `fault` behind these says that the page's own fault is in it.

use syntax::{
    FAULT_IDS, FileId, MAX_FAULTS, Parse, SourceFile, assert_invariants, parse_asmetal, parse_avalla, parse_chart,
    parse_term,
};
use testkit::Page;
use testkit::page::Block;

fn parse(block: &Block<'_>) -> Option<Parse> {
    let file = FileId(0);
    let words: Vec<&str> = block.info.split_whitespace().filter(|word| *word != "fault").collect();
    Some(match words[..] {
        ["asmetal"] => parse_asmetal(file, block.text),
        ["asmetal", "rule"] => {
            parse_asmetal(file, &format!("asm example signature: definitions: rule r_example =\n{}", block.text))
        }
        ["asmetal", "term"] => parse_term(file, block.text),
        ["avalla"] => parse_avalla(file, block.text),
        ["chart"] => parse_chart(file, block.text),
        ["asmetal", "built"] => parse_asmetal(file, block.text),
        ["ebnf" | "text"] | [] => return None,
        _ => panic!("line {}: a block of an unknown kind: {}", block.line, block.info),
    })
}

fn ids(parse: &Parse) -> Vec<&'static str> {
    parse.diagnostics.iter().map(|fault| fault.id).collect()
}

#[test]
fn the_examples_of_the_language_parse() {
    for name in ["language", "avalla", "charts"] {
        let mut count = 0;
        for block in Page::spec(name).blocks() {
            let Some(parse) = parse(&block) else { continue };
            assert!(parse.diagnostics.is_empty(), "{name}.md, line {}: {:?}", block.line, parse.diagnostics);
            assert_invariants(block.text.as_bytes());
            count += 1;
        }
        assert!(count >= 5, "{name}.md has hardly an example");
    }
}

#[test]
fn each_fault_has_a_page_whose_example_shows_it() {
    for id in FAULT_IDS {
        let page = Page::fault(id);
        let blocks = page.blocks();
        let example = blocks.iter().find(|block| block.info.ends_with(" fault"));
        match (example, *id) {
            (None, "file-too-large" | "too-many-faults") => {} // too long for a page; see below and `limits.rs`
            (None, "not-utf8") => {}                           // a page is UTF-8; see below
            (None, _) => panic!("the page of {id} has no example"),
            (Some(block), _) => {
                let parse = parse(block).expect("an example that can be parsed");
                assert_eq!(ids(&parse), [*id], "the example of {id}");
            }
        }
    }
}

#[test]
fn the_fault_of_too_many_faults() {
    let text = format!("asm a signature: definitions: main rule r_a = par {} endpar", "x = 1 ".repeat(MAX_FAULTS + 1));
    assert_eq!(ids(&parse_asmetal(FileId(0), &text)).last(), Some(&"too-many-faults"));
}

#[test]
fn the_fault_of_a_text_that_is_not_utf8() {
    let source = SourceFile::decode("a.asm", b"asm a // caff\xe8".to_vec()).expect("a text");
    assert_eq!(source.foreign.map(|foreign| foreign.warning(FileId(0)).id), Some("not-utf8"));
}

#[test]
fn the_ids_are_in_order() {
    assert!(FAULT_IDS.is_sorted());
}
