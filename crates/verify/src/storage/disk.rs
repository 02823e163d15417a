//! Files for what memory has no room for: made by a shell, known here by what is written to and read from them.

use std::fmt::Debug;

/// Makes files. Trouble with one is the shell's to tell.
pub trait Disk: Debug + Send + Sync {
    /// An empty file, which is gone when it is dropped; none where there is trouble.
    fn tape(&self) -> Option<Box<dyn Tape>>;
}

/// A file of words.
pub trait Tape: Debug + Send {
    /// Writes on at its end; false where there is trouble.
    fn write(&mut self, words: &[u64]) -> bool;
    /// Reads the words from this place on; false where there is trouble.
    fn read(&mut self, at: u64, words: &mut [u64]) -> bool;
}

/// There was trouble with a file: nothing is known of what it held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Lost;
