//! What is got is as new as the readings before it say, for each kind of channel, and is not there before the first reading. A datum of a
//! number has one value, whoever gets it.
//!
//! The recordings are written by hand: channels whose writers have no machine.

use recording::Event;

use super::*;

/// What a task of the channel `c` recorded: readings, and what it got.
enum Said {
    Reading(Kind, u64),
    Got { known: bool, fresh: bool },
}

use Said::{Got as Gets, Reading};

fn unlike(said: &[Said]) -> Option<To> {
    let mut track = Track { task: "t".to_string(), ..Track::default() };
    for one in said {
        match *one {
            Reading(kind, number) => {
                track.events.push(Event { kind, object: "c".into(), number, ..Event::default() });
            }
            Gets { known, fresh } => {
                let (events, object) = (track.events.len(), Arc::from("c"));
                track.decisions.push(Decision {
                    time_ns: 0,
                    is_got: true,
                    object,
                    part: 0,
                    bits: 0,
                    known,
                    fresh,
                    events,
                });
            }
        }
    }
    let recording = Recording { tracks: vec![track], ended: true, ..Recording::default() };
    let mut carried = Carried::new(BTreeSet::from(["c".to_string()]), BTreeMap::new(), BTreeSet::new());
    carried.go_on(&recording, false).map(|unlike| unlike.to)
}

const NEW: Said = Gets { known: true, fresh: true };
const OLD: Said = Gets { known: true, fresh: false };
const NONE: Said = Gets { known: false, fresh: false };

#[track_caller]
fn agrees(said: &[Said]) {
    let found = unlike(said);
    assert!(found.is_none(), "{found:?}");
}

#[track_caller]
fn newness(expected: bool, said: &[Said]) {
    let found = unlike(said);
    assert!(matches!(found, Some(To::Newness(is_new)) if is_new == expected), "{found:?}");
}

#[test]
fn a_datum_is_new_if_its_reading_brought_another_number() {
    for kind in [Kind::Reads, Kind::Loads] {
        agrees(&[Reading(kind, 0), NONE, Reading(kind, 3), NEW, Reading(kind, 3), OLD, Reading(kind, 4), NEW]);
        newness(true, &[Reading(kind, 1), OLD]);
        newness(false, &[Reading(kind, 1), NEW, Reading(kind, 1), NEW]);
        newness(false, &[Reading(kind, 0), Gets { known: false, fresh: true }]);
    }
}

#[test]
fn a_reading_that_was_given_up_brings_nothing_new() {
    agrees(&[Reading(Kind::Reads, 1), NEW, Reading(Kind::GivesUp, 0), OLD]);
    newness(false, &[Reading(Kind::Reads, 1), NEW, Reading(Kind::GivesUp, 0), NEW]);
}

#[test]
fn a_message_is_new_to_one_decision() {
    let takes = |number| Reading(Kind::Takes, number);
    agrees(&[takes(0), NONE, takes(1), NEW, takes(0), OLD, takes(2), NEW]);
    newness(true, &[takes(1), OLD]);
    newness(false, &[takes(1), NEW, takes(0), NEW]);
    newness(false, &[takes(1), NEW, NEW]);
}

#[test]
fn nothing_is_got_before_the_first_reading_that_brings_something() {
    for said in [&[OLD][..], &[Reading(Kind::Takes, 0), OLD], &[Reading(Kind::Reads, 0), OLD]] {
        let found = unlike(said);
        assert!(matches!(found, Some(To::Nothing)), "{found:?}");
    }
}

/// A recording of tasks, each with what it did in order: an event, or the value that it got.
#[derive(Clone, Copy)]
enum Did {
    Event(Kind, &'static str, u64),
    Value(&'static str, u64, bool),
}

fn recording(tasks: &[(&str, &[Did])]) -> Recording {
    let track = |(task, all): &(&str, &[Did])| {
        let mut track = Track { task: (*task).to_string(), ..Track::default() };
        for did in *all {
            let (time_ns, events) = (track.events.len() as i64 * 1_000_000, track.events.len());
            match *did {
                Did::Event(kind, object, number) => {
                    track.events.push(Event { time_ns, kind, object: object.into(), number, ..Event::default() });
                }
                Did::Value(object, bits, fresh) => {
                    let (object, is_got, known, part) = (object.into(), true, true, 0);
                    track.decisions.push(Decision { time_ns, is_got, object, part, bits, known, fresh, events });
                }
            }
        }
        track
    };
    Recording { tracks: tasks.iter().map(track).collect(), ended: true, ..Recording::default() }
}

/// The datum that was got before as another value, and the one that was got now: task, number, value.
fn contradicts(tasks: &[(&str, &[Did])]) -> Option<[(usize, u64, u64); 2]> {
    let names = |names: &[&str]| names.iter().map(|name| name.to_string()).collect::<BTreeSet<String>>();
    let drawn = ["x", "y"].map(|reader| (format!("c_{reader}"), "c".to_string()));
    let mut carried = Carried::new(names(&["c", "c_x", "c_y"]), drawn.into(), names(&["compute"]));
    let Unlike { track, number, got, to } = carried.go_on(&recording(tasks), false)?;
    match to {
        To::Before { track: first, number: told, got: before } => {
            Some([(first, told, before[0].bits), (track, number, got[0].bits)])
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_datum_of_a_number_has_one_value() {
    use Did::{Event as E, Value as V};
    for (writes, reads) in [(Kind::Writes, Kind::Reads), (Kind::Stores, Kind::Loads), (Kind::Sends, Kind::Takes)] {
        let writer = [E(writes, "c", 1), E(writes, "c", 2)];
        let reader = |again: u64, next: u64| {
            // No message is taken twice; without a new one the last one stays.
            let number = if reads == Kind::Takes { 0 } else { 1 };
            let again = [E(reads, "c", number), V("c", again, false)];
            [&[E(reads, "c", 1), V("c", 7, true)][..], &again, &[E(reads, "c", 2), V("c", next, true)]].concat()
        };
        let check = |again: u64, next: u64| contradicts(&[("w", &writer), ("r", &reader(again, next))]);
        assert_eq!(check(7, 7), None, "{reads}");
        assert_eq!(check(7, 8), None, "{reads}");
        assert_eq!(check(8, 8), Some([(1, 1, 7), (1, 1, 8)]), "{reads}");
    }
}

/// What a task computes is one value for all readers of a channel, whatever numbers it has for them.
#[test]
fn all_readers_of_a_channel_get_one_value() {
    use Did::{Event as E, Value as V};
    let ends = E(Kind::Ends, "compute", 0);
    // The first datum to y is lost: from then on its numbers are smaller.
    let writer = [
        ends,
        E(Kind::Stores, "c_x", 1),
        ends,
        E(Kind::Stores, "c_x", 2),
        E(Kind::Stores, "c_y", 1),
        E(Kind::Stores, "c_y", 2),
    ];
    let reader =
        |channel: &'static str, number: u64, value: u64| [E(Kind::Loads, channel, number), V(channel, value, true)];
    let check = |[x, y]: [(u64, u64); 2]| {
        contradicts(&[("w", &writer), ("x", &reader("c_x", x.0, x.1)), ("y", &reader("c_y", y.0, y.1))])
    };
    assert_eq!(check([(2, 5), (1, 5)]), None);
    assert_eq!(check([(2, 5), (1, 6)]), Some([(1, 2, 5), (2, 1, 6)]));
    // These are of two elaborations; and what is written again without one may be anything.
    assert_eq!(check([(1, 5), (1, 6)]), None);
    assert_eq!(check([(2, 5), (2, 6)]), None);
}
