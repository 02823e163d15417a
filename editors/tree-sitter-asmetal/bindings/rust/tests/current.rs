//! The generated files are those of `grammar.js`, and nobody changed them by hand.
//!
//! `generate.sh` writes the sums of all of them when it has generated; tree-sitter's program, which generates, is on few machines.

use sha2::{Digest, Sha256};

use crate::support::{folder, text};

#[test]
fn the_generated_parser_is_that_of_the_grammar() {
    let sums = text("src/sums");
    let files: Vec<&str> = sums.lines().filter_map(|line| line.split_whitespace().nth(1)).collect();
    assert_eq!(files, ["grammar.js", "src/grammar.json", "src/node-types.json", "src/parser.c"]);
    for line in sums.lines() {
        let (sum, file) = line.split_once("  ").expect("a sum and a file");
        let bytes = std::fs::read(folder().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        let found: String = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(found, sum, "{file} is not what the parser was generated from: run generate.sh");
    }
}
