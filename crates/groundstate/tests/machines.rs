//! Components' own machines, from the chart to the recording: data are late and lost as their channels are; a decision that the machine
//! would not make is found, with what it was made from.

use groundstate::conform::{Decision, Events as Run, Recording, Track, Verdict};
use groundstate::job::{self, Cancel, ConformRequest, Conformed, Events, NoTail};
use groundstate::{Loaded, build_chart, load};
use machine::{Choice, Environment, Limits, LocationRef, TimeUnit, Value};
use model::Loader;
use program::{DomainId, Program};
use syntax::SourceFile;
use testkit::Texts;

pub(super) const TANK: &str = "chart Tank
system tank
	sensor level : Integer
	actuator valve : Boolean
	component gauge synchronous period 4 ms
		elaborate measure by Gauge
		write levels
	endcomponent
	component control synchronous period 12 ms
		read levels
		elaborate decide by Control
	endcomponent
	channel levels : Integer from gauge to control swinging buffer 2
	level -> gauge
	control -> valve
endsystem
";

pub(super) const GAUGE: &str = "asm Gauge
import StandardLibrary
signature:
	monitored level: Integer
	out levels: Integer
definitions:
	main rule r_Main = levels := level * 10
";

/// Opens the valve for a level that is new and higher than all before.
pub(super) const CONTROL: &str = "asm Control
import StandardLibrary
signature:
	monitored levels: Integer
	monitored isNewLevels: Boolean
	out valve: Boolean
	controlled highest: Integer
definitions:
	main rule r_Main =
		if isNewLevels and levels > highest then par highest := levels valve := true endpar else valve := false endif
default init s0:
	function highest = 0
	function valve = false
";

struct Files(Texts);

impl Loader for Files {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        self.0.load(importer, path).or_else(|reason| groundstate::patterns::pattern(&importer.name, path).ok_or(reason))
    }
}

pub(super) fn model() -> Loaded {
    model_of(TANK, GAUGE, CONTROL)
}

fn model_of(chart: &str, gauge: &str, control: &str) -> Loaded {
    edited(chart, gauge, control, &|text| text)
}

/// The model that is built, with its text changed by hand.
pub(super) fn edited(chart: &str, gauge: &str, control: &str, edit: &dyn Fn(String) -> String) -> Loaded {
    let mut files = Files(Texts::of([("Gauge.asm", gauge), ("Control.asm", control)]));
    let built = build_chart(SourceFile::new("Tank.chart", chart), "Tank.asm", None, &mut files);
    let text = built.built.unwrap_or_else(|| panic!("{:#?}", built.faults)).text;
    load(SourceFile::new("Tank.asm", edit(text)), &mut files)
        .unwrap_or_else(|faulty| panic!("{:#?}", faulty.diagnostics))
}

/// The level is the number of the tick.
struct Rising(i64);

impl Environment for Rising {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        assert_eq!(location.show(program).to_string(), "level");
        Ok(Value::Integer(self.0))
    }

    fn choose(&mut self, _: &Program, _: &Choice<'_>) -> Result<usize, String> {
        Ok(0)
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Err("no time is asked for".to_string())
    }
}

const TICK_NS: i64 = 1_000_000;

