//! How old data get: the bounds that need no search hold in every run of small systems, the verified model's ages are those of the
//! ground model, and a bound that is one tick too short is refuted by a run that violates the ground model's invariant, too.

use std::hash::{DefaultHasher, Hash, Hasher};

use chart::times::{Order, Platform, times};
use groundstate::verify::{Options, Outcome, Report, Subject, verify};
use groundstate::{AgedWay, Loaded, VerifiedSystem, aged_system, aged_ways, verified_system};
use machine::{Choice, Closed, Environment, Limits, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Program, PropertyKind};
use syntax::SourceFile;
use testkit::Patterns;

use crate::draw::Draw;

fn system(text: &str) -> Box<VerifiedSystem> {
    let system = verified_system(SourceFile::new("Aged.chart", text), &[], &|_| false, &mut Patterns);
    system.unwrap_or_else(|faults| panic!("{text}\n{faults:#?}"))
}

/// A chain of components, with a second way now and then; without its bounds.
fn drawn(seed: u64) -> String {
    let mut draw = Draw(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let count = draw.number(2, 3) as usize;
    let mut text = "chart Aged\nimport patterns/ControlTask\nsystem aged\n".to_string();
    let mut channels = String::new();
    for index in 0..count {
        let is_async = index > 0 && draw.number(0, 2) == 0;
        let mut phases = Vec::new();
        let kind = match is_async {
            true if draw.number(0, 3) == 0 => "asynchronous".to_string(),
            // With a channel from the side, now and then.
            true if draw.number(0, 1) == 0 => {
                let quantifier = ["all", "any"][draw.number(0, 1) as usize];
                let kind = ["queue 4", "shared value", "swinging buffer 2"][draw.number(0, 2) as usize];
                let (period, offset) = (draw.number(9, 14), draw.number(0, 5));
                text += &format!(
                    "\tcomponent s{index} synchronous period {period} ms offset {offset} ms\n\t\telaborate x{index} 1 ms\n\t\t\
                     write d{index} 1 ms\n\tendcomponent\n"
                );
                channels += &format!("\tchannel d{index} from s{index} to t{index} {kind}\n");
                phases.push(format!("read d{index} 1 ms"));
                format!("asynchronous awaits {quantifier} c{index}, d{index}")
            }
            true => format!("asynchronous awaits c{index}"),
            false => {
                let (period, offset) = (draw.number(9, 14), draw.number(0, 5));
                let jitter =
                    if draw.number(0, 3) == 0 { format!(" jitter {} ms", draw.number(1, 3)) } else { String::new() };
                let deadline = match draw.number(0, 2) {
                    0 => format!(" deadline {} ms", period - draw.number(0, 3)),
                    _ => String::new(),
                };
                format!("synchronous period {period} ms{jitter} offset {offset} ms{deadline}")
            }
        };
        if index > 0 {
            phases.push(format!("read c{index} 1 ms"));
        }
        let least = draw.number(1, 2);
        let most = least + draw.number(0, 2);
        let length = if most > least { format!("{least}..{most} ms") } else { format!("{least} ms") };
        let at = draw.number(0, phases.len() as u64) as usize;
        phases.insert(at, format!("elaborate e{index} {length}"));
        if index + 1 < count {
            let at = if draw.number(0, 3) == 0 { 0 } else { phases.len() };
            phases.insert(at, format!("write c{} 1 ms", index + 1));
            let kind = match draw.number(0, 3) {
                0 => "queue 4".to_string(),
                1 => "shared value".to_string(),
                _ => {
                    let arrays = draw.number(2, 3);
                    format!("swinging buffer {arrays} master t{}", index + draw.number(0, 1) as usize)
                }
            };
            // With a second reader, now and then, who keeps the writer waiting, too.
            let mut readers = format!("t{}", index + 1);
            if draw.number(0, 5) == 0 && !kind.contains("master") {
                let period = draw.number(9, 14);
                text += &format!(
                    "\tcomponent r{index} synchronous period {period} ms\n\t\tread c{} 1 ms\n\t\telaborate y{index} 1 ms\n\tendcomponent\n",
                    index + 1
                );
                readers += &format!(", r{index}");
            }
            channels += &format!("\tchannel c{} from t{index} to {readers} {kind}\n", index + 1);
        }
        text += &format!("\tcomponent t{index} {kind}\n");
        phases.iter().for_each(|phase| text += &format!("\t\t{phase}\n"));
        text += "\tendcomponent\n";
    }
    text + &channels + &format!("\twithin LIMIT ms from t0 to t{}\nendsystem\n", count - 1)
}

fn with_limit(text: &str, limit: u64) -> String {
    text.replace("LIMIT", &limit.to_string())
}

/// The greatest age that is bounded without a search, and the longest waiting of each task.
fn bounded(text: &str) -> (Option<u64>, Vec<(String, Option<u64>)>) {
    let chart = chart::load(SourceFile::new("Aged.chart", with_limit(text, 10_000)), &mut Patterns).chart;
    let system = chart.system.expect("it has a system");
    let times = times(&system, Platform { processors: 99, order: Order::Rate });
    let waits = system.components.iter().zip(&times.tasks).filter(|(one, _)| one.timing.period().is_some());
    (times.ages[0].most, waits.map(|(one, task)| (one.name.clone(), task.blocking)).collect())
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

/// A run of a model: the functions of ages after each step.
fn run(loaded: &Loaded, seed: u64, steps: u64) -> Vec<Vec<(String, i64)>> {
    let mut machine = Machine::new(loaded.program.clone(), Limits::default());
    let mut inputs = Inputs { seed, step: 0 };
    machine.start(&mut inputs).unwrap_or_else(|fault| panic!("{fault:?}"));
    let mut all = Vec::new();
    for _ in 0..steps {
        inputs.step += 1;
        machine.step(&mut inputs).unwrap_or_else(|fault| panic!("{fault:?}"));
        let program = machine.program();
        let values = machine.locations().into_iter().filter_map(|(location, value)| {
            let name = location.show(program).to_string();
            match value {
                Value::Integer(number) if name.starts_with("way_") => Some((name, number)),
                _ => None,
            }
        });
        all.push(values.collect());
    }
    all
}

/// The greatest age in a run of the ground model.
fn oldest(system: &VerifiedSystem, seed: u64, steps: u64) -> u64 {
    let end = run(&system.ground, seed, steps).pop().expect("there are steps");
    let oldest = end.iter().filter(|(name, _)| name.starts_with("way_oldest")).map(|(_, age)| *age);
    oldest.max().unwrap_or(0).try_into().expect("no age is negative")
}

fn searched(loaded: &Loaded, max_states: u64) -> Report {
    let options = Options { max_states, ..Options::default() };
    verify(&loaded.program, &options, &mut |_| true).unwrap_or_else(|trouble| panic!("{trouble:?}"))
}

fn is_age(program: &Program, subject: Subject) -> bool {
    matches!(subject, Subject::Property(index) if program.properties[index].name.starts_with("inv_age"))
}

#[test]
fn bounds_without_a_search_hold_in_every_run() {
    let (mut held, mut refuted, mut tight) = (0, 0, 0);
    let full = testkit::sample::is_full();
    let (seeds, states) = if full { (120, 30_000) } else { (8, 4_000) };
    for seed in 1..=seeds {
        let text = drawn(seed);
        let (Some(most), waits) = bounded(&text) else { continue };
        let root = || SourceFile::new("Aged.chart", with_limit(&text, most));
        let drawn = aged_system(root(), &mut Patterns).unwrap_or_else(|faults| panic!("{faults:#?}"));
        let mut asked = system(&with_limit(&text, most));
        assert_eq!(asked.ages.len(), 1, "it needs no search\n{text}");
        asked.loaded = drawn.expect("it has a system");
        let mut loaded = asked.loaded.overlay();
        for (name, wait) in &waits {
            // A writer from the side may wait for room in a queue; where the age rests on it, there is none.
            let Some(wait) = wait else {
                assert!(name.starts_with('s'), "an age needs it");
                continue;
            };
            let term = format!("task_timeInWait({name}_task) <= {wait}");
            loaded.property(PropertyKind::Invariant, "waits", &term).unwrap_or_else(|faults| panic!("{faults:#?}"));
        }
        asked.loaded.program = loaded.program.clone();
        let report = searched(&asked.loaded, states);
        for verdict in &report.verdicts {
            let Subject::Property(index) = verdict.subject else { continue };
            let name = asked.loaded.program.properties[index].name.as_str();
            if name.starts_with("inv_age") || name == "waits" {
                let is_violated = matches!(verdict.outcome, Outcome::Violated(_));
                assert!(!is_violated, "seed {seed}, {name}, most {most}\n{text}");
            }
        }
        held += usize::from(report.complete);
        // A run shows an age; the bound of one tick less does not hold.
        let age = (0..3).map(|seed| oldest(&asked, seed, 120)).max().expect("there are runs");
        assert!(age <= most && age > 0, "seed {seed}: {age} of {most}\n{text}");
        tight += usize::from(age * 2 >= most);
        // Nor is it proved on each of its ways by itself.
        let root = SourceFile::new("Aged.chart", with_limit(&text, age - 1));
        let ways = aged_ways(root, &mut Patterns).unwrap_or_else(|faults| panic!("{faults:#?}"));
        let is_proved = |way: &AgedWay| {
            let report = searched(&way.loaded, 3 * states);
            report.complete && report.verdicts.iter().all(|verdict| matches!(verdict.outcome, Outcome::Holds))
        };
        assert!(!ways.is_empty() && !ways.iter().all(is_proved), "seed {seed}: {age}\n{text}");
        if refuted < 1 || full {
            let shorter = system(&with_limit(&text, age - 1));
            let report = searched(&shorter.loaded, 30 * states);
            let program = &shorter.loaded.program;
            let found = report.verdicts.iter().find_map(|verdict| match &verdict.outcome {
                Outcome::Violated(trace) if is_age(program, verdict.subject) => Some((verdict.subject, trace)),
                _ => None,
            });
            let (subject, trace) = found.unwrap_or_else(|| panic!("seed {seed}: {age} is not refuted\n{text}"));
            let asked = (&**program, &shorter.loaded.sources);
            let run = shorter.ground_run(Limits::default(), asked, subject, trace).expect("the run is made");
            assert_eq!(run.violates, Some(true), "seed {seed}\n{text}");
            refuted += 1;
        }
    }
    assert!(held >= 1 && refuted >= 1 && tight >= 1, "{held} {refuted} {tight}");
}

#[test]
fn the_verified_ages_are_those_of_the_ground_model() {
    for seed in 1..=2 {
        let text = drawn(seed);
        let age = oldest(&system(&with_limit(&text, 10_000)), 1, 100);
        // A limit that is exceeded now and then.
        let aged = system(&with_limit(&text, (age * 2 / 3).max(1)));
        let (ground, verified) = (run(&aged.ground, 1, 100), run(&aged.loaded, 1, 100));
        let exceeded = |values: &[(String, i64)]| -> Vec<(String, bool)> {
            let too_old = values.iter().filter(|(name, _)| name.starts_with("way_tooOld"));
            too_old.map(|(name, number)| (name.clone(), *number > 0)).collect()
        };
        for (step, (one, other)) in ground.iter().zip(&verified).enumerate() {
            assert_eq!(exceeded(one), exceeded(other), "seed {seed}, step {step}\n{text}");
        }
    }
}
