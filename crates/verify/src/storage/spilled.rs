//! The states met, in files once there are more than memory has room for.
//!
//! In: packed states, level by level. Out: whether they are new. While there is room they are in a [`Table`]. Then all of
//! them go to a file in the order of their arrival, and once more to a sorted one; the table is empty again and takes in
//! what comes, new or not. When it is full, and at the end of each level, its states are sorted and held against the
//! sorted files, which are read from their first block to their last (*delayed duplicate detection*: A. W. Roscoe,
//! *Model-checking CSP*, 1994; U. Stern, D. Dill, *Using magnetic disk instead of main memory in the Murφ verifier*, 1998).
//! What is left is new. INVARIANT: two sorted files are of different size by a factor of two, so that there are few.

use std::sync::Arc;

use crate::storage::disk::{Disk, Lost, Tape};
use crate::storage::run::SortedRun;
use crate::table::Table;

/// So many states are taken in at a time.
const STRETCH: usize = 1 << 12;

/// See the module.
#[derive(Debug)]
pub(crate) struct Spilled {
    words: usize,
    disk: Arc<dyn Disk>,
    /// How many bytes of memory there are.
    room: usize,
    /// All states while there is room; then those of which it is not known whether they are new.
    table: Table,
    out: Option<Out>,
    lost: bool,
}

/// What is in files.
#[derive(Debug)]
struct Out {
    /// All states, as they came.
    arrived: Box<dyn Tape>,
    /// How many.
    len: usize,
    /// All of them, each in one.
    runs: Vec<SortedRun>,
    /// Some of them, for who reads them.
    window: Vec<u64>,
    first: usize,
}

impl Spilled {
    /// No states of so many words, and room for so many bytes.
    pub fn new(words: usize, disk: &Arc<dyn Disk>, room: u64) -> Spilled {
        let room = usize::try_from(room).unwrap_or(usize::MAX);
        Spilled { words, disk: Arc::clone(disk), room, table: Table::new(words), out: None, lost: false }
    }

    /// How many states are known to be there.
    pub fn len(&self) -> usize {
        self.out.as_ref().map_or(self.table.len(), |out| out.len)
    }

    /// How many states have come in of which it is not known whether they are new.
    pub fn pending(&self) -> usize {
        self.out.as_ref().map_or(0, |_| self.table.len())
    }

    /// Files have met trouble: what is known of the states is not all there was.
    pub fn is_lost(&self) -> bool {
        self.lost
    }

    /// How many bytes of memory it takes.
    pub fn bytes(&self) -> usize {
        let out = |out: &Out| 8 * out.window.capacity() + out.runs.iter().map(SortedRun::bytes).sum::<usize>();
        self.table.bytes() + self.out.as_ref().map_or(0, out)
    }

    /// How many bytes of files.
    pub fn spilled(&self) -> usize {
        let states = |out: &Out| out.len + out.runs.iter().map(SortedRun::len).sum::<usize>();
        8 * self.words * self.out.as_ref().map_or(0, states)
    }

    /// A state by its place, one that was loaded.
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

    /// Makes the states of these places ready to be read; false where that cannot be done.
    pub fn load(&mut self, places: std::ops::Range<usize>) -> bool {
        if let Some(out) = &mut self.out {
            out.first = places.start;
            out.window.resize(places.len() * self.words, 0);
            self.lost |= !out.arrived.read((places.start * self.words) as u64, &mut out.window);
        }
        !self.lost
    }

    /// Adds states; calls `new` with each that is known to be.
    pub fn insert_all(&mut self, states: &[u64], new: &mut impl FnMut(&[u64])) {
        for stretch in states.chunks(STRETCH * self.words) {
            // To sort the states takes as much again as they do.
            let count = self.table.len() + stretch.len() / self.words;
            let needed = self.table.bytes_of(count) + 8 * self.words * count + self.bytes() - self.table.bytes();
            if self.table.len() > 0 && (needed > self.room || count > Table::MOST) {
                self.settle(new);
            }
            match self.out {
                None => self.table.insert_all(stretch, new),
                Some(_) => self.table.insert_all(stretch, &mut |_| {}),
            }
        }
    }

    /// Finds out which of the pending states are new, and calls `new` with them.
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
