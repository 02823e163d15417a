//! How often tasks start: periodic ones by their periods, others by the data that they await.
//!
//! In: a system, and the responses of its tasks so far. Out: for each component its [`Stream`]s, and how often it starts in the long run.
//! A cycle that needs something new on *any* channel starts no more often than data come on all of them together. One that needs
//! something new on *all* takes a datum from each; so it starts no more often than data come on any one of them, and what lay there
//! before. INVARIANT: no run has more starts than the streams allow, while every response is kept.

use super::Analysis;
use crate::system::{ChannelKind, Needs, System, Timing};

/// Events of which at most ⌈(*t* + jitter) / period⌉ come in any time *t*, in ticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Stream {
    pub(super) period: u64,
    pub(super) jitter: u64,
}

/// LIMIT: a component that starts by more streams is taken as one that may start at any time.
const STREAMS: usize = 64;

/// For each component how often it starts in the long run: the periods of its streams. None: at any time.
pub(super) fn periods(system: &System) -> Vec<Option<Vec<u64>>> {
    let mut known: Vec<Option<Vec<u64>>> = vec![None; system.components.len()];
    let often = |periods: &Vec<u64>| rate(periods.iter().copied());
    // Each round is right by itself; later ones know more writers.
    for _ in 0..2 * system.components.len() {
        let of = |component: &crate::system::Component| {
            let Timing::Asynchronous { awaits } = &component.timing else {
                return component.timing.period().map(|period| vec![period]);
            };
            let writers = awaits.channels.iter().map(|channel| known[system.channels[*channel].from].clone());
            match awaits.needs {
                Needs::All => writers.flatten().min_by(|one, other| often(one).total_cmp(&often(other))),
                Needs::Any => writers.collect::<Option<Vec<Vec<u64>>>>().map(|all| all.concat()),
            }
            .filter(|periods| (1..=STREAMS).contains(&periods.len()))
        };
        known = system.components.iter().map(of).collect();
    }
    known
}

/// For each component the streams of the instants at which its cycles could begin. None: at any time.
pub(super) fn releases(analysis: &Analysis<'_>) -> Vec<Option<Vec<Stream>>> {
    let count = analysis.system.components.len();
    let mut starts: Vec<Option<Vec<Stream>>> = vec![None; count];
    let mut releases = starts.clone();
    for _ in 0..2 * count {
        releases = (0..count).map(|index| analysis.released(index, &starts)).collect();
        starts = (0..count).map(|index| analysis.started(index, &releases[index])).collect();
    }
    releases
}

impl Analysis<'_> {
    /// When the cycles of a component could begin, if the starts of the others are these.
    fn released(&self, index: usize, starts: &[Option<Vec<Stream>>]) -> Option<Vec<Stream>> {
        let awaits = match &self.system.components[index].timing {
            Timing::Synchronous { period, jitter, .. } => {
                return Some(vec![Stream { period: *period, jitter: *jitter }]);
            }
            Timing::Asynchronous { awaits } => awaits,
        };
        let arrivals = awaits.channels.iter().map(|channel| (*channel, self.arrivals(*channel, starts)));
        if awaits.gathers() {
            // What lay there before lets a cycle begin that no arrival stands for.
            let all = arrivals.filter_map(|(channel, streams)| Some(self.with_backlog(channel, streams?)));
            let often = |streams: &Vec<Stream>| rate(streams.iter().map(|one| one.period));
            return all.min_by(|one, other| often(one).total_cmp(&often(other)));
        }
        let all = arrivals.map(|(_, streams)| streams).collect::<Option<Vec<Vec<Stream>>>>()?.concat();
        (1..=STREAMS).contains(&all.len()).then_some(all)
    }

    /// When they begin: what comes while a cycle is at work waits until it is over.
    fn started(&self, index: usize, releases: &Option<Vec<Stream>>) -> Option<Vec<Stream>> {
        let releases = releases.clone()?;
        let Timing::Asynchronous { awaits } = &self.system.components[index].timing else { return Some(releases) };
        let keeps_up = match &releases[..] {
            [one] => self.responses[index].is_some_and(|response| response <= one.period),
            _ => false,
        };
        if awaits.gathers() || keeps_up {
            return Some(releases);
        }
        Some(awaits.channels.iter().fold(releases, |streams, channel| self.with_backlog(*channel, streams)))
    }

    /// When data come to the reader of a channel: when its writer is done.
    fn arrivals(&self, channel: usize, starts: &[Option<Vec<Stream>>]) -> Option<Vec<Stream>> {
        let writer = self.system.channels[channel].from;
        let response = self.responses[writer]?;
        let is_periodic = self.system.components[writer].timing.period().is_some();
        // The response of a synchronous writer has its jitter in it.
        let late = |one: &Stream| response.saturating_add(if is_periodic { 0 } else { one.jitter });
        let streams = starts[writer].as_ref()?.iter();
        Some(streams.map(|one| Stream { jitter: late(one), ..*one }).collect())
    }

    /// With as many events more as data may lie in a channel.
    fn with_backlog(&self, channel: usize, mut streams: Vec<Stream>) -> Vec<Stream> {
        let waiting = match self.system.channels[channel].kind {
            ChannelKind::Queue { capacity } => capacity,
            // The reader takes the newest datum alone.
            ChannelKind::Buffer { .. } | ChannelKind::Shared => 1,
        };
        if let Some(first) = streams.first_mut() {
            first.jitter = first.jitter.saturating_add(waiting.saturating_mul(first.period));
        }
        streams
    }
}

