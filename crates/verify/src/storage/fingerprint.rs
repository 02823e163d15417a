//! A state's hash from a universal family, so that the probability of collisions is known.
//!
//! In: a seed, which selects a member of the family; packed states. Out: 61 bits. The half-words of a state, each
//! multiplied by a key, are added modulo the prime 2⁶¹ − 1 (L. Carter, M. Wegman, *Universal classes of hash
//! functions*, 1979). Any two different states have equal hashes for one in 2⁶¹ − 1 of all keys.

/// The prime.
pub const PRIME: u64 = (1 << 61) - 1;

/// A hash function for states.
#[derive(Debug)]
pub struct Fingerprint {
    /// Two per word.
    keys: Vec<u64>,
}

impl Fingerprint {
    /// The hash function for states with this many words that a seed selects.
    pub fn new(words: usize, seed: u64) -> Fingerprint {
        // The generator is SplitMix64 (G. Steele, D. Lea, C. Flood, 2014).
        let mut state = seed;
        let mut draw = || loop {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut mixed = state;
            mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            let key = (mixed ^ mixed >> 31) >> 3;
            if key < PRIME {
                return key;
            }
        };
        Fingerprint { keys: (0..2 * words).map(|_| draw()).collect() }
    }

    /// The hash of a state, below [`PRIME`].
    #[inline]
    pub fn of(&self, state: &[u64]) -> u64 {
        let mut sum = 0u128;
        for (word, keys) in state.iter().zip(self.keys.chunks_exact(2)) {
            sum +=
                u128::from(*word & 0xffff_ffff) * u128::from(keys[0]) + u128::from(*word >> 32) * u128::from(keys[1]);
        }
        // Each product has at most 93 bits, so two folds leave less than twice the prime.
        let folded = (sum & u128::from(PRIME)) + (sum >> 61);
        let folded = (folded as u64 & PRIME) + (folded >> 61) as u64;
        if folded >= PRIME { folded - PRIME } else { folded }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(state: &[u64]) {
        let hash = Fingerprint::new(state.len(), 7);
        let straight = state.iter().zip(hash.keys.chunks_exact(2)).fold(0u128, |sum, (word, keys)| {
            let (low, high) = (u128::from(*word & 0xffff_ffff), u128::from(*word >> 32));
            (sum + low * u128::from(keys[0]) + high * u128::from(keys[1])) % u128::from(PRIME)
        });
        assert_eq!(u128::from(hash.of(state)), straight);
    }

    #[test]
    fn folding_is_division() {
        check(&[0]);
        check(&[u64::MAX]);
        check(&[u64::MAX; 300]);
        check(&[PRIME, 1, u64::MAX, 0]);
        (0..200).for_each(|shift| check(&[1 << (shift % 64), 1 << (shift * 7 % 64), shift]));
    }

    /// Such states collide in many hash functions, whatever else they contain.
    #[test]
    fn bits_that_cancel_in_a_multiplication_do_not_here() {
        let hash = Fingerprint::new(2, 0);
        let high = 1u64 << 63;
        assert_ne!(hash.of(&[5, 9]), hash.of(&[5 ^ high, 9 ^ high ^ 1 << 31]));
    }

    #[test]
    fn seeds_draw_different_hashes() {
        assert_ne!(Fingerprint::new(1, 0).of(&[1]), Fingerprint::new(1, 1).of(&[1]));
    }
}
