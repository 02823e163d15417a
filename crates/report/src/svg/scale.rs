//! Scales of plots: from values to pixels, with round numbers to label, linear or by decades.

/// From values to pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    /// The values at both ends; with `log` their logarithms.
    from: f64,
    to: f64,
    /// The pixels at both ends.
    start: f64,
    end: f64,
    log: bool,
}

impl Scale {
    /// Even steps. Values that do not differ get some room.
    pub fn linear((from, to): (f64, f64), (start, end): (f64, f64)) -> Scale {
        let to = if to > from { to } else { from + 1.0 };
        Scale { from, to, start, end, log: false }
    }

    /// A decade is as long as any other.
    pub fn log((from, to): (f64, f64), (start, end): (f64, f64)) -> Scale {
        let (from, to) = (from.max(f64::MIN_POSITIVE).log10(), to.max(f64::MIN_POSITIVE).log10());
        Scale { from, to: if to > from { to } else { from + 1.0 }, start, end, log: true }
    }

    /// Where a value lies; never beyond the ends.
    pub fn place(&self, value: f64) -> f64 {
        let value = if self.log { value.max(f64::MIN_POSITIVE).log10() } else { value };
        let share = ((value - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        self.start + share * (self.end - self.start)
    }

    /// Round values to label, at least this many pixels apart; of decades all or every second one, …
    pub fn ticks(&self, apart: f64) -> Vec<f64> {
        let room = ((self.end - self.start).abs() / apart).max(1.0);
        if self.log {
            let (first, last) = ((self.from - 1e-9).ceil() as i32, (self.to + 1e-9).floor() as i32);
            let step = ((f64::from(last - first + 1)) / room).ceil().max(1.0) as usize;
            return (first..=last).step_by(step).map(|power| 10f64.powi(power)).collect();
        }
        let least = (self.to - self.from) / room;
        let power = 10f64.powf(least.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|f| f * power).find(|s| *s >= least * 0.999).unwrap_or(power);
        let first = (self.from / step - 1e-9).ceil() as i64;
        let last = (self.to / step + 1e-9).floor() as i64;
        (first..=last).map(|index| index as f64 * step).collect()
    }
}

/// A number as it appears at an axis: no needless zeros, small powers of ten as such.
pub(crate) fn label(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = value.abs();
    if !(1e-3..1e6).contains(&size) {
        let power = size.log10().floor() as i32;
        let digits: String = power.to_string().chars().map(raised).collect();
        let factor = value / 10f64.powi(power);
        return if (factor - 1.0).abs() < 1e-6 {
            format!("10{digits}")
        } else {
            format!("{factor:.1}\u{b7}10{digits}")
        };
    }
    let mut text = format!("{value:.4}");
    text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    text.replace('-', "\u{2212}")
}

fn raised(digit: char) -> char {
    match digit {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        digit => digit.to_digit(10).and_then(|n| char::from_u32(0x2070 + n)).unwrap_or(digit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_values_are_labelled() {
        let scale = Scale::linear((0.0, 10.0), (0.0, 500.0));
        assert_eq!(scale.ticks(80.0), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!((scale.place(5.0), scale.place(-3.0), scale.place(12.0)), (250.0, 0.0, 500.0));
        let log = Scale::log((1e-4, 1.0), (100.0, 0.0));
        assert_eq!(log.ticks(20.0).len(), 5);
        assert!((log.place(1e-2) - 50.0).abs() < 1e-9);
        // Downwards, and too narrow for all.
        assert_eq!(log.ticks(40.0).len(), 3);
        let narrow = Scale::linear((-1.6, -1.5), (0.0, 90.0)).ticks(40.0);
        assert_eq!(narrow.into_iter().map(label).collect::<Vec<_>>(), ["\u{2212}1.6", "\u{2212}1.55", "\u{2212}1.5"]);
    }

    #[test]
    fn labels_are_short() {
        let labels: Vec<String> = [0.0, 0.05, -1.55, 1e-5, 20.0, 100_000.0].into_iter().map(label).collect();
        assert_eq!(labels, ["0", "0.05", "\u{2212}1.55", "10\u{207b}\u{2075}", "20", "100000"]);
    }
}
