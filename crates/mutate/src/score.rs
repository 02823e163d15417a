//! How sure a share is that a sample shows.
//!
//! In: how many of how many. Out: the interval in which the share of all lies with a probability of 95 % (E. B. Wilson,
//! *Probable inference, the law of succession, and statistical inference*, 1927).

/// Bounds of a share, between 0 and 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The lower bound.
    pub low: f64,
    /// The upper bound.
    pub high: f64,
}

/// The interval of a share of which a sample shows so many of so many.
pub fn interval(killed: usize, of: usize) -> Option<Interval> {
    const Z: f64 = 1.959_963_984_540_054;
    if of == 0 {
        return None;
    }
    let (n, share) = (of as f64, killed as f64 / of as f64);
    let middle = share + Z * Z / (2.0 * n);
    let width = Z * (share * (1.0 - share) / n + Z * Z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + Z * Z / n;
    Some(Interval { low: ((middle - width) / scale).max(0.0), high: ((middle + width) / scale).min(1.0) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_is_wilsons() {
        let check = |killed, of, low: f64, high: f64| {
            let found = interval(killed, of).expect("a sample");
            assert!((found.low - low).abs() < 5e-4 && (found.high - high).abs() < 5e-4, "{found:?}");
        };
        check(8, 10, 0.490, 0.943);
        check(10, 10, 0.722, 1.0);
        check(0, 10, 0.0, 0.278);
        assert_eq!(interval(0, 0), None);
    }
}
