//! What each task did at each moment of a recorded run, as the lanes of a [`Report`].
//!
//! In: a recording. Out: lanes of tasks, each a [`Track`] of its phases. The events in a phase decide what it is: a
//! phase with readings reads, one with writings writes, one without either elaborates. INVARIANT: the intervals of a
//! task are in order and do not overlap.

use std::collections::BTreeMap;

use recording::{Event, Kind as EventKind, Recording};

use crate::program::{TaskTiming, length};
use crate::report::{Report, Task};
use crate::tally::Tally;
use crate::time::TimeBase;
use crate::tone::Tone;
use crate::track::{Kind, Track};

/// The finest that is drawn.
const TICK_NS: u64 = 10_000;
/// LIMIT: the lanes show so much of a run, in ticks.
const SHOWN: u64 = 100_000;
/// What the first view shows, in ticks.
const WINDOW: u64 = 4_000;

/// What a task can be seen to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Activity {
    Elaborates,
    Reads,
    Writes,
    Passes,
    Waits,
}

const ACTIVITIES: [(Activity, &str, Tone); 5] = [
    (Activity::Elaborates, "elaborating", Tone::Work),
    (Activity::Reads, "reading", Tone::Read),
    (Activity::Writes, "writing", Tone::Write),
    (Activity::Passes, "passing a message", Tone::Message),
    (Activity::Waits, "waiting for a lock that another task holds", Tone::Wait),
];

/// Something that went on without a break.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Interval {
    from_ns: i64,
    to_ns: i64,
    activity: Activity,
}

/// The lanes of all tasks.
pub(super) fn lanes(recording: &Recording, timing: &[TaskTiming], span_ns: u64) -> Report {
    let kinds: Vec<Kind> =
        ACTIVITIES.iter().map(|(_, label, tone)| Kind { label: (*label).into(), tone: *tone }).collect();
    let phases = activities(recording);
    let held = held(recording);
    let ticks = span_ns.div_ceil(TICK_NS).max(1);
    let mut tasks: Vec<Task> = recording
        .tracks
        .iter()
        .zip(timing)
        .map(|(track, timing)| {
            let intervals = intervals(&track.task, &track.events, &phases, &held);
            task(track, timing, &intervals, &kinds, ticks)
        })
        .collect();
    let waits = tasks.iter().any(|task| !task.waits.is_empty());
    // A kind that never occurs needs no place in the legend; kinds keep their numbers.
    let mut activities = kinds;
    if !waits {
        activities.pop();
        tasks.iter_mut().for_each(|task| _ = task.shares.pop());
    }
    Report {
        title: recording.system.clone(),
        note: String::new(),
        model: recording.system.clone(),
        time: TimeBase::new(TICK_NS),
        ticks,
        from_initial: false,
        shown: ticks.min(SHOWN),
        window: ticks.min(WINDOW),
        activities,
        tasks,
        buffers: Vec::new(),
        queues: Vec::new(),
        series: Vec::new(),
        flow: None,
        charts: Vec::new(),
        chart_style: String::new(),
        invariants: Vec::new(),
        stopped: None,
        scenarios: Vec::new(),
        coverage: None,
        facts: Vec::new(),
    }
}

fn tick(time_ns: i64) -> u64 {
    (length(0, time_ns) + TICK_NS / 2) / TICK_NS
}

