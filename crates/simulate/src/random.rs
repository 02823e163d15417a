//! Random inputs and choices from a seed.
//!
//! The generator is SplitMix64 (Steele, Lea, Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014).
//! INVARIANT: a draw depends only on the seed, the step and its purpose (a location, or the number of the choice within
//! the step), never on the order of asking. The same seed gives the same run for ever, and adding an input to a model
//! does not change the values of the others.

use machine::Value;

use crate::draw::{Bounds, draw};
use crate::inputs::{Ask, Source};
use crate::splitmix::{SplitMix, StableHash, location_key};

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
