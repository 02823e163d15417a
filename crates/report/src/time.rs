//! Ticks as time for people.
//!
//! In: a number of ticks. Out: text such as `38.4 ms`. A whole report uses one unit, so figures can be compared at a
//! glance, with as many decimals as one tick needs. A model without a notion of time counts steps.

/// How long a tick is, and therefore in which unit times are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TimeBase {
    tick_ns: Option<u64>,
}

/// The narrow space that separates a number from its unit and groups of three digits.
const THIN: char = '\u{202f}';

impl TimeBase {
    /// A tick lasts this many nanoseconds.
    pub fn new(tick_ns: u64) -> TimeBase {
        TimeBase { tick_ns: Some(tick_ns.max(1)) }
    }

    /// Ticks are steps, not time.
    pub fn steps() -> TimeBase {
        TimeBase { tick_ns: None }
    }

    /// Nanoseconds of a tick.
    pub fn tick_ns(self) -> Option<u64> {
        self.tick_ns
    }

    /// The unit's sign and its nanoseconds: the largest unit of which a tick is at least a thousandth.
    fn scale(self) -> (&'static str, u64) {
        match self.tick_ns {
            None => ("steps", 1),
            Some(ns) if ns >= 10_000_000 => ("s", 1_000_000_000),
            Some(ns) if ns >= 10_000 => ("ms", 1_000_000),
            Some(ns) if ns >= 10 => ("µs", 1_000),
            Some(_) => ("ns", 1),
        }
    }

    /// The sign of the unit.
    pub fn unit(self) -> &'static str {
        self.scale().0
    }

    /// How many units a tick is.
    pub fn factor(self) -> f64 {
        self.tick_ns.unwrap_or(1) as f64 / self.scale().1 as f64
    }

    /// Decimals that show every tick exactly, three at most.
    pub fn decimals(self) -> usize {
        let (_, unit) = self.scale();
        let tick = self.tick_ns.unwrap_or(1);
        (0..3).find(|digits| (tick * 10u64.pow(*digits)).is_multiple_of(unit)).unwrap_or(3) as usize
    }

    /// A time without its unit, every tick distinct: `38.4`.
    pub fn bare(self, ticks: i64) -> String {
        grouped(ticks as f64 * self.factor(), self.decimals())
    }

    /// A time: `38.4 ms`.
    pub fn show(self, ticks: u64) -> String {
        format!("{}{THIN}{}", self.bare(ticks as i64), self.unit())
    }

    /// A time with its needless zeros taken off: `12 ms`.
    pub fn short(self, ticks: u64) -> String {
        let value = self.bare(ticks as i64);
        let value = if value.contains('.') { value.trim_end_matches('0').trim_end_matches('.') } else { &value };
        format!("{value}{THIN}{}", self.unit())
    }

    /// A mean of times, with one more decimal than a single one has.
    pub fn mean(self, ticks: f64) -> String {
        format!("{}{THIN}{}", grouped(ticks * self.factor(), self.decimals() + 1), self.unit())
    }

    /// A whole run: `1 s`, in the unit that makes it short.
    pub fn run(self, ticks: u64) -> String {
        let units = [("s", 1_000_000_000), ("ms", 1_000_000), ("µs", 1_000)];
        let whole = self.tick_ns.map(|ns| ns.saturating_mul(ticks));
        match whole.and_then(|ns| units.iter().find(|(_, unit)| ns.is_multiple_of(unit / 10) && ns >= *unit)) {
            Some((sign, unit)) => {
                let text = format!("{:.1}", whole.unwrap_or(0) as f64 / *unit as f64);
                format!("{}{THIN}{sign}", text.trim_end_matches(".0"))
            }
            None => self.short(ticks),
        }
    }
}

/// A count with its digits in groups of three from five digits on: `10 000`, but `2000`.
pub fn count(n: u64) -> String {
    grouped(n as f64, 0)
}

/// A number with this many decimals, its whole part in groups of three.
fn grouped(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let (whole, fraction) = text.split_once('.').map_or((text.as_str(), ""), |(whole, rest)| (whole, rest));
    let digits = whole.trim_start_matches('-');
    let mut out = String::new();
    if whole.starts_with('-') && text.contains(|c: char| c.is_ascii_digit() && c != '0') {
        out.push('\u{2212}');
    }
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index) % 3 == 0 && digits.len() > 4 {
            out.push(THIN);
        }
        out.push(digit);
    }
    if !fraction.is_empty() {
        out.push('.');
        out.push_str(fraction);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_follows_the_tick() {
        let base = TimeBase::new(100_000);
        assert_eq!(base.show(384), "38.4\u{202f}ms");
        assert_eq!(base.short(120), "12\u{202f}ms");
        assert_eq!(base.mean(1.25), "0.12\u{202f}ms");
        assert_eq!(base.run(10_000), "1\u{202f}s");
        assert_eq!(base.run(400), "40\u{202f}ms");
        assert_eq!(TimeBase::new(1_000).show(12), "12\u{202f}µs");
        assert_eq!(TimeBase::new(1_000_000_000).show(12), "12\u{202f}s");
        assert_eq!(TimeBase::new(250_000).show(3), "0.75\u{202f}ms");
        assert_eq!(TimeBase::steps().show(12_345), "12\u{202f}345\u{202f}steps");
    }

    #[test]
    fn digits_are_grouped_from_five_on() {
        assert_eq!(count(2000), "2000");
        assert_eq!(count(10_000), "10\u{202f}000");
        assert_eq!(count(1_234_567), "1\u{202f}234\u{202f}567");
        assert_eq!(TimeBase::new(100_000).bare(-3), "\u{2212}0.3");
        assert_eq!(TimeBase::new(100_000).bare(0), "0.0");
    }
}