fn task(track: &recording::Track, timing: &TaskTiming, intervals: &[Interval], kinds: &[Kind], ticks: u64) -> Task {
    let mut lane = Track::new(kinds.to_vec());
    let mut shares = vec![0; ACTIVITIES.len()];
    let mut waits = Tally::default();
    for interval in intervals {
        let (start, end) = (tick(interval.from_ns), tick(interval.to_ns).max(tick(interval.from_ns) + 1));
        shares[interval.activity as usize] += tick(interval.to_ns) - start;
        if interval.activity == Activity::Waits {
            waits.add(end - start, start);
        }
        if start < SHOWN {
            lane.extend(start, end.min(SHOWN), interval.activity as u16);
        }
    }
    let due = |rhythm: recording::Rhythm| {
        let times = (0..).map(move |cycle| rhythm.offset_ns.saturating_add(rhythm.period_ns.saturating_mul(cycle)));
        times.map(tick).take_while(|tick| *tick <= SHOWN.min(ticks)).collect()
    };
    let late = track.events.iter().filter(|event| event.kind == EventKind::Misses).map(|event| tick(event.time_ns));
    let mut cycles = Tally::default();
    for (ns, count) in timing.responses.counts() {
        (0..*count).for_each(|_| cycles.add(ns / TICK_NS, 0));
    }
    Task {
        name: track.task.clone(),
        caption: match (&timing.awaits, timing.period_ns) {
            (Some(channel), _) => format!("awaits {channel}"),
            (None, Some(_)) => String::new(),
            (None, None) => "again and again".to_owned(),
        },
        period: timing.period_ns.map(|ns| ns / TICK_NS),
        deadline: track.rhythm.map(|rhythm| length(0, rhythm.deadline_ns) / TICK_NS),
        may_miss: false,
        track: lane,
        shares,
        waits,
        cycles,
        completed: Some(timing.responses.count()),
        met: timing.met,
        missed: timing.missed,
        skipped: Some(timing.skips),
        overdue: None,
        releases: track.rhythm.map_or_else(Vec::new, due),
        misses: late.take_while(|tick| *tick <= SHOWN).collect(),
    }
}

/// What each phase is, by its name: what happens in any of its occurrences.
fn activities(recording: &Recording) -> BTreeMap<&str, Activity> {
    let mut found = BTreeMap::new();
    for track in &recording.tracks {
        let mut phase: Option<&str> = None;
        for event in &track.events {
            let activity = match event.kind {
                EventKind::Begins => {
                    phase = Some(&event.object);
                    found.entry(event.object.as_ref()).or_insert(Activity::Elaborates);
                    continue;
                }
                EventKind::Ends => {
                    phase = None;
                    continue;
                }
                EventKind::Reads | EventKind::Loads => Activity::Reads,
                EventKind::Writes | EventKind::Stores => Activity::Writes,
                EventKind::Sends | EventKind::Takes | EventKind::Refuses => Activity::Passes,
                _ => continue,
            };
            if let Some(known) = phase.and_then(|phase| found.get_mut(phase)) {
                *known = activity;
            }
        }
    }
    found
}

/// By channel, which task was inside its lock and when, in order.
fn held(recording: &Recording) -> BTreeMap<&str, Vec<(i64, i64, &str)>> {
    let mut found: BTreeMap<&str, Vec<(i64, i64, &str)>> = BTreeMap::new();
    for track in &recording.tracks {
        let mut since: BTreeMap<&str, i64> = BTreeMap::new();
        for event in &track.events {
            match event.kind {
                EventKind::Enters => _ = since.insert(&event.object, event.time_ns),
                EventKind::Releases => {
                    if let Some(from_ns) = since.remove(event.object.as_ref()) {
                        found.entry(&event.object).or_default().push((from_ns, event.time_ns, &track.task));
                    }
                }
                _ => {}
            }
        }
        // What is not left at the end is held to the end.
        for (channel, from_ns) in since {
            found.entry(channel).or_default().push((from_ns, i64::MAX, &track.task));
        }
    }
    found.values_mut().for_each(|stays| stays.sort_unstable());
    found
}