/// A run of the model as a program that follows it would record it, and all that its machines decide. What goes through the channel has
/// so many parts.
pub(super) fn recorded(loaded: &Loaded, width: usize) -> Recording {
    let program = &loaded.program;
    let mut level = Rising(0);
    let mut run = Run::start(program, Limits::default(), &mut level).expect("it starts");
    let track = |task: &str| Track { task: task.to_string(), ..Track::default() };
    let mut tracks = vec![track("gauge"), track("control")];
    for tick in 0..60 {
        level.0 = tick;
        let read = match value(loaded, &mut run, "sb_receivedSequence(levels)") {
            Value::Integer(number) => value(loaded, &mut run, &format!("levels_value({number})")),
            _ => Value::Undef,
        };
        let is_new = value(loaded, &mut run, "sb_fresh(levels)") == Value::Boolean(true);
        let events = run.step(&mut level).expect("a step");
        for (task, mut event) in events {
            event.time_ns = tick * TICK_NS;
            let track = usize::from(task == "control");
            let before = tracks[track].events.len();
            let decision = |is_got: bool, object: &str, value: &Value, fresh: bool| {
                let parts = match value {
                    Value::Tuple(parts) => parts.to_vec(),
                    Value::Undef if object == "levels" => vec![Value::Undef; width],
                    scalar => vec![scalar.clone()],
                };
                let record = move |(value, part): (Value, u64)| {
                    let (bits, known) = match value {
                        Value::Integer(number) => (number as u64, true),
                        Value::Boolean(truth) => (u64::from(truth), true),
                        _ => (0, false),
                    };
                    Decision {
                        time_ns: tick * TICK_NS,
                        is_got,
                        object: object.into(),
                        part,
                        bits,
                        known,
                        fresh,
                        events: before,
                    }
                };
                parts.into_iter().zip(0..).map(record).collect::<Vec<_>>()
            };
            if event.kind.word() == "ends" && event.object.as_ref() == "gauge_measure" {
                let decided = value(loaded, &mut run, "gauge_levels");
                tracks[0].decisions.extend(decision(true, "level", &Value::Integer(tick), false));
                tracks[0].decisions.extend(decision(false, "levels", &decided, false));
            }
            if event.kind.word() == "ends" && event.object.as_ref() == "control_decide" {
                let decided = value(loaded, &mut run, "valve");
                tracks[1].decisions.extend(decision(true, "levels", &read, is_new));
                tracks[1].decisions.extend(decision(false, "valve", &decided, false));
            }
            tracks[track].events.push(event);
        }
    }
    Recording {
        tracks,
        system: "tank".to_string(),
        tick_ns: TICK_NS,
        pace: "modelled".to_string(),
        stopped_ns: Some(60 * TICK_NS),
        ended: true,
        ..Recording::default()
    }
}

/// The value of the location that is shown so.
fn value(loaded: &Loaded, run: &mut Run, location: &str) -> Value {
    let all = run.machine().locations();
    let found = all.into_iter().find(|(known, _)| known.show(&loaded.program).to_string() == location);
    found.map_or(Value::Undef, |(_, value)| value)
}

fn conformed(loaded: &Loaded, recording: Recording, by_order: bool) -> Conformed {
    let request = ConformRequest {
        loaded: loaded.clone(),
        events: Events::<NoTail>::Whole(recording),
        limits: Limits::default(),
        by_order,
    };
    let job = job::conform(request, Cancel::new()).expect("a thread");
    job.finish().expect("no panic").expect("of this system")
}

