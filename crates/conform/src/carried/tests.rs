//! What is got is as new as the readings before it say, for each kind of channel, and is not there before the first reading.
//!
//! The recordings are written by hand: one task, one channel whose writer has no machine.

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
    let mut carried = Carried::new(["c".to_string()].into_iter());
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
