//! What a command has read it does not write over: a wrong `-o` must not cost anybody his work.
//!
//! In: the files that are read as models, charts, scenarios, specifications, inputs; and those about to be written. Out: a
//! refusal. INVARIANT: every file that is read by `files` is known here; only who brings a file up to date in place, which
//! is what its user asks for (`fmt`, `chart place`, `chart build` of the model that is there), writes by another way.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::failure::Failure;

/// The files read so far, each by the one path that leads to it without links.
static READ: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Notes a file that is read.
pub fn note(path: &Path) {
    if let Some(path) = one_path(path) {
        READ.lock().unwrap_or_else(PoisonError::into_inner).insert(path);
    }
}

/// Refuses to write a file that was read.
pub fn refuse(path: &Path) -> Result<(), Failure> {
    let read = one_path(path).is_some_and(|path| READ.lock().unwrap_or_else(PoisonError::into_inner).contains(&path));
    if !read {
        return Ok(());
    }
    Err(Failure::usage_with_help(
        format!("{} is what this command reads; it is not written over", path.display()),
        "name another file to write",
    ))
}

/// Whether two paths lead to one file.
pub fn same(first: &Path, second: &Path) -> bool {
    matches!((one_path(first), one_path(second)), (Some(first), Some(second)) if first == second)
}

/// Of an ordinary file; pipes and terminals can be read and written at once.
fn one_path(path: &Path) -> Option<PathBuf> {
    let path = std::fs::canonicalize(path).ok()?;
    path.is_file().then_some(path)
}
