//! How long the elaborations of a program took, and how late its cycles were released: counted from recordings, as the distributions from
//! which a run of its model draws.
//!
//! In: the system of a chart, and recordings of its program. Out: a [`Counted`] for each component whose elaborations or releases vary
//! there, and the text of a file of inputs (docs/cli.md, "Random values and choices"). A length counts as the nearest number of ticks. What
//! lies outside the chart's bounds counts as the bound, and is told.

use std::collections::BTreeMap;
use std::fmt::Write;

use chart::system::{Action, Component, System, Timing};
use recording::{Event, Kind, Recording, Track};

/// What was counted for an input of the model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Counted {
    /// The input: `endsNow(NAME)`, `isReleased(NAME)`.
    pub input: String,
    /// What was counted: `elaborations`, `releases`.
    pub what: &'static str,
    /// By the ticks after the shortest time, or after the start of the period: how often.
    pub after: BTreeMap<u64, u64>,
    /// How many were shorter than the chart says.
    pub below: u64,
    /// How many were longer, or later.
    pub beyond: u64,
}

impl Counted {
    fn new(input: String, what: &'static str) -> Counted {
        Counted { input, what, after: BTreeMap::new(), below: 0, beyond: 0 }
    }

    /// How many were counted.
    pub fn number(&self) -> u64 {
        self.after.values().sum()
    }

    /// Counts a length, of which the chart allows these.
    fn add(&mut self, ticks: u64, least: u64, most: u64) {
        self.below += u64::from(ticks < least);
        self.beyond += u64::from(ticks > most);
        *self.after.entry(ticks.clamp(least, most) - least).or_default() += 1;
    }
}

/// What recordings say of each input of a system's model that stands for a time.
pub fn counted_times(system: &System, recordings: &[Recording]) -> Vec<Counted> {
    let mut all = Vec::new();
    for component in &system.components {
        let tracks = recordings.iter().filter_map(|recording| {
            let track = recording.tracks.iter().find(|track| track.task == component.name)?;
            Some((recording, track))
        });
        let tracks: Vec<(&Recording, &Track)> = tracks.collect();
        let varies = component.phases.iter().any(|phase| phase.least < phase.time);
        if varies {
            let mut counted = Counted::new(format!("endsNow({})", component.name), "elaborations");
            tracks
                .iter()
                .for_each(|(recording, track)| elaborations(system, component, recording, track, &mut counted));
            all.push(counted);
        }
        if component.timing.jitter() > 0 {
            let mut counted = Counted::new(format!("isReleased({})", component.name), "releases");
            tracks.iter().for_each(|(recording, track)| releases(system, component, recording, track, &mut counted));
            all.push(counted);
        }
    }
    all
}

/// The nearest number of ticks.
fn ticks(system: &System, length_ns: i64) -> u64 {
    let length = u64::try_from(length_ns).unwrap_or(0);
    length.saturating_add(system.tick_ns / 2) / system.tick_ns.max(1)
}

fn elaborations(system: &System, component: &Component, recording: &Recording, track: &Track, counted: &mut Counted) {
    for phase in component.phases.iter().filter(|phase| phase.least < phase.time) {
        if !matches!(phase.action, Action::Elaborate(_)) {
            continue;
        }
        let mut begun: Option<&Event> = None;
        for event in track.events.iter().filter(|event| *event.object == *phase.name) {
            match (event.kind, begun) {
                (Kind::Begins, _) => begun = Some(event),
                (Kind::Ends, Some(first)) => {
                    let length_ns = recording.instant_ns(event) - recording.instant_ns(first);
                    counted.add(ticks(system, length_ns), phase.least, phase.time);
                    begun = None;
                }
                _ => {}
            }
        }
    }
}

fn releases(system: &System, component: &Component, recording: &Recording, track: &Track, counted: &mut Counted) {
    let &Timing::Synchronous { period, offset, jitter, .. } = &component.timing else { return };
    let Some(first) = component.phases.first() else { return };
    let mut done_ns = i64::MIN;
    for event in &track.events {
        let at_ns = recording.instant_ns(event);
        if event.kind == Kind::Begins && *event.object == *first.name {
            let due = offset.saturating_add(period.saturating_mul(event.number)).saturating_mul(system.tick_ns);
            let due_ns = i64::try_from(due).unwrap_or(i64::MAX);
            // A cycle that begins as soon as the one before is over says nothing about its release.
            if done_ns < due_ns {
                counted.add(ticks(system, at_ns.saturating_sub(due_ns)), 0, jitter);
            }
        }
        done_ns = at_ns;
    }
}

