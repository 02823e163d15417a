//! When the cycles of each task were due, began and ended.
//!
//! In: a recording. Out: [`TaskTiming`]s. A cycle of a synchronous task is due at its offset and a period after
//! another; an asynchronous task is due when the data that it awaits are let go of, the last of them if it needs several,
//! if it rested then: data that come while it works do not wake it.

use recording::{Kind, Recording, Track};

use crate::program::{TaskTiming, length};

/// The timing of all tasks.
pub(super) fn tasks(recording: &Recording) -> Vec<TaskTiming> {
    recording.tracks.iter().map(|track| task(recording, track)).collect()
}

fn task(recording: &Recording, track: &Track) -> TaskTiming {
    let count = |kinds: &[Kind]| track.events.iter().filter(|event| kinds.contains(&event.kind)).count() as u64;
    let rhythm = track.rhythm;
    let mut timing = TaskTiming {
        name: track.task.clone(),
        period_ns: rhythm.map(|rhythm| rhythm.period_ns.max(0) as u64),
        awaits: track.awaits.as_ref().map(ToString::to_string),
        met: rhythm.map(|_| count(&[Kind::Meets])),
        missed: rhythm.map(|_| count(&[Kind::Misses])),
        skips: count(&[Kind::GivesUp, Kind::Refuses]),
        ..TaskTiming::default()
    };
    let awaited = track.awaits.as_ref().map(|awaits| Awaits::new(recording, track, awaits));
    let mut rested_ns = i64::MIN;
    for cycle in cycles(recording, track) {
        let due_ns = match rhythm {
            Some(rhythm) => Some(rhythm.offset_ns + rhythm.period_ns.saturating_mul(cycle.number as i64)),
            None => awaited.as_ref().and_then(|awaited| awaited.due(cycle.begun_ns, rested_ns)),
        };
        timing.activations += 1;
        if let Some(due_ns) = due_ns {
            timing.wake_ups.add(length(due_ns, cycle.begun_ns), due_ns.max(0) as u64);
        }
        if let Some(done_ns) = cycle.done_ns {
            let from_ns = due_ns.unwrap_or(cycle.begun_ns);
            timing.responses.add(length(from_ns, done_ns), from_ns.max(0) as u64);
            rested_ns = done_ns;
        }
    }
    timing
}

/// What came on the channels that a task awaits, and what it took of that.
struct Awaits {
    all: bool,
    channels: Vec<Awaited>,
}

struct Awaited {
    /// When something new was there.
    arrivals: Vec<i64>,
    /// When it was read.
    readings: Vec<i64>,
    /// Each message is taken once; otherwise a reading takes the newest datum.
    is_queue: bool,
}

impl Awaits {
    fn new(recording: &Recording, track: &Track, awaits: &recording::Awaited) -> Awaits {
        let of = |channel: &String| {
            let own = track.events.iter().filter(|event| *event.object == **channel);
            let reads = own.filter(|event| match event.kind {
                Kind::Takes => event.number > 0,
                kind => matches!(kind, Kind::Reads | Kind::Loads),
            });
            let is_queue = track.events.iter().any(|event| event.kind == Kind::Takes && *event.object == **channel);
            let readings = reads.map(|event| recording.instant_ns(event)).collect();
            Awaited { arrivals: arrivals(recording, track, channel), readings, is_queue }
        };
        Awaits { all: awaits.all, channels: awaits.channels.iter().map(of).collect() }
    }

    /// When a cycle that began then was due, if the task had rested since that instant.
    fn due(&self, begun_ns: i64, rested_ns: i64) -> Option<i64> {
        if self.all && self.channels.len() > 1 {
            // It woke for the last of the data that it needed, if they were not all there when its cycle before was over.
            let first = self.channels.iter().map(|channel| channel.unread(begun_ns)).collect::<Option<Vec<i64>>>()?;
            return first.into_iter().max().filter(|due_ns| (rested_ns..=begun_ns).contains(due_ns));
        }
        // It woke for the first datum that came while it rested.
        let come = |channel: &Awaited| {
            let from = channel.arrivals.partition_point(|time| *time < rested_ns);
            channel.arrivals.get(from).copied().filter(|time| *time <= begun_ns)
        };
        self.channels.iter().filter_map(come).min()
    }
}

