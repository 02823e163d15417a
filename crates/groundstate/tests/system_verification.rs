//! What is verified of a chart's system is the system: the verified models go in lock-step with the ground model, up to what the
//! reduction forgets; what is seeded into a chart is found, and its run fails on the ground model, too.

use std::collections::{BTreeMap, BTreeSet};
use std::hash::{DefaultHasher, Hash, Hasher};

use groundstate::verify::{Options, Outcome, Report, Subject, verify};
use groundstate::{Loaded, VerifiedSystem, not_kept, verified_system};
use machine::{Choice, Closed, Environment, Limits, LocationRef, Machine, Show, TimeUnit, Value};
use program::{DomainId, Program, PropertyKind};
use syntax::SourceFile;
use testkit::{Disk, Patterns, repository};

/// Every kind of component and channel; times that vary; an offset and an early deadline.
const SMALL: &str = r#"chart Small
import patterns/ControlTask
system small
	tick 1 ms
	component sense synchronous period 8 ms offset 3 ms deadline 7 ms
		elaborate acquire 1..2 ms
		write level 1 ms
	endcomponent
	component plan asynchronous awaits level
		read level 1 ms
		elaborate think 2..6 ms
		write orders 1 ms
		write goal 1 ms
	endcomponent
	component act synchronous period 12 ms
		read orders 1 ms
		read goal 1 ms
		elaborate drive 2 ms
		write done 1 ms
	endcomponent
	component watch asynchronous awaits done
		read done 1 ms
		elaborate look 1..5 ms
	endcomponent
	channel level from sense to plan swinging buffer 2
	channel orders from plan to act queue 2
	channel goal from plan to act shared value
	channel done from act to watch swinging buffer 3
endsystem
"#;

fn system(text: &str) -> Box<VerifiedSystem> {
    let name = text.split_whitespace().nth(1).expect("it begins with `chart` and its name");
    let system = verified_system(SourceFile::new(format!("{name}.chart"), text), &[], &|_| false, &mut Patterns);
    system.unwrap_or_else(|faults| panic!("{faults:#?}"))
}

/// The inputs of a run: drawn for each step and component, or as another run had them.
struct Inputs {
    seed: u64,
    step: u64,
    ending: Option<BTreeSet<String>>,
}

impl Environment for Inputs {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        let name = location.show(program).to_string();
        let Some(scheduler) = name.strip_prefix("endsNow(").and_then(|rest| rest.strip_suffix(')')) else {
            return Closed.monitored(program, location, codomain);
        };
        if let Some(ending) = &self.ending {
            return Ok(Value::Boolean(ending.contains(scheduler)));
        }
        let mut hasher = DefaultHasher::new();
        (self.seed, self.step, scheduler).hash(&mut hasher);
        Ok(Value::Boolean(hasher.finish().is_multiple_of(4)))
    }

    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Closed.choose(program, choice)
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        Closed.time(unit)
    }
}

struct Run {
    machine: Machine,
    inputs: Inputs,
}

impl Run {
    fn new(loaded: &Loaded, seed: u64) -> Run {
        let mut machine = Machine::new(loaded.program.clone(), Limits::default());
        let mut inputs = Inputs { seed, step: 0, ending: None };
        machine.start(&mut inputs).unwrap_or_else(|fault| panic!("{fault:?}"));
        Run { machine, inputs }
    }

    fn step(&mut self) {
        self.inputs.step += 1;
        self.machine.step(&mut self.inputs).unwrap_or_else(|fault| panic!("{fault:?}"));
    }

    /// The values of these functions, without undef.
    fn values(&self, functions: &[&str]) -> BTreeMap<String, String> {
        let program = self.machine.program();
        let wanted =
            |location: &machine::Location| functions.contains(&program.function(location.function).name.as_str());
        let all =
            self.machine.locations().into_iter().filter(|(location, value)| wanted(location) && *value != Value::Undef);
        all.map(|(location, value)| (location.show(program).to_string(), value.show(program).to_string())).collect()
    }

