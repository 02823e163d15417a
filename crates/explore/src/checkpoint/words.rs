//! The format of checkpoints: sections, each with its length, and a checksum at the end.
//!
//! In: a [`Keeper`], which does the I/O. Out: the sections, or that the words are damaged. INVARIANT: a length is not
//! trusted before that many words were read; nothing is used before the checksum is verified.

use super::keeper::{Keeper, Refusal};

/// What a checkpoint is of: its first two words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind {
    /// The search that it is of.
    pub name: &'static [u8; 8],
    /// Increased whenever the meaning of the written words changes.
    pub version: u64,
}

/// How many words are transferred at a time.
const PIECE: usize = 1 << 12;

/// A checksum that detects words that are changed, missing or moved.
#[derive(Debug, Clone, Copy)]
struct Sum(u64);

impl Sum {
    fn add(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 ^= self.0 >> 29;
    }
}

/// Writes a checkpoint's sections.
pub struct Writer<'k> {
    keeper: &'k mut dyn Keeper,
    sum: Sum,
    piece: Vec<u64>,
}

impl<'k> Writer<'k> {
    /// Begins a checkpoint of this kind.
    pub fn begin(keeper: &'k mut dyn Keeper, kind: Kind) -> Writer<'k> {
        let mut writer = Writer { keeper, sum: Sum(0), piece: Vec::with_capacity(PIECE) };
        writer.word(u64::from_be_bytes(*kind.name));
        writer.word(kind.version);
        writer
    }

    /// Writes one word.
    pub fn word(&mut self, word: u64) {
        self.sum.add(word);
        self.piece.push(word);
        if self.piece.len() == PIECE {
            self.keeper.write(&self.piece);
            self.piece.clear();
        }
    }

    /// Writes a whole section.
    pub fn section(&mut self, words: &[u64]) {
        self.word(words.len() as u64);
        words.iter().for_each(|word| self.word(*word));
    }

    /// Completes the checkpoint.
    pub fn end(mut self) {
        let sum = self.sum.0;
        self.word(sum);
        self.keeper.write(&self.piece);
        self.keeper.end();
    }
}

/// Reads a checkpoint's sections.
pub struct Reader<'k> {
    keeper: &'k mut dyn Keeper,
    sum: Sum,
}

impl<'k> Reader<'k> {
    /// Begins to read; `None` if there is no checkpoint.
    ///
    /// # Errors
    /// It is not a checkpoint, or its version differs.
    pub fn begin(keeper: &'k mut dyn Keeper, kind: Kind) -> Result<Option<Reader<'k>>, Refusal> {
        if !keeper.open() {
            return Ok(None);
        }
        let mut reader = Reader { keeper, sum: Sum(0) };
        if reader.word().ok() != Some(u64::from_be_bytes(*kind.name)) {
            return Err(Refusal::Foreign);
        }
        if reader.word()? != kind.version {
            return Err(Refusal::Version);
        }
        Ok(Some(reader))
    }

    /// Reads one word.
    ///
    /// # Errors
    /// There is none.
    pub fn word(&mut self) -> Result<u64, Refusal> {
        let mut word = [0];
        if !self.keeper.read(&mut word) {
            return Err(Refusal::Damaged);
        }
        self.sum.add(word[0]);
        Ok(word[0])
    }

    /// Reads a section.
    ///
    /// # Errors
    /// It ends too soon.
    pub fn section(&mut self) -> Result<Vec<u64>, Refusal> {
        let mut left = self.word()?;
        let mut words = Vec::new();
        while left > 0 {
            let piece = left.min(PIECE as u64) as usize;
            let start = words.len();
            words.resize(start + piece, 0);
            if !self.keeper.read(&mut words[start..]) {
                return Err(Refusal::Damaged);
            }
            words[start..].iter().for_each(|word| self.sum.add(*word));
            left -= piece as u64;
        }
        Ok(words)
    }

    /// Ends reading.
    ///
    /// # Errors
    /// The checksum is wrong, or more words follow.
    pub fn end(mut self) -> Result<(), Refusal> {
        let sum = self.sum.0;
        if self.word()? != sum || self.keeper.read(&mut [0]) { Err(Refusal::Damaged) } else { Ok(()) }
    }
}
