//! Files for what does not fit in memory. A shell creates them; this crate only writes and reads words.

use std::fmt::Debug;

/// Creates files. The shell reports trouble with them.
pub trait Disk: Debug + Send + Sync {
    /// An empty file, which is deleted when dropped; `None` if there is trouble.
    fn tape(&self) -> Option<Box<dyn Tape>>;
}

/// A file of words.
pub trait Tape: Debug + Send {
    /// Appends words; `false` if there is trouble.
    fn write(&mut self, words: &[u64]) -> bool;
    /// Reads words from this position; `false` if there is trouble.
    fn read(&mut self, at: u64, words: &mut [u64]) -> bool;
}

/// A file could not be read or written, so its contents are unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Lost;
