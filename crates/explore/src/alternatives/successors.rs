//! The states that the steps of one state lead to, where they may be too many to be kept once for each alternative.
//!
//! In: successors, in the order of the alternatives. Out: the same at the end of a list, each at least once, in the order in which
//! they come up first. INVARIANT: the list has room for no more than a few times as many as there are different ones.

use std::hash::Hasher;

use hashbrown::HashTable;
use rustc_hash::FxHasher;

/// So many words are listed before those that came up before are looked for.
const PIECE: usize = 1 << 16;

/// See the module.
pub(crate) struct Successors<'o> {
    out: &'o mut Vec<u64>,
    /// Where they begin in the list.
    start: usize,
    /// How long the list may get.
    most: usize,
}

impl<'o> Successors<'o> {
    /// At the end of a list.
    pub fn new(out: &'o mut Vec<u64>) -> Successors<'o> {
        let start = out.len();
        Successors { out, start, most: start + PIECE }
    }

    /// The list, with room for one more of so many words.
    #[inline]
    pub fn room(&mut self, words: usize) -> &mut Vec<u64> {
        if self.out.len() >= self.most {
            self.thin(words);
        }
        self.out
    }

    #[cold]
    fn thin(&mut self, words: usize) {
        let Successors { out, start, most } = self;
        let mut seen: HashTable<usize> = HashTable::new();
        let mut end = *start;
        for place in (*start..out.len()).step_by(words) {
            let hash = hash_of(&out[place..place + words]);
            let new = seen.find(hash, |other| out[*other..other + words] == out[place..place + words]).is_none();
            if new {
                out.copy_within(place..place + words, end);
                seen.insert_unique(hash, end, |other| hash_of(&out[*other..other + words]));
                end += words;
            }
        }
        out.truncate(end);
        // Looking for duplicates again pays once the list has doubled.
        *most = end + (end - *start).max(PIECE);
    }
}

fn hash_of(state: &[u64]) -> u64 {
    let mut hasher = FxHasher::default();
    state.iter().for_each(|word| hasher.write_u64(*word));
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Successors of so many words, of which so many are different, in an order in which each comes up again and again.
    fn check(words: usize, different: u64, count: u64) {
        let mut out = vec![7; words];
        let state = |number: u64| (0..words as u64).map(move |word| number * 3 + word);
        let mut successors = Successors::new(&mut out);
        for number in 0..count {
            successors.room(words).extend(state(number * number % different));
        }
        let longest = successors.out.len();
        successors.thin(words);
        let mut expected = vec![7; words];
        let mut seen = std::collections::BTreeSet::new();
        (0..count).map(|number| number * number % different).filter(|number| seen.insert(*number)).for_each(|number| {
            expected.extend(state(number));
        });
        assert_eq!(out, expected);
        assert!(longest <= 2 * expected.len() + PIECE + words, "{longest} words for {}", expected.len());
    }

    #[test]
    fn each_is_listed_in_its_order_and_not_for_each_alternative() {
        check(1, 101, 300_000);
        check(2, 50_021, 200_000);
    }
}
