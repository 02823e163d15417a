//! Releases with jitter: cycles begin at every tick at which they may and at no other, the bounds that need no search hold in every run of
//! small systems, and a bound that is one tick too short is refuted by a run that violates the ground model's invariant, too.

use std::collections::{BTreeMap, BTreeSet};
use std::hash::{DefaultHasher, Hash, Hasher};

use chart::times::{Order, Platform, Times, Verdict, times};
use groundstate::verify::{Options, Outcome, Report, verify};
use groundstate::{VerifiedSystem, verified_system};
use machine::{Choice, Closed, Environment, Limits, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Program};
use syntax::SourceFile;
use testkit::Patterns;

use crate::draw::Draw;

fn system(text: &str) -> Box<VerifiedSystem> {
    let system = verified_system(SourceFile::new("Jittered.chart", text), &[], &|_| false, &mut Patterns);
    system.unwrap_or_else(|faults| panic!("{text}\n{faults:#?}"))
}

/// Two tasks and a channel; the first one's releases have jitter, the second one's now and then.
fn drawn(seed: u64) -> String {
    let mut draw = Draw(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let periods = [6, 8, 12];
    let mut period = || periods[draw.number(0, 2) as usize];
    let (writes, reads) = (period(), period());
    let reader = match draw.number(0, 3) {
        0 => "asynchronous awaits water".to_string(),
        1 => format!("synchronous period {reads} ms"),
        _ => format!("synchronous period {reads} ms jitter {} ms offset {} ms", draw.number(1, 2), draw.number(0, 3)),
    };
    let kind = match draw.number(0, 3) {
        0 => "queue 4".to_string(),
        1 => "shared value".to_string(),
        _ => format!("swinging buffer 2 master {}", ["pour", "drink"][draw.number(0, 1) as usize]),
    };
    let jitter = draw.number(1, 3);
    format!(
        "chart Jittered\nimport patterns/ControlTask\nsystem jittered\n\
         \tcomponent pour synchronous period {writes} ms jitter {jitter} ms\n\t\telaborate fill 1 ms\n\t\twrite water 1 ms\n\tendcomponent\n\
         \tcomponent drink {reader}\n\t\tread water 1 ms every FRESH ms fresh\n\t\telaborate swallow {} ms\n\tendcomponent\n\
         \tchannel water from pour to drink {kind}\n\twithin AGE ms from pour to drink\nendsystem\n",
        draw.number(1, 2)
    )
}

fn with(text: &str, fresh: u64, age: u64) -> String {
    text.replace("FRESH", &fresh.to_string()).replace("AGE", &age.to_string())
}

fn analysed(text: &str) -> Times {
    let chart = chart::load(SourceFile::new("Jittered.chart", with(text, 10_000, 10_000)), &mut Patterns).chart;
    times(&chart.system.expect("it has a system"), Platform { processors: 9, order: Order::Rate })
}

struct Inputs {
    seed: u64,
    step: u64,
}

impl Environment for Inputs {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        let mut hasher = DefaultHasher::new();
        (self.seed, self.step, location.show(program).to_string()).hash(&mut hasher);
        Ok(Value::Boolean(hasher.finish().is_multiple_of(3)))
    }

    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Closed.choose(program, choice)
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        Closed.time(unit)
    }
}

/// What runs of the ground model show.
#[derive(Debug, Default)]
struct Shown {
    /// How late the cycles of each synchronous task began.
    late: BTreeMap<String, BTreeSet<i64>>,
    oldest: u64,
}

fn run(system: &VerifiedSystem, seed: u64, shown: &mut Shown) {
    let mut machine = Machine::new(system.ground.program.clone(), Limits::default());
    let mut inputs = Inputs { seed, step: 0 };
    machine.start(&mut inputs).unwrap_or_else(|fault| panic!("{fault:?}"));
    let mut starts: BTreeMap<String, i64> = BTreeMap::new();
    for step in 0..300 {
        machine.step(&mut inputs).unwrap_or_else(|fault| panic!("{fault:?}"));
        inputs.step += 1;
        for (location, value) in machine.locations() {
            let name = location.show(machine.program()).to_string();
            let Value::Integer(value) = value else { continue };
            if name.starts_with("way_oldest") {
                shown.oldest = shown.oldest.max(value.unsigned_abs());
            }
            let Some(task) = name.strip_prefix("task_periodStart(") else { continue };
            if starts.insert(task.to_string(), value).is_some_and(|before| before != value) {
                shown.late.entry(task.to_string()).or_default().insert(step - value);
            }
        }
    }
}

