//! Where models are read from.

use std::path::{Path, PathBuf};

use syntax::SourceFile;

/// Reads nothing: random models import the built-in library alone.
pub struct NoFiles;

impl model::Loader for NoFiles {
    fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        Err(format!("no file {path}"))
    }
}

/// Reads files beside the importing one.
pub struct Disk;

impl model::Loader for Disk {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let folder = Path::new(&importer.name).parent().unwrap_or(Path::new(""));
        let path = path.replace('\\', "/");
        let path = folder.join(if path.ends_with(".asm") { path } else { format!("{path}.asm") });
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(SourceFile::new(path.display().to_string(), text))
    }
}

/// All models of library/ and examples/, in order.
pub fn models() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut found = Vec::new();
    for folder in ["library", "examples"] {
        walk(&root.join(folder), &mut found);
    }
    found.sort();
    found
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            walk(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "asm") {
            found.push(path);
        }
    }
}
