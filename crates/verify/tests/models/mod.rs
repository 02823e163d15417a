//! Models of the repository, and models in a text, lowered: what tests of whole models begin with.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::path::Path;
use std::sync::Arc;

use program::Program;
use syntax::SourceFile;

/// Files on disk; imports are relative to who imports.
pub struct Disk;

impl Disk {
    pub fn read(path: &Path) -> Result<SourceFile, String> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(SourceFile::new(path.display().to_string(), text))
    }
}

impl model::Loader for Disk {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        Disk::read(&Path::new(&importer.name).parent().unwrap_or(Path::new("")).join(format!("{path}.asm")))
    }
}

/// The program of a model in which nothing is to be complained about.
pub fn lowered(file: SourceFile) -> Arc<Program> {
    let checked = model::check(file, &mut Disk);
    assert!(checked.diagnostics.is_empty(), "{:#?}", checked.diagnostics);
    Arc::new(program::lower(&checked.model).expect("it can be lowered"))
}
