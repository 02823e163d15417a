//! Stores checkpoints; reasons why one cannot be used.

/// Stores a checkpoint, for example in a file. The shell reports trouble with it.
pub trait Keeper {
    /// A number that identifies the model.
    fn model(&self) -> u64;
    /// Whether it is time to write a checkpoint.
    fn is_due(&mut self) -> bool;
    /// Begins to read the checkpoint; `false` if there is none.
    fn open(&mut self) -> bool;
    /// Reads the next words; `false` if there are not that many.
    fn read(&mut self, words: &mut [u64]) -> bool;
    /// Writes the next words.
    fn write(&mut self, words: &[u64]);
    /// Completes the checkpoint, which replaces the previous one.
    fn end(&mut self);
    /// Removes the checkpoint after the search has ended.
    fn remove(&mut self);
}

/// Why a search cannot continue from a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// It is not a checkpoint.
    Foreign,
    /// Another version of this program made it.
    Version,
    /// It belongs to another model.
    Model,
    /// It belongs to other properties, bounds or machine limits.
    Question,
    /// It differs from what was written.
    Damaged,
}
