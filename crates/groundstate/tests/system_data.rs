//! What is verified of a system with its data is the system: values lie where the ground model has them, tick by tick, in channels of
//! every kind; what machines decide is the same; and what is violated is violated by a run of the ground model.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use groundstate::simulate::read_value;
use groundstate::verify::{Options, Outcome, verify};
use groundstate::{Loaded, VerifiedSystem, not_kept, verified_system};
use machine::{Choice, Closed, Environment, Limits, LocationRef, TimeUnit, Value};
use program::{DomainId, Program, PropertyKind};
use syntax::SourceFile;
use testkit::{Texts, WithPatterns};

use crate::asked_run::AskedRun;

const LEVELS: &str = "module Levels
import StandardLibrary
export *
signature:
	domain Level subsetof Integer
definitions:
	domain Level = {0 : 3}
";

const PLAN: &str = "asm Plan
import StandardLibrary
import Levels
signature:
	monitored level: Level
	monitored isNewLevel: Boolean
	out orders: Level
	out goal: Prod(Level, Boolean)
	controlled old: Level
definitions:
	main rule r_Main =
		par
			if isNewLevel then old := level endif
			orders := if old = level then 0 else level endif
			goal := (old, isNewLevel)
		endpar
default init s0:
	function old = 0
";

const ACT: &str = "asm Act
import StandardLibrary
import Levels
signature:
	monitored orders: Level
	monitored isNewOrders: Boolean
	monitored goal: Prod(Level, Boolean)
	monitored level: Level
	monitored isNewLevel: Boolean
	monitored stop: Boolean
	out done: Level
	derived isAhead: Boolean
definitions:
	function isAhead = isDef(goal) and isDef(level) and first(goal) > level
	main rule r_Main =
		if stop then
			done := undef
		else
			done := if isNewOrders then orders else if isAhead or isNewLevel then 3 else 1 endif endif
		endif
";

const WATCH: &str = "asm Watch
import StandardLibrary
import Levels
signature:
	monitored done: Level
	out lamp: Boolean
	controlled seen: Level
definitions:
	main rule r_Main = par seen := done lamp := done = seen endpar
";

/// Every kind of channel; one with two readers; times that vary.
const CELL: &str = "chart Small
import Levels
import patterns/ControlTask
system small
	tick 1 ms
	sensor stop : Boolean
	actuator lamp : Boolean
	component sense synchronous period 8 ms offset 3 ms
		elaborate acquire 1 ms
		write level 1 ms
	endcomponent
	component plan asynchronous awaits level
		read level 1 ms
		elaborate think 2..6 ms by Plan
		write orders 1 ms
		write goal 1 ms
	endcomponent
	component act synchronous period 12 ms
		read orders 1 ms
		read goal 1 ms
		read level 1 ms
		elaborate drive 2 ms by Act
		write done 1 ms
	endcomponent
	component watch asynchronous awaits done
		read done 1 ms
		elaborate look 1..5 ms by Watch
	endcomponent
	channel level : Level from sense to plan, act swinging buffer 2
	channel orders : Level from plan to act queue 2
	channel goal : Prod(Level, Boolean) from plan to act shared value
	channel done : Level from act to watch swinging buffer 3
	stop -> act
	watch -> lamp
endsystem
";

/// Writings and readings that meet in one tick: the periods have no common divisor.
const TIGHT: &str = "chart Small
import Levels
import patterns/ControlTask
system small
	tick 1 ms
	component sense synchronous period 5 ms
		elaborate acquire 1 ms
		write level 1 ms
	endcomponent
	component plan synchronous period 7 ms
		read level 1 ms
		elaborate think 1 ms by Plan
		write orders 1 ms
		write goal 1 ms
	endcomponent
	component act synchronous period 6 ms
		read goal 1 ms
		read orders 1 ms
		read level 1 ms
		elaborate drive 1 ms by Act
		write done 1 ms
	endcomponent
	component watch synchronous period 11 ms
		read done 1 ms
		elaborate look 1 ms by Watch
	endcomponent
	sensor stop : Boolean
	actuator lamp : Boolean
	channel level : Level from sense to plan, act shared value
	channel orders : Level from plan to act queue 1
	channel goal : Prod(Level, Boolean) from plan to act swinging buffer 2
	channel done : Level from act to watch queue 3
	stop -> act
	watch -> lamp
endsystem
";

fn files() -> WithPatterns {
    WithPatterns(Texts::of([("Levels.asm", LEVELS), ("Plan.asm", PLAN), ("Act.asm", ACT), ("Watch.asm", WATCH)]))
}

fn system(text: &str, speaks_of: &dyn Fn(&str) -> bool) -> Box<VerifiedSystem> {
    let system = verified_system(SourceFile::new("Small.chart", text), &[], speaks_of, &mut files());
    system.unwrap_or_else(|faults| panic!("{faults:#?}"))
}

/// Inputs drawn for each step and name.
struct Inputs {
    seed: u64,
    step: u64,
}

impl Environment for Inputs {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        let name = location.show(program).to_string();
        let mut hasher = DefaultHasher::new();
        (self.seed, self.step, &name).hash(&mut hasher);
        let drawn = hasher.finish();
        let text = match name.as_str() {
            "sense_level" => (drawn % 4).to_string(),
            _ => drawn.is_multiple_of(4).to_string(),
        };
        read_value(program, codomain, &text)
    }

    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Closed.choose(program, choice)
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        Closed.time(unit)
    }
}