    /// What the reduction keeps: control states, locks, flags, lengths of queues, whether a deadline was missed.
    fn kept(&self) -> BTreeMap<String, String> {
        const KEPT: [&str; 12] = [
            "mq_sent",
            "mq_taken",
            "task_deadlinesMissed",
            "indexUpdated",
            "sb_ctrlState",
            "sb_fresh",
            "sb_pending",
            "scheduler_currentPhase",
            "sem_illegalPost",
            "sem_state",
            "semaq",
            "sv_fresh",
        ];
        let state = self.values(&KEPT);
        let number = |location: &str| state.get(location).and_then(|value| value.parse::<i64>().ok()).unwrap_or(0);
        let kept = state.iter().filter_map(|(location, value)| {
            let (function, argument) = location.split_once('(')?;
            match function {
                "mq_sent" => {
                    let length = number(location) - number(&format!("mq_taken({argument}"));
                    Some((format!("mq_length({argument}"), length.to_string()))
                }
                "mq_taken" => None,
                "task_deadlinesMissed" => Some((location.clone(), (number(location) > 0).to_string())),
                _ => Some((location.clone(), value.clone())),
            }
        });
        kept.collect()
    }

    fn phase(&self, scheduler: &str) -> String {
        let phases = self.values(&["scheduler_currentPhase"]);
        phases.get(&format!("scheduler_currentPhase({scheduler})")).cloned().unwrap_or_default()
    }
}

/// Whether the two verified models do what the ground model does, for so many steps. What ends in the ground model, ends in the model
/// whose elaborations take any time.
fn lock_step(system: &VerifiedSystem, seed: u64, steps: u64) {
    let drawn = system.chart.system.as_ref().expect("it has a system");
    let free: Vec<(&str, Vec<&str>)> = drawn
        .components
        .iter()
        .filter(|component| component.timing.period().is_none())
        .map(|component| (component.name.as_str(), component.phases.iter().map(|phase| phase.name.as_str()).collect()))
        .collect();
    let (mut ground, mut verified) = (Run::new(&system.ground, seed), Run::new(&system.loaded, seed));
    let mut general = system.general.as_ref().map(|loaded| Run::new(loaded, seed));
    let mut seen = BTreeSet::new();
    for number in 0..steps {
        let before: Vec<String> = free.iter().map(|(name, _)| ground.phase(name)).collect();
        ground.step();
        verified.step();
        let kept = ground.kept();
        assert_eq!(kept, verified.kept(), "seed {seed}, step {number}");
        let Some(general) = &mut general else { continue };
        let left = free
            .iter()
            .zip(&before)
            .filter(|((name, phases), before)| phases.contains(&before.as_str()) && ground.phase(name) != **before);
        let ending: BTreeSet<String> = left.map(|((name, _), _)| (*name).to_string()).collect();
        // A synchronous elaboration ends when it does in the ground model: its inputs are the same.
        let mut drawn_inputs = Inputs { seed, step: number + 1, ending: None };
        let others = drawn.components.iter().filter(|component| component.timing.period().is_some());
        let mut all = ending;
        for component in others {
            let mut hasher = DefaultHasher::new();
            (drawn_inputs.seed, drawn_inputs.step, component.name.as_str()).hash(&mut hasher);
            if hasher.finish().is_multiple_of(4) {
                all.insert(component.name.clone());
            }
        }
        drawn_inputs.ending = Some(all);
        general.inputs = Inputs { step: number, ..drawn_inputs };
        general.step();
        assert_eq!(kept, general.kept(), "any length: seed {seed}, step {number}");
        seen.insert(kept.into_iter().collect::<Vec<_>>());
    }
    assert!(system.general.is_none() || seen.len() > 20, "{} states", seen.len());
}

#[test]
fn the_verified_models_do_what_the_ground_model_does() {
    let small = system(SMALL);
    assert!(small.general.is_some());
    for seed in 0..3 {
        lock_step(&small, seed, 250);
    }
    for path in ["micro_assembly/AssemblySystem", "pick_and_place/PlacingSystem"] {
        let file = repository::root().join(format!("examples/{path}.chart"));
        let root = Disk::read(&file).expect("the example is there");
        let example = verified_system(root, &[], &|_| false, &mut Disk).unwrap_or_else(|faults| panic!("{faults:#?}"));
        lock_step(&example, 0, 60);
    }
}

