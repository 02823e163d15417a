//! Recordings of which half is missing, changed or out of order; and tasks that give up each access.

use recording::{Event, Kind};

use super::by_order::{conforms, contention, parts, recording, verdict};
use super::tests::{recorded_for, session, whole};
use super::*;

/// The model's own run, by the order of events.
fn good() -> Recording {
    recorded_for("real", 300)
}

/// Of each task, the events that are kept.
fn keeping(kept: impl Fn(usize, usize) -> bool) -> Recording {
    let mut recording = good();
    for track in &mut recording.tracks {
        let (mut at, count) = (0, track.events.len());
        track.events.retain(|_| (kept(at, count), at += 1).0);
    }
    recording
}

fn is_parted(recording: &Recording) {
    let verdict = whole(recording);
    assert!(matches!(verdict, Verdict::Parts(_)), "{verdict:#?}");
}

#[test]
fn half_is_missing() {
    is_parted(&keeping(|at, count| at >= count / 2));
    is_parted(&keeping(|at, _| at % 2 == 0));
    is_parted(&keeping(|at, _| at % 2 == 1));
    is_parted(&keeping(|at, count| at < count / 4 || at >= count * 3 / 4));
    // A task may stop in the middle, as far as an order of events goes; whoever tells the verdict says so.
    let early = keeping(|at, count| at < count / 2);
    assert!(matches!(whole(&early), Verdict::Conforms { .. }));
    // If the file says how many were lost, or has no end, nothing is known.
    let mut lost = early.clone();
    lost.tracks[0].lost = true;
    assert!(matches!(whole(&lost), Verdict::Unknown { .. }));
    assert!(matches!(whole(&Recording { ended: false, ..early }), Verdict::Unknown { .. }));
}

#[test]
fn half_of_the_tasks_are_missing() {
    for silent in 0..2 {
        let mut recording = good();
        let tracks = recording.tracks.iter_mut().enumerate();
        tracks.filter(|(at, _)| at % 2 == silent).for_each(|(_, track)| track.events.clear());
        is_parted(&recording);
    }
}

#[test]
fn half_is_changed() {
    let changed = |change: &dyn Fn(&mut Event)| {
        let mut recording = good();
        for track in &mut recording.tracks {
            let half = track.events.len() / 2;
            track.events[half..].iter_mut().for_each(change);
        }
        is_parted(&recording);
    };
    changed(&|event| event.number += 1);
    changed(&|event| event.object = "another".into());
    changed(&|event| event.kind = if event.kind == Kind::Begins { Kind::Ends } else { Kind::Begins });
    changed(&|event| event.fresh = event.fresh.map(|fresh| !fresh));
}

#[test]
fn halves_are_out_of_order() {
    // With their instants, time goes back.
    let mut swapped = good();
    for track in &mut swapped.tracks {
        let half = track.events.len() / 2;
        track.events.rotate_left(half);
    }
    assert!(
        matches!(session(&swapped).go_on(&swapped, false), Err(Refusal::Words(words)) if words.contains("time goes back"))
    );
    // With the instants where they were, the events are not those of a run.
    let mut told = good();
    for track in &mut told.tracks {
        let times: Vec<i64> = track.events.iter().map(|event| event.time_ns).collect();
        let half = track.events.len() / 2;
        track.events.rotate_left(half);
        track.events.iter_mut().zip(times).for_each(|(event, time_ns)| event.time_ns = time_ns);
    }
    is_parted(&told);
    let mut backwards = good();
    for track in &mut backwards.tracks {
        let times: Vec<i64> = track.events.iter().map(|event| event.time_ns).collect();
        track.events.reverse();
        track.events.iter_mut().zip(times).for_each(|(event, time_ns)| event.time_ns = time_ns);
    }
    is_parted(&backwards);
}

/// What the encoder does if it comes to no writing; the robot holds nothing.
fn giving_up(how: &str) -> Recording {
    let mut lines = "encoder 100 begins encoder_acquire 0\n encoder 110 ends encoder_acquire 0\n".to_string();
    for (at, to) in [(200, "robot"), (300, "motor")] {
        lines += &match how {
            "passes" => format!("encoder {at} passes encoder_write_{to} 0\n"),
            _ => format!(
                "encoder {at} begins encoder_write_{to} 0
                 encoder {} asks encoder_to_{to}
                 encoder {} {how} encoder_to_{to}
                 encoder {} ends encoder_write_{to} 0\n",
                at + 10,
                at + 20,
                at + 30
            ),
        };
    }
    lines += "encoder 400 meets encoder 0";
    recording("real", &lines)
}

/// How often the encoder came to each of its channels: turns, accesses, given up, left out.
fn of_encoder(recording: &Recording) -> Vec<(String, [usize; 4], bool)> {
    let (sources, model, program) = super::tests::model_named("CompleteController.asm");
    let session =
        Session::new(sources, model, program, Limits::default(), recording, true).expect("it can be replayed");
    let own = session.accesses(recording).into_iter().filter(|access| access.task == "encoder" && access.writes);
    own.map(|access| {
        (access.channel.clone(), [access.turns, access.made, access.given_up, access.left_out], access.never())
    })
    .collect()
}

/// Nobody else has the locks, so the model's task gets them.
#[test]
fn what_nobody_holds_is_not_given_up() {
    let never = giving_up("gives_up");
    parts(&never, "gives_up encoder_to_robot", "enters encoder_to_robot; writes encoder_to_robot");
    let each = |channel: &str| (channel.to_string(), [1, 0, 1, 0], true);
    assert_eq!(of_encoder(&never), [each("encoder_to_robot"), each("encoder_to_motor")]);
}

/// That there is nothing to hand over is the program's own word: it is followed, and counted.
#[test]
fn writings_that_are_left_out_are_counted() {
    let passes = giving_up("passes");
    conforms(&passes);
    let each = |channel: &str| (channel.to_string(), [1, 0, 0, 1], true);
    assert_eq!(of_encoder(&passes), [each("encoder_to_robot"), each("encoder_to_motor")]);
    // What comes after the stop is not counted, as it is not compared.
    let early = Recording { stopped_ns: Some(300), ..passes };
    assert!(matches!(verdict(&early), Verdict::Conforms { events: 3, .. }));
    assert_eq!(of_encoder(&early)[1], ("encoder_to_motor".to_string(), [0; 4], false));
    let good = contention("drawn", TICK_NS, "enters");
    assert!(of_encoder(&good).iter().all(|(_, counts, never)| *counts == [1, 1, 0, 0] && !never));
}

const TICK_NS: i64 = 100_000;
