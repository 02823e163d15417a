//! The set of discovered states, which also lists them in the order of discovery.
//!
//! In: packed states. Out: whether one is new. A state is stored once in a list of chunks, which never moves, and once
//! in an open-addressed table: as itself if it is a single word, else as its index with a part of its hash. The table
//! grows by half, so states and table together take at most 22 bytes for a state of one word. Only the order of arrival
//! is visible, never the order of hashes.

use explore::hash;

use crate::slots::Slots;

/// States in a chunk.
const CHUNK: usize = 1 << 14;
/// How many lookups are in progress at a time, so that their memory is fetched in parallel.
const AHEAD: usize = 16;
/// Marks an occupied slot that contains a state itself.
const OCCUPIED: u64 = 1 << 63;

/// A set of states in the order of arrival.
#[derive(Debug)]
pub struct Table {
    words: usize,
    chunks: Vec<Vec<u64>>,
    len: usize,
    slots: Slots,
    /// Set when the table may not grow further, or cannot, for want of memory.
    full: bool,
}

impl Table {
    /// LIMIT: the most states in one table.
    pub const MOST: usize = u32::MAX as usize - 1;

    /// An empty set of states with this many words.
    pub fn new(words: usize) -> Table {
        Table { words, chunks: Vec::new(), len: 0, slots: Slots::default(), full: false }
    }

    /// How many states there are.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether no more states can be kept.
    pub fn is_full(&self) -> bool {
        self.full
    }

    /// The number of bytes it takes.
    pub fn bytes(&self) -> usize {
        self.slots.bytes() + self.chunks.iter().map(|chunk| 8 * chunk.capacity()).sum::<usize>()
    }

    /// The number of bytes it would take with this many states, at least as many as now.
    pub fn bytes_of(&self, len: usize) -> usize {
        8 * Slots::grown_for(self.slots.len(), len + AHEAD) + len.div_ceil(CHUNK) * CHUNK * self.words * 8
    }

    /// The states in the order of arrival.
    pub fn chunks(&self) -> impl Iterator<Item = &[u64]> {
        self.chunks.iter().map(Vec::as_slice)
    }

    /// The states in ascending order.
    pub fn sorted(self) -> Vec<u64> {
        let Table { words, chunks, len, slots, .. } = self;
        drop(slots);
        let mut all = Vec::with_capacity(len * words);
        if words == 1 {
            chunks.into_iter().for_each(|chunk| all.extend(chunk));
            all.sort_unstable();
            return all;
        }
        let state = |index: u32| {
            let (index, start) = (index as usize / CHUNK, index as usize % CHUNK * words);
            &chunks[index][start..start + words]
        };
        let mut order: Vec<u32> = (0..len as u32).collect();
        order.sort_unstable_by_key(|index| state(*index));
        order.into_iter().for_each(|index| all.extend_from_slice(state(index)));
        all
    }

    /// The state at an index.
    #[inline]
    pub fn state(&self, index: usize) -> &[u64] {
        let start = index % CHUNK * self.words;
        &self.chunks[index / CHUNK][start..start + self.words]
    }

    /// Adds states one after another; calls `new` with each new one.
    pub fn insert_all(&mut self, states: &[u64], new: &mut impl FnMut(&[u64])) {
        self.insert_each(states, new, &mut |_| {});
    }

    /// The same; calls `place` with the index of each, new or not. It has no meaning for states of one word, and is
    /// [`Table::MOST`] where the table is full.
    pub fn insert_each(&mut self, states: &[u64], new: &mut impl FnMut(&[u64]), place: &mut impl FnMut(u32)) {
        let mut hashes = [0; AHEAD];
        for batch in states.chunks(AHEAD * self.words) {
            // Growing in advance keeps slots valid within a batch.
            if self.slots.is_full_with(self.len + AHEAD) && !self.grow() {
                self.full = true;
                batch.chunks_exact(self.words).for_each(|_| place(Table::MOST as u32));
                continue;
            }
            let mut touched = 0;
            for (state, place) in batch.chunks_exact(self.words).zip(&mut hashes) {
                *place = hash(state);
                touched ^= self.slots.get(self.slot_of(*place));
            }
            std::hint::black_box(touched);
            for (state, hash) in batch.chunks_exact(self.words).zip(&hashes) {
                let (is_new, index) = self.find_or_add(state, *hash);
                place(index);
                if is_new {
                    new(state);
                }
            }
        }
    }