#[test]
fn data_go_through_channels_and_decisions_are_held_to_their_machines() {
    let loaded = model();
    let good = recorded(&loaded, 1);
    // Of three levels that the gauge measures, the control reads one: the others are lost. The first time there is none.
    let measured: Vec<u64> = good.tracks[0].decisions.iter().filter(|one| !one.is_got).map(|one| one.bits).collect();
    let got: Vec<_> = good.tracks[1].decisions.iter().filter(|one| one.is_got).collect();
    assert!(
        !got[0].known && got[1..].iter().all(|one| one.known && one.fresh && measured.contains(&one.bits)),
        "{got:?}"
    );
    assert!(got[1..].windows(2).all(|two| two[0].bits < two[1].bits), "{got:?}");
    assert!(measured.len() > 2 * got.len() && got.len() > 3, "{measured:?}");
    let first = got[1].bits;
    let whole = conformed(&loaded, good.clone(), false);
    assert!(matches!(whole.verdict, Verdict::Conforms { .. }), "{:#?}", whole.verdict);
    assert_eq!(whole.decisions, Some(measured.len() + got.len()));
    for by_order in [false, true] {
        // The valve stays shut, and the machine would open it.
        let mut wrong = good.clone();
        wrong.tracks[1].decisions[3].bits ^= 1;
        let Verdict::Parts(parted) = conformed(&loaded, wrong, by_order).verdict else { panic!("it is found") };
        let reason = format!("decided valve = false, its machine true, from levels = {first} (new)");
        assert_eq!(parted.reason, Some(reason));
        assert_eq!((parted.task.as_str(), parted.decides), ("control", true));
        // What was got is another datum than was written, and all that was decided from it is as the machine decides.
        let mut other = good.clone();
        let unlike = other.tracks[1].decisions[2].bits + 1;
        other.tracks[1].decisions[2].bits = unlike;
        let Verdict::Parts(parted) = conformed(&loaded, other, by_order).verdict else { panic!("it is found") };
        let reason = parted.reason.unwrap_or_default();
        assert!(reason.starts_with(&format!("got levels = {unlike} as datum ")), "{reason}");
        assert!(reason.ends_with(&format!(", which was decided as {first}")), "{reason}");
        let mut early = good.clone();
        (early.tracks[1].decisions[0].known, early.tracks[1].decisions[0].bits) = (true, 0);
        let Verdict::Parts(parted) = conformed(&loaded, early, by_order).verdict else { panic!("it is found") };
        assert_eq!(parted.reason.as_deref(), Some("got levels = 0 before there was a datum"));
        // Nothing is handed over, and the machine would.
        let mut silent = good.clone();
        silent.tracks[0].decisions[1].known = false;
        let Verdict::Parts(parted) = conformed(&loaded, silent, by_order).verdict else { panic!("it is found") };
        let reason = parted.reason.unwrap_or_default();
        assert!(reason.starts_with("decided levels = undef, its machine "), "{reason}");
        // What is missing is noticed: all decisions of a task, the last one, what it got, what it decided.
        let found = |change: &dyn Fn(&mut Vec<Decision>)| {
            let mut less = good.clone();
            change(&mut less.tracks[1].decisions);
            let Verdict::Parts(parted) = conformed(&loaded, less, by_order).verdict else { panic!("it is found") };
            assert_eq!(parted.task, "control");
            parted.reason.unwrap_or_default()
        };
        let reason = found(&|decisions| decisions.clear());
        assert!(reason.ends_with("but what it decided is recorded never"), "{reason}");
        let reason = found(&|decisions| decisions.truncate(decisions.len() - 2));
        assert!(reason.contains("but what it decided is recorded"), "{reason}");
        let reason = found(&|decisions| _ = decisions.remove(2));
        assert_eq!(reason, "decided, and it is not recorded what it got from levels");
        let reason = found(&|decisions| decisions.retain(|one| one.is_got));
        assert!(reason.ends_with("but what it decided is recorded never"), "{reason}");
        found(&|decisions| decisions.swap(2, 3));
    }
}

#[test]
fn what_is_new_is_what_the_readings_say() {
    let loaded = model();
    let good = recorded(&loaded, 1);
    let found = |by_order: bool, change: &dyn Fn(&mut Decision)| {
        let mut wrong = good.clone();
        wrong.tracks[1].decisions.iter_mut().for_each(change);
        let Verdict::Parts(parted) = conformed(&loaded, wrong, by_order).verdict else { panic!("it is found") };
        assert_eq!((parted.task.as_str(), parted.decides), ("control", true));
        parted.reason.unwrap_or_default()
    };
    for by_order in [false, true] {
        // A runtime that never tells of a new level; from that its machine decides nothing else than the program did.
        let reason = found(by_order, &|one| match one.is_got {
            true => one.fresh = false,
            false => one.bits = 0,
        });
        assert!(reason.starts_with("got levels as not new, and its reading brought a new one: "), "{reason}");
    }
}

#[test]
fn what_is_left_out_of_all_decisions_is_missed() {
    let loaded = model();
    let good = recorded(&loaded, 1);
    let found = |track: usize, object: &str| {
        let mut less = good.clone();
        less.tracks[track].decisions.retain(|one| one.object.as_ref() != object);
        // Half a decision is one all the same, if something was decided.
        let Verdict::Parts(parted) = conformed(&loaded, less, false).verdict else { panic!("it is found") };
        parted.reason.unwrap_or_default()
    };
    assert_eq!(found(0, "level"), "decided, and it is not recorded what it got from level");
    assert_eq!(found(1, "levels"), "decided, and it is not recorded what it got from levels");
    // Two actuators, so that the log of one has decisions without the other.
    let loaded = model_of(
        &TANK
            .replace("actuator valve : Boolean", "actuator valve : Boolean\n\tactuator lamp : Boolean")
            .replace("control -> valve", "control -> valve\n\tcontrol -> lamp"),
        GAUGE,
        &CONTROL
            .replace("out valve: Boolean", "out valve: Boolean\n\tout lamp: Boolean")
            .replace("if isNewLevels and", "par lamp := false if isNewLevels and")
            .replace("valve := false endif", "valve := false endif endpar")
            .replace("function valve = false", "function valve = false\n\tfunction lamp = false"),
    );
    let Verdict::Parts(parted) = conformed(&loaded, recorded(&loaded, 1), false).verdict else { panic!("it is found") };
    assert_eq!(parted.reason.as_deref(), Some("decided, and it is not recorded what for lamp"));
}

