//! What of a log is missing, doubled or out of order is never said to conform.
//!
//! The log is that of the model's own run, in the model's time, and one written by hand, by the order of events.

use recording::Event;

use super::tests::{recorded_for, session};
use super::*;

/// Few enough that no step is worth being compiled.
const TICKS: i64 = 140;

/// The log as it is, and a session that looks at one changed log after another.
struct Bench {
    good: Recording,
    session: Session,
}

impl Bench {
    fn new() -> Bench {
        let good = recorded_for("modelled", TICKS);
        let session = session(&good);
        let mut bench = Bench { good, session };
        assert!(matches!(bench.verdict(|_| {}), Ok(Verdict::Conforms { .. })));
        bench
    }

    fn verdict(&mut self, change: impl FnOnce(&mut Recording)) -> Result<Verdict, String> {
        let mut recording = self.good.clone();
        change(&mut recording);
        self.session.begin_again(&recording, false).expect("it can be replayed");
        match self.session.go_on(&recording, false) {
            Ok(verdict) => Ok(verdict.expect("nothing more comes")),
            Err(Refusal::Words(words)) => Err(words),
            Err(Refusal::Model(..)) => unreachable!("the model has been taken"),
        }
    }

    #[track_caller]
    fn refused(&mut self, expect: &str, change: impl FnOnce(&mut Recording)) {
        match self.verdict(change) {
            Err(words) => assert!(words.contains(expect), "{words}"),
            Ok(verdict) => panic!("{verdict:#?}"),
        }
    }

    #[track_caller]
    fn parts(&mut self, change: impl FnOnce(&mut Recording)) -> Box<crate::Parted> {
        match self.verdict(change) {
            Ok(Verdict::Parts(parted)) => parted,
            other => panic!("{other:#?}"),
        }
    }

    /// How many events agree before it is not known any more.
    #[track_caller]
    fn is_not_known(&mut self, change: impl FnOnce(&mut Recording)) -> usize {
        match self.verdict(change) {
            Ok(Verdict::Unknown { events, .. }) => events,
            other => panic!("{other:#?}"),
        }
    }
}

/// The places of two neighbours of one task in one step, by their kinds.
fn neighbours(recording: &Recording, first: Kind, second: Kind) -> (usize, usize) {
    let found = recording.tracks.iter().enumerate().find_map(|(lane, track)| {
        let pair =
            |pair: &[Event]| pair[0].time_ns == pair[1].time_ns && (pair[0].kind, pair[1].kind) == (first, second);
        Some((lane, track.events.windows(2).position(pair)?))
    });
    found.unwrap_or_else(|| panic!("no task has {first} and then {second} in one step"))
}

#[test]
fn a_run_that_ended_early_is_not_known() {
    let mut bench = Bench::new();
    let all = bench.good.events();
    let agreed = bench.is_not_known(|recording| recording.failure = Some("task a hung in cycle 3".to_string()));
    assert!(0 < agreed && agreed <= all);
}

#[test]
fn neighbours_of_a_step_have_their_order() {
    use Kind::{Begins, Ends, Enters, Reads, Releases, Swaps, Writes};
    let mut bench = Bench::new();
    for (first, second) in [(Enters, Swaps), (Enters, Writes), (Releases, Reads), (Releases, Ends), (Ends, Begins)] {
        let (lane, at) = neighbours(&bench.good, first, second);
        let parted = bench.parts(|recording| recording.tracks[lane].events.swap(at, at + 1));
        let said = parted.event.as_ref().map(|event| event.kind);
        assert_eq!(said, Some(second), "{parted:#?}");
        assert_eq!(parted.reason.as_deref(), Some("the model's task does that in the same step, but not first"));
    }
}

#[test]
fn time_does_not_go_back_in_a_task() {
    let mut bench = Bench::new();
    bench.refused("the event before it at", |recording| {
        let events = &mut recording.tracks[1].events;
        let last = events.len() - 1;
        events[last].time_ns = events[last - 1].time_ns - 1;
    });
    bench.refused("before the run began", |recording| recording.tracks[1].events[0].time_ns = -1);
}

#[test]
fn half_of_a_log_is_not_all_of_it() {
    let mut bench = Bench::new();
    let keep = |keep: fn(i64) -> bool| {
        move |recording: &mut Recording| {
            recording.tracks.iter_mut().for_each(|track| track.events.retain(|event| keep(event.time_ns)));
        }
    };
    bench.parts(keep(|ns| ns > 70_000));
    bench.parts(keep(|ns| ns < 70_000));
    bench.parts(keep(|ns| !(40_000..80_000).contains(&ns)));
    // Of one that tells of its gap nothing is known from there on.
    let agree = bench.is_not_known(|recording| {
        keep(|ns| ns < 70_000)(recording);
        recording.tracks.iter_mut().for_each(|track| track.lost = true);
    });
    assert!(agree > 0);
    bench.is_not_known(|recording| recording.ended = false);
    assert_eq!(bench.is_not_known(|recording| recording.stopped_ns = Some(0)), 0);
}

#[test]
fn each_task_is_there_once() {
    let mut bench = Bench::new();
    bench.refused("the recording has no task", |recording| _ = recording.tracks.remove(1));
    bench.refused("no component nobody", |recording| recording.tracks[1].task = "nobody".to_string());
    bench.refused("the recording has two tasks", |recording| {
        let again = recording.tracks[1].clone();
        recording.tracks.push(again);
    });
    bench.parts(|recording| recording.tracks[1].events.clear());
    let mut odd = bench.good.clone();
    odd.pace = "slow".to_string();
    assert!(matches!(bench.session.begin_again(&odd, false), Err(Refusal::Words(words)) if words.contains("`slow`")));
}
