//! The corpus of the grammar, in the format of tree-sitter's own tests: a title between lines of `=`, a text, a line of `-`, the tree.
//!
//! `tree-sitter test` runs the same files, and `tree-sitter test --update` writes the trees.

use crate::support::{corpus, tree};

/// A tree as one line, whatever its layout.
fn squeezed(tree: &str) -> String {
    let words: Vec<&str> = tree.split_whitespace().collect();
    words.join(" ").replace(" )", ")")
}

#[test]
fn the_corpus() {
    let cases = corpus();
    assert!(cases.len() > 20, "{} cases", cases.len());
    for (source, expected) in cases {
        let found = tree(&source.text).root_node().to_sexp();
        assert_eq!(squeezed(&found), squeezed(&expected), "{}", source.name);
        assert!(source.is_clean(), "{}: {:?}", source.name, source.parse().diagnostics);
    }
}
