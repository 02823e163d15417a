//! The generator of random numbers, and the keys that its streams are named by.
//!
//! SplitMix64 (Steele, Lea, Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014). The same seed gives the same
//! numbers for ever.

use std::fmt;
use std::hash::{Hash, Hasher};

use machine::Value;
use program::Program;

/// The generator.
#[derive(Debug, Clone)]
pub struct SplitMix {
    state: u64,
}

impl SplitMix {
    /// Starts from a seed.
    pub fn new(seed: u64) -> Self {
        SplitMix { state: seed }
    }

    /// The stream for one thing in one step.
    pub fn stream(seed: u64, step: u64, key: u64) -> Self {
        let step = SplitMix::new(seed).mixed(step);
        SplitMix::new(SplitMix::new(step).mixed(key))
    }

    fn mixed(mut self, word: u64) -> u64 {
        self.state ^= word.wrapping_mul(0xd134_2543_de82_ef95);
        self.next_u64()
    }

    /// The next 64 bits.
    pub fn next_u64(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `bound`, which is not 0: the high word of a 128-bit product. Its bias is below
    /// `bound / 2⁶⁴`.
    pub fn below(&mut self, bound: u64) -> u64 {
        ((u128::from(self.next_u64()) * u128::from(bound)) >> 64) as u64
    }

    /// A number in `[low, high]`.
    pub fn between(&mut self, low: i64, high: i64) -> i64 {
        let width = high.wrapping_sub(low) as u64;
        let offset = if width == u64::MAX { self.next_u64() } else { self.below(width + 1) };
        low.wrapping_add(offset as i64)
    }
}

/// A hash that is the same on every machine and in every release: FNV-1a.
#[derive(Debug, Clone)]
pub(crate) struct StableHash(u64);

impl StableHash {
    pub fn new() -> Self {
        StableHash(0xcbf2_9ce4_8422_2325)
    }

    pub fn text(mut self, text: &str) -> Self {
        self.write(text.as_bytes());
        self.write(&[0xff]);
        self
    }
}

impl Hasher for StableHash {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

impl fmt::Write for StableHash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.write(text.as_bytes());
        Ok(())
    }
}

/// What a location is drawn by.
pub(crate) fn location_key_of(name: &str, program: &Program, arguments: &[Value]) -> u64 {
    location_key(StableHash::new().text(name), program, arguments)
}

/// What a location is drawn by: its function's name, which is hashed already, and its arguments.
pub(crate) fn location_key(name: StableHash, program: &Program, arguments: &[Value]) -> u64 {
    use fmt::Write;
    use machine::Show;
    let mut hash = name;
    for argument in arguments {
        match argument {
            Value::Integer(n) => n.to_le_bytes().hash(&mut hash),
            other => {
                write!(hash, "{}", other.show(program)).expect("a hash takes every text");
                hash = hash.text("");
            }
        }
    }
    hash.finish()
}
