//! Models of the repository, and models in a text, lowered: what tests of whole models begin with.
//!
//! In: a file, read from the disk or made of a text. Out: its program; a model with any fault is a failure of the test.

use std::sync::Arc;

use program::Program;
use syntax::SourceFile;

pub use testkit::Disk;

/// The program of a model in which nothing is to be complained about.
pub fn lowered(file: SourceFile) -> Arc<Program> {
    let checked = model::check(file, &mut Disk);
    assert!(checked.diagnostics.is_empty(), "{:#?}", checked.diagnostics);
    Arc::new(program::lower(&checked.model).expect("it can be lowered"))
}
