//! Stores states on the disk when memory is full, in unnamed files of a folder; they vanish however the search ends.
//!
//! In: the folder. Out: a [`Disk`]. Words have eight bytes, little-endian. INVARIANT: the first trouble with the files
//! is reported when the search has ended.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use groundstate::verify::{Disk, Tape};

use crate::failure::Failure;
use crate::within;

/// A folder for such files.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    failure: Arc<Mutex<Option<Failure>>>,
}

#[derive(Debug)]
struct Unnamed {
    file: File,
    folder: PathBuf,
    /// Its length; `at` is the position of the next access, which the system knows, too.
    end: u64,
    at: u64,
    bytes: Vec<u8>,
    failure: Arc<Mutex<Option<Failure>>>,
}

fn fail(to: &Mutex<Option<Failure>>, failure: Failure) {
    to.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(failure);
}

impl Folder {
    /// Uses an existing folder.
    pub fn new(path: &Path) -> Result<Arc<Folder>, Failure> {
        if !path.is_dir() {
            return Err(Failure::usage_with_help(
                format!("--disk {}: there is no such folder", path.display()),
                "name one with as much room as the states need",
            ));
        }
        within::may_write(&path.join("states"))?;
        // An unwritable folder is better reported before the search than after it.
        tempfile::tempfile_in(path).map_err(|error| Failure::of_file("write", path, error))?;
        Ok(Arc::new(Folder { path: path.to_path_buf(), failure: Arc::default() }))
    }

    /// Ends the storage; returns the first trouble with the files.
    pub fn done(&self) -> Result<(), Failure> {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).take().map_or(Ok(()), Err)
    }
}

impl Disk for Folder {
    fn tape(&self) -> Option<Box<dyn Tape>> {
        match tempfile::tempfile_in(&self.path) {
            Ok(file) => {
                let (folder, failure) = (self.path.clone(), Arc::clone(&self.failure));
                Some(Box::new(Unnamed { file, folder, end: 0, at: 0, bytes: Vec::new(), failure }))
            }
            Err(error) => {
                fail(&self.failure, Failure::of_file("write", &self.path, error));
                None
            }
        }
    }
}

impl Unnamed {
    fn seek(&mut self, to: u64) -> std::io::Result<()> {
        if self.at != to {
            self.file.seek(SeekFrom::Start(to))?;
        }
        Ok(())
    }
}

impl Tape for Unnamed {
    fn write(&mut self, words: &[u64]) -> bool {
        let mut bytes = std::mem::take(&mut self.bytes);
        // Writing in pieces keeps the buffer small.
        let written = words.chunks(1 << 13).try_for_each(|words| {
            bytes.clear();
            bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
            self.seek(self.end)?;
            self.at = u64::MAX;
            self.file.write_all(&bytes)?;
            self.end += bytes.len() as u64;
            self.at = self.end;
            Ok(())
        });
        self.bytes = bytes;
        written.map_err(|error| fail(&self.failure, Failure::of_file("write", &self.folder, error))).is_ok()
    }

    fn read(&mut self, at: u64, words: &mut [u64]) -> bool {
        let mut bytes = std::mem::take(&mut self.bytes);
        bytes.resize(8 * words.len(), 0);
        let read = self.seek(8 * at).and_then(|()| {
            self.at = u64::MAX;
            self.file.read_exact(&mut bytes)
        });
        if read.is_ok() {
            self.at = 8 * (at + words.len() as u64);
            for (word, bytes) in words.iter_mut().zip(bytes.chunks_exact(8)) {
                *word = u64::from_le_bytes(bytes.try_into().expect("there are eight"));
            }
        }
        self.bytes = bytes;
        read.map_err(|error| fail(&self.failure, Failure::of_file("read", &self.folder, error))).is_ok()
    }
}
