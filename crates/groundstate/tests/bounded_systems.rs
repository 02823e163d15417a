//! Deadlines that may be missed, and how often readers get something new: what the model counts is counted again from its other functions,
//! the bound that just holds is proved, the one below is refuted by a run of the ground model, and the analysis allows what was found.

use chart::times::{Order, Platform, times};
use groundstate::verify::{Options, Outcome, Report, Subject, verify};
use groundstate::{VerifiedSystem, verified_system};
use machine::{Closed, Limits, Machine, Value};
use syntax::SourceFile;
use testkit::Patterns;

use crate::draw::Draw;

fn system(text: &str) -> Box<VerifiedSystem> {
    let system = verified_system(SourceFile::new("Bounded.chart", text), &[], &|_| false, &mut Patterns);
    system.unwrap_or_else(|faults| panic!("{text}\n{faults:#?}"))
}

/// Two tasks and a channel, all times fixed: there is one run. The reader may be late, and its reading is bounded.
fn drawn(seed: u64) -> String {
    let mut draw = Draw(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let periods = [6, 8, 12];
    let mut period = || periods[draw.number(0, 2) as usize];
    let (writes, reads) = (period(), period());
    let kind = match draw.number(0, 3) {
        0 => "queue 4".to_string(),
        1 => "shared value".to_string(),
        _ => format!("swinging buffer 2 master {}", ["pour", "drink"][draw.number(0, 1) as usize]),
    };
    let work = draw.number(1, reads - 1);
    let reader = match draw.number(0, 4) {
        0 => "asynchronous awaits water".to_string(),
        1 => "asynchronous".to_string(),
        _ => {
            let deadline = draw.number(reads.div_ceil(2), reads);
            format!(
                "synchronous period {reads} ms offset {} ms deadline {deadline} ms misses MISSES",
                draw.number(0, 5)
            )
        }
    };
    let spent = draw.number(1, writes.min(4));
    format!(
        "chart Bounded\nimport patterns/ControlTask\nsystem bounded\n\
         \tcomponent pour synchronous period {writes} ms\n\t\telaborate fill {spent} ms\n\t\twrite water {} ms\n\tendcomponent\n\
         \tcomponent drink {reader}\n\t\tread water 1 ms every LIMIT ms fresh\n\t\telaborate swallow {work} ms\n\tendcomponent\n\
         \tchannel water from pour to drink {kind}\nendsystem\n",
        draw.number(1, 3)
    )
}

const WINDOW: u64 = 5;
/// Longer than any two periods and what is late.
const STARVED: u64 = 60;

fn with(text: &str, limit: u64, missed: u64) -> String {
    text.replace("LIMIT", &limit.to_string()).replace("MISSES", &format!("{missed} of {WINDOW}"))
}

/// What a run of the ground model shows.
#[derive(Debug, PartialEq, Eq)]
struct Shown {
    longest: u64,
    missed: u64,
}

/// Counted by the model, and counted again from what was read and how many deadlines were missed.
fn run(system: &VerifiedSystem, steps: u64) -> (Shown, Shown) {
    let mut machine = Machine::new(system.ground.program.clone(), Limits::default());
    machine.start(&mut Closed).unwrap_or_else(|fault| panic!("{fault:?}"));
    let (mut late, mut at, mut again) = (Vec::new(), None, Shown { longest: 0, missed: 0 });
    let mut before = [0; 3];
    let mut counted = Shown { longest: 0, missed: 0 };
    for step in 0..steps {
        machine.step(&mut Closed).unwrap_or_else(|fault| panic!("{fault:?}"));
        let program = machine.program();
        let mut now = [0; 3];
        for (location, value) in machine.locations() {
            let Value::Integer(number) = value else { continue };
            let number = number.unsigned_abs();
            match location.show(program).to_string().as_str() {
                "sb_receivedSequence(water)" | "mq_taken(water)" | "sv_receivedSequence(water)" => now[0] = number,
                "task_cycles(drink_task)" => now[1] = number,
                "task_deadlinesMissed(drink_task)" => now[2] = number,
                "reading_longest(drink_read_water_fresh)" => counted.longest = number,
                "task_mostMissed(drink_task)" => counted.missed = number,
                _ => {}
            }
        }
        if let Some(at) = at {
            again.longest = again.longest.max(step - at);
        }
        if now[0] != before[0] {
            at = Some(step);
        }
        if now[1] != before[1] {
            late.push(now[2] != before[2]);
            let last = late.len().saturating_sub(WINDOW as usize);
            again.missed = again.missed.max(late[last..].iter().filter(|late| **late).count() as u64);
        }
        before = now;
    }
    (counted, again)
}

fn searched(system: &VerifiedSystem) -> Report {
    verify(&system.loaded.program, &Options::default(), &mut |_| true).unwrap_or_else(|trouble| panic!("{trouble:?}"))
}

/// Whether the bounds of each kind hold. Their counterexamples are runs of the ground model that violate its invariant.
fn judged<const N: usize>(text: &str, kinds: [&str; N]) -> [bool; N] {
    let asked = system(text);
    let report = searched(&asked);
    let program = &asked.loaded.program;
    let name = |subject| match subject {
        Subject::Property(index) => program.properties[index].name.as_str(),
        _ => "",
    };
    kinds.map(|kind| {
        let verdict = report.verdicts.iter().find(|verdict| name(verdict.subject).starts_with(kind));
        match verdict
            .map(|verdict| (verdict.subject, &verdict.outcome))
            .unwrap_or_else(|| panic!("{kind} is not asked\n{text}"))
        {
            (_, Outcome::Holds) => true,
            (subject, Outcome::Violated(trace)) => {
                let within = (&**program, &asked.loaded.sources);
                let run = asked.ground_run(Limits::default(), within, subject, trace).expect("the run is made");
                assert_eq!(run.violates, Some(true), "{text}");
                false
            }
            (_, Outcome::Unknown(_)) => panic!("{kind} is not decided\n{text}"),
        }
    })
}

/// Whether it is proved that something new comes.
fn comes(text: &str) -> bool {
    let asked = system(text);
    let properties = &asked.loaded.program.properties;
    let is_asked = |subject| match subject {
        Subject::Property(index) => properties[index].name.starts_with("ctlSpec_fresh"),
        _ => false,
    };
    let report = searched(&asked);
    let verdict = report.verdicts.iter().find(|verdict| is_asked(verdict.subject)).expect("it is asked");
    assert!(!matches!(verdict.outcome, Outcome::Unknown(_)), "it is not decided\n{text}");
    matches!(verdict.outcome, Outcome::Holds)
}

fn holds(text: &str, kind: &str) -> bool {
    judged(text, [kind])[0]
}

#[test]
fn bounds_that_just_hold_are_proved_and_those_below_are_refuted() {
    let (mut fresh, mut some, mut bounded, mut starved) = (0, 0, 0, 0);
    let seeds = if testkit::sample::is_full() { 120 } else { 12 };
    for seed in 1..=seeds {
        let text = drawn(seed);
        let (counted, again) = run(&system(&with(&text, 10_000, WINDOW - 1)), 200);
        let is_late = text.contains("MISSES");
        assert_eq!(counted, again, "seed {seed}\n{text}");
        // Where nothing is ever read no time counts; that something comes is a formula of its own.
        if counted.longest == 0 {
            assert!(!comes(&with(&text, STARVED, WINDOW - 1)), "seed {seed} reads nothing\n{text}");
            continue;
        }
        let Shown { longest, missed } = counted;
        // A task that is ever later gives up its readings: nothing new comes any more.
        if longest > STARVED {
            assert!(!holds(&with(&text, STARVED, missed.min(WINDOW - 1)), "inv_fresh_"), "seed {seed}\n{text}");
            starved += 1;
            continue;
        }
        let just = with(&text, longest, missed.min(WINDOW - 1));
        let kinds = ["inv_fresh_", "ctlSpec_fresh", if is_late { "inv_misses_" } else { "inv_fresh_" }];
        let [is_fresh, comes, misses] = judged(&just, kinds);
        assert!(is_fresh && comes, "seed {seed}, {counted:?}\n{just}");
        assert!(misses || missed == WINDOW, "seed {seed}, {counted:?}\n{just}");
        // Periods that are longer are a fault.
        let below = with(&text, longest - 1, missed.min(WINDOW - 1));
        let chart = chart::load(SourceFile::new("Bounded.chart", below.as_str()), &mut Patterns);
        if chart.diagnostics.iter().all(|fault| fault.id != "fresh-bound") {
            assert!(!holds(&below, "inv_fresh_"), "seed {seed}, {counted:?}\n{below}");
            fresh += 1;
        }
        if is_late && missed > 0 {
            let fewer = with(&text, longest, missed - 1);
            assert!(!holds(&fewer, "inv_misses_"), "seed {seed}, {counted:?}\n{fewer}");
            some += 1;
        }
        let chart = chart::load(SourceFile::new("Bounded.chart", just.as_str()), &mut Patterns).chart;
        let told =
            times(chart.system.as_ref().expect("it has a system"), Platform { processors: 9, order: Order::Rate });
        if let Some(most) = told.fresh[0].most {
            assert!(longest <= most, "seed {seed}: {longest} of {most}\n{text}");
            bounded += 1;
        }
        if let Some(most) = told.tasks[1].missed.as_ref().and_then(|missed| missed.most) {
            assert!(missed <= most, "seed {seed}: {missed} of {most}\n{text}");
        }
    }
    assert!(fresh >= 3 && some >= 3 && bounded >= 3 && starved >= 1, "{fresh} {some} {bounded} {starved}");
}

/// A chart as a user writes it: a length that varies, a deadline that some cycles miss.
fn varying(longest: u64, limit: u64) -> String {
    format!(
        "chart Cell\nimport patterns/ControlTask\nsystem cell\n\
         \tcomponent scan synchronous period 10 ms deadline 8 ms misses 1 of 3\n\t\telaborate look 5..{longest} ms\n\t\twrite marks 1 ms\n\
         \tendcomponent\n\tcomponent steer synchronous period 4 ms\n\t\tread marks 1 ms every {limit} ms fresh\n\t\telaborate turn 2 ms\n\
         \tendcomponent\n\tchannel marks from scan to steer shared value\nendsystem\n"
    )
}

#[test]
fn a_task_that_may_be_late_again_and_again_is_refuted() {
    // New marks every 10 ms and up to two more, read on a grid of 4 ms.
    let all = ["inv_misses_scan", "inv_deadlines", "inv_periods", "inv_fresh_"];
    assert_eq!(judged(&varying(7, 16), all), [true; 4]);
    // The others still miss none.
    assert_eq!(judged(&varying(8, 16), all), [false, true, true, true]);
    assert_eq!(judged(&varying(7, 11), all), [true, true, true, false]);
}
