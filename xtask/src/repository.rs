//! Where this repository lies, and the files it tracks.
//!
//! In: nothing but where this crate was compiled. Out: paths. It must not know what any of the files mean.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Failure;

/// The root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_path_buf).unwrap_or_default()
}

/// The files that the repository holds, tracked or new and not ignored, relative to its root, sorted.
///
/// # Errors
/// Git cannot be run.
pub fn files() -> Result<Vec<String>, Failure> {
    let listed = Command::new("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .current_dir(root())
        .output()
        .map_err(|error| format!("git cannot be run: {error}"))?;
    let names = String::from_utf8_lossy(&listed.stdout).into_owned();
    let mut names: Vec<String> = names.split('\0').filter(|name| !name.is_empty()).map(String::from).collect();
    names.retain(|name| root().join(name).is_file());
    names.sort();
    Ok(names)
}