#[test]
fn a_value_outside_its_domain_is_a_difference() {
    let loaded = model();
    let good = recorded(&loaded, 1);
    for (known, bits) in [(true, 2), (true, 77)] {
        let mut wrong = good.clone();
        for one in wrong.tracks[1].decisions.iter_mut().filter(|one| !one.is_got) {
            (one.known, one.bits) = (known, if one.bits == 1 { bits } else { 0 });
        }
        let Verdict::Parts(parted) = conformed(&loaded, wrong, false).verdict else { panic!("it is found") };
        let reason = parted.reason.unwrap_or_default();
        assert_eq!(reason, format!("decided valve = {bits}, which is no value of Boolean"));
    }
}

#[test]
fn tuples_are_replayed_by_their_parts() {
    let pair = "Prod(Integer, Boolean)";
    let loaded = model_of(
        &TANK.replace("levels : Integer", &format!("levels : {pair}")),
        &GAUGE.replace("levels: Integer", &format!("levels: {pair}")).replace("level * 10", "(level * 10, level > 3)"),
        &CONTROL
            .replace("levels: Integer", &format!("levels: {pair}"))
            .replace("levels > highest", "second(levels) and first(levels) > highest")
            .replace(":= levels", ":= first(levels)"),
    );
    let good = recorded(&loaded, 2);
    let whole = conformed(&loaded, good.clone(), false);
    assert!(matches!(whole.verdict, Verdict::Conforms { .. }), "{:#?}", whole.verdict);
    // Two parts are one value: three records make a decision of the gauge, and three of the control.
    let records: usize = good.tracks.iter().map(|track| track.decisions.len()).sum();
    assert_eq!(whole.decisions.map(|decisions| decisions * 3), Some(records));
    let found = |change: &dyn Fn(&mut Recording)| {
        let mut wrong = good.clone();
        change(&mut wrong);
        let Verdict::Parts(parted) = conformed(&loaded, wrong, false).verdict else { panic!("it is found") };
        parted.reason.unwrap_or_default()
    };
    let last = good.tracks[0].decisions.len() - 1;
    let reason = found(&|wrong| wrong.tracks[0].decisions[last].bits = 0);
    assert_eq!(reason, "decided levels = (570,false), its machine (570,true), from level = 57");
    let reason = found(&|wrong| wrong.tracks[0].decisions[last].known = false);
    assert_eq!(reason, "decided levels = undef, its machine (570,true), from level = 57");
    // A recording that ends early, or has a gap, may end within a value: that is no difference.
    for cut in 1..6 {
        for lost in [false, true] {
            let mut early = good.clone();
            for track in &mut early.tracks {
                let kept = track.decisions.len() - cut;
                track.events.truncate(track.decisions[kept].events);
                track.decisions.truncate(kept);
                track.lost = lost;
            }
            early.ended = lost;
            let verdict = conformed(&loaded, early, false).verdict;
            assert!(!matches!(verdict, Verdict::Parts(_)), "{verdict:#?}");
        }
    }
    // A part that is missing, one that comes twice, parts in another order.
    found(&|wrong| _ = wrong.tracks[0].decisions.remove(last));
    found(&|wrong| _ = wrong.tracks[0].decisions.remove(last - 1));
    found(&|wrong| wrong.tracks[0].decisions[last].part = 2);
    found(&|wrong| wrong.tracks[0].decisions.swap(last - 1, last));
    found(&|wrong| wrong.tracks[1].decisions[1].part = 0);
}