fn searched(loaded: &Loaded) -> Report {
    let options = Options { max_states: 12_000, ..Options::default() };
    verify(&loaded.program, &options, &mut |_| true).unwrap_or_else(|trouble| panic!("{trouble:?}"))
}

fn violated(loaded: &Loaded, report: &Report) -> BTreeSet<String> {
    let found = report.verdicts.iter().filter(|verdict| matches!(verdict.outcome, Outcome::Violated(_)));
    found
        .map(|verdict| match verdict.subject {
            Subject::Property(index) => loaded.program.properties[index].name.clone(),
            other => format!("{other:?}"),
        })
        .collect()
}

#[test]
fn a_sound_system_holds_for_any_length() {
    let small = system(SMALL);
    let general = small.general.as_ref().expect("some times vary");
    let report = searched(general);
    assert_eq!(violated(general, &report), BTreeSet::new());
    assert!(report.complete, "{} states", report.progress.states);
    assert!(report.verdicts.iter().all(|verdict| matches!(verdict.outcome, Outcome::Holds)), "{:#?}", report.verdicts);
}

/// Changes the small chart, and returns what is violated as it is drawn. Each run must violate the ground model's property, too.
fn seeded(from: &str, to: &str) -> BTreeSet<String> {
    assert!(SMALL.contains(from), "{from}");
    let system = system(&SMALL.replace(from, to));
    let report = searched(&system.loaded);
    for verdict in &report.verdicts {
        let Outcome::Violated(trace) = &verdict.outcome else { continue };
        let asked = (&*system.loaded.program, &system.loaded.sources);
        let run = system.ground_run(Limits::default(), asked, verdict.subject, trace).expect("the run is made");
        assert_ne!(run.violates, Some(false), "{:?}", verdict.subject);
        system.tell_run(Limits::default(), asked, verdict.subject, trace).expect("the run is told");
    }
    violated(&system.loaded, &report)
}

#[test]
fn what_is_seeded_is_found() {
    // Once in a while the longer elaboration ends after the deadline.
    let late = seeded("elaborate acquire 1..2 ms", "elaborate acquire 1..6 ms");
    assert!(late.contains("inv_deadlines"), "{late:?}");
    // It ends after the period whenever it takes its longest time.
    let overrun = seeded("elaborate drive 2 ms", "elaborate drive 2..11 ms");
    assert!(overrun.contains("inv_deadlines") && overrun.contains("inv_periods"), "{overrun:?}");
    assert_eq!(seeded("elaborate think 2..6 ms", "elaborate think 2..7 ms"), BTreeSet::new());
}

#[test]
fn what_is_not_kept_is_named() {
    let small = system(SMALL);
    let read = |text: &str| {
        let mut asked = small.loaded.overlay();
        asked.property(PropertyKind::Invariant, "asked", text).unwrap_or_else(|faults| panic!("{faults:#?}"));
        not_kept(&asked.program, &asked.program.properties.last().expect("it was added").formula, &[])
    };
    assert_eq!(read("task_cycles(act_task) < 5"), ["task_cycles"]);
    assert_eq!(read("scheduler_currentScheduleTime(plan) < 3"), ["clock", "scheduler_actionStart"]);
    assert_eq!(read("mq_refused(orders) = 0"), ["mq_refused"]);
    assert_eq!(read("mq_sent(orders) < 9"), ["mq_sent"]);
    assert_eq!(read("time(plan_think) > 0"), ["time"]);
    for kept in [
        "scheduler_currentPhase(act) = act_drive implies scheduler_currentPhase(plan) != plan_wait",
        "mq_length(orders) <= 2 and not mq_isFull(orders)",
        "isLocked(level_lock) implies sem_state(level_lock, plan_task) = EXECUTION",
        "activity(plan) = ELABORATION implies sb_fresh(level)",
    ] {
        assert_eq!(read(kept), [] as [&str; 0], "{kept}");
    }
}
