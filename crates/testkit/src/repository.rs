//! The repository that this crate was compiled in: its root, texts of it, all files below a folder.
//!
//! In: paths from the root. Out: absolute paths without `..`, sorted, and texts. What a test asks for must be there: a
//! missing folder is a panic, not an empty list, so no test passes because it found nothing to look at.

use std::path::{Path, PathBuf};

/// The root of the repository.
pub fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.ancestors().nth(2).expect("this crate lies two folders below the root").to_path_buf()
}

/// The text of a file.
///
/// # Panics
/// It cannot be read, or is not UTF-8.
pub fn text(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The text of a file; none if it is not UTF-8, as some that are there to be refused.
///
/// # Panics
/// It cannot be read.
pub fn text_if_utf8(path: impl AsRef<Path>) -> Option<String> {
    let path = root().join(path);
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    String::from_utf8(bytes).ok()
}

/// All files below a folder, at any depth, whose names have one of these endings (`asm`, not `.asm`), in order.
///
/// # Panics
/// The folder cannot be read.
pub fn files(folder: impl AsRef<Path>, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    walk(&root().join(folder), endings, &mut found);
    found
}

fn walk(folder: &Path, endings: &[&str], found: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            walk(&path, endings, found);
        } else if path.extension().is_some_and(|ending| endings.iter().any(|wanted| ending == *wanted)) {
            found.push(path);
        }
    }
}
