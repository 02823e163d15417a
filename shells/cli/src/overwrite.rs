//! Refuses to overwrite a file that the command has read: a wrong `-o` must not destroy anybody's work.
//!
//! In: the files that are read as models, charts, scenarios, specifications, inputs; and the files about to be written.
//! Out: a refusal. INVARIANT: every file that `files` reads is recorded here. Only commands that update a file in place
//! as their user asks (`fmt`, `chart place`, `chart build` of an existing model) write without this check.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::failure::Failure;

/// The files read so far, as canonical paths.
static READ: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Records a file that is read.
pub fn note(path: &Path) {
    if let Some(path) = one_path(path) {
        READ.lock().unwrap_or_else(PoisonError::into_inner).insert(path);
    }
}

/// Refuses to write to a file that was read.
pub fn refuse(path: &Path) -> Result<(), Failure> {
    let read = one_path(path).is_some_and(|path| READ.lock().unwrap_or_else(PoisonError::into_inner).contains(&path));
    if !read {
        return Ok(());
    }
    Err(Failure::usage_with_help(
        format!("{} is read by this command, so it is not overwritten", path.display()),
        "name another file to write",
    ))
}

/// Whether two paths name the same file.
pub fn same(first: &Path, second: &Path) -> bool {
    matches!((one_path(first), one_path(second)), (Some(first), Some(second)) if first == second)
}

/// The canonical path of an ordinary file. Pipes and terminals have none, since they can be read and written at once.
fn one_path(path: &Path) -> Option<PathBuf> {
    let path = std::fs::canonicalize(path).ok()?;
    path.is_file().then_some(path)
}
