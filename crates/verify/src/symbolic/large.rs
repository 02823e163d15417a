//! Numbers of states that have as many bits as a state may have: a float whose exponent has no end.
//!
//! A diagram is counted from its leaves, each of which stands for all states there could be: 2ⁿ for n bits, which no `f64` holds where
//! n > 2044. INVARIANT: as exact as an `f64`, so exact below 2⁵³.

use std::ops::{AddAssign, ShlAssign, ShrAssign, SubAssign};

use oxidd::util::IsFloatingPoint;

/// The number `part · 2^exponent`, with a part of 0 or from 1 up to 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Large {
    part: f64,
    exponent: i64,
}

/// A number whose exponent is so much smaller than another one's adds nothing to it.
const NOTHING: i64 = 64;

impl Large {
    fn of(part: f64, exponent: i64) -> Large {
        if part == 0.0 {
            return Large { part, exponent: 0 };
        }
        let more = part.abs().log2().floor();
        Large { part: part * (-more).exp2(), exponent: exponent + more as i64 }
    }

    /// The number, if an `f64` holds it; else infinity.
    pub fn value(self) -> f64 {
        self.part * (self.exponent as f64).exp2()
    }

    fn plus(self, other: Large) -> Large {
        let (great, small) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let apart = great.exponent - small.exponent;
        if great.part == 0.0 {
            return small;
        }
        if small.part == 0.0 || apart > NOTHING {
            return great;
        }
        Large::of(great.part + small.part * (-(apart as f64)).exp2(), great.exponent)
    }
}

impl From<u32> for Large {
    fn from(value: u32) -> Large {
        Large::of(value.into(), 0)
    }
}

impl IsFloatingPoint for Large {
    const FLOATING_POINT: bool = true;
    const MIN_EXP: i32 = 0;
}

impl AddAssign<&Large> for Large {
    fn add_assign(&mut self, other: &Large) {
        *self = self.plus(*other);
    }
}

impl SubAssign<&Large> for Large {
    fn sub_assign(&mut self, other: &Large) {
        *self = self.plus(Large { part: -other.part, ..*other });
    }
}

impl ShlAssign<u32> for Large {
    fn shl_assign(&mut self, by: u32) {
        self.exponent += if self.part == 0.0 { 0 } else { i64::from(by) };
    }
}

impl ShrAssign<u32> for Large {
    fn shr_assign(&mut self, by: u32) {
        self.exponent -= if self.part == 0.0 { 0 } else { i64::from(by) };
    }
}

#[cfg(test)]
mod tests {
    use super::Large;

    #[test]
    fn sums_are_those_of_numbers() {
        let check = |terms: &[u32], by: u32, sum: f64| {
            let mut all = Large::from(0);
            for term in terms {
                let mut term = Large::from(*term);
                term <<= by;
                all += &term;
            }
            all >>= by;
            assert_eq!(all.value(), sum, "{terms:?} times 2^{by}");
        };
        for by in [0, 1, 1_000, 2_044, 2_045, 100_000] {
            check(&[], by, 0.0);
            check(&[1], by, 1.0);
            check(&[3, 5, 0, 7], by, 15.0);
            check(&[u32::MAX, u32::MAX, 1], by, 2.0 * f64::from(u32::MAX) + 1.0);
        }
        let mut one = Large::from(1);
        one <<= 1_100;
        assert_eq!(one.value(), f64::INFINITY);
        let mut less = Large::from(7);
        less -= &Large::from(7);
        assert_eq!(less.value(), 0.0);
        less -= &Large::from(2);
        assert_eq!(less.value(), -2.0);
    }
}
