//! What compiled code refers to by number.
//!
//! In: what the translator came upon. Out: the same for the helpers, whichever machine runs the code.

use program::TermId;

/// See the module.
#[derive(Debug, Default)]
pub(super) struct Numbered {
    /// Frames opened for the interpreter: their size and the slots that are handed over.
    pub spills: Vec<(u32, Vec<u32>)>,
    /// The fixed terms whose values are tabulated.
    pub fixed: Vec<Fixed>,
}

/// A term that depends on nothing but its variables, tabulated over their values.
#[derive(Debug)]
pub(super) struct Fixed {
    pub term: TermId,
    pub spill: u64,
    /// How many values its variables have together.
    pub entries: usize,
}

impl Numbered {
    /// The number of a list of slots.
    pub fn spill(&mut self, frame: u32, slots: Vec<u32>) -> usize {
        let entry = (frame, slots);
        if let Some(known) = self.spills.iter().position(|spill| *spill == entry) {
            return known;
        }
        self.spills.push(entry);
        self.spills.len() - 1
    }

    /// The number of a fixed term.
    pub fn table(&mut self, fixed: Fixed) -> usize {
        self.fixed.push(fixed);
        self.fixed.len() - 1
    }
}
