//! Random inputs and choices from a seed.
//!
//! The generator is SplitMix64 (Steele, Lea, Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014).
//! INVARIANT: what is drawn depends only on the seed, the step and what is drawn for (a location, or the number of
//! the choice within the step), never on the order of asking. The same seed gives the same run for ever, and adding
//! an input to a model leaves the values of the others as they were.

use std::fmt;
use std::hash::{Hash, Hasher};

use machine::Value;
use program::Program;

use crate::draw::{Bounds, draw};
use crate::inputs::{Ask, Source};

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
fn location_key(name: StableHash, program: &Program, arguments: &[Value]) -> u64 {
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

/// Draws every input from its domain.
#[derive(Debug)]
pub struct RandomSource {
    seed: u64,
    bounds: Bounds,
    /// The hashes of functions' names, by function, as they are asked for.
    names: Vec<Option<StableHash>>,
}

impl RandomSource {
    /// Inputs from a seed; infinite domains are cut to the bounds.
    pub fn new(seed: u64, bounds: Bounds) -> Self {
        RandomSource { seed, bounds, names: Vec::new() }
    }
}

impl Source for RandomSource {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        if ask.clock {
            return Ok(None);
        }
        let function = ask.location.function.0 as usize;
        if self.names.len() <= function {
            self.names.resize(ask.program.functions.len(), None);
        }
        let name = self.names[function]
            .get_or_insert_with(|| StableHash::new().text(&ask.program.functions[function].name))
            .clone();
        let key = location_key(name, ask.program, ask.location.arguments);
        let mut stream = SplitMix::stream(self.seed, ask.step, key);
        let value = draw(ask.program, ask.carriers, &self.bounds, ask.codomain, &mut stream).map_err(|reason| {
            format!("no random value can be drawn for {}: {reason}", ask.location.show(ask.program))
        })?;
        Ok(Some(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first numbers that the reference implementation gives for the seed 1234567.
    #[test]
    fn is_splitmix64() {
        let mut random = SplitMix::new(1_234_567);
        let first: Vec<u64> = (0..3).map(|_| random.next_u64()).collect();
        assert_eq!(first, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn draws_stay_in_bounds() {
        let mut random = SplitMix::new(7);
        for _ in 0..10_000 {
            assert!((-3..=3).contains(&random.between(-3, 3)));
            assert!(random.below(5) < 5);
        }
        assert_eq!(random.between(4, 4), 4);
        random.between(i64::MIN, i64::MAX);
    }

    #[test]
    fn streams_differ_by_step_and_key() {
        let first = |step, key| SplitMix::stream(1, step, key).next_u64();
        assert_ne!(first(1, 1), first(2, 1));
        assert_ne!(first(1, 1), first(1, 2));
        assert_eq!(first(1, 1), first(1, 1));
    }
}