#[test]
fn values_lie_where_the_ground_model_has_them() {
    for text in [CELL, TIGHT] {
        let small = system(text, &|_| true);
        let inputs = ["sense_level", "stop"];
        let kept: Vec<String> = small.data.into_iter().filter(|name| !inputs.contains(&name.as_str())).collect();
        for function in [
            "plan_old",
            "plan_isNewLevel",
            "act_level",
            "act_isNewOrders",
            "act_isAhead",
            "act_done",
            "watch_seen",
            "lamp",
        ] {
            assert!(kept.iter().any(|name| name == function), "{function}: {kept:?}");
        }
        lock_step(&small.ground, &small.loaded, &kept);
    }
}

#[test]
fn machines_on_which_nothing_rests_are_left_out() {
    for text in [CELL, TIGHT] {
        let (whole, part) = (system(text, &|_| true), system(text, &|function| function == "act_isAhead"));
        let names = |machines: Vec<&groundstate::chart::ComponentMachine>| {
            machines.iter().map(|one| one.component).collect::<Vec<_>>()
        };
        let (within, without) = part.machines();
        assert_eq!((names(within), names(without)), (vec![1, 2], vec![3]));
        let kept: Vec<String> =
            part.data.into_iter().filter(|name| !["sense_level", "stop"].contains(&name.as_str())).collect();
        assert!(
            kept.iter().any(|name| name == "act_done") && !kept.iter().any(|name| name.starts_with("watch")),
            "{kept:?}"
        );
        lock_step(&whole.ground, &part.loaded, &kept);
        let first = system(text, &|function| function == "plan_old");
        assert_eq!(names(first.machines().0), [1]);
        // What comes in can be asked about by itself.
        let given = system(text, &|function| function == "sense_level");
        assert_eq!((&given.data, given.machines().0.len()), (&vec!["sense_level".to_string()], 0));
    }
}

fn lock_step(ground: &Loaded, verified: &Loaded, kept: &[String]) {
    let mut seen: BTreeMap<String, std::collections::BTreeSet<String>> = BTreeMap::new();
    for seed in testkit::sample::seeds(3, 30) {
        let mut inputs = Inputs { seed, step: 0 };
        let mut first = AskedRun::new(ground, kept, &mut inputs);
        let mut second = AskedRun::new(verified, kept, &mut inputs);
        for step in 0..400 {
            inputs.step = step + 1;
            first.step(&mut inputs);
            second.step(&mut inputs);
            let (one, other) = (first.values(), second.values());
            assert_eq!(one, other, "seed {seed}, step {step}");
            one.into_iter().for_each(|(name, value)| _ = seen.entry(name).or_default().insert(value));
        }
    }
    // Each of them has had several values, or the comparison says little.
    assert!(seen.values().all(|values| values.len() > 1), "{seen:#?}");
}

#[test]
fn data_are_a_part_only_where_something_speaks_of_them() {
    assert_eq!(system(CELL, &|_| false).data, [""; 0]);
    assert_eq!(system(CELL, &|function| function == "level_plan_value").data, [""; 0]);
    let small = system(CELL, &|function| function == "lamp");
    let read = |text: &str| {
        let mut asked = small.loaded.overlay();
        asked.property(PropertyKind::Invariant, "asked", text).unwrap_or_else(|faults| panic!("{faults:#?}"));
        let formula = &asked.program.properties.last().expect("it was added").formula;
        not_kept(&asked.program, formula, &small.data)
    };
    assert_eq!(read("lamp implies act_isAhead or plan_level = 3"), [""; 0]);
    // Where values lie is the verified model's own business.
    assert_eq!(read("level_plan_atReader = plan_level"), ["level_plan_atReader"]);
    assert_eq!(read("orders_hasCome"), ["orders_hasCome"]);
    assert_eq!(read("watch_seen = task_cycles(act_task)"), ["task_cycles"]);
}

/// What is said of each invariant, and, if it is violated, by the ground model in the same run.
fn judged(invariants: &[&str]) -> Vec<Option<bool>> {
    let small = system(CELL, &|_| true);
    let mut asked = small.loaded.overlay();
    let own = small.loaded.program.properties.len();
    for text in invariants {
        asked.property(PropertyKind::Invariant, text, *text).unwrap_or_else(|faults| panic!("{faults:#?}"));
    }
    let options = Options { max_states: 60_000, ..Options::default() };
    let report = verify(&asked.program, &options, &mut |_| true).unwrap_or_else(|trouble| panic!("{trouble:?}"));
    let about = (&*asked.program, &asked.sources);
    let verdict = |index: usize| {
        let of = |verdict: &&groundstate::verify::Verdict| {
            verdict.subject == groundstate::verify::Subject::Property(own + index)
        };
        match &report.verdicts.iter().find(of).expect("it was asked").outcome {
            Outcome::Violated(trace) => {
                let subject = groundstate::verify::Subject::Property(own + index);
                let run = small.ground_run(Limits::default(), about, subject, trace).expect("the run is made");
                assert_eq!(run.violates, Some(true), "{}", invariants[index]);
                Some(true)
            }
            Outcome::Holds => Some(false),
            _ => None,
        }
    };
    (0..invariants.len()).map(verdict).collect()
}

#[test]
fn what_is_violated_is_violated_by_the_ground_model() {
    let violated =
        ["not lamp", "act_level != 2", "not (isDef(plan_goal) and second(plan_goal) and first(plan_goal) = 3)"];
    let kept = ["isDef(act_level) implies act_level <= 3", "plan_old = 0 or isDef(plan_level)"];
    let said = judged(&[violated, [kept[0], kept[1], "true"]].concat());
    assert_eq!(said[..3], [Some(true); 3]);
    assert!(said[3..].iter().all(|said| *said != Some(true)), "{said:?}");
}
