//! Files in memory, as a project reads them.

use std::collections::BTreeMap;

use groundstate::workspace::{Absent, Files};
use ide::Project;
use syntax::SourceFile;

/// Files by their paths.
#[derive(Debug, Clone, Default)]
pub struct Texts(pub BTreeMap<String, String>);

impl Files for Texts {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        self.0.get(path).map(|text| SourceFile::new(path, text.as_str())).ok_or(Absent::Missing)
    }
}

/// A project of these files, none of which is being edited.
pub fn project(files: &BTreeMap<String, String>) -> Project<Texts> {
    let mut project = Project::new(Texts(files.clone()));
    project.set_files(files.keys().cloned());
    project
}

/// Files as the disk has them.
#[derive(Debug, Clone, Copy)]
pub struct Folder;

impl Files for Folder {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        std::fs::read_to_string(path).map(|text| SourceFile::new(path, text)).map_err(|_| Absent::Missing)
    }
}
