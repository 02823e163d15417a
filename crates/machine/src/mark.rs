//! Marks: states to which a machine goes back by restoring what its steps overwrote.

use crate::machine::Machine;

/// A state that a machine can go back to, as long as it is not forgotten.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mark {
    /// The number of the first entry after it.
    entry: u64,
    steps: u64,
}

impl Machine {
    /// The present state, to go back to. From the first mark on steps note what they overwrite.
    pub fn mark(&mut self) -> Mark {
        let journal = self.core.journal.get_or_insert_default();
        Mark { entry: journal.end(), steps: self.steps() }
    }

    /// Goes back to a state of before, as [`Machine::restore`] does. Marks set since are void.
    ///
    /// # Panics
    /// The mark was forgotten.
    pub fn go_back(&mut self, mark: &Mark) {
        self.unwind(mark.steps);
        let journal = self.core.journal.get_or_insert_default();
        journal.go_back(mark.entry, &mut self.core.store);
        self.core.disturbed = true;
        self.core.memo.changed();
    }

    /// No mark that was set before this one is gone back to any more.
    pub fn forget_before(&mut self, mark: &Mark) {
        let Some(journal) = &mut self.core.journal else { return };
        journal.forget_before(mark.entry);
    }
}