/// What a task did, from its events.
fn intervals(
    task: &str,
    events: &[Event],
    phases: &BTreeMap<&str, Activity>,
    held: &BTreeMap<&str, Vec<(i64, i64, &str)>>,
) -> Vec<Interval> {
    let mut found: Vec<Interval> = Vec::new();
    let mut put = |from_ns: i64, to_ns: i64, activity: Activity| {
        if to_ns > from_ns {
            found.push(Interval { from_ns, to_ns, activity });
        }
    };
    let mut activity = Activity::Elaborates;
    let mut since_ns: Option<i64> = None;
    let mut asked: Option<(i64, &str)> = None;
    for event in events {
        match event.kind {
            EventKind::Begins => {
                activity = phases.get(event.object.as_ref()).copied().unwrap_or(Activity::Elaborates);
                since_ns = Some(event.time_ns);
            }
            EventKind::Ends => {
                if let Some(from_ns) = since_ns.take() {
                    put(from_ns, event.time_ns, activity);
                }
            }
            EventKind::Asks => asked = Some((event.time_ns, &event.object)),
            EventKind::Enters | EventKind::GivesUp => {
                let Some((from_ns, channel)) = asked.take() else { continue };
                // The last that another task was inside while this one waited.
                let other = held.get(channel).and_then(|stays| {
                    let before = stays.partition_point(|(entered, ..)| *entered <= from_ns || *entered < event.time_ns);
                    let mut others = stays[..before].iter().rev().filter(|(.., who)| *who != task);
                    others.next().filter(|(_, left, _)| *left > from_ns)
                });
                if let (Some((_, left_ns, _)), Some(begun_ns)) = (other, since_ns) {
                    let until_ns =
                        if event.kind == EventKind::Enters { event.time_ns.min(*left_ns) } else { event.time_ns };
                    put(begun_ns, from_ns, activity);
                    put(from_ns, until_ns, Activity::Waits);
                    since_ns = Some(until_ns);
                }
            }
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(time_ns: i64, kind: &str, object: &str) -> Event {
        Event { time_ns, kind: EventKind::of(kind).expect("a kind"), object: object.into(), ..Event::default() }
    }

    fn two() -> Recording {
        let track = |task: &str, events| recording::Track { task: task.into(), events, ..recording::Track::default() };
        let ms = 1_000_000;
        Recording {
            tracks: vec![
                track(
                    "reader",
                    vec![
                        event(0, "begins", "read"),
                        event(0, "asks", "c"),
                        event(0, "enters", "c"),
                        event(0, "reads", "c"),
                        event(3 * ms, "releases", "c"),
                        event(3 * ms, "ends", "read"),
                        event(3 * ms, "begins", "law"),
                        event(5 * ms, "ends", "law"),
                    ],
                ),
                track(
                    "writer",
                    vec![
                        event(ms, "begins", "write"),
                        event(2 * ms, "asks", "c"),
                        event(4 * ms, "enters", "c"),
                        event(4 * ms, "writes", "c"),
                        event(6 * ms, "releases", "c"),
                        event(6 * ms, "ends", "write"),
                    ],
                ),
            ],
            stopped_ns: Some(6 * ms),
            ..Recording::default()
        }
    }

    #[test]
    fn a_wait_lasts_as_long_as_another_is_inside_the_lock() {
        let recording = two();
        let (phases, held) = (activities(&recording), held(&recording));
        let of = |task: usize| {
            let track = &recording.tracks[task];
            let found = intervals(&track.task, &track.events, &phases, &held);
            found.iter().map(|i| (i.from_ns / 1_000_000, i.to_ns / 1_000_000, i.activity)).collect::<Vec<_>>()
        };
        assert_eq!(of(0), [(0, 3, Activity::Reads), (3, 5, Activity::Elaborates)]);
        // It asked at 2, and the other one left at 3; then it is at its own work.
        assert_eq!(of(1), [(1, 2, Activity::Writes), (2, 3, Activity::Waits), (3, 6, Activity::Writes)]);
    }

    #[test]
    fn another_may_come_in_while_a_task_waits() {
        let ms = 1_000_000;
        let mut recording = two();
        // The reader gets the lock a little after the writer has asked for it, and keeps it to the end.
        recording.tracks[0].events = vec![event(0, "begins", "read"), event(2 * ms + 1, "enters", "c")];
        recording.tracks[1].events.truncate(2);
        recording.tracks[1].events.push(event(5 * ms, "gives_up", "c"));
        let (phases, held) = (activities(&recording), held(&recording));
        let waits = intervals("writer", &recording.tracks[1].events, &phases, &held);
        let waits: Vec<_> = waits.into_iter().filter(|one| one.activity == Activity::Waits).collect();
        assert_eq!(waits, [Interval { from_ns: 2 * ms, to_ns: 5 * ms, activity: Activity::Waits }]);
    }

    #[test]
    fn lanes_are_in_ticks_of_ten_microseconds() {
        let recording = two();
        let report = lanes(&recording, &super::super::timing::tasks(&recording), 6_000_000);
        let spans: Vec<_> =
            report.tasks[1].track.spans().iter().map(|span| (span.start, span.end, span.kind)).collect();
        assert_eq!(spans, [(100, 200, 2), (200, 300, 4), (300, 600, 2)]);
        assert_eq!((report.ticks, report.tasks[1].shares[2], report.tasks[1].shares[4]), (600, 400, 100));
        assert_eq!(report.tasks[1].waits.greatest(), Some((100, 200)));
        assert_eq!(report.time.show(600), "6.00\u{202f}ms");
    }
}
