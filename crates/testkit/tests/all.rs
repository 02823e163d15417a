//! What the tests of the other crates rely on: where imports lead, what a block is, which files are found,
//! what a schema refuses.
//!
//! One program with a module for each part of the crate. Solvers have none: whether they are installed is not for a test to say.

mod loader;
mod page;
mod repository;
mod schema;
