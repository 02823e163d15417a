//! A keeper of checkpoints in memory, and checkpoints that are damaged.

use explore::checkpoint::Keeper;

use crate::random::Random;

/// Stores words in memory.
#[derive(Debug, Default)]
pub struct Memory {
    /// What identifies the model.
    pub model: u64,
    /// The last checkpoint.
    pub kept: Option<Vec<u64>>,
    unfinished: Vec<u64>,
    read: usize,
    /// A checkpoint is due every this many rounds.
    pub every: usize,
    rounds: usize,
    /// How many checkpoints were written.
    pub times: usize,
}

impl Memory {
    /// A keeper with a checkpoint of this model, or none yet.
    pub fn of(model: u64, kept: Option<Vec<u64>>) -> Memory {
        Memory { model, kept, ..Memory::default() }
    }

    /// A keeper that is due every so many rounds.
    pub fn every(every: usize) -> Memory {
        Memory { every, ..Memory::default() }
    }
}

impl Keeper for Memory {
    fn model(&self) -> u64 {
        self.model
    }

    fn is_due(&mut self) -> bool {
        self.rounds += 1;
        self.every > 0 && self.rounds.is_multiple_of(self.every)
    }

    fn open(&mut self) -> bool {
        self.read = 0;
        self.kept.is_some()
    }

    fn read(&mut self, words: &mut [u64]) -> bool {
        let kept = self.kept.as_deref().unwrap_or_default();
        let Some(found) = kept.get(self.read..self.read + words.len()) else { return false };
        words.copy_from_slice(found);
        self.read += words.len();
        true
    }

    fn write(&mut self, words: &[u64]) {
        self.unfinished.extend(words);
    }

    fn end(&mut self) {
        self.kept = Some(std::mem::take(&mut self.unfinished));
        self.times += 1;
    }

    fn remove(&mut self) {
        self.kept = None;
    }
}

/// Checkpoints that are shorter, or differ in a bit, each with what is wrong with it.
pub fn damaged(whole: &[u64]) -> impl Iterator<Item = (String, Vec<u64>)> + '_ {
    let mut random = Random(1);
    let shorter = (0..whole.len()).map(|len| (format!("{len} words"), whole[..len].to_vec()));
    let bits = (0..whole.len()).flat_map(move |word| [0, 63, random.below(64)].map(|bit| (word, bit)));
    let flipped = bits.map(|(word, bit)| {
        let mut flipped = whole.to_vec();
        flipped[word] ^= 1 << bit;
        (format!("bit {bit} of word {word}"), flipped)
    });
    shorter.chain(flipped)
}
