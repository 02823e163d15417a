//! How often a tree of decisions has known the steps of a state, and whether it should give way.
//!
//! In: each walk, and each that did not find all it looked for. Out: two judgements, for two ways to make steps without the
//! tree. A walk costs a tenth of a compiled step; a step that the machine makes for the tree to learn costs fifty compiled
//! ones. So the machine alone is better than a tree that misses one state in four, and machine code is better than one that has
//! learned much and still misses one in sixteen. How long a step takes the machine is measured by how often it looks at a field.
//! INVARIANT: a record counts; what is done about it is up to the caller.

/// LIMIT: walks of the tree before it is first compared with the machine.
const TRIAL: u64 = 1 << 14;
/// The machine wins if more than one walk in so many misses.
const POOR: u64 = 4;
/// LIMIT: misses of the tree before it is compared with machine code. Compiling takes no longer than the machine takes for so many steps.
const PATIENCE: u64 = 1 << 11;
/// LIMIT: how often steps that the tree has learned have looked at a field, before machine code wins if hardly any walk found anything.
/// Compiling takes about as long as the machine takes for these steps, whatever the size of the program.
const LOOKS: u64 = 1 << 16;
/// Hardly any: one in so many.
const HARDLY: u64 = 16;
/// Machine code wins if more than one walk in so many misses, once the tree has learned much.
const RARELY: u64 = 16;

/// Walks, and how many of them missed.
#[derive(Debug, Clone, Copy, Default)]
struct Count {
    walks: u64,
    misses: u64,
}

impl Count {
    /// Whether more than one walk in so many missed.
    fn misses_one_in(self, so_many: u64) -> bool {
        self.misses * so_many > self.walks
    }
}

/// See the module.
#[derive(Debug, Default)]
pub(crate) struct Record {
    /// Since the start, older walks counting less.
    against_machine: Count,
    /// Since the tree was last compared with machine code.
    against_code: Count,
    /// The misses at which that is next done; 0 before the first time.
    due: u64,
    /// How often the steps that it has learned have looked at a field.
    looks: u64,
    /// It was asked whether hardly any walk has found anything.
    doubted: bool,
}

impl Record {
    /// Counts a walk.
    #[inline]
    pub fn walk(&mut self) {
        self.against_machine.walks += 1;
        self.against_code.walks += 1;
    }

    /// Counts that the last walk has missed.
    pub fn miss(&mut self) {
        self.against_machine.misses += 1;
        self.against_code.misses += 1;
    }

    /// Counts that a step which looks at so many fields is learned.
    pub fn learn(&mut self, looks: usize) {
        self.looks += looks as u64;
    }

    /// Whether the machine alone makes steps faster; to be asked after each miss.
    pub fn loses_to_machine(&mut self) -> bool {
        let count = &mut self.against_machine;
        if count.walks < TRIAL {
            return false;
        }
        let loses = count.misses_one_in(POOR);
        *count = Count { walks: count.walks / 2, misses: count.misses / 2 };
        loses
    }

    /// Whether machine code makes steps faster; to be asked after each miss.
    pub fn loses_to_code(&mut self) -> bool {
        if self.looks >= LOOKS && !std::mem::replace(&mut self.doubted, true) {
            let Count { walks, misses } = self.against_code;
            if (walks - misses) * HARDLY <= walks {
                return true;
            }
        }
        let due = self.due.max(PATIENCE);
        if self.against_code.misses < due {
            return false;
        }
        // One in two is tolerated at first, when there is much to learn; later only rarer misses are.
        let loses = self.against_code.misses_one_in((2 * due / PATIENCE).min(RARELY));
        (self.against_code, self.due) = (Count::default(), due * 2);
        loses
    }
}
