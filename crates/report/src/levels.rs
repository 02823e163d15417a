//! How long a value stood at each of its levels: counts of ticks by level, also negative ones.
//!
//! Like [`Tally`](crate::Tally) for lengths. Means and quantiles come from the counts, so they are exact.

use std::collections::BTreeMap;

/// Ticks by level, and where the greatest one was first.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Levels {
    counts: BTreeMap<i64, u64>,
    greatest_at: u64,
}

impl Levels {
    /// One more tick at this level.
    pub fn add(&mut self, level: i64, tick: u64) {
        if self.greatest().is_none_or(|(greatest, _)| level > greatest) {
            self.greatest_at = tick;
        }
        *self.counts.entry(level).or_insert(0) += 1;
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty()
    }

    /// The least level.
    pub fn least(&self) -> Option<i64> {
        self.counts.keys().next().copied()
    }

    /// The greatest level, and the tick of its first occurrence.
    pub fn greatest(&self) -> Option<(i64, u64)> {
        self.counts.keys().next_back().map(|level| (*level, self.greatest_at))
    }

    /// The mean over all ticks; 0 of none.
    pub fn mean(&self) -> f64 {
        let ticks: u64 = self.counts.values().sum();
        let total: i128 = self.counts.iter().map(|(level, count)| i128::from(*level) * i128::from(*count)).sum();
        if ticks == 0 { 0.0 } else { total as f64 / ticks as f64 }
    }

    /// The level that is not exceeded in this many of a hundred ticks.
    pub fn percentile(&self, percent: u64) -> Option<i64> {
        let wanted = (self.counts.values().sum::<u64>() * percent).div_ceil(100).max(1);
        let mut seen = 0;
        self.counts.iter().find_map(|(level, count)| {
            seen += count;
            (seen >= wanted).then_some(*level)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_below_zero_count() {
        let mut levels = Levels::default();
        assert_eq!((levels.is_empty(), levels.mean(), levels.percentile(95)), (true, 0.0, None));
        for (tick, level) in [-4, 2, 2, -4, -4].into_iter().enumerate() {
            levels.add(level, tick as u64);
        }
        assert_eq!((levels.least(), levels.greatest(), levels.mean()), (Some(-4), Some((2, 1)), -1.6));
        assert_eq!((levels.percentile(50), levels.percentile(95)), (Some(-4), Some(2)));
    }
}
