//! Keeps a checkpoint of a search in a file: words of eight bytes, little-endian.
//!
//! In: the path, the fingerprints of the models. Out: a [`Keeper`]. The file gets its name when it is complete. INVARIANT: if
//! the file makes trouble, the search goes on without it, and the first trouble is reported at the end.

use std::fs::File;
use std::io::{BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use groundstate::verify::{Keeper, Refusal};

use crate::failure::Failure;
use crate::files::Unfinished;

/// The shortest time between two checkpoints.
const BETWEEN: Duration = Duration::from_secs(60);
/// The search runs at least this many times as long as the last checkpoint took to write.
const SHARE: u32 = 20;

/// A checkpoint in a file.
pub struct Checkpoint {
    path: PathBuf,
    model: u64,
    last: Instant,
    wait: Duration,
    reading: Option<BufReader<File>>,
    writing: Option<(Unfinished, Instant)>,
    /// Writing has failed; the rest of this checkpoint is dropped.
    lost: bool,
    failure: Option<Failure>,
}

impl Checkpoint {
    /// The checkpoint of models in a file, which may not exist yet.
    pub fn new(path: &Path, fingerprints: &[&str]) -> Result<Checkpoint, Failure> {
        if path.is_dir() {
            return Err(Failure::Folder(path.to_path_buf()));
        }
        // An unwritable file is better reported before the search than after it.
        drop(Unfinished::create(path)?);
        Ok(Checkpoint {
            path: path.to_path_buf(),
            model: fingerprints.iter().fold(0, |all: u64, fingerprint| {
                all.rotate_left(1) ^ u64::from_str_radix(fingerprint, 16).unwrap_or_default()
            }),
            last: Instant::now(),
            wait: BETWEEN,
            reading: None,
            writing: None,
            lost: false,
            failure: None,
        })
    }

    /// Why the search cannot continue from the file; it asks about `what`.
    pub fn refused(self, refusal: Refusal, what: &str) -> Failure {
        if let Some(failure) = self.failure {
            return failure;
        }
        let path = self.path.display();
        let message = match refusal {
            Refusal::Foreign => format!("{path} is not a checkpoint"),
            Refusal::Version => format!("{path} is a checkpoint of another version of groundstate"),
            Refusal::Model => format!("{path} is a checkpoint of another model, or of one that has changed since"),
            Refusal::Question => format!("{path} is a checkpoint of a search with {what}, bounds or limits"),
            Refusal::Damaged => format!("{path} is damaged: it differs from what was written"),
        };
        Failure::usage_with_help(message, "remove it to start over, or name another file")
    }

    /// Ends the checkpoint; returns the first trouble with the file.
    pub fn done(self) -> Result<(), Failure> {
        self.failure.map_or(Ok(()), Err)
    }

    fn fail(&mut self, failure: Failure) {
        self.writing = None;
        self.lost = true;
        self.failure.get_or_insert(failure);
    }
}

impl Keeper for Checkpoint {
    fn model(&self) -> u64 {
        self.model
    }

    fn is_due(&mut self) -> bool {
        self.last.elapsed() > self.wait
    }

    fn open(&mut self) -> bool {
        match File::open(&self.path) {
            Ok(file) => {
                self.reading = Some(BufReader::new(file));
                true
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => false,
            // A file that cannot be opened reads as if it ended too soon, and is not replaced.
            Err(error) => {
                self.failure = Some(Failure::of_file("read", &self.path, error));
                true
            }
        }
    }

    fn read(&mut self, words: &mut [u64]) -> bool {
        let Some(file) = &mut self.reading else { return false };
        words.iter_mut().all(|word| {
            let mut bytes = [0; 8];
            let read = file.read_exact(&mut bytes).is_ok();
            *word = u64::from_le_bytes(bytes);
            read
        })
    }

    fn write(&mut self, words: &[u64]) {
        self.reading = None;
        if self.lost {
            return;
        }
        let now = Instant::now();
        let (mut file, began) = match self.writing.take() {
            Some(writing) => writing,
            None => match Unfinished::create(&self.path) {
                Ok(file) => (file, now),
                Err(failure) => return self.fail(failure),
            },
        };
        for word in words {
            if let Err(error) = file.write_all(&word.to_le_bytes()) {
                return self.fail(Failure::of_file("write", &self.path, error));
            }
        }
        self.writing = Some((file, began));
    }

    fn end(&mut self) {
        self.last = Instant::now();
        self.lost = false;
        let Some((file, began)) = self.writing.take() else { return };
        if let Err(failure) = file.finish() {
            return self.fail(failure);
        }
        self.last = Instant::now();
        self.wait = BETWEEN.max(began.elapsed() * SHARE);
    }

    fn remove(&mut self) {
        self.reading = None;
        match std::fs::remove_file(&self.path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                self.fail(Failure::of_file("remove", &self.path, error));
            }
            _ => {}
        }
    }
}
