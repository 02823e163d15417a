//! Booleans that become true after a number of steps: `--weight 'endsNow(scan)=after 0..16'`, or the same under `random:`.
//!
//! In: a text that says how many steps pass. Out: a [`Delay`], from which numbers are drawn. Even: `after 0..16`. Triangular, with the
//! likeliest in the middle: `after 0..4..16`. As they were counted: `after 0:5, 3:20, 9:1`. INVARIANT: what is drawn depends on the seed,
//! the location and the step in which the waiting began alone.

use std::collections::BTreeMap;

use crate::splitmix::SplitMix;

/// LIMIT: the most steps, and the most numbers of steps, that are told apart.
const MOST: u64 = 100_000;

/// How many steps pass, by how likely each number is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Delay {
    /// Steps and their weights, in increasing order; no weight is 0.
    weights: Vec<(u64, u64)>,
    total: u64,
}

impl Delay {
    /// What stands behind `after`; none if the text does not begin with this word.
    pub(crate) fn read(text: &str) -> Option<Result<Delay, String>> {
        let rest = text.trim().strip_prefix("after")?;
        rest.starts_with(char::is_whitespace).then(|| Delay::read_steps(rest.trim()))
    }

    fn read_steps(text: &str) -> Result<Delay, String> {
        let form = || {
            format!(
                "`{text}` says no numbers of steps: write `after 0..16`, `after 0..4..16` with the likeliest in the middle, or how often each was counted, as in `after 0:5, 3:20`"
            )
        };
        let number = |text: &str| match text.trim().parse::<u64>() {
            Ok(number) if number <= MOST => Ok(number),
            Ok(_) => Err(format!("at most {MOST} steps may pass")),
            Err(_) => Err(form()),
        };
        let weights: BTreeMap<u64, u64> = if text.contains(':') {
            let mut weights = BTreeMap::new();
            for part in text.split(',') {
                let (steps, often) = part.split_once(':').ok_or_else(form)?;
                let (steps, often) = (number(steps)?, often.trim().parse::<u32>().map_err(|_| form())?);
                if weights.insert(steps, u64::from(often)).is_some() {
                    return Err(format!("{steps} stands here twice"));
                }
            }
            weights
        } else {
            let ends = text.split("..").map(number).collect::<Result<Vec<u64>, String>>()?;
            let (least, likeliest, most) = match ends[..] {
                [one] => (one, None, one),
                [least, most] => (least, None, most),
                [least, likeliest, most] => (least, Some(likeliest), most),
                _ => return Err(form()),
            };
            if least > most || likeliest.is_some_and(|one| one < least || one > most) {
                return Err(format!("`{text}` is empty: the least number of steps comes first, the greatest last"));
            }
            // From nothing beside the ends up to the likeliest, and down again: whole numbers, so the same on every machine.
            let weight = |steps: u64| match likeliest {
                None => 1,
                Some(peak) if steps <= peak => (steps - least + 1) * (most - peak + 1),
                Some(peak) => (most - steps + 1) * (peak - least + 1),
            };
            (least..=most).map(|steps| (steps, weight(steps))).collect()
        };
        let weights: Vec<(u64, u64)> = weights.into_iter().filter(|(_, weight)| *weight > 0).collect();
        match weights.iter().map(|(_, weight)| weight).sum() {
            0 => Err("one number of steps at least is to be counted once".to_string()),
            total => Ok(Delay { weights, total }),
        }
    }

    fn draw(&self, stream: &mut SplitMix) -> u64 {
        let mut at = stream.below(self.total);
        for (steps, weight) in &self.weights {
            match at.checked_sub(*weight) {
                Some(rest) => at = rest,
                None => return *steps,
            }
        }
        self.weights.last().map_or(0, |(steps, _)| *steps)
    }
}

/// A waiting: the location was asked for in each step from the first to the last one.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    first: u64,
    last: u64,
    /// The step in which it is true.
    until: u64,
}

/// The waitings of all locations.
#[derive(Debug, Clone, Default)]
pub(crate) struct Waitings {
    by_location: BTreeMap<u64, Vec<Waiting>>,
}