impl Awaited {
    /// When the first datum came that was not read before that instant.
    fn unread(&self, before_ns: i64) -> Option<i64> {
        let read = self.readings.partition_point(|time| *time < before_ns);
        let from = match self.readings[..read].last() {
            _ if self.is_queue => read,
            Some(last_ns) => self.arrivals.partition_point(|time| time <= last_ns),
            None => 0,
        };
        self.arrivals.get(from).copied()
    }
}

/// When data were there for this task: the instants at which their producer let go of them.
fn arrivals(recording: &Recording, reader: &Track, channel: &str) -> Vec<i64> {
    let others = recording.tracks.iter().filter(|track| track.task != reader.task);
    let events = others.flat_map(|track| &track.events).filter(|event| *event.object == *channel);
    let mut times: Vec<i64> = events
        .filter(|event| [Kind::Releases, Kind::Sends, Kind::Stores].contains(&event.kind))
        .map(|event| recording.instant_ns(event))
        .collect();
    times.sort_unstable();
    times
}

/// A cycle: it is done when its last phase ended, or when the deadline was checked; none: it was cut off.
struct Cycle {
    number: u64,
    begun_ns: i64,
    done_ns: Option<i64>,
}

fn cycles(recording: &Recording, track: &Track) -> Vec<Cycle> {
    let mut cycles: Vec<Cycle> = Vec::new();
    for event in &track.events {
        let time_ns = recording.instant_ns(event);
        let last = cycles.last_mut().filter(|cycle| cycle.number == event.number);
        match (event.kind, last) {
            (Kind::Begins, None) => cycles.push(Cycle { number: event.number, begun_ns: time_ns, done_ns: None }),
            // Another phase of the same cycle.
            (Kind::Begins, Some(cycle)) => cycle.done_ns = None,
            (Kind::Ends | Kind::Passes | Kind::Meets | Kind::Misses, Some(cycle)) => cycle.done_ns = Some(time_ns),
            _ => {}
        }
    }
    cycles
}

#[cfg(test)]
mod tests {
    use recording::{Event, Rhythm};

    use super::*;

    fn event(time_ns: i64, kind: &str, object: &str, number: u64) -> Event {
        Event { time_ns, kind: Kind::of(kind).expect("a kind"), object: object.into(), number, ..Event::default() }
    }

    #[test]
    fn a_synchronous_task_is_due_on_its_grid() {
        let rhythm = Some(Rhythm { period_ns: 100, offset_ns: 20, deadline_ns: 80 });
        let events = vec![
            event(20, "begins", "a", 0),
            event(50, "ends", "a", 0),
            event(50, "begins", "b", 0),
            event(70, "ends", "b", 0),
            event(71, "meets", "t", 0),
            // Due at 120, wakes 7 late; gives up a lock.
            event(127, "begins", "a", 1),
            event(150, "gives_up", "c", 0),
            event(210, "ends", "a", 1),
            event(215, "misses", "t", 1),
            // Cut off: it has no response.
            event(220, "begins", "a", 2),
        ];
        let track = Track { task: "t".into(), rhythm, events, ..Track::default() };
        let timing = &tasks(&Recording { tracks: vec![track], ..Recording::default() })[0];
        assert_eq!((timing.activations, timing.met, timing.missed, timing.skips), (3, Some(1), Some(1), 1));
        assert_eq!(timing.wake_ups.counts().iter().map(|(ns, n)| (*ns, *n)).collect::<Vec<_>>(), [(0, 2), (7, 1)]);
        assert_eq!(timing.responses.counts().iter().map(|(ns, n)| (*ns, *n)).collect::<Vec<_>>(), [(51, 1), (95, 1)]);
        assert_eq!((timing.responses.greatest(), timing.wake_ups.percentile(50)), (Some((95, 120)), Some(0)));
    }