/// How many events of these periods come in a tick, in the long run.
pub(super) fn rate(periods: impl Iterator<Item = u64>) -> f64 {
    periods.map(|period| 1.0 / period.max(1) as f64).sum()
}

#[cfg(test)]
mod tests {
    use syntax::{FileId, parse_chart};
    use testkit::Random;

    use super::*;
    use crate::times::{Order, Platform};

    fn chart(quantifier: &str, periods: [u64; 2]) -> String {
        let writer = |name: &str, period: u64| {
            format!(
                "component {name} synchronous period {period} ms elaborate e{name} 1..2 ms write {name}s 1 ms endcomponent "
            )
        };
        format!(
            "chart C system s processors 3 {}{}component g asynchronous awaits {quantifier} as, bs read as 1 ms read bs 1 ms endcomponent \
             channel as from a to g shared value channel bs from b to g shared value endsystem",
            writer("a", periods[0]),
            writer("b", periods[1])
        )
    }

    /// When a task could begin that takes no time, and takes a datum of each channel that has one.
    fn begins(all: bool, arrivals: &[Vec<u64>; 2]) -> Vec<u64> {
        let last = arrivals.iter().flatten().max().copied().unwrap_or(0);
        let mut waiting = [0_u64; 2];
        let mut begins = Vec::new();
        for now in 0..=last {
            for (there, times) in waiting.iter_mut().zip(arrivals) {
                let come = times.iter().filter(|time| **time == now).count() as u64;
                *there = (*there + come).min(1);
            }
            while if all { waiting.iter().all(|there| *there > 0) } else { waiting.iter().any(|there| *there > 0) } {
                begins.push(now);
                waiting.iter_mut().for_each(|there| *there = there.saturating_sub(1));
            }
        }
        begins
    }

    #[test]
    fn no_run_has_more_starts_than_the_streams_allow() {
        let mut numbers = Random(77);
        let mut tight = 0;
        for round in 0..200 {
            let all = round % 2 == 0;
            // Periods that differ by little drift through all their phases.
            let least = 8 + numbers.below(23);
            let periods = [least, least + numbers.below(4)];
            let text = chart(if all { "all" } else { "any" }, periods);
            let parse = parse_chart(FileId(0), &text);
            let (chart, faults) = crate::read::read(FileId(0), &parse);
            assert!(faults.iter().all(|fault| fault.severity != syntax::Severity::Error), "{faults:?}");
            let system = chart.system.expect("it has a system");
            let analysis = Analysis::new(&system, Platform { processors: 3, order: Order::Rate });
            let Some(streams) = &analysis.releases[2] else { panic!("no streams: {text}") };
            let arrivals = [0, 1].map(|writer| {
                let offset = numbers.below(periods[writer] + 1);
                (0..120).map(|number| offset + number * periods[writer] + 2 + numbers.below(2)).collect::<Vec<u64>>()
            });
            let begins = begins(all, &arrivals);
            for (first, from) in begins.iter().enumerate() {
                for (count, to) in (1..).zip(&begins[first..]) {
                    let time = to - from + 1;
                    let most: u64 = streams.iter().map(|one| (time + one.jitter).div_ceil(one.period)).sum();
                    assert!(count <= most, "{count} of {most} in {time}: {text}");
                    tight += usize::from(count == most && count > 3);
                }
            }
        }
        assert!(tight > 100, "{tight}");
    }
}
