//! A counterexample is a run of the whole system: machines that were left out of the search make their steps in it, and what machines
//! choose is chosen again.

use groundstate::verify::{Options, Outcome, Subject, Trace, verify};
use groundstate::{VerifiedSystem, counterexample_scenario, verified_system};
use machine::Limits;
use program::PropertyKind;
use syntax::SourceFile;
use testkit::{Texts, WithPatterns};

const LEVELS: &str = "module Levels
import StandardLibrary
export *
signature:
	enum domain Level = {LOW | HIGH}
definitions:
";

/// It asks for an input, and chooses.
const PLAN: &str = "asm Plan
import StandardLibrary
import Levels
signature:
	monitored button: Boolean
	out go: Level
definitions:
	main rule r_Main = choose $l in Level with $l = HIGH or not button do go := $l
default init s0:
	function go = LOW
";

/// It makes no step while it is hot: only some inputs will do.
const ACT: &str = "asm Act
import StandardLibrary
import Levels
signature:
	monitored hot: Boolean
	monitored go: Level
	out lamp: Boolean
definitions:
	main rule r_Main = if hot then lamp := 1 / 0 = 1.0 else lamp := go = HIGH endif
default init s0:
	function lamp = false
";

const TWO: &str = "chart Two
import Levels
import patterns/ControlTask
system two
	tick 1 ms
	sensor button : Boolean
	sensor hot : Boolean
	actuator lamp : Boolean
	component plan synchronous period 4 ms
		elaborate think 1..2 ms by Plan
		write go 1 ms
	endcomponent
	component act synchronous period 3 ms
		read go 1 ms
		elaborate do 1 ms by Act
	endcomponent
	channel go : Level from plan to act queue 1
	button -> plan
	hot -> act
	act -> lamp
endsystem
";

/// The system, a run that violates a property, and its ground model's verdict about it.
fn violated(property: &str, with_data: bool) -> (Box<VerifiedSystem>, groundstate::Overlay, Subject, Trace) {
    let files = Texts::of([("Levels.asm", LEVELS), ("Plan.asm", PLAN), ("Act.asm", ACT)]);
    let system = verified_system(SourceFile::new("Two.chart", TWO), &[], &|_| with_data, &mut WithPatterns(files));
    let system = system.unwrap_or_else(|faults| panic!("{faults:#?}"));
    let mut asked = system.loaded.overlay();
    let subject = Subject::Property(asked.program.properties.len());
    asked.property(PropertyKind::Invariant, "asked", property).unwrap_or_else(|faults| panic!("{faults:#?}"));
    let report = verify(&asked.program, &Options::default(), &mut |_| true).expect("there are initial states");
    let verdict = report.verdicts.into_iter().find(|verdict| verdict.subject == subject).expect("it was asked");
    let Outcome::Violated(trace) = verdict.outcome else { panic!("{:?}", verdict.outcome) };
    (system, asked, subject, *trace)
}

#[test]
fn machines_that_are_left_out_get_inputs() {
    let (system, asked, subject, trace) = violated("mq_length(go) = 0", false);
    let (whole, run) = system
        .whole_run(&Limits::default(), &asked.program, &trace)
        .expect("some inputs will do")
        .expect("they were left out");
    assert_eq!(run.steps.len(), trace.steps.len());
    let scenario = counterexample_scenario(whole, &run, subject, "two", "Two.asm");
    for line in ["set button := ", "set hot := false;", "pick $l in r_plan_Main := ", "set endsNow(plan) := true;"] {
        assert!(scenario.contains(line), "{line}: {scenario}");
    }
}

#[test]
fn what_machines_choose_is_chosen_again() {
    let (system, asked, subject, trace) = violated("plan_go = LOW", true);
    assert!(matches!(system.whole_run(&Limits::default(), &asked.program, &trace), Ok(None)), "nothing is left out");
    let run = system.ground_run(Limits::default(), (&asked.program, &asked.sources), subject, &trace);
    assert_eq!(run.expect("the ground model makes it").violates, Some(true));
}
