//! Every change of a single event of a log.
//!
//! In: a recording. Out: one recording after another, each with what was changed, in a fixed order. Only what is compared is
//! changed: events before the tasks were asked to stop. Numbers in the order of a task are those of the changed log: that a
//! lost one leaves a gap is the reader's own matter.

use std::collections::BTreeSet;
use std::sync::Arc;

use recording::{Event, Kind, Recording};

/// How an event is changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Change {
    Drop,
    Duplicate,
    /// With the task's next one; the instants stay where they are.
    ExchangeInTask,
    /// With the next one of another task: what the two say.
    ExchangeAcross,
    /// With the next one of another task: when the two say it.
    ExchangeInstants,
    Move(i64),
    OtherKind,
    OtherObject,
    OtherNumber(i64),
    OtherIndex,
    OtherFreshness,
}

/// So long is a move, by the words of the report.
#[derive(Debug, Clone, Copy)]
pub struct Lengths {
    pub tick_ns: i64,
    /// Of tasks without a period, the shortest one of the system.
    pub shortest_period_ns: i64,
}

const SECOND_NS: i64 = 1_000_000_000;

impl Change {
    /// The row of the report.
    pub fn row(self) -> &'static str {
        match self {
            Change::Drop => "drop",
            Change::Duplicate => "duplicate",
            Change::ExchangeInTask => "exchange with the task's next",
            Change::ExchangeAcross => "exchange with another task's next",
            Change::ExchangeInstants => "exchange instants with another task's next",
            Change::Move(by_ns) if by_ns.abs() == SECOND_NS => "move by a second",
            Change::Move(_) => "move by a tick or half a period",
            Change::OtherKind => "another kind",
            Change::OtherObject => "another id",
            Change::OtherNumber(_) => "another number",
            Change::OtherIndex => "another index",
            Change::OtherFreshness => "another freshness",
        }
    }

    /// All rows, in the order of the report.
    pub const ROWS: [&'static str; 12] = [
        "drop",
        "duplicate",
        "exchange with the task's next",
        "exchange with another task's next",
        "exchange instants with another task's next",
        "move by a tick or half a period",
        "move by a second",
        "another kind",
        "another id",
        "another number",
        "another index",
        "another freshness",
    ];
}

/// An event by its place.
pub type Place = (usize, usize);

/// All changes of all events that are compared.
pub fn changes(recording: &Recording) -> Vec<(Place, Change)> {
    let stopped_ns = recording.stopped_ns.unwrap_or(i64::MAX);
    let rhythms = || recording.tracks.iter().filter_map(|track| Some(track.rhythm?.period_ns));
    let lengths =
        Lengths { tick_ns: recording.tick_ns, shortest_period_ns: rhythms().min().unwrap_or(recording.tick_ns * 10) };
    let mut all = Vec::new();
    for (lane, track) in recording.tracks.iter().enumerate() {
        let half_ns = track.rhythm.map_or(lengths.shortest_period_ns, |rhythm| rhythm.period_ns) / 2;
        for (at, event) in track.events.iter().enumerate().filter(|(_, event)| event.time_ns < stopped_ns) {
            let mut push = |change: Change| all.push(((lane, at), change));
            let across = [Change::ExchangeAcross, Change::ExchangeInstants];
            [Change::Drop, Change::Duplicate, Change::ExchangeInTask].into_iter().chain(across).for_each(&mut push);
            for by_ns in [lengths.tick_ns, half_ns, SECOND_NS] {
                [Change::Move(-by_ns), Change::Move(by_ns)].into_iter().for_each(&mut push);
            }
            [Change::OtherKind, Change::OtherObject, Change::OtherNumber(1)].into_iter().for_each(&mut push);
            if event.number > 0 {
                push(Change::OtherNumber(-1));
            }
            if event.array.is_some() {
                push(Change::OtherIndex);
            }
            if event.fresh.is_some() {
                push(Change::OtherFreshness);
            }
        }
    }
    all
}

/// The recording with that change; none where there is nothing to exchange.
pub fn mutant(recording: &Recording, (lane, at): Place, change: Change) -> Option<Recording> {
    let mut changed = recording.clone();
    let other = next_of_another(recording, (lane, at));
    let events = &mut changed.tracks[lane].events;
    match change {
        Change::Drop => _ = events.remove(at),
        Change::Duplicate => events.insert(at, events[at].clone()),
        Change::ExchangeInTask => {
            let next = at + 1;
            let (one, two) = (events[at].clone(), events.get(next)?.clone());
            events[at] = Event { time_ns: one.time_ns, ..two.clone() };
            events[next] = Event { time_ns: two.time_ns, ..one };
        }
        Change::ExchangeAcross | Change::ExchangeInstants => {
            let (beside, place) = other?;
            let (one, two) =
                (recording.tracks[lane].events[at].clone(), recording.tracks[beside].events[place].clone());
            let said = change == Change::ExchangeAcross;
            let exchanged = |own: &Event, other: &Event| match said {
                true => Event { time_ns: own.time_ns, ..other.clone() },
                false => Event { time_ns: other.time_ns, ..own.clone() },
            };
            changed.tracks[lane].events[at] = exchanged(&one, &two);
            changed.tracks[beside].events[place] = exchanged(&two, &one);
        }
        Change::Move(by_ns) => events[at].time_ns += by_ns,
        Change::OtherKind => {
            let place = Kind::ALL.iter().position(|kind| *kind == events[at].kind).unwrap_or(0);
            events[at].kind = Kind::ALL[(place + 1) % Kind::ALL.len()];
        }
        Change::OtherObject => events[at].object = another_object(recording, &events[at].object)?,
        Change::OtherNumber(by) => events[at].number = events[at].number.checked_add_signed(by)?,
        Change::OtherIndex => events[at].array = events[at].array.map(|array| array + 1),
        Change::OtherFreshness => events[at].fresh = events[at].fresh.map(|fresh| !fresh),
    }
    (changed != *recording).then_some(changed)
}

/// The first event of another task that is not before that one, and is compared too.
fn next_of_another(recording: &Recording, (lane, at): Place) -> Option<Place> {
    let from_ns = recording.tracks[lane].events[at].time_ns;
    let others = recording.tracks.iter().enumerate().filter(|(other, _)| *other != lane);
    let nexts = others.filter_map(|(other, track)| {
        let place = track.events.partition_point(|event| event.time_ns < from_ns);
        Some((track.events.get(place)?.time_ns, (other, place)))
    });
    let (time_ns, place) = nexts.min()?;
    (time_ns < recording.stopped_ns.unwrap_or(i64::MAX)).then_some(place)
}

/// What another event names.
fn another_object(recording: &Recording, object: &Arc<str>) -> Option<Arc<str>> {
    let all: BTreeSet<&Arc<str>> =
        recording.tracks.iter().flat_map(|track| &track.events).map(|event| &event.object).collect();
    let all: Vec<&Arc<str>> = all.into_iter().collect();
    let place = all.iter().position(|known| *known == object)?;
    all.get((place + 1) % all.len()).map(|other| Arc::clone(other))
}
