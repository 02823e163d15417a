//! A recording of what the model itself does conforms; with one event changed it does not; and reading along gives the
//! same verdict as reading the whole.

use machine::Closed;
use recording::Rhythm;
use testkit::{Disk, repository};

use super::*;

/// A model of the case study.
pub(crate) fn model_named(name: &str) -> (Sources, Model, Program) {
    let path = repository::root().join("examples/visual_servoing").join(name);
    let checked = model::check(Disk::read(&path).expect("the model is there"), &mut Disk);
    let program = program::lower(&checked.model).expect("it can be lowered");
    (checked.sources, checked.model, program)
}

fn model() -> (Sources, Model, Program) {
    model_named("VisionSystem.asm")
}

const TICK_NS: i64 = 1_000;
const TICKS: i64 = 300;

/// The events of the model's own run. By the order of events an instant is within its tick, one event after another.
fn recorded(pace: &str) -> Recording {
    recorded_for(pace, TICKS)
}

/// This many ticks of it.
pub(super) fn recorded_for(pace: &str, ticks: i64) -> Recording {
    let (_, _, program) = model();
    let mut machine = Machine::new(Arc::new(program.clone()), Limits::default());
    machine.start(&mut Closed).expect("it starts");
    let vocabulary = Vocabulary::new(&program, &machine).expect("the library's patterns");
    let track = |task: String| Track { task, ..Track::default() };
    let mut tracks: Vec<Track> = vocabulary.components.iter().map(|known| track(known.name.clone())).collect();
    for tick in 0..ticks {
        machine.step(&mut Closed).expect("a step");
        for (component, claim) in vocabulary.claims(&machine, &vocabulary.changes(&machine)) {
            let mut event = claim.event;
            event.time_ns = tick * TICK_NS;
            tracks[component].events.push(event);
        }
    }
    Recording {
        tracks,
        system: "vision_system".to_string(),
        tick_ns: TICK_NS,
        pace: pace.to_string(),
        stopped_ns: Some(ticks * TICK_NS),
        ended: true,
        ..Recording::default()
    }
}

pub(super) fn session(head: &Recording) -> Session {
    let (sources, model, program) = model();
    Session::new(sources, model, program, Limits::default(), head, false).expect("it can be replayed")
}

pub(super) fn whole(recording: &Recording) -> Verdict {
    let verdict = session(recording).go_on(recording, false).expect("of this system");
    verdict.expect("nothing more comes")
}

/// Reads each task's events a few at a time, the tasks in turn, and says when the verdict came.
fn along(recording: &Recording, at_once: usize) -> (Verdict, bool) {
    let mut heard = Recording { stopped_ns: None, ended: false, ..recording.clone() };
    heard.tracks.iter_mut().for_each(|track| track.events.clear());
    let mut session = session(&heard);
    loop {
        let mut grew = false;
        for (track, all) in heard.tracks.iter_mut().zip(&recording.tracks) {
            let from = track.events.len();
            let to = (from + at_once).min(all.events.len());
            track.events.extend_from_slice(&all.events[from..to]);
            grew |= to > from;
        }
        if !grew {
            let verdict = session.go_on(recording, false).expect("of this system");
            return (verdict.expect("nothing more comes"), false);
        }
        if let Some(verdict) = session.go_on(&heard, true).expect("of this system") {
            return (verdict, true);
        }
    }
}

#[test]
fn what_the_head_names_is_in_the_model() {
    let (sources, model, program) = model();
    // A name in the log is no text of a model: it would be the term `true` here.
    let head = Recording { wait_free: vec!["true".to_string()], ..recorded_for("modelled", 1) };
    let refused = Session::new(sources, model, program, Limits::default(), &head, false).map(|_| ());
    assert!(
        matches!(&refused, Err(Refusal::Words(words)) if words == "the model has no channel true, which was generated wait-free"),
        "{refused:?}"
    );
}

#[test]
fn what_the_head_says_of_tasks_is_so_in_the_model() {
    let refused = |task: &str, change: &dyn Fn(&mut Track)| {
        let mut head = recorded_for("modelled", 1);
        change(head.tracks.iter_mut().find(|track| track.task == task).expect("the task is there"));
        let (sources, model, program) = model();
        match Session::new(sources, model, program, Limits::default(), &head, false) {
            Ok(_) => "nothing".to_string(),
            Err(Refusal::Words(words)) => words.replace("the recording is of another system: ", ""),
            Err(other) => panic!("{other:?}"),
        }
    };
    let rhythm = |period: i64, offset: i64, deadline: i64| {
        let [period_ns, offset_ns, deadline_ns] = [period, offset, deadline].map(|ticks| ticks * TICK_NS);
        move |track: &mut Track| track.rhythm = Some(Rhythm { period_ns, offset_ns, deadline_ns })
    };
    // The camera has a period of 100 ticks; the servoing has none, and begins again and again.
    assert_eq!(refused("camera", &rhythm(100, 0, 100)), "nothing");
    let period = "the period of camera is 0.09 ms in the recording, 0.1 ms in the model";
    assert_eq!(refused("camera", &rhythm(90, 0, 90)), period);
    let offset = "the offset of camera is 0.001 ms in the recording, 0 ms in the model";
    assert_eq!(refused("camera", &rhythm(100, 1, 100)), offset);
    let deadline = "the deadline of camera is 0.2 ms in the recording, 0.1 ms in the model";
    assert_eq!(refused("camera", &rhythm(100, 0, 200)), deadline);
    let none = "visual_servoing has a period in the recording, and none in the model";
    assert_eq!(refused("visual_servoing", &rhythm(100, 0, 100)), none);
    let awaits = |channel: &'static str| move |track: &mut Track| track.awaits = recording::Awaited::read(channel);
    assert_eq!(refused("visual_servoing", &awaits("camera_to_vs")), "nothing");
    let other = "visual_servoing awaits vs_to_robot in the recording, camera_to_vs in the model";
    assert_eq!(refused("visual_servoing", &awaits("vs_to_robot")), other);
    let nothing = "robot awaits vs_to_robot in the recording, nothing in the model";
    assert_eq!(refused("robot", &awaits("vs_to_robot")), nothing);
}

