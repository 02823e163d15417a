//! Numbers within bounds for random systems: the same from the same seed on every machine.

/// G. Marsaglia's xorshift; the seed must not be 0.
pub struct Draw(pub u64);

impl Draw {
    /// A number between two, both of them possible.
    pub fn number(&mut self, least: u64, most: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        least + self.0 % (most - least + 1)
    }
}