    #[test]
    fn parts_of_a_tick_tell_nothing_where_the_pace_is_the_models() {
        let rhythm = Some(Rhythm { period_ns: 100, offset_ns: 0, deadline_ns: 100 });
        let events = vec![event(125, "begins", "a", 1), event(225, "ends", "a", 1), event(225, "meets", "t", 1)];
        let track = Track { task: "t".into(), rhythm, events, ..Track::default() };
        let recording =
            Recording { tracks: vec![track], tick_ns: 100, pace: "modelled".into(), ..Recording::default() };
        let timing = &tasks(&recording)[0];
        assert_eq!((timing.wake_ups.greatest(), timing.responses.greatest()), (Some((0, 100)), Some((100, 100))));
    }

    #[test]
    fn an_asynchronous_task_wakes_when_its_data_are_let_go_of() {
        let producer = Track {
            task: "camera".into(),
            events: vec![
                event(5, "releases", "frames", 0),
                event(8, "releases", "other", 0),
                // While the reader is at work: it does not wake.
                event(40, "releases", "frames", 0),
                event(90, "releases", "frames", 0),
                event(95, "releases", "frames", 0),
            ],
            ..Track::default()
        };
        let reader = Track {
            task: "servo".into(),
            awaits: recording::Awaited::read("frames"),
            events: vec![
                event(9, "begins", "look", 0),
                event(60, "ends", "look", 0),
                event(61, "begins", "look", 1),
                event(80, "ends", "look", 1),
                event(96, "begins", "look", 2),
                event(99, "ends", "look", 2),
            ],
            ..Track::default()
        };
        let all = tasks(&Recording { tracks: vec![producer, reader], ..Recording::default() });
        let timing = &all[1];
        assert_eq!((timing.activations, timing.met, timing.wake_ups.count()), (3, None, 2));
        assert_eq!(timing.wake_ups.counts().iter().map(|(ns, n)| (*ns, *n)).collect::<Vec<_>>(), [(4, 1), (6, 1)]);
        assert_eq!(timing.responses.greatest(), Some((55, 5)));
    }

    #[test]
    fn a_task_that_awaits_several_channels_wakes_for_the_last_or_the_first() {
        let writer = |task: &str, channel: &str, times: &[i64]| Track {
            task: task.into(),
            events: times.iter().map(|time| event(*time, "stores", channel, 0)).collect(),
            ..Track::default()
        };
        let reader = |awaits: &str| {
            let cycle = |begun_ns: i64, number: u64| {
                [
                    event(begun_ns, "begins", "look", number),
                    event(begun_ns, "loads", "frames", 1),
                    event(begun_ns + 2, "loads", "poses", 1),
                    event(begun_ns + 10, "ends", "match", number),
                ]
            };
            let events = [cycle(35, 0), cycle(72, 1), cycle(82, 2)].concat();
            Track { task: "fuse".into(), awaits: recording::Awaited::read(awaits), events, ..Track::default() }
        };
        let wake_ups = |awaits: &str| {
            // The third cycle needs what came before the second one was over.
            let tracks = vec![
                writer("camera", "frames", &[30, 60, 75]),
                writer("encoder", "poses", &[10, 20, 66, 76]),
                reader(awaits),
            ];
            let all = tasks(&Recording { tracks, ..Recording::default() });
            all[2].wake_ups.counts().iter().map(|(ns, count)| (*ns, *count)).collect::<Vec<_>>()
        };
        assert_eq!(wake_ups("all frames, poses"), [(5, 1), (6, 1)]);
        assert_eq!(wake_ups("any frames, poses"), [(12, 1), (25, 1)]);
        assert_eq!(wake_ups("frames"), [(5, 1), (12, 1)]);
    }
}
