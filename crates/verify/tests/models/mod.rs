//! Models of the repository, and models from texts, lowered for tests of whole models.
//!
//! In: a file, read from the disk or made from a text. Out: its program; a model with any fault fails the test.

use std::sync::Arc;

use program::Program;
use syntax::SourceFile;

pub use testkit::Disk;

/// The program of a model without any faults.
pub fn lowered(file: SourceFile) -> Arc<Program> {
    let checked = model::check(file, &mut Disk);
    assert!(checked.diagnostics.is_empty(), "{:#?}", checked.diagnostics);
    Arc::new(program::lower(&checked.model).expect("it can be lowered"))
}
