//! Stores discovered states in files once they exceed memory.
//!
//! In: packed states, level by level. Out: whether they are new. At first they are in a [`Table`]. When memory is full,
//! all of them are written to a file in the order of arrival, and also to a sorted one; the table is emptied and takes
//! in what arrives, new or not. When it is full, and at the end of each level, its states are sorted and compared with
//! the sorted files, which are read sequentially (*delayed duplicate detection*: A. W. Roscoe, *Model-checking CSP*,
//! 1994; U. Stern, D. Dill, *Using magnetic disk instead of main memory in the Murφ verifier*, 1998). What remains is
//! new. INVARIANT: the sizes of any two sorted files differ by a factor of at least two, so there are few.

use std::sync::Arc;

use crate::storage::disk::{Disk, Lost, Tape};
use crate::storage::run::SortedRun;
use crate::table::Table;

/// How many states are added at a time.
const STRETCH: usize = 1 << 12;

/// States in memory, then in files.
#[derive(Debug)]
pub(crate) struct Spilled {
    words: usize,
    disk: Arc<dyn Disk>,
    /// The available bytes of memory.
    room: usize,
    /// At first all states; later those of which it is unknown whether they are new.
    table: Table,
    out: Option<Out>,
    lost: bool,
    /// There was no memory for a state.
    full: bool,
}

/// The states in files.
#[derive(Debug)]
struct Out {
    /// All states in the order of arrival.
    arrived: Box<dyn Tape>,
    /// How many.
    len: usize,
    /// Sorted files; each state is in one of them.
    runs: Vec<SortedRun>,
    /// The loaded states.
    window: Vec<u64>,
    first: usize,
}

impl Spilled {
    /// An empty set of states with this many words, with this many bytes of memory.
    pub fn new(words: usize, disk: &Arc<dyn Disk>, room: u64) -> Spilled {
        let room = usize::try_from(room).unwrap_or(usize::MAX);
        Spilled { words, disk: Arc::clone(disk), room, table: Table::new(words), out: None, lost: false, full: false }
    }

    /// How many states are known to be new.
    pub fn len(&self) -> usize {
        self.out.as_ref().map_or(self.table.len(), |out| out.len)
    }

    /// How many states have arrived of which it is unknown whether they are new.
    pub fn pending(&self) -> usize {
        self.out.as_ref().map_or(0, |_| self.table.len())
    }

    /// Whether no more states can be kept, for want of memory.
    pub fn is_full(&self) -> bool {
        self.full
    }

    /// Whether a file failed, so that states may be missing.
    pub fn is_lost(&self) -> bool {
        self.lost
    }

    /// The number of bytes in memory.
    pub fn bytes(&self) -> usize {
        let out = |out: &Out| 8 * out.window.capacity() + out.runs.iter().map(SortedRun::bytes).sum::<usize>();
        self.table.bytes() + self.out.as_ref().map_or(0, out)
    }

    /// The number of bytes in files.
    pub fn spilled(&self) -> usize {
        let states = |out: &Out| out.len + out.runs.iter().map(SortedRun::len).sum::<usize>();
        8 * self.words * self.out.as_ref().map_or(0, states)
    }

    /// The loaded state at an index.
    #[inline]
    pub fn state(&self, index: usize) -> &[u64] {
        match &self.out {
            None => self.table.state(index),
            Some(out) => {
                let start = (index - out.first) * self.words;
                &out.window[start..start + self.words]
            }
        }
    }

    /// Loads the states at these indices; `false` if that is impossible.
    pub fn load(&mut self, places: std::ops::Range<usize>) -> bool {
        if let Some(out) = &mut self.out {
            out.first = places.start;
            out.window.resize(places.len() * self.words, 0);
            self.lost |= !out.arrived.read((places.start * self.words) as u64, &mut out.window);
        }
        !self.lost
    }

    /// Adds states; calls `new` with each that is known to be new.
    pub fn insert_all(&mut self, states: &[u64], new: &mut impl FnMut(&[u64])) {
        for stretch in states.chunks(STRETCH * self.words) {
            // Sorting takes as much memory again as the states.
            let count = self.table.len() + stretch.len() / self.words;
            let needed = self.table.bytes_of(count) + 8 * self.words * count + self.bytes() - self.table.bytes();
            if self.table.len() > 0 && (needed > self.room || count > Table::MOST) {
                self.settle(new);
            }
            match self.out {
                None => self.table.insert_all(stretch, new),
                Some(_) => self.table.insert_all(stretch, &mut |_| {}),
            }
            self.full |= self.table.is_full();
        }
    }

    /// Determines which of the pending states are new; calls `new` with them.
    pub fn settle(&mut self, new: &mut impl FnMut(&[u64])) {
        if !self.lost {
            self.lost = self.try_settle(new).is_err();
        }
        if self.lost {
            self.table = Table::new(self.words);
        }
    }

    fn try_settle(&mut self, new: &mut impl FnMut(&[u64])) -> Result<(), Lost> {
        let table = std::mem::replace(&mut self.table, Table::new(self.words));
        let Some(out) = &mut self.out else {
            let mut arrived = self.disk.tape().ok_or(Lost)?;
            let len = table.len();
            table.chunks().all(|chunk| arrived.write(chunk)).then_some(()).ok_or(Lost)?;
            let run = SortedRun::new(self.words, &table.sorted(), &self.disk)?;
            self.out = Some(Out { arrived, len, runs: vec![run], window: Vec::new(), first: 0 });
            return Ok(());
        };
        let mut sorted = table.sorted();
        for run in out.runs.iter_mut().rev() {
            run.take_out(&mut sorted)?;
        }
        sorted.chunks_exact(self.words).for_each(new);
        if !out.arrived.write(&sorted) {
            return Err(Lost);
        }
        out.len += sorted.len() / self.words;
        if sorted.is_empty() {
            return Ok(());
        }
        let mut run = SortedRun::new(self.words, &sorted, &self.disk)?;
        drop(sorted);
        while let Some(before) = out.runs.pop_if(|before| before.len() < 2 * run.len()) {
            run = before.merged(run, &self.disk)?;
        }
        out.runs.push(run);
        Ok(())
    }
}
