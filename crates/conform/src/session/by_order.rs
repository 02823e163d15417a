//! Recordings of the complete controller, written by hand: overlapping actions may have happened in any order, and no
//! task waits longer than the model's watchdog allows.

use recording::{Event, Track};

use super::tests::model_named;
use super::*;

const TICK_NS: i64 = 100_000;

/// The recording with these events, one on each line: task, instant, kind, object, and the rest of its words.
pub(super) fn recording(pace: &str, lines: &str) -> Recording {
    let names = ["operator", "camera", "visual_servoing", "robot", "motor", "encoder"];
    let mut tracks: Vec<Track> =
        names.iter().map(|name| Track { task: (*name).to_string(), ..Track::default() }).collect();
    for line in lines.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [task, time_ns, kind, object, rest @ ..] = words.as_slice() else { continue };
        let mut event = Event {
            time_ns: time_ns.parse().expect("an instant"),
            kind: Kind::of(kind).expect("a kind"),
            object: (*object).into(),
            ..Event::default()
        };
        let numbers: Vec<u64> = rest.iter().filter_map(|word| word.parse().ok()).collect();
        event.number = numbers.first().copied().unwrap_or(0);
        (event.array, event.next) = (numbers.get(1).copied(), numbers.get(2).copied());
        event.fresh = rest
            .last()
            .and_then(|word| [("new", true), ("old", false)].iter().find(|(known, _)| known == word))
            .map(|(_, fresh)| *fresh);
        let track = tracks.iter_mut().find(|track| track.task == *task).expect("a task");
        track.events.push(event);
    }
    Recording {
        tracks,
        tick_ns: TICK_NS,
        pace: pace.to_string(),
        stopped_ns: Some(20_000 * TICK_NS),
        ended: true,
        ..Recording::default()
    }
}

pub(super) fn verdict(recording: &Recording) -> Verdict {
    let (sources, model, program) = model_named("CompleteController.asm");
    let mut session =
        Session::new(sources, model, program, Limits::default(), recording, true).expect("it can be replayed");
    session.go_on(recording, false).expect("of this system").expect("nothing more comes")
}

#[track_caller]
pub(super) fn conforms(recording: &Recording) {
    let verdict = verdict(recording);
    assert!(matches!(verdict, Verdict::Conforms { .. }), "{verdict:#?}");
}

/// Where the two differ, and what the model has instead.
#[track_caller]
pub(super) fn parts(recording: &Recording, event: &str, model: &str) {
    match verdict(recording) {
        Verdict::Parts(parted) => {
            let words = |event: &Event| format!("{} {}", event.kind, event.object);
            assert_eq!(parted.event.as_ref().map(words).unwrap_or_default(), event, "{parted:#?}");
            let claims: Vec<String> = parted.claims.iter().map(|claim| words(&claim.event)).collect();
            assert_eq!(claims.join("; "), model, "{parted:#?}");
        }
        other => panic!("{other:#?}"),
    }
}

/// The robot releases a lock between 274 and 334; the encoder gives it up between 264 and `gave_up`.
fn collision(released: i64, read: i64) -> Recording {
    let lines = format!(
        "robot 50 begins robot_read_vs 0
         robot 60 asks vs_to_robot
         robot 70 enters vs_to_robot
         robot 80 reads vs_to_robot 0 2 old
         robot 90 releases vs_to_robot
         robot 100 ends robot_read_vs 0
         robot 110 begins robot_read_encoder 0
         robot 140 asks encoder_to_robot
         robot 190 enters encoder_to_robot
         robot {released} releases encoder_to_robot
         robot {read} reads encoder_to_robot 0 1 old
         robot 374 ends robot_read_encoder 0
         encoder 100 begins encoder_acquire 0
         encoder 110 ends encoder_acquire 0
         encoder 214 begins encoder_write_robot 0
         encoder 264 asks encoder_to_robot
         encoder 344 gives_up encoder_to_robot
         encoder 384 ends encoder_write_robot 0"
    );
    recording("real", &lines)
}

#[test]
fn what_is_told_later_may_have_happened_before() {
    conforms(&collision(274, 334));
    parts(&collision(230, 250), "gives_up encoder_to_robot", "enters encoder_to_robot; writes encoder_to_robot");
}

/// The encoder holds a lock that the motor has asked for at 1000 ns; then comes the motor's event, `after` that time.
pub(super) fn contention(pace: &str, after_ns: i64, kind: &str) -> Recording {
    let came = 1_000 + after_ns;
    let mut lines = format!(
        "encoder 100 begins encoder_acquire 0
         encoder 110 ends encoder_acquire 0
         encoder 200 begins encoder_write_robot 0
         encoder 220 asks encoder_to_robot
         encoder 220 enters encoder_to_robot
         encoder 230 writes encoder_to_robot 1 0
         encoder 240 releases encoder_to_robot
         encoder 250 ends encoder_write_robot 0
         encoder 260 begins encoder_write_motor 0
         encoder 280 asks encoder_to_motor
         encoder 280 enters encoder_to_motor
         encoder 290 writes encoder_to_motor 1 0
         encoder {} releases encoder_to_motor
         encoder {} ends encoder_write_motor 0
         motor 500 begins motor_read_encoder 0
         motor 1000 asks encoder_to_motor\n",
        came - 10 + i64::from(kind == "gives_up") * 20,
        came + 20,
    );
    lines += &match kind {
        "enters" => format!(
            "motor {came} enters encoder_to_motor
             motor {} swaps encoder_to_motor 1 0 1
             motor {} releases encoder_to_motor
             motor {} reads encoder_to_motor 1 0 new",
            came + 30,
            came + 40,
            came + 50
        ),
        "gives_up" => format!(
            "motor {came} gives_up encoder_to_motor
             motor {} reads encoder_to_motor 0 1 old",
            came + 50
        ),
        _ => String::new(),
    };
    recording(pace, &lines)
}

