//! The generated parser of AsmetaL, Avalla and charts, for programs in Rust that use tree-sitter.
//!
//! In: nothing. Out: [`LANGUAGE`]. It must not know `crates/syntax`: that is the parser that counts, and the tests beside
//! this file hold the generated one to it.

#![allow(unsafe_code, reason = "the parser is C that tree-sitter generates")]

use tree_sitter_language::LanguageFn;

unsafe extern "C" {
    fn tree_sitter_asmetal() -> *const ();
}

/// The language, for `tree_sitter::Parser::set_language`.
// SAFETY: `src/parser.c` defines this function, and it returns a pointer to a static `TSLanguage`.
pub const LANGUAGE: LanguageFn = unsafe { LanguageFn::from_raw(tree_sitter_asmetal) };
