//! Intervals of 64-bit integers: known bounds of an expression's value.
//!
//! In: the intervals of operands. Out: the interval of the result, and whether the operation can fault. With their
//! help, arithmetic that cannot overflow becomes plain C++, and an index within its array is not checked (Cousot &
//! Cousot 1977, the interval domain).

/// An interval. INVARIANT: the only empty interval is [`Interval::EMPTY`], for what is never evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Interval {
    pub low: i64,
    pub high: i64,
}

/// The result of an operation, and whether it has one for all operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Outcome {
    pub interval: Interval,
    pub safe: bool,
}

impl Interval {
    pub const EMPTY: Interval = Interval { low: i64::MAX, high: i64::MIN };
    pub const ALL: Interval = Interval { low: i64::MIN, high: i64::MAX };
    pub const NATURAL: Interval = Interval { low: 0, high: i64::MAX };

    pub fn of(number: i64) -> Interval {
        Interval { low: number, high: number }
    }

    pub fn is_empty(self) -> bool {
        self.low > self.high
    }

    pub fn contains(self, number: i64) -> bool {
        (self.low..=self.high).contains(&number)
    }

    /// Whether it is contained in the other one.
    pub fn within(self, other: Interval) -> bool {
        self.is_empty() || (other.low <= self.low && self.high <= other.high)
    }

    /// The smallest interval that contains both.
    pub fn join(self, other: Interval) -> Interval {
        Interval { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The intersection.
    pub fn meet(self, other: Interval) -> Interval {
        let both = Interval { low: self.low.max(other.low), high: self.high.min(other.high) };
        if both.is_empty() { Interval::EMPTY } else { both }
    }

    /// A larger interval, so that growth soon ends: each end that grew beyond `before` moves to 0 or to its extreme.
    pub fn widened(self, before: Interval) -> Interval {
        let low = match self.low {
            low if low == before.low => low,
            low if low >= 0 => 0,
            _ => i64::MIN,
        };
        let high = match self.high {
            high if high == before.high => high,
            high if high <= 0 => 0,
            _ => i64::MAX,
        };
        Interval { low, high }
    }

    pub fn add(self, other: Interval) -> Outcome {
        self.corners(other, |a, b| a + b)
    }

    pub fn subtract(self, other: Interval) -> Outcome {
        self.corners(other, |a, b| a - b)
    }

    pub fn multiply(self, other: Interval) -> Outcome {
        self.corners(other, |a, b| a * b)
    }

    pub fn minimum(self, other: Interval) -> Outcome {
        self.corners(other, Ord::min)
    }

    pub fn maximum(self, other: Interval) -> Outcome {
        self.corners(other, Ord::max)
    }

    pub fn negate(self) -> Outcome {
        Interval::of(0).subtract(self)
    }

    pub fn absolute(self) -> Outcome {
        match self {
            _ if self.is_empty() || self.low >= 0 => Outcome { interval: self, safe: true },
            _ if self.high <= 0 => self.negate(),
            _ => {
                let negated = self.negate();
                let high = negated.interval.high.max(self.high);
                Outcome { interval: Interval { low: 0, high }, safe: negated.safe }
            }
        }
    }

    /// Truncated toward zero.
    pub fn quotient(self, divisor: Interval) -> Outcome {
        if divisor.contains(0) {
            return Outcome { interval: Interval::ALL, safe: false };
        }
        self.corners(divisor, |a, b| a / b)
    }

    /// With the sign of the dividend.
    pub fn remainder(self, divisor: Interval) -> Outcome {
        if self.is_empty() || divisor.is_empty() {
            return Outcome { interval: Interval::EMPTY, safe: true };
        }
        // In C++, dividing the least integer by -1 traps.
        let traps = divisor.contains(-1) && self.contains(i64::MIN);
        let safe = !divisor.contains(0) && !traps;
        let most =
            divisor.low.unsigned_abs().max(divisor.high.unsigned_abs()).saturating_sub(1).min(i64::MAX as u64) as i64;
        let low = if self.low < 0 { self.low.max(-most) } else { 0 };
        let high = if self.high > 0 { self.high.min(most) } else { 0 };
        Outcome { interval: Interval { low, high }, safe }
    }

    /// An operation whose extreme results occur at the ends of the operands.
    fn corners(self, other: Interval, operation: impl Fn(i128, i128) -> i128) -> Outcome {
        if self.is_empty() || other.is_empty() {
            return Outcome { interval: Interval::EMPTY, safe: true };
        }
        let ends = |interval: Interval| [i128::from(interval.low), i128::from(interval.high)];
        let results = ends(self).map(|a| ends(other).map(|b| operation(a, b)));
        let all = || results.iter().flatten().copied();
        let (low, high) = (all().min().unwrap_or(0), all().max().unwrap_or(0));
        let limits = [i128::from(i64::MIN), i128::from(i64::MAX)];
        let clamped = |number: i128| number.clamp(limits[0], limits[1]) as i64;
        Outcome {
            interval: Interval { low: clamped(low), high: clamped(high) },
            safe: limits[0] <= low && high <= limits[1],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn interval(low: i64, high: i64) -> Interval {
        Interval { low, high }
    }

    /// Every operation, on all pairs of small intervals and near the limits: no result lies outside, and no safe
    /// operation overflows.
    #[test]
    fn results_lie_inside() {
        type Check = fn(i64, i64) -> Option<i64>;
        type Operation = fn(Interval, Interval) -> Outcome;
        let operations: [(Operation, Check); 7] = [
            (Interval::add, i64::checked_add),
            (Interval::subtract, i64::checked_sub),
            (Interval::multiply, i64::checked_mul),
            (Interval::minimum, |a, b| Some(a.min(b))),
            (Interval::maximum, |a, b| Some(a.max(b))),
            (Interval::quotient, i64::checked_div),
            (Interval::remainder, i64::checked_rem),
        ];
        let ends = [i64::MIN, i64::MIN + 1, -3, -1, 0, 1, 2, 5, i64::MAX - 1, i64::MAX];
        let intervals: Vec<Interval> = ends
            .iter()
            .flat_map(|low| ends.iter().map(|high| interval(*low, *high)))
            .filter(|i| !i.is_empty())
            .collect();
        for (operation, check) in operations {
            for a in &intervals {
                for b in &intervals {
                    let outcome = operation(*a, *b);
                    for x in ends.iter().filter(|x| a.contains(**x)) {
                        for y in ends.iter().filter(|y| b.contains(**y)) {
                            match check(*x, *y) {
                                Some(result) => assert!(outcome.interval.contains(result), "{x} {y} of {a:?} {b:?}"),
                                None => assert!(!outcome.safe, "{x} {y} of {a:?} {b:?}"),
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn magnitudes() {
        assert_eq!(interval(-3, 2).absolute(), Outcome { interval: interval(0, 3), safe: true });
        assert_eq!(interval(-3, -2).absolute(), Outcome { interval: interval(2, 3), safe: true });
        assert!(!Interval::ALL.absolute().safe);
        assert_eq!(
            interval(0, 31).add(Interval::of(32)).interval.remainder(Interval::of(32)).interval,
            interval(0, 31)
        );
    }

    #[test]
    fn widening_ends() {
        assert_eq!(interval(0, 3).widened(interval(0, 2)), interval(0, i64::MAX));
        assert_eq!(interval(-1, 3).widened(interval(0, 3)), interval(i64::MIN, 3));
        assert_eq!(interval(2, 3).widened(interval(3, 3)), interval(0, 3));
    }
}