#[test]
fn what_the_head_leaves_out_is_named() {
    let mut head = recorded_for("modelled", 1);
    let unsaid = |head: &Recording| {
        let (sources, model, program) = model();
        Session::new(sources, model, program, Limits::default(), head, false).expect("it fits").unsaid(head)
    };
    for track in &mut head.tracks {
        let period_ns = 100 * TICK_NS;
        (track.rhythm, track.awaits) = match track.task.as_str() {
            "camera" => (Some(Rhythm { period_ns, offset_ns: 0, deadline_ns: period_ns }), None),
            "visual_servoing" => (None, recording::Awaited::read("camera_to_vs")),
            _ => (track.rhythm, None),
        };
    }
    let others: Vec<String> = unsaid(&head);
    assert!(others.iter().all(|what| !what.contains("camera") && !what.contains("visual_servoing")), "{others:?}");
    for track in &mut head.tracks {
        (track.rhythm, track.awaits) = (None, None);
    }
    let all = unsaid(&head);
    assert!(all.contains(&"which period camera has".to_string()), "{all:?}");
    assert!(all.contains(&"what visual_servoing awaits".to_string()), "{all:?}");
    // The robot awaits nothing.
    assert!(!all.contains(&"what robot awaits".to_string()), "{all:?}");
}

#[test]
fn the_models_own_run_conforms() {
    let recording = recorded("modelled");
    assert!(recording.events() > 50, "{} events", recording.events());
    let verdict = whole(&recording);
    assert!(matches!(verdict, Verdict::Conforms { .. }), "{verdict:#?}");
    assert_eq!(along(&recording, 2), (verdict, false));
}

#[test]
fn who_reads_along_hears_what_the_whole_says() {
    let good = recorded("modelled");
    for (task, at) in [(0, 3), (1, 5), (2, 9)] {
        let mut wrong = good.clone();
        wrong.tracks[task].events[at].number += 7;
        let verdict = whole(&wrong);
        assert!(matches!(verdict, Verdict::Parts(_)), "{verdict:#?}");
        assert_eq!(along(&wrong, 2), (verdict, true));
    }
}

/// The model's tasks act at once; written in their order, their actions are also a run of single steps.
#[test]
fn by_the_order_of_events_too() {
    let good = recorded("real");
    let verdict = whole(&good);
    assert!(matches!(verdict, Verdict::Conforms { .. }), "{verdict:#?}");
    let mut wrong = good.clone();
    wrong.tracks[1].events[5].number += 7;
    let Verdict::Parts(parted) = whole(&wrong) else { panic!("one event is wrong") };
    for at_once in [1, 7] {
        assert!(matches!(along(&good, at_once), (Verdict::Conforms { .. }, false)));
        let (verdict, early) = along(&wrong, at_once);
        let Verdict::Parts(heard) = verdict else { panic!("{verdict:#?}") };
        assert_eq!((&heard.event, &heard.task, early), (&parted.event, &parted.task, true));
    }
}

/// A task without events delays no other, if the recording says that it had none.
#[test]
fn the_horizon_stands_for_events_of_the_silent() {
    let mut wrong = recorded("real");
    let silent = wrong.tracks.iter().position(|track| track.task == "camera").expect("there is a camera");
    let other = (silent + 1) % wrong.tracks.len();
    wrong.tracks[silent].events.clear();
    let event = &mut wrong.tracks[other].events[0];
    event.object = "another".into();
    let heard = Recording { stopped_ns: None, ended: false, ..wrong };
    let mut session = session(&heard);
    assert_eq!(session.go_on(&heard, true).expect("of this system"), None);
    let mut later = Recording { horizon_ns: Some(TICKS * TICK_NS), ..heard };
    assert_eq!(session.go_on(&later, true).expect("of this system"), None, "it is looked at anew, later");
    later.horizon_ns = Some(TICKS * TICK_NS + 2 * GRACE_NS);
    let verdict = session.go_on(&later, true).expect("of this system");
    assert!(matches!(verdict, Some(Verdict::Parts(_))), "{verdict:?}");
}

#[test]
fn a_silent_task_is_named_while_one_reads_along() {
    let mut heard = Recording { stopped_ns: None, ended: false, ..recorded("modelled") };
    let session = session(&heard);
    let told = session.progress(&heard);
    assert!(told.starts_with("0 events agree, the run is at 0.0 s") && !told.contains("silent"), "{told}");
    heard.tracks[1].events.last_mut().expect("it did something").time_ns = 3_000_000_000;
    assert!(session.progress(&heard).contains(" has been silent since 0.0 s"), "{}", session.progress(&heard));
}

#[test]
fn an_interrupt_ends_a_comparison() {
    for pace in ["modelled", "real"] {
        let good = recorded(pace);
        let mut session = session(&good);
        let interrupt = Interrupt::new();
        session.heed(interrupt.clone());
        interrupt.raise(machine::Cause::Asked);
        let verdict = session.go_on(&good, false).expect("of this system");
        let reason = "the comparison was interrupted".to_string();
        assert_eq!(verdict, Some(Verdict::Unknown { events: 0, reason }), "{pace}");
    }
}