fn searched(system: &VerifiedSystem, max_states: u64) -> Report {
    let options = Options { max_states, ..Options::default() };
    verify(&system.loaded.program, &options, &mut |_| true).unwrap_or_else(|trouble| panic!("{trouble:?}"))
}

fn name(system: &VerifiedSystem, subject: groundstate::verify::Subject) -> &str {
    match subject {
        groundstate::verify::Subject::Property(index) => system.loaded.program.properties[index].name.as_str(),
        _ => "",
    }
}

#[test]
fn bounds_without_a_search_hold_for_all_releases() {
    let (mut held, mut refuted, mut tight) = (0, 0, 0);
    let full = testkit::sample::is_full();
    for seed in 1..=(if full { 80 } else { 8 }) {
        let text = drawn(seed);
        let told = analysed(&text);
        let (Some(age), Some(fresh)) = (told.ages[0].most, told.fresh[0].most) else { continue };
        if told.tasks.iter().any(|task| !matches!(task.verdict, Verdict::Meets | Verdict::None)) {
            continue;
        }
        let asked = system(&with(&text, fresh, age));
        let report = searched(&asked, if full { 60_000 } else { 4_000 });
        for verdict in &report.verdicts {
            let is_violated = matches!(verdict.outcome, Outcome::Violated(_));
            assert!(!is_violated, "seed {seed}, {}\n{}", name(&asked, verdict.subject), with(&text, fresh, age));
        }
        held += usize::from(report.complete);
        let mut shown = Shown::default();
        (0..4).for_each(|seed| run(&asked, seed, &mut shown));
        assert!(shown.oldest > 0 && shown.oldest <= age, "seed {seed}: {} of {age}\n{text}", shown.oldest);
        tight += usize::from(shown.oldest * 2 >= age);
        if refuted < 1 || full {
            let shorter = system(&with(&text, fresh, shown.oldest - 1));
            let report = searched(&shorter, 60_000);
            let found = report.verdicts.iter().find_map(|verdict| match &verdict.outcome {
                Outcome::Violated(trace) if name(&shorter, verdict.subject).starts_with("inv_age") => {
                    Some((verdict.subject, trace))
                }
                _ => None,
            });
            let (subject, trace) =
                found.unwrap_or_else(|| panic!("seed {seed}: {} is not refuted\n{text}", shown.oldest));
            let within = (&*shorter.loaded.program, &shorter.loaded.sources);
            let run = shorter.ground_run(Limits::default(), within, subject, trace).expect("the run is made");
            assert_eq!(run.violates, Some(true), "seed {seed}\n{text}");
            refuted += 1;
        }
    }
    assert!(held >= 3 && refuted >= 1 && tight >= 1, "{held} {refuted} {tight}");
}

const PAIR: &str = "chart Pair\nimport patterns/ControlTask\nsystem pair\n\
     \tcomponent even synchronous period 8 ms jitter 3 ms offset 2 ms\n\t\telaborate law 2 ms\n\t\twrite set 1 ms\n\tendcomponent\n\
     \tcomponent odd synchronous period 5 ms DEADLINE\n\t\tread set 1 ms\n\t\telaborate turn 2 ms\n\tendcomponent\n\
     \tchannel set from even to odd shared value\nendsystem\n";

#[test]
fn cycles_begin_at_every_tick_at_which_they_may() {
    let asked = system(&PAIR.replace("DEADLINE", "jitter 1 ms"));
    let mut shown = Shown::default();
    (0..4).for_each(|seed| run(&asked, seed, &mut shown));
    assert_eq!(shown.late["even_task)"], (0..=3).collect());
    assert_eq!(shown.late["odd_task)"], (0..=1).collect());
}

#[test]
fn a_deadline_counts_from_the_start_of_the_period() {
    let judged = |deadline: &str| {
        let asked = system(&PAIR.replace("DEADLINE", deadline));
        let report = searched(&asked, 100_000);
        assert!(report.complete);
        let verdict = report.verdicts.iter().find(|verdict| name(&asked, verdict.subject) == "inv_deadlines");
        matches!(verdict.expect("it is asked").outcome, Outcome::Holds)
    };
    // Three ticks of work, released up to one or two later.
    assert!(judged("jitter 1 ms deadline 4 ms"));
    assert!(!judged("jitter 2 ms deadline 4 ms"));
    assert!(judged("jitter 2 ms"));
}
