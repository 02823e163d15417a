//! How often each length occurred: counts by value, in memory that does not grow with the run.
//!
//! Means and quantiles come from the counts, so they are exact and the same on every machine.

use std::collections::BTreeMap;

/// Counts by value, and where the greatest one was.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tally {
    counts: BTreeMap<u64, u64>,
    greatest_at: u64,
}

impl Tally {
    /// Nothing yet.
    pub const fn new() -> Tally {
        Tally { counts: BTreeMap::new(), greatest_at: 0 }
    }

    /// One more of this value, seen at this tick.
    pub fn add(&mut self, value: u64, tick: u64) {
        if self.greatest().is_none_or(|(greatest, _)| value > greatest) {
            self.greatest_at = tick;
        }
        *self.counts.entry(value).or_insert(0) += 1;
    }

    /// Each value with its count, in ascending order.
    pub fn counts(&self) -> &BTreeMap<u64, u64> {
        &self.counts
    }

    /// How many there are.
    pub fn count(&self) -> u64 {
        self.counts.values().sum()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty()
    }

    /// The sum of all values.
    pub fn total(&self) -> u64 {
        self.counts.iter().map(|(value, count)| value * count).sum()
    }

    /// The mean; 0 of none.
    pub fn mean(&self) -> f64 {
        if self.is_empty() { 0.0 } else { self.total() as f64 / self.count() as f64 }
    }

    /// The least value.
    pub fn least(&self) -> Option<u64> {
        self.counts.keys().next().copied()
    }

    /// The greatest value, and the tick of its first occurrence.
    pub fn greatest(&self) -> Option<(u64, u64)> {
        self.counts.keys().next_back().map(|value| (*value, self.greatest_at))
    }

    /// The value that this many of a hundred do not exceed.
    pub fn percentile(&self, percent: u64) -> Option<u64> {
        let wanted = (self.count() * percent).div_ceil(100).max(1);
        let mut seen = 0;
        self.counts.iter().find_map(|(value, count)| {
            seen += count;
            (seen >= wanted).then_some(*value)
        })
    }

    /// The counts in this many bins of equal width: `(first value, counts)` with the width of a bin.
    pub fn bins(&self, most: u64) -> (u64, u64, Vec<u64>) {
        let (Some(least), Some((greatest, _))) = (self.least(), self.greatest()) else { return (0, 1, Vec::new()) };
        let width = nice_width((greatest - least + 1).div_ceil(most.max(1)));
        let first = least / width * width;
        let mut bins = vec![0; ((greatest - first) / width + 1) as usize];
        for (value, count) in &self.counts {
            bins[((value - first) / width) as usize] += count;
        }
        (first, width, bins)
    }
}

/// The next of 1, 2, 5, 10, 20, …
fn nice_width(least: u64) -> u64 {
    let mut power = 1u64;
    loop {
        for factor in [1, 2, 5] {
            let width = power.saturating_mul(factor);
            if width >= least {
                return width;
            }
        }
        power = power.saturating_mul(10);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_come_from_the_counts() {
        let mut tally = Tally::default();
        assert_eq!((tally.percentile(50), tally.greatest(), tally.bins(4).2.len()), (None, None, 0));
        for (tick, value) in [3, 1, 7, 3, 7].into_iter().enumerate() {
            tally.add(value, tick as u64 * 10);
        }
        assert_eq!((tally.count(), tally.total(), tally.greatest()), (5, 21, Some((7, 20))));
        assert_eq!((tally.percentile(50), tally.percentile(95), tally.percentile(0)), (Some(3), Some(7), Some(1)));
        assert_eq!(tally.bins(3), (0, 5, vec![3, 2]));
        assert_eq!(tally.bins(100), (1, 1, vec![1, 0, 2, 0, 0, 0, 2]));
    }
}
