//! A part of a system has all runs of the whole: each run of the whole is followed in the part, tick by tick, with what the whole had at
//! that moment for what the part leaves free. All that the part keeps, and when its tasks do what, must be the same.

use std::hash::{DefaultHasher, Hash, Hasher};

use groundstate::simulate::read_value;
use groundstate::{ReducedSystem, reduced_system, verified_system};
use machine::{Choice, Closed, Environment, LocationRef, TimeUnit, Value};
use program::{DomainId, Program, Term};
use syntax::SourceFile;
use testkit::{Texts, WithPatterns};

use crate::asked_run::AskedRun;

const COUNTING: &str = "asm Counting
import StandardLibrary
import Levels
signature:
	monitored pulse: Boolean
	out count: Level
	out mark: Boolean
	controlled before: Boolean
definitions:
	rule r_count = par count := (count + 1) mod 4 mark := not mark endpar
	main rule r_Main = par before := pulse if pulse and not before then r_count[] endif endpar
default init s0:
	function count = 0
	function mark = false
	function before = false
";
const JUDGING: &str = "asm Judging
import StandardLibrary
import Levels
signature:
	monitored count: Level
	monitored isNewCount: Boolean
	out verdict: Level
	controlled last: Level
	controlled seen: Boolean
	derived isHigher: Boolean
definitions:
	function isHigher = isDef(last) and isDef(count) and count > last
	main rule r_Main =
		par
			last := count
			seen := isNewCount
			if isHigher then verdict := count else if isUndef(verdict) then verdict := 0 else skip endif endif
		endpar
default init s0:
	function seen = false
";
const ACTING: &str = "asm Acting
import StandardLibrary
import Levels
signature:
	monitored verdict: Level
	monitored isNewVerdict: Boolean
	monitored mark: Boolean
	monitored stop: Boolean
	out arm: Boolean
	controlled isHalted: Boolean
	controlled strokes: Level
definitions:
	main rule r_Main =
		if isHalted or stop then
			par isHalted := true arm := false endpar
		else
			par
				arm := isNewVerdict and isDef(verdict) and verdict > 1
				if mark = true then strokes := (strokes + 1) mod 4 else skip endif
			endpar
		endif
default init s0:
	function isHalted = false
	function arm = false
	function strokes = 0
";
const LEVELS: &str = "module Levels
import StandardLibrary
export *
signature:
	domain Level subsetof Integer
definitions:
	domain Level = {0 : 3}
";
const CELL: &str = "chart Cell
import patterns/ControlTask
import Levels
system cell
	tick 1 ms
	component counter synchronous period 7 ms
		elaborate look 1 ms by Counting
		write count 1 ms
		write mark 1 ms
	endcomponent
	component judge asynchronous awaits count
		read count 2 ms
		elaborate think 1..4 ms by Judging
		write verdict 2 ms
	endcomponent
	component actor synchronous period 13 ms
		read verdict 1 ms
		read mark 1 ms
		elaborate act 1..2 ms by Acting
	endcomponent
	sensor pulse : Boolean
	sensor stop : Boolean
	actuator arm : Boolean
	channel count : Level from counter to judge swinging buffer 2
	channel verdict : Level from judge to actor swinging buffer 3 master actor
	channel mark : Boolean from counter to actor shared value
	pulse -> counter
	stop -> actor
	actor -> arm
endsystem
";

fn files() -> WithPatterns {
    let machines = [("Counting.asm", COUNTING), ("Judging.asm", JUDGING), ("Acting.asm", ACTING)];
    WithPatterns(Texts::of(machines.into_iter().chain([("Levels.asm", LEVELS)])))
}

fn chart() -> SourceFile {
    SourceFile::new("Cell.chart", CELL)
}

fn drawn(of: impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    of.hash(&mut hasher);
    hasher.finish()
}

/// What an environment answers: by the name of the location.
type Answer<'a> = &'a dyn Fn(&str) -> Option<String>;

struct Given<'a>(Answer<'a>);

impl Environment for Given<'_> {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        let name = location.show(program).to_string();
        match (self.0)(&name) {
            Some(text) if text == "undef" => Ok(Value::Undef),
            Some(text) => read_value(program, codomain, &text),
            None => Err(format!("{name} is not known")),
        }
    }

    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Closed.choose(program, choice)
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        Closed.time(unit)
    }
}

const COMPONENTS: [&str; 3] = ["counter", "judge", "actor"];

fn phase(component: &str) -> String {
    format!("scheduler_currentPhase({component})")
}

