//! A block is what stands between two fences at the beginning of lines, whatever its info string says.
//!
//! A page whose last block has no end is a fault of the page: a reader that skipped it would let a test pass unseen.

use testkit::Page;
use testkit::page::{Block, blocks};

#[test]
fn blocks_are_taken_out_of_pages() {
    let text = "a\n```asmetal run\nx := 1\n\n```\n  ```\nb\n```\n```\n";
    let expected = [Block { info: "asmetal run", text: "x := 1\n\n", line: 2 }, Block { info: "", text: "", line: 8 }];
    assert_eq!(blocks(text), expected);
}

#[test]
#[should_panic(expected = "line 3 has no end")]
fn a_block_without_an_end_is_no_block() {
    blocks("a\n\n```asmetal\nx\n");
}

#[test]
fn examples_are_found_by_their_whole_info_string() {
    let page = Page { path: "p.md".to_string(), text: "```a b\n1\n```\n```a\n2\n```\n```a\n3\n```\n".to_string() };
    assert_eq!((page.example("a"), page.texts("a"), page.texts("b")), ("2\n", vec!["2\n", "3\n"], vec![]));
    assert!(Page::fault("inconsistent-update").blocks().iter().any(|block| block.info == "asmetal run"));
}