impl Waitings {
    /// Whether the location is true in this step. It waits anew in the first step in which it is asked for, after it was true, and after a
    /// step in which it was not asked for. Steps may be made again.
    pub(crate) fn is_over(&mut self, delay: &Delay, seed: u64, step: u64, key: u64) -> bool {
        let waitings = self.by_location.entry(key).or_default();
        while waitings.last().is_some_and(|waiting| waiting.first >= step) {
            waitings.pop();
        }
        if let Some(waiting) = waitings.last_mut() {
            waiting.last = waiting.last.min(step - 1);
            if waiting.last + 1 == step && waiting.last < waiting.until {
                waiting.last = step;
                return step == waiting.until;
            }
        }
        let until = step + delay.draw(&mut SplitMix::stream(seed, step, key));
        waitings.push(Waiting { first: step, last: step, until });
        step == until
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn delay(text: &str) -> Delay {
        Delay::read(text).expect("it is one").unwrap_or_else(|told| panic!("{told}"))
    }

    /// How often each number of steps comes in so many waitings, asked for without a gap.
    fn counted(text: &str, waitings: usize) -> BTreeMap<u64, usize> {
        let (delay, mut state) = (delay(text), Waitings::default());
        let (mut counts, mut begun, mut all) = (BTreeMap::new(), 1, 0);
        for step in 1.. {
            if state.is_over(&delay, 7, step, 3) {
                *counts.entry(step - begun).or_default() += 1;
                begun = step + 1;
                all += 1;
            }
            if all == waitings {
                break;
            }
        }
        counts
    }

    #[test]
    fn drawn_as_they_are_said() {
        let even = counted("after 2..5", 4_000);
        assert_eq!(even.keys().copied().collect::<Vec<_>>(), [2, 3, 4, 5]);
        assert!(even.values().all(|count| (900..1_100).contains(count)), "{even:?}");
        // Weights 2, 4, 6, 3 of 15.
        let peaked = counted("after 0..2..3", 15_000);
        let expected = [2_000, 4_000, 6_000, 3_000];
        assert!(peaked.values().zip(expected).all(|(count, wanted)| count.abs_diff(wanted) < 300), "{peaked:?}");
        let recorded = counted("after 0:1, 4:0, 9:3", 4_000);
        assert_eq!(recorded.keys().copied().collect::<Vec<_>>(), [0, 9]);
        assert!(recorded[&9].abs_diff(3_000) < 150, "{recorded:?}");
        assert_eq!(counted("after 3", 5), BTreeMap::from([(3, 5)]));
    }

    #[test]
    fn a_gap_begins_anew_and_steps_may_be_made_again() {
        let delay = delay("after 5");
        let mut state = Waitings::default();
        let mut asked = |steps: std::ops::RangeInclusive<u64>| -> Vec<u64> {
            steps.filter(|step| state.is_over(&delay, 1, *step, 1)).collect()
        };
        assert_eq!(asked(1..=4), [0; 0]);
        // Not asked for in step 5.
        assert_eq!(asked(6..=20), [11, 17]);
        assert_eq!(asked(9..=20), [11, 17]);
        assert_eq!(asked(3..=8), [6]);
    }

    #[test]
    fn what_is_no_number_of_steps() {
        let told = |text: &str| Delay::read(text).map(|read| read.err().unwrap_or_default());
        assert_eq!(told("afterwards"), None);
        assert_eq!(told("1%"), None);
        for text in ["after x", "after 1..", "after 1..2..3..4", "after 0:x", "after 0:1, 2", "after -1..2"] {
            assert!(told(text).is_some_and(|told| told.contains("says no numbers of steps")), "{text}");
        }
        for text in ["after 5..3", "after 1..9..4", "after 5..1..9"] {
            assert!(told(text).is_some_and(|told| told.contains("is empty")), "{text}");
        }
        assert_eq!(told("after 0:1,0:2").as_deref(), Some("0 stands here twice"));
        assert_eq!(told("after 0:0").as_deref(), Some("one number of steps at least is to be counted once"));
        assert_eq!(told("after 0..100001").as_deref(), Some("at most 100000 steps may pass"));
    }
}
