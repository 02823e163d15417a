//! Which files that are not open are to be checked, and when again.
//!
//! In: the files of the folders, and what was read for each when it was checked. Out: the next file to check. A file is checked again
//! when a text that it was checked with is another. LIMIT: so many files of a folder are checked, and none that is larger.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::time::SystemTime;

/// LIMIT: files that are not open and are checked all the same.
const FILES: usize = 2_000;

/// LIMIT: bytes of such a file.
const BYTES: u64 = 1 << 20;

/// What tells a text on the disk from another: its time and length; none if there is none.
type Stamp = Option<(SystemTime, u64)>;

/// See the module.
#[derive(Debug, Default)]
pub struct Background {
    /// The files of the folders.
    files: BTreeSet<String>,
    /// Each file that was checked, with the paths that were read for it.
    checked: BTreeMap<String, BTreeMap<String, Stamp>>,
    /// Those that are to be checked.
    waiting: BTreeSet<String>,
}

impl Background {
    /// From now on these are the files of the folders, or what is in them may have changed. Out: those that are there no more.
    pub fn set_files(&mut self, files: Vec<String>) -> Vec<String> {
        self.files = files.into_iter().take(FILES).collect();
        let gone: Vec<String> = self.checked.keys().filter(|path| !self.files.contains(*path)).cloned().collect();
        self.checked.retain(|path, _| self.files.contains(path));
        self.waiting = self.files.iter().filter(|path| !self.holds(path)).cloned().collect();
        gone
    }

    /// What was found still holds.
    fn holds(&self, path: &str) -> bool {
        self.checked.get(path).is_some_and(|read| read.iter().all(|(path, known)| stamp(path) == *known))
    }

    /// The text at a path is another one.
    pub fn changed(&mut self, path: &str) {
        let over = self.checked.iter().filter(|(file, read)| *file == path || read.contains_key(path));
        self.waiting.extend(over.map(|(file, _)| file.clone()));
        self.waiting.extend(self.files.get(path).cloned());
    }

    /// There is nothing to check.
    pub fn is_done(&self) -> bool {
        self.waiting.is_empty()
    }

    /// The next file to check that is not open and not too large.
    pub fn next(&mut self, is_open: impl Fn(&str) -> bool) -> Option<String> {
        loop {
            let path = self.waiting.pop_first()?;
            let fits = |data: fs::Metadata| data.len() <= BYTES;
            if self.files.contains(&path) && !is_open(&path) && fs::metadata(&path).is_ok_and(fits) {
                return Some(path);
            }
        }
    }

    /// A file was checked with these texts.
    pub fn checked(&mut self, path: String, read: BTreeSet<String>) {
        let read = read.into_iter().map(|path| (path.clone(), stamp(&path))).collect();
        self.checked.insert(path, read);
    }

    /// The check of a file was stopped.
    pub fn stopped(&mut self, path: String) {
        self.waiting.insert(path);
    }
}

fn stamp(path: &str) -> Stamp {
    let data = fs::metadata(path).ok()?;
    Some((data.modified().ok()?, data.len()))
}
