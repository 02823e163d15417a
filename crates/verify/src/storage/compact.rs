//! Lossy storage of states: as hashes, or as bits of an array.
//!
//! In: packed states, level by level. Out: whether one is new, as far as can be known, and the states of the last two
//! levels. *Hash compaction* (P. Wolper, D. Leroy, *Reliable hashing without collision detection*, 1993; U. Stern, D.
//! Dill, *Improved probabilistic verification by hash compaction*, 1995) stores a hash: with n states and hashes modulo
//! p, some state is omitted with a probability of at most n(n − 1)/2p. *Bit-state hashing* (G. Holzmann, *An analysis
//! of bitstate hashing*, 1998) sets k bits of an array for each state: if a share f of the bits is set, a new state is
//! mistaken for a known one with a probability of fᵏ. INVARIANT: a known state is always recognised.

use std::collections::VecDeque;

use crate::slots::Slots;
use crate::storage::fingerprint::{Fingerprint, PRIME};

/// States in a chunk.
const CHUNK: usize = 1 << 12;
/// How many lookups are in progress at a time.
const AHEAD: usize = 16;
/// The bits set for each state.
const BITS: u64 = 3;

/// A lossy set of states.
#[derive(Debug)]
pub(crate) struct Compact {
    words: usize,
    /// Additional words carried by each state.
    more: usize,
    seen: Seen,
    /// The states that are still needed.
    window: VecDeque<Vec<u64>>,
    /// How many chunks were dropped before these.
    forgotten: usize,
    len: usize,
    /// There was no memory for more.
    full: bool,
}

/// What is stored of all states.
#[derive(Debug)]
enum Seen {
    /// Hashes in an open-addressed table, each plus one; 0 marks an empty slot.
    Hashes { hash: Fingerprint, slots: Slots },
    /// Bits of an array, and how many are set; two hashes determine all bits of a state (A. Kirsch, M. Mitzenmacher,
    /// *Less hashing, same performance*, 2006).
    Bits { hashes: [Fingerprint; 2], array: Vec<u64>, set: u64, omitted: f64 },
}

impl Compact {
    /// An empty set that stores hashes of states with this many words.
    pub fn hashes(words: usize, seed: u64) -> Compact {
        let seen = Seen::Hashes { hash: Fingerprint::new(words, seed), slots: Slots::default() };
        Compact { words, more: 0, seen, window: VecDeque::new(), forgotten: 0, len: 0, full: false }
    }

    /// An empty set that stores bits in an array of this many bytes, for states with this many words.
    pub fn bits(words: usize, seed: u64, bytes: u64) -> Compact {
        let hashes = [Fingerprint::new(words, seed), Fingerprint::new(words, !seed)];
        let array = vec![0; (bytes / 8).max(1) as usize];
        let seen = Seen::Bits { hashes, array, set: 0, omitted: 0.0 };
        Compact { words, more: 0, seen, window: VecDeque::new(), forgotten: 0, len: 0, full: false }
    }

    /// The same set, in which each state carries additional words.
    pub fn with_more(mut self, more: usize) -> Compact {
        self.more = more;
        self
    }

    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether no more states can be kept, for want of memory.
    pub fn is_full(&self) -> bool {
        self.full
    }

    pub fn bytes(&self) -> usize {
        let seen = match &self.seen {
            Seen::Hashes { slots, .. } => slots.bytes(),
            Seen::Bits { array, .. } => 8 * array.len(),
        };
        seen + self.window.iter().map(|chunk| 8 * chunk.capacity()).sum::<usize>()
    }

    #[inline]
    fn item(&self, index: usize) -> &[u64] {
        let stride = self.words + self.more;
        let start = index % CHUNK * stride;
        &self.window[index / CHUNK - self.forgotten][start..start + stride]
    }

    /// The state at an index.
    #[inline]
    pub fn state(&self, index: usize) -> &[u64] {
        &self.item(index)[..self.words]
    }

    /// The additional words of a state.
    pub fn more(&self, index: usize) -> &[u64] {
        &self.item(index)[self.words..]
    }

    /// Forgets the states before an index.
    pub fn forget_before(&mut self, index: usize) {
        while self.forgotten < index / CHUNK && self.window.pop_front().is_some() {
            self.forgotten += 1;
        }
    }

    /// Adds states one after another, each with its additional words; calls `new` with each new one.
    pub fn insert_all(&mut self, items: &[u64], new: &mut impl FnMut(&[u64])) {
        let (words, stride) = (self.words, self.words + self.more);
        let mut hashes = [(0, 0); AHEAD];
        for batch in items.chunks(AHEAD * stride) {
            if let Seen::Hashes { slots, .. } = &mut self.seen
                && slots.is_full_with(self.len + AHEAD)
            {
                let len = Slots::grown_for(slots.len(), self.len + AHEAD);
                if !slots.grow(len, |entry, len| place(entry - 1, len as u64) as usize) {
                    self.full = true;
                    return;
                }
            }
            for (item, hashes) in batch.chunks_exact(stride).zip(&mut hashes) {
                *hashes = self.seen.begin(&item[..words]);
            }
            for (item, hashes) in batch.chunks_exact(stride).zip(&hashes) {
                if self.seen.insert(*hashes) {
                    self.keep(item);
                    new(item);
                }
            }
        }
    }

    fn keep(&mut self, item: &[u64]) {
        let chunk = self.len / CHUNK - self.forgotten;
        if chunk == self.window.len() {
            // A search begins with few states.
            let room = if self.len == 0 { 16 } else { CHUNK };
            self.window.push_back(Vec::with_capacity(room * item.len()));
        }
        self.window[chunk].extend_from_slice(item);
        self.len += 1;
    }