/// The model's motor has two ticks to wait for locks: 10 ticks of period, of which its work takes 8.
#[test]
fn the_models_watchdog_bounds_the_waiting() {
    conforms(&contention("drawn", 2 * TICK_NS, "enters"));
    let gives_up = "gives_up encoder_to_motor";
    parts(&contention("drawn", 2 * TICK_NS + 1, "enters"), "enters encoder_to_motor", gives_up);
    conforms(&contention("drawn", 2 * TICK_NS, "gives_up"));
    parts(&contention("drawn", 2 * TICK_NS - 1, "gives_up"), gives_up, "");
    // It may have been interrupted for so long.
    conforms(&contention("real", 9_000 * TICK_NS, "enters"));
    parts(&contention("real", 10_003 * TICK_NS, "enters"), "enters encoder_to_motor", gives_up);
    conforms(&contention("real", 9_000 * TICK_NS, "gives_up"));
}

/// In real time a cycle that begins late has that much less time to wait.
#[test]
fn a_late_cycle_may_give_up_earlier() {
    let late = |pace: &str, late_ns: i64| {
        let mut recording = contention(pace, 50, "gives_up");
        let events = recording.tracks.iter_mut().flat_map(|track| &mut track.events);
        events.filter(|event| event.time_ns >= 260).for_each(|event| event.time_ns += late_ns);
        recording
    };
    let gives_up = "gives_up encoder_to_motor";
    parts(&late("real", 0), gives_up, "");
    parts(&late("real", TICK_NS), gives_up, "");
    conforms(&late("real", 2 * TICK_NS));
    parts(&late("drawn", 2 * TICK_NS), gives_up, "");
}

#[test]
fn who_waits_at_the_end_has_not_waited_too_long() {
    let mut still = contention("drawn", 2 * TICK_NS, "nothing");
    still.tracks[5].events.truncate(12);
    parts(&still, "", "gives_up encoder_to_motor");
    still.stopped_ns = Some(1_000 + 2 * TICK_NS);
    conforms(&still);
}

/// The array is touched before the lock is there, and other events of a task in a wrong order.
#[test]
fn neighbours_of_a_task_have_their_order() {
    let good = contention("drawn", TICK_NS, "enters");
    conforms(&good);
    let last = |lane: usize| good.tracks[lane].events.len() - 1;
    for lane in [4, 5] {
        for at in 0..last(lane) {
            let mut wrong = good.clone();
            let events = &mut wrong.tracks[lane].events;
            events.swap(at, at + 1);
            let (one, two) = (events[at].time_ns, events[at + 1].time_ns);
            (events[at].time_ns, events[at + 1].time_ns) = (two, one);
            let verdict = verdict(&wrong);
            assert!(matches!(verdict, Verdict::Parts(_)), "event {at} of lane {lane}: {verdict:#?}");
        }
    }
}

/// After an event that comes a second late, or goes back in time, the others are compared all the same.
#[test]
fn all_events_are_come_to() {
    let mut late = contention("drawn", TICK_NS, "enters");
    late.tracks[5].events.last_mut().expect("an event").time_ns += 1_000_000_000;
    conforms(&late);
    late.tracks[4].events.iter_mut().for_each(|event| event.number += u64::from(event.kind == Kind::Swaps));
    parts(&late, "swaps encoder_to_motor", "swaps encoder_to_motor");
    late.tracks[5].events.last_mut().expect("an event").time_ns = 0;
    let (sources, model, program) = model_named("CompleteController.asm");
    let mut session =
        Session::new(sources, model, program, Limits::default(), &late, true).expect("it can be replayed");
    assert!(matches!(session.go_on(&late, false), Err(Refusal::Words(words)) if words.contains("time goes back")));
}

/// Nothing is handed over in a skipped writing, and only writings are skipped.
#[test]
fn what_is_passed_over_is_a_writing() {
    let passing = |lines: &str| {
        recording(
            "drawn",
            &format!(
                "encoder 100 begins encoder_acquire 0
         encoder 110 ends encoder_acquire 0\n{lines}"
            ),
        )
    };
    let rest = "encoder 200 passes encoder_write_motor 0\n encoder 200 meets encoder 0";
    conforms(&passing(&format!("encoder 200 passes encoder_write_robot 0\n{rest}")));
    conforms(&passing(&format!(
        "encoder 200 invalid encoder_to_robot\n encoder 200 passes encoder_write_robot 0\n{rest}"
    )));
    parts(&passing(&format!("encoder 200 passes encoder_write_robot 1\n{rest}")), "passes encoder_write_robot", "");
    parts(&passing("encoder 200 invalid encoder_to_motor"), "invalid encoder_to_motor", "");
    parts(
        &passing("encoder 200 invalid encoder_to_robot\n encoder 200 begins encoder_write_robot 0"),
        "invalid encoder_to_robot",
        "",
    );
    parts(&recording("drawn", "encoder 100 passes encoder_acquire 0"), "passes encoder_acquire", "");
    let failed = passing("encoder 200 begins encoder_write_robot 0\n encoder 200 faults encoder_write_robot 0");
    assert!(matches!(verdict(&failed), Verdict::Unknown { .. }));
}

#[test]
fn the_pages_of_faults_show_them() {
    for id in crate::FAULT_IDS {
        let page = testkit::Page::fault(id);
        let Verdict::Parts(parted) = verdict(&recording("real", page.example("events"))) else { panic!("{id}") };
        let fault = crate::diagnose_parted(&parted).expect("the model does something there");
        assert_eq!((fault.id, fault.message.as_str()), (*id, "the model releases encoder_to_robot here"));
    }
}
