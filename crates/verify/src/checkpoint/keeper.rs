//! Who keeps a checkpoint, and why one is none to go on from.

/// Where a checkpoint is kept: in a file, by a shell. Trouble with it is the shell's.
pub trait Keeper {
    /// The model, by a number that another model does not have.
    fn model(&self) -> u64;
    /// Whether it is time to keep what there is.
    fn is_due(&mut self) -> bool;
    /// Begins to read the checkpoint; false where there is none.
    fn open(&mut self) -> bool;
    /// Reads on; false where there are not as many words.
    fn read(&mut self, words: &mut [u64]) -> bool;
    /// Writes on.
    fn write(&mut self, words: &[u64]);
    /// What was written is whole: it takes the place of the checkpoint before.
    fn end(&mut self);
    /// The search has ended: there is nothing to go on with.
    fn remove(&mut self);
}

/// Why a search does not go on from a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// It is none.
    Foreign,
    /// Another version of this program made it.
    Version,
    /// It is of another model.
    Model,
    /// It is of other properties, bounds or limits of the machine.
    Question,
    /// It is not as it was written.
    Damaged,
}