    /// See [`crate::storage::Store::omission`].
    pub fn omission(&self) -> f64 {
        match &self.seen {
            // The first state that is omitted was mistaken for one of those met until then.
            Seen::Hashes { .. } => self.len as f64 * (self.len as f64 + 1.0) / 2.0 / PRIME as f64,
            Seen::Bits { omitted, .. } => *omitted,
        }
    }
}

impl Seen {
    /// The hashes of a state; also prefetches the memory it needs.
    #[inline]
    fn begin(&self, state: &[u64]) -> (u64, u64) {
        match self {
            Seen::Hashes { hash, slots } => {
                let hash = hash.of(state);
                std::hint::black_box(slots.get(place(hash, slots.len() as u64) as usize));
                (hash, 0)
            }
            Seen::Bits { hashes: [first, second], array, .. } => {
                let hashes = (scattered(first.of(state)), scattered(second.of(state)));
                for index in 0..BITS {
                    std::hint::black_box(array[(bit(hashes, index, array.len()) / 64) as usize]);
                }
                hashes
            }
        }
    }

    /// Adds a state with these hashes; returns whether it is new.
    #[inline]
    fn insert(&mut self, hashes: (u64, u64)) -> bool {
        match self {
            Seen::Hashes { slots, .. } => put(slots, hashes.0 + 1),
            Seen::Bits { array, set, omitted, .. } => {
                let share = *set as f64 / (array.len() as f64 * 64.0);
                let mut new = false;
                for index in 0..BITS {
                    let bit = bit(hashes, index, array.len());
                    let word = &mut array[(bit / 64) as usize];
                    if *word >> (bit % 64) & 1 == 0 {
                        *word |= 1 << (bit % 64);
                        *set += 1;
                        new = true;
                    }
                }
                if new {
                    // For each new state, the expected number of omitted ones.
                    let mistaken = share.powi(BITS as i32);
                    *omitted += mistaken / (1.0 - mistaken);
                }
                new
            }
        }
    }
}

/// Scatters hashes. Similar states have consecutive hashes, which would fill the array more evenly than random ones;
/// the estimate of omissions assumes random ones.
#[inline]
fn scattered(hash: u64) -> u64 {
    let mixed = (hash ^ hash >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    (mixed ^ mixed >> 31) & PRIME
}

/// The slot of a hash in a table of this size.
#[inline]
fn place(hash: u64, of: u64) -> u64 {
    ((u128::from(hash) * u128::from(of)) >> 61) as u64
}

/// One of a state's bits in an array of this many words.
#[inline]
fn bit(hashes: (u64, u64), index: u64, words: usize) -> u64 {
    let mixed = hashes.0.wrapping_add(hashes.1.wrapping_mul(index)) & PRIME;
    place(mixed, words as u64 * 64)
}

/// Puts an entry into its slot; `false` if it is there already.
#[inline]
fn put(slots: &mut Slots, entry: u64) -> bool {
    let mut slot = place(entry - 1, slots.len() as u64) as usize;
    loop {
        match slots.get(slot) {
            0 => break,
            found if found == entry => return false,
            _ => slot = slots.after(slot),
        }
    }
    slots.set(slot, entry);
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    const STATES: u64 = 20_000;

    /// How many of different states count as new.
    fn check(mut compact: Compact) -> (usize, f64) {
        let states: Vec<u64> = (0..STATES).flat_map(|state| [state, state * 3, 1]).collect();
        let (mut new, mut again) = (0, 0);
        compact.insert_all(&states, &mut |_| new += 1);
        compact.insert_all(&states, &mut |_| again += 1);
        assert_eq!(again, 0, "what was met is known");
        assert_eq!(compact.len(), new);
        (new, compact.omission())
    }

    #[test]
    fn hashes_tell_thousands_of_states_apart() {
        let (new, omission) = check(Compact::hashes(3, 0));
        assert_eq!(new, STATES as usize);
        assert!(omission > 0.0 && omission < 1e-9, "{omission}");
    }

    #[test]
    fn a_large_array_omits_few_and_says_so() {
        let (new, omission) = check(Compact::bits(3, 0, 1 << 20));
        assert!(new > STATES as usize - 20 && omission < 10.0, "{new} {omission}");
    }

    /// The expected number of omissions is close to the actual one.
    #[test]
    fn a_small_array_omits_many_and_says_so() {
        for (bytes, seed) in [(1 << 13, 0), (1 << 14, 1), (1 << 15, 2)] {
            let (new, omission) = check(Compact::bits(3, seed, bytes));
            let omitted = STATES as f64 - new as f64;
            assert!(omitted > 10.0);
            assert!((omission - omitted).abs() < 0.2 * omitted + 10.0, "{omitted} were, {omission} expected");
        }
    }

    #[test]
    fn states_of_levels_before_are_forgotten() {
        let mut compact = Compact::hashes(2, 0).with_more(1);
        let states: Vec<u64> = (0..STATES).flat_map(|state| [state, 1, state + 7]).collect();
        compact.insert_all(&states, &mut |_| {});
        let before = compact.bytes();
        compact.forget_before(STATES as usize - 5);
        assert!(compact.bytes() < before);
        assert_eq!(compact.state(STATES as usize - 5), [STATES - 5, 1]);
        assert_eq!(compact.more(STATES as usize - 1), [STATES + 6]);
        compact.insert_all(&[STATES, 1, 9], &mut |item| assert_eq!(item, [STATES, 1, 9]));
        assert_eq!(compact.state(STATES as usize), [STATES, 1]);
    }
}
