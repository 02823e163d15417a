//! Compiles the generated parser.
//!
//! In: `src/parser.c`, which `generate.sh` writes. Out: a static library that this crate links.

#![allow(clippy::disallowed_macros, reason = "Cargo is told by printing")]

fn main() {
    println!("cargo:rerun-if-changed=src/parser.c");
    cc::Build::new().include("src").file("src/parser.c").std("c11").warnings(false).compile("tree-sitter-asmetal");
}