/// Whether a function is derived from one of these.
fn rests_on(program: &Program, name: &str, free: &[String]) -> bool {
    let named = program.functions.iter().find(|function| function.name == name);
    let mut open: Vec<_> =
        named.and_then(|function| function.definition.as_ref()).map(|one| one.body).into_iter().collect();
    while let Some(id) = open.pop() {
        if let Term::Read { function, .. } | Term::Define { function, .. } = program.term(id) {
            let read = program.function(*function);
            if free.contains(&read.name) {
                return true;
            }
            open.extend(read.definition.as_ref().map(|one| one.body));
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    false
}

/// Follows runs of the whole in a part; returns in how many of their ticks something free was asked for.
fn follow(part: &ReducedSystem) -> usize {
    let whole = verified_system(chart(), &[], &|_| true, &mut files()).unwrap_or_else(|faults| panic!("{faults:#?}"));
    let text =
        part.system.ground.sources.iter().map(|(_, source)| source.text.to_string()).collect::<Vec<_>>().join("");
    let kept_tasks: Vec<&str> = COMPONENTS.into_iter().filter(|name| text.contains(&format!("{name}_task"))).collect();
    let kept = part.system.data.iter().filter(|name| !part.free.contains(name) && whole.data.contains(name));
    let kept: Vec<String> = kept.filter(|name| !["pulse", "stop"].contains(&name.as_str())).cloned().collect();
    // What is derived from something free has no value of its own between two steps.
    let kept: Vec<String> =
        kept.into_iter().filter(|name| !rests_on(&part.system.loaded.program, name, &part.free)).collect();
    assert!(!kept.is_empty());
    let same: Vec<String> = kept.iter().cloned().chain(kept_tasks.iter().map(|task| phase(task))).collect();
    // An actuator has the name of its function where nothing is left of it but that.
    let of_whole = |free: &str| match whole.data.iter().any(|name| name == free) {
        true => free.to_string(),
        false => free.split_once('_').map_or(free, |(_, device)| device).to_string(),
    };
    let free = part.free.iter().map(|name| of_whole(name));
    let all: Vec<String> = same.iter().cloned().chain(free).chain(COMPONENTS.map(phase)).collect();
    let mut asked = 0;
    for seed in 0..3_u64 {
        let closed = |_: &str| None;
        let mut long = AskedRun::new(&whole.loaded, &all, &mut Given(&closed));
        let mut short = AskedRun::new(&part.system.loaded, &same, &mut Given(&closed));
        for tick in 0..200_u64 {
            // Some runs end their elaborations early, others late; a stop is rare.
            let input = |name: &str| {
                let one_in = if name == "stop" { 200 } else { 2 + seed % 3 };
                Some(drawn((seed, tick, name)).is_multiple_of(one_in).to_string())
            };
            let before = long.values();
            long.step(&mut Given(&input));
            let after = long.values();
            let count = std::cell::Cell::new(0);
            let follows = |name: &str| {
                if let Some(task) = name.strip_prefix("endsNow(").and_then(|rest| rest.strip_suffix(')')) {
                    return Some((before[&phase(task)] != after[&phase(task)]).to_string());
                }
                match before.get(&of_whole(name)).filter(|_| part.free.iter().any(|free| free == name)) {
                    Some(value) => {
                        assert!(
                            value != "undef" || part.undefined.iter().any(|one| one == name),
                            "{name} may be undef"
                        );
                        count.set(1);
                        Some(value.clone())
                    }
                    None => input(name),
                }
            };
            short.step(&mut Given(&follows));
            asked += count.get();
            let in_part = short.values();
            for name in &same {
                assert_eq!(
                    in_part[name], after[name],
                    "{name} after tick {tick} of run {seed}, of {:?}",
                    part.components
                );
            }
        }
    }
    asked
}

fn part(spoken: &[&str], widenings: usize) -> Option<ReducedSystem> {
    let speaks_of = |name: &str| spoken.contains(&name);
    let part = reduced_system(chart(), &[], &speaks_of, widenings, &mut files());
    part.unwrap_or_else(|faults| panic!("{faults:#?}"))
}

#[test]
fn each_run_of_the_whole_is_one_of_each_part() {
    for spoken in [&["arm"][..], &["actor_strokes"], &["judge_verdict"], &["judge_seen", "arm"], &["counter_mark"]] {
        let mut widest = 0;
        while let Some(part) = part(spoken, widest) {
            follow(&part);
            widest += 1;
        }
        assert!(widest > 0, "{spoken:?} has no part");
    }
    let least = part(&["arm"], 0).expect("a part");
    assert_eq!(least.components, ["actor"]);
    assert!(
        least.free.contains(&"actor_verdict".to_string())
            && !least.undefined.contains(&"actor_isNewVerdict".to_string())
    );
    assert!(follow(&least) > 20, "what is free is asked for");
}

#[test]
fn nothing_is_left_out_where_it_could_make_a_difference() {
    // A task that may give up waiting.
    let hurried = CELL.replace("actor synchronous period 13 ms", "actor synchronous period 7 ms");
    let part = reduced_system(SourceFile::new("Cell.chart", hurried), &[], &|name| name == "arm", 0, &mut files());
    assert!(part.expect("no faults").is_none());
    // A function that is read again after an update in the same step brings all of its machine.
    let acting = ACTING
        .replace("\tmain rule r_Main =\n", "\tmain rule r_Main = seq strokes := 0\n")
        .replace("endif\ndefault", "endif endseq\ndefault");
    let machines =
        [("Counting.asm", COUNTING), ("Judging.asm", JUDGING), ("Acting.asm", &acting), ("Levels.asm", LEVELS)];
    let part = reduced_system(chart(), &[], &|name| name == "arm", 0, &mut WithPatterns(Texts::of(machines)));
    let free = part.expect("no faults").map(|part| part.free).unwrap_or_default();
    assert!(free.iter().all(|name| !name.starts_with("actor_")), "{free:?}");
}
