//! The tests of the grammar, as one program: what `crates/syntax` reads, it reads, too; its words, its queries, its corpus; and
//! whether the generated files are those of `grammar.js`.
//!
//! Tests read the repository.

#![allow(clippy::disallowed_methods, clippy::disallowed_macros, missing_docs, reason = "tests")]

mod corpus;
mod current;
mod queries;
mod sources;
mod support;
mod words;
