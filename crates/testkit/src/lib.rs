//! Tools for the tests of several crates: loaders, the blocks of Markdown pages, solver processes, JSON Schema, random
//! numbers, the repository's files.
//!
//! It does I/O, which the crates under test must not, so it is a dev-dependency and nothing else. It knows `syntax`, `model`,
//! `explore` and `solve` for their traits. The unit tests of these see another copy of these types: only their integration
//! tests can use it. All other tests can.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "tests read the repository, run solvers, and say when there is none"
)]

pub mod loader;
pub mod memory;
pub mod page;
pub mod random;
pub mod repository;
pub mod sample;
pub mod schema;
pub mod solver;

pub use loader::{Disk, EditedDisk, NoFiles, Patterns, Texts, WithPatterns};
pub use page::Page;
pub use random::Random;
pub use solver::NoSolver;