    #[inline]
    fn slot_of(&self, hash: u64) -> usize {
        slot_among(hash, self.slots.len())
    }

    // The inner loop of a search: a function call here would cost as much as a lookup.
    #[inline(always)]
    fn find_or_add(&mut self, state: &[u64], hash: u64) -> (bool, u32) {
        let mut slot = self.slot_of(hash);
        if let [state] = state {
            let entry = state | OCCUPIED;
            loop {
                let found = self.slots.get(slot);
                if found == entry {
                    return (false, 0);
                }
                if found == 0 {
                    break;
                }
                slot = self.slots.after(slot);
            }
            return self.add(slot, entry, &[*state]);
        }
        let mark = hash << 32;
        loop {
            let found = self.slots.get(slot);
            if found == 0 {
                break;
            }
            if found & !0xffff_ffff == mark && self.state((found as u32) as usize - 1) == state {
                return (false, found as u32 - 1);
            }
            slot = self.slots.after(slot);
        }
        self.add(slot, mark | (self.len as u64 + 1), state)
    }

    #[inline]
    fn add(&mut self, slot: usize, entry: u64, state: &[u64]) -> (bool, u32) {
        if self.len >= Table::MOST {
            self.full = true;
            return (false, Table::MOST as u32);
        }
        self.slots.set(slot, entry);
        if self.len / CHUNK == self.chunks.len() {
            self.chunks.push(Vec::with_capacity(CHUNK * self.words));
        }
        self.chunks[self.len / CHUNK].extend_from_slice(state);
        self.len += 1;
        (true, self.len as u32 - 1)
    }

    /// `false` if there is no memory.
    #[cold]
    fn grow(&mut self) -> bool {
        let len = Slots::grown_for(self.slots.len(), self.len + AHEAD);
        if self.words == 1 {
            return self.slots.grow(len, |entry, len| slot_among(hash(&[entry & !OCCUPIED]), len));
        }
        // An entry has only a part of its hash, and states are listed in another order.
        if !self.slots.clear(len) {
            return false;
        }
        let mut hashes = [0; AHEAD];
        for first in (0..self.len).step_by(AHEAD) {
            let batch = first..self.len.min(first + AHEAD);
            let mut touched = 0;
            for (index, place) in batch.clone().zip(&mut hashes) {
                *place = hash(self.state(index));
                touched ^= self.slots.get(self.slot_of(*place));
            }
            std::hint::black_box(touched);
            for (index, hash) in batch.zip(hashes) {
                self.slots.put(self.slot_of(hash), hash << 32 | (index as u64 + 1));
            }
        }
        true
    }
}

/// The slot of a hash among so many.
#[inline]
fn slot_among(hash: u64, slots: usize) -> usize {
    ((u128::from(hash) * slots as u128) >> 64) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that come up again and again, as states of so many words.
    fn check(words: usize) {
        let mut table = Table::new(words);
        let mut expected = Vec::new();
        let mut random = 1u64;
        let mut batch = Vec::new();
        for _ in 0..100_000 {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let number = random >> 33 & 0x7fff;
            batch.extend((0..words as u64).map(|word| number * (word + 1)));
        }
        let mut seen = vec![false; 1 << 15];
        for state in batch.chunks_exact(words) {
            if !std::mem::replace(&mut seen[state[0] as usize], true) {
                expected.push(state.to_vec());
            }
        }
        let (mut new, mut places) = (Vec::new(), Vec::new());
        table.insert_each(&batch, &mut |state| new.push(state.to_vec()), &mut |place| places.push(place));
        assert_eq!(new, expected);
        if words > 1 {
            let placed: Vec<u64> = places.iter().flat_map(|place| table.state(*place as usize).to_vec()).collect();
            assert_eq!(placed, batch);
        }
        assert_eq!(table.len(), expected.len());
        for (place, state) in expected.iter().enumerate() {
            assert_eq!(table.state(place), state);
        }
        assert_eq!(table.bytes_of(table.len()), table.bytes());
        assert_eq!(table.chunks().collect::<Vec<_>>().concat(), expected.concat());
        expected.sort();
        assert_eq!(table.sorted(), expected.concat());
    }

    #[test]
    fn each_state_is_new_once() {
        (1..4).for_each(check);
    }
}
