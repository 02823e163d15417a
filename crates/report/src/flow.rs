//! The way of each datum through the tasks: when each hop got it, and how long each leg took.
//!
//! A datum is known by an Integer that is unique in a run (the tick of its origin, a sequence number). It reaches a
//! hop in the step that makes the hop's term equal to it. INVARIANT: times of a journey never decrease.

use std::collections::BTreeMap;

use crate::tally::Tally;

/// LIMIT: this many data are followed at a time; the oldest is given up for a new one.
const UNDER_WAY: usize = 1024;

/// All journeys of a run.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Flow {
    /// What travels: singular and plural.
    pub noun: (String, String),
    /// Task and event of each hop, from source to sink.
    pub hops: Vec<(String, String)>,
    /// How many data reached each hop.
    pub reached: Vec<u64>,
    /// From each hop to the next one, by ticks: one fewer than hops.
    pub legs: Vec<Tally>,
    /// From source to sink.
    pub whole: Tally,
    /// The journeys in the order of their beginning, as far as lanes are shown.
    pub journeys: Vec<Journey>,
    under_way: BTreeMap<i64, Journey>,
}

/// The ticks at which a datum reached the hops, from the source on.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Journey {
    /// One for each hop reached.
    pub times: Vec<u64>,
}

impl Flow {
    pub(crate) fn new(noun: (String, String), hops: Vec<(String, String)>) -> Flow {
        let legs = vec![Tally::default(); hops.len().saturating_sub(1)];
        Flow { noun, reached: vec![0; hops.len()], hops, legs, ..Flow::default() }
    }

    /// The datum reached the hop at this tick; journeys that begin before tick `shown` are kept for drawing. Data that
    /// did not pass all hops before are not followed.
    pub(crate) fn reach(&mut self, hop: usize, datum: i64, tick: u64, shown: u64) {
        if hop == 0 {
            self.reached[0] += 1;
            self.under_way.insert(datum, Journey { times: vec![tick] });
            if self.under_way.len() > UNDER_WAY {
                let first = self.under_way.iter().min_by_key(|(_, journey)| journey.times[0]).map(|(datum, _)| *datum);
                self.settle(first.into_iter().collect(), shown);
            }
            return;
        }
        let Some(journey) = self.under_way.get_mut(&datum) else { return };
        if journey.times.len() != hop {
            return;
        }
        let begin = journey.times[0];
        self.reached[hop] += 1;
        self.legs[hop - 1].add(tick - journey.times[hop - 1], journey.times[hop - 1]);
        journey.times.push(tick);
        let arrived = journey.times.len() == self.hops.len();
        if arrived {
            self.whole.add(tick - begin, begin);
        }
        let overtaken = |journey: &Journey| journey.times[0] < begin && journey.times.len() <= hop;
        let done = self.under_way.iter().filter(|(other, journey)| (arrived && **other == datum) || overtaken(journey));
        self.settle(done.map(|(datum, _)| *datum).collect(), shown);
    }

    /// These journeys have ended: they arrived, or a later one overtook them.
    fn settle(&mut self, done: Vec<i64>, shown: u64) {
        let done = done.into_iter().filter_map(|datum| self.under_way.remove(&datum));
        self.journeys.extend(done.filter(|journey| journey.times[0] < shown));
    }

    /// The run is over: data under way stay where they are.
    pub(crate) fn finish(&mut self, shown: u64) {
        let rest = self.under_way.keys().copied().collect();
        self.settle(rest, shown);
        self.journeys.sort_by(|a, b| a.times.cmp(&b.times));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_overtaken_datum_goes_no_further() {
        let hop = |name: &str| (name.to_owned(), "had".to_owned());
        let mut flow = Flow::new(("frame".to_owned(), "frames".to_owned()), vec![hop("a"), hop("b"), hop("c")]);
        for (hop, datum, tick) in [(0, 7, 0), (0, 8, 10), (1, 8, 14), (1, 7, 15), (0, 9, 20), (2, 8, 21), (2, 5, 22)] {
            flow.reach(hop, datum, tick, 100);
        }
        flow.finish(100);
        let times: Vec<_> = flow.journeys.iter().map(|journey| journey.times.clone()).collect();
        assert_eq!(times, [vec![0], vec![10, 14, 21], vec![20]]);
        assert_eq!(flow.reached, [3, 1, 1]);
        assert_eq!(flow.whole.greatest(), Some((11, 10)));
        assert_eq!(flow.legs[0].greatest(), Some((4, 10)));
    }
}
