//! The tests of `ide` as one program: the pages of `spec/ide`, and what must hold whatever the text.
#![allow(clippy::disallowed_methods, reason = "tests rewrite the pages on request")]

mod drawing;
mod edits;
mod keys;
mod pages;
mod refactor;
mod support;
mod system;