/// A file of inputs that draws what was counted, with what it comes from in words.
pub fn counted_inputs(counted: &[Counted], from: &[String]) -> String {
    let mut out = format!("# Counted from {}, in ticks.\nrandom:\n", from.join(", "));
    for one in counted.iter().filter(|one| one.number() > 0) {
        let pairs: Vec<String> = one.after.iter().map(|(ticks, count)| format!("{ticks}:{count}")).collect();
        let _ = writeln!(out, "  {}: after {}", one.input, pairs.join(", "));
    }
    out
}

#[cfg(test)]
mod tests {
    use recording::Rhythm;
    use syntax::SourceFile;
    use testkit::Patterns;

    use super::*;

    const CHART: &str = "chart C\nimport patterns/ControlTask\nsystem s\n\ttick 0.5 ms\n\tcomponent camera synchronous period 10 ms jitter 1 ms\n\t\telaborate \
        look 3..5 ms\n\t\twrite frames 0.5 ms\n\tendcomponent\n\tcomponent vision asynchronous awaits frames\n\t\tread frames 0.5 ms\n\t\t\
        elaborate find 1 ms\n\tendcomponent\n\tchannel frames from camera to vision queue 4\nendsystem\n";

    fn event(time_us: i64, kind: &str, object: &str, number: u64) -> Event {
        let kind = Kind::of(kind).expect("a kind");
        Event { time_ns: time_us * 1000, kind, object: object.into(), number, ..Event::default() }
    }

    #[test]
    fn lengths_and_releases_are_counted_in_ticks() {
        let chart = chart::load(SourceFile::new("C.chart", CHART), &mut Patterns).chart;
        let system = chart.system.expect("it has a system");
        let name = system.components[0].phases[0].name.clone();
        let cycle = |number: u64, begins: i64, ends: i64| {
            let begins = event(begins, "begins", &name, number);
            let ends = event(ends, "ends", &name, number);
            [begins, ends, event(number as i64 * 10_000 + 9_000, "meets", "camera", number)]
        };
        let events = [
            // 3.1 ms are six ticks, 0.2 ms late is in time.
            cycle(0, 200, 3_300),
            // 4.3 ms are nine, half a millisecond late.
            cycle(1, 10_500, 14_800),
            // Too short, too late.
            cycle(2, 23_000, 24_000),
            // Too long; the one after it begins when it is over, and is cut off.
            [event(30_000, "begins", &name, 3), event(41_000, "ends", &name, 3), event(41_000, "misses", "camera", 3)],
            [event(41_000, "begins", &name, 4), event(41_100, "begins", "other", 4), event(41_200, "ends", "other", 4)],
        ]
        .concat();
        let rhythm = Some(Rhythm { period_ns: 10_000_000, offset_ns: 0, deadline_ns: 10_000_000 });
        let track = Track { task: "camera".into(), rhythm, events, ..Track::default() };
        let recording = Recording { tracks: vec![track], tick_ns: 500_000, ..Recording::default() };
        let counted = counted_times(&system, std::slice::from_ref(&recording));
        let lengths = &counted[0];
        assert_eq!((lengths.input.as_str(), lengths.below, lengths.beyond), ("endsNow(camera)", 1, 1));
        assert_eq!(lengths.after, BTreeMap::from([(0, 2), (3, 1), (4, 1)]));
        let late = &counted[1];
        assert_eq!((late.input.as_str(), late.below, late.beyond, counted.len()), ("isReleased(camera)", 0, 1, 2));
        assert_eq!(late.after, BTreeMap::from([(0, 2), (1, 1), (2, 1)]));
        let text = counted_inputs(&counted, &["run.mcap".to_string()]);
        let expected = "# Counted from run.mcap, in ticks.\nrandom:\n  endsNow(camera): after 0:2, 3:1, 4:1\n  \
                        isReleased(camera): after 0:2, 1:1, 2:1\n";
        assert_eq!(text, expected);
        // Of two recordings, both count.
        let twice = counted_times(&system, &[recording.clone(), recording]);
        assert_eq!(twice[0].number(), 8);
    }
}
