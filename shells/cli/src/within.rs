//! Keeps a command in one folder: nothing outside is read or written, whatever a model imports and wherever links lead.
//!
//! In: the folder of `--within`; the files about to be read or written. Out: a refusal. INVARIANT: who opens a file of users asks here
//! first: `files`, and what reads along or keeps states on the disk; the built-in libraries are no files.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::failure::Failure;

static FOLDER: OnceLock<PathBuf> = OnceLock::new();

/// From now on this is the folder.
pub fn keep(folder: &Path) -> Result<(), Failure> {
    let path = std::fs::canonicalize(folder).map_err(|error| Failure::of_file("read", folder, error))?;
    // The command line is read once.
    _ = FOLDER.set(path);
    Ok(())
}

/// Refuses to read a file outside the folder. What is not there is for the reader to tell.
pub fn may_read(path: &Path) -> Result<(), Failure> {
    match (FOLDER.get(), std::fs::canonicalize(path)) {
        (Some(folder), Ok(real)) if !real.starts_with(folder) => Err(outside(path, folder)),
        _ => Ok(()),
    }
}

/// Refuses to write a file outside the folder.
pub fn may_write(path: &Path) -> Result<(), Failure> {
    let Some(folder) = FOLDER.get() else { return Ok(()) };
    let parent = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let real = match std::fs::canonicalize(path) {
        Ok(real) => real,
        // A link to nothing leads nobody knows where.
        Err(_) if std::fs::symlink_metadata(path).is_ok() => return Err(outside(path, folder)),
        Err(_) => match std::fs::canonicalize(parent) {
            Ok(real) => real,
            // Nothing can be written there.
            Err(_) => return Ok(()),
        },
    };
    if real.starts_with(folder) { Ok(()) } else { Err(outside(path, folder)) }
}

fn outside(path: &Path, folder: &Path) -> Failure {
    Failure::usage_with_help(
        format!("{} lies outside {}", path.display(), folder.display()),
        "name a folder with --within that holds both",
    )
}
