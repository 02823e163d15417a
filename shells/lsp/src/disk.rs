//! Files as the disk has them.
//!
//! In: paths. Out: texts, read again when the file's time or length is another; the files of folders that are open. LIMIT: a file
//! of more than [`BYTES`] is not read; of a folder so many entries are looked at.

use std::collections::BTreeMap;
use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use groundstate::Kind;
use groundstate::workspace::{Absent, Files};
use syntax::{NotText, SourceFile};

/// LIMIT: bytes of a file; a model of a tenth of it is far more than anybody writes.
const BYTES: u64 = 32 << 20;

/// LIMIT: entries of folders that are looked at for files of a project.
const ENTRIES: usize = 50_000;

/// LIMIT: folders in folders.
const DEPTH: usize = 12;

/// LIMIT: texts that are kept.
const KEPT: usize = 256;

/// A folder of the project.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folder {
    /// Where it is.
    pub path: String,
    /// With the folders in it: it is open in the editor, and not only a file of it.
    pub whole: bool,
}

/// See the module.
#[derive(Debug, Default)]
pub struct Disk {
    read: BTreeMap<String, (Option<SystemTime>, u64, SourceFile)>,
    /// Files elsewhere are as if they were not there.
    within: Option<PathBuf>,
}

impl Disk {
    /// The whole disk, or what is in one folder of it, links followed.
    pub fn new(within: Option<PathBuf>) -> Disk {
        Disk { read: BTreeMap::new(), within }
    }
}

impl Files for Disk {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        let unreadable = |error: std::io::Error| match error.kind() {
            ErrorKind::NotFound | ErrorKind::NotADirectory => Absent::Missing,
            _ => Absent::Unreadable(format!("{path} cannot be read: {error}")),
        };
        if let Some(folder) = &self.within {
            let outside =
                || Absent::Unreadable(format!("{path} lies outside the folder that is open, {}", folder.display()));
            // A library that is built in has no place on the disk.
            if Path::new(path).is_absolute() && !Path::new(path).starts_with(folder) {
                return Err(outside());
            }
            if !fs::canonicalize(path).map_err(unreadable)?.starts_with(folder) {
                return Err(outside());
            }
        }
        let data = fs::metadata(path).map_err(unreadable)?;
        if !data.is_file() {
            return Err(Absent::Unreadable(format!("{path} is no file")));
        }
        let (time, length) = (data.modified().ok(), data.len());
        if let Some((known, size, source)) = self.read.get(path)
            && (*known, *size) == (time, length)
            && time.is_some()
        {
            return Ok(source.clone());
        }
        let mut bytes = Vec::new();
        let file = fs::File::open(path).map_err(unreadable)?;
        file.take(BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
        if bytes.len() as u64 > BYTES {
            return Err(Absent::Unreadable(format!("{path} is too large to be read")));
        }
        let source = SourceFile::decode(path, bytes)
            .map_err(|NotText { offset }| Absent::Unreadable(format!("{path} is not text: see byte {offset}")))?;
        if self.read.len() >= KEPT {
            self.read.clear();
        }
        self.read.insert(path.to_string(), (time, length, source.clone()));
        Ok(source)
    }
}

/// The files of a project in some folders, by their names. Folders that begin with a point, and those of builds, are left out; so is
/// what is behind a link, since a file is to be there once.
pub fn project_files(folders: &[Folder]) -> Vec<String> {
    let mut found = Vec::new();
    let mut left = ENTRIES;
    for folder in folders {
        let depth = if folder.whole { DEPTH } else { 0 };
        walk(Path::new(&folder.path), depth, &mut left, &mut found);
    }
    found.sort();
    found.dedup();
    found
}

fn walk(folder: &Path, depth: usize, left: &mut usize, found: &mut Vec<String>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let mut paths: Vec<_> = entries.filter_map(Result::ok).map(|entry| (entry.path(), entry.file_type())).collect();
    paths.sort_by(|a, b| a.0.cmp(&b.0));
    for (path, kind) in paths {
        if *left == 0 {
            return;
        }
        *left -= 1;
        let Ok(kind) = kind else { continue };
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if kind.is_dir() {
            if depth > 0 && !name.starts_with('.') && !matches!(name, "target" | "node_modules" | "build") {
                walk(&path, depth - 1, left, found);
            }
        } else if kind.is_file() && Kind::of(&path).is_some() {
            found.extend(path.to_str().map(str::to_string));
        }
    }
}
