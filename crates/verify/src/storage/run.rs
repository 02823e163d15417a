//! A sorted set of states in a file.
//!
//! In: states in ascending order, without duplicates. Out: a [`SortedRun`], which removes its states from others and
//! merges with another run. The first state of each block stays in memory, so blocks without relevant states are not
//! read. INVARIANT: the states of a run never change.

use std::cmp::Ordering;
use std::sync::Arc;

use crate::storage::disk::{Disk, Lost, Tape};

/// Words in a block, unless a state has more.
const BLOCK: usize = 1 << 12;

/// A sorted run.
#[derive(Debug)]
pub(crate) struct SortedRun {
    words: usize,
    tape: Box<dyn Tape>,
    /// How many states.
    len: usize,
    /// The first state of each block.
    fences: Vec<u64>,
}

/// The order of states in runs.
#[inline]
fn order(a: &[u64], b: &[u64]) -> Ordering {
    match (a, b) {
        ([a], [b]) => a.cmp(b),
        _ => a.cmp(b),
    }
}

/// How many states a block has.
fn block(words: usize) -> usize {
    (BLOCK / words).max(1)
}

/// Writes a run.
struct Writer {
    run: SortedRun,
    filled: Vec<u64>,
}

impl Writer {
    fn new(words: usize, disk: &Arc<dyn Disk>) -> Result<Writer, Lost> {
        let tape = disk.tape().ok_or(Lost)?;
        let run = SortedRun { words, tape, len: 0, fences: Vec::new() };
        Ok(Writer { run, filled: Vec::with_capacity(block(words) * words) })
    }

    #[inline]
    fn put(&mut self, state: &[u64]) -> Result<(), Lost> {
        if self.filled.is_empty() {
            self.run.fences.extend_from_slice(state);
        }
        self.filled.extend_from_slice(state);
        self.run.len += 1;
        if self.filled.len() == block(self.run.words) * self.run.words { self.flush() } else { Ok(()) }
    }

    fn flush(&mut self) -> Result<(), Lost> {
        let written = self.run.tape.write(&self.filled);
        self.filled.clear();
        if written { Ok(()) } else { Err(Lost) }
    }

    fn end(mut self) -> Result<SortedRun, Lost> {
        self.flush()?;
        Ok(self.run)
    }
}

/// Reads a run from its first state to its last.
struct Reader<'r> {
    run: &'r mut SortedRun,
    next: usize,
    states: Vec<u64>,
    at: usize,
}

impl Reader<'_> {
    fn new(run: &mut SortedRun) -> Reader<'_> {
        Reader { run, next: 0, states: Vec::new(), at: 0 }
    }

    /// The next state; `None` after the last.
    #[inline]
    fn peek(&mut self) -> Result<Option<&[u64]>, Lost> {
        if self.at == self.states.len() {
            if self.next == self.run.blocks() {
                return Ok(None);
            }
            self.run.read(self.next, &mut self.states)?;
            (self.next, self.at) = (self.next + 1, 0);
        }
        Ok(Some(&self.states[self.at..self.at + self.run.words]))
    }
}

impl SortedRun {
    /// The run of sorted states with this many words.
    pub fn new(words: usize, sorted: &[u64], disk: &Arc<dyn Disk>) -> Result<SortedRun, Lost> {
        let mut writer = Writer::new(words, disk)?;
        sorted.chunks_exact(words).try_for_each(|state| writer.put(state))?;
        writer.end()
    }

    /// How many states it has.
    pub fn len(&self) -> usize {
        self.len
    }

    /// How many bytes of memory it takes.
    pub fn bytes(&self) -> usize {
        8 * self.fences.capacity()
    }

    fn blocks(&self) -> usize {
        self.fences.len() / self.words
    }

    fn fence(&self, block: usize) -> &[u64] {
        &self.fences[block * self.words..(block + 1) * self.words]
    }

    fn read(&mut self, at: usize, states: &mut Vec<u64>) -> Result<(), Lost> {
        let first = at * block(self.words);
        let len = block(self.words).min(self.len - first);
        states.resize(len * self.words, 0);
        if self.tape.read((first * self.words) as u64, states) { Ok(()) } else { Err(Lost) }
    }

    /// The last block, from a given one on, that does not begin after a state.
    fn block_of(&self, from: usize, state: &[u64]) -> usize {
        let (mut low, mut step) = (from, 1);
        // It is usually close.
        while low + step < self.blocks() && order(self.fence(low + step), state).is_le() {
            low += step;
            step *= 2;
        }
        let mut high = (low + step).min(self.blocks());
        while low + 1 < high {
            let middle = low + (high - low) / 2;
            if order(self.fence(middle), state).is_le() {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// Removes its states from sorted ones.
    pub fn take_out(&mut self, sorted: &mut Vec<u64>) -> Result<(), Lost> {
        let words = self.words;
        let (mut kept, mut states, mut loaded, mut at) = (0, Vec::new(), usize::MAX, 0);
        for place in (0..sorted.len()).step_by(words) {
            let wanted = &sorted[place..place + words];
            let block = self.block_of(if loaded == usize::MAX { 0 } else { loaded }, wanted);
            if block != loaded {
                self.read(block, &mut states)?;
                (loaded, at) = (block, 0);
            }
            while at < states.len() && order(&states[at..at + words], wanted).is_lt() {
                at += words;
            }
            if at == states.len() || states[at..at + words] != *wanted {
                sorted.copy_within(place..place + words, kept);
                kept += words;
            }
        }
        sorted.truncate(kept);
        Ok(())
    }

    /// The union of two runs.
    pub fn merged(mut self, mut other: SortedRun, disk: &Arc<dyn Disk>) -> Result<SortedRun, Lost> {
        let words = self.words;
        let mut writer = Writer::new(words, disk)?;
        let (mut left, mut right) = (Reader::new(&mut self), Reader::new(&mut other));
        loop {
            let from_left = match (left.peek()?, right.peek()?) {
                (None, None) => break,
                (Some(_), None) => true,
                (None, Some(_)) => false,
                (Some(a), Some(b)) => order(a, b).is_lt(),
            };
            let from = if from_left { &mut left } else { &mut right };
            writer.put(&from.states[from.at..from.at + words])?;
            from.at += words;
        }
        writer.end()
    }
}
