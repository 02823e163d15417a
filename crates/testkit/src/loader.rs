//! Where tests read imported files from: nowhere, a map of texts, the disk, the pattern library.
//!
//! In: an importing file and the path that its import says. Out: the file that the path leads to, under one name
//! however it is reached. Loaders know names and endings, and nothing of a file's contents.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use model::Loader;
use syntax::SourceFile;

use crate::repository;

/// Finds no file: the model imports only built-in libraries.
#[derive(Debug, Clone, Copy)]
pub struct NoFiles;

impl Loader for NoFiles {
    fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        Err(format!("there is no file {path}"))
    }
}

/// Files in memory, by their paths.
#[derive(Debug, Clone, Default)]
pub struct Texts(BTreeMap<String, String>);

impl Texts {
    /// Files by path and text.
    pub fn of<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        Texts(files.into_iter().map(|(path, text)| (path.to_string(), text.to_string())).collect())
    }
}

impl Loader for Texts {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let name = beside(&importer.name, path).display().to_string();
        let text = self.0.get(&name).ok_or_else(|| "there is no such file".to_string())?;
        Ok(SourceFile::new(name, text.as_str()))
    }
}

/// Files on the disk, relative to the importing file. Bytes that are not UTF-8 are replaced.
#[derive(Debug, Clone, Copy)]
pub struct Disk;

impl Disk {
    /// The file at a path.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn read(path: &Path) -> Result<SourceFile, String> {
        let path = tidied(path);
        let bytes = std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(SourceFile::new(path.display().to_string(), String::from_utf8_lossy(&bytes).into_owned()))
    }
}

impl Loader for Disk {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        Disk::read(&beside(&importer.name, path))
    }
}

/// Files on the disk in which one text is replaced by another.
#[derive(Debug, Clone)]
pub struct EditedDisk {
    /// The text to replace, wherever it stands.
    pub from: String,
    /// What is put there.
    pub to: String,
}

impl EditedDisk {
    /// The file at a path.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn read(&self, path: &Path) -> Result<SourceFile, String> {
        let file = Disk::read(path)?;
        let text = file.text.replace(&self.from, &self.to);
        Ok(SourceFile::new(file.name, text))
    }
}

impl Loader for EditedDisk {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        self.read(&beside(&importer.name, path))
    }
}

/// Only the pattern library: the last part of a path names the module, wherever the importing file lies.
#[derive(Debug, Clone, Copy)]
pub struct Patterns;

impl Loader for Patterns {
    fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let name = named(path.rsplit(['/', '\\']).next().unwrap_or(path));
        let file = Disk::read(&repository::root().join("library/patterns").join(&name))?;
        Ok(SourceFile::new(format!("patterns/{name}"), file.text))
    }
}

/// Files in memory, and the pattern library for paths that begin with `patterns/`.
#[derive(Debug, Clone, Default)]
pub struct WithPatterns(pub Texts);

impl Loader for WithPatterns {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        if importer.name.starts_with("patterns/") || path.starts_with("patterns/") {
            return Patterns.load(importer, path);
        }
        self.0.load(importer, path)
    }
}

/// The path of an import with its ending: `.asm` if none is written.
fn named(path: &str) -> String {
    let path = path.replace('\\', "/");
    let complete = [".asm", ".avalla", ".chart"].iter().any(|ending| path.ends_with(ending));
    if complete { path } else { path + ".asm" }
}

/// The path of an import, relative to the folder from which the importing file's path starts.
fn beside(importer: &str, path: &str) -> PathBuf {
    tidied(&Path::new(importer).parent().unwrap_or(Path::new("")).join(named(path)))
}

/// `a/b/../c` as `a/c`.
fn tidied(path: &Path) -> PathBuf {
    let mut tidied = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir if matches!(tidied.components().next_back(), Some(Component::Normal(_))) => {
                tidied.pop();
            }
            other => tidied.push(other),
        }
    }
    tidied
}
