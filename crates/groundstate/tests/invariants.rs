//! Skipping an invariant's evaluation does not change its value: runs that evaluate only invariants that may have
//! changed record the same as runs that evaluate all.

use std::sync::Arc;

use groundstate::simulate::{Bounds, Choices, Inputs, Invariants, Options, RandomSource, Record, Run};
use program::Program;
use syntax::SourceFile;
use testkit::{Disk, repository};

fn load(source: SourceFile) -> Arc<Program> {
    let name = source.name.clone();
    groundstate::load(source, &mut Disk).unwrap_or_else(|faulty| panic!("{name}: {faulty:#?}")).program
}

/// The records of a run; `all` evaluates every invariant in every state.
fn records(program: &Arc<Program>, steps: u64, seed: u64, all: bool) -> Vec<Record> {
    let inputs = Inputs::new().with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed));
    let options = Options { steps: Some(steps), invariants: Invariants::Report, ..Options::default() };
    let mut run = Run::new(Arc::clone(program), machine::Limits::default(), inputs, options);
    let mut records = Vec::new();
    while let Some(record) = run.advance() {
        if all {
            run.machine_mut();
        }
        records.push(record);
    }
    records
}

/// How many violations the runs recorded.
fn check(program: &Arc<Program>, steps: u64, seeds: u64, name: &str) -> usize {
    let mut violations = 0;
    for seed in 0..seeds {
        let (some, all) = (records(program, steps, seed, false), records(program, steps, seed, true));
        assert_eq!(some.len(), all.len(), "{name}, seed {seed}");
        for (index, (some, all)) in some.iter().zip(&all).enumerate() {
            assert_eq!(some, all, "{name}, seed {seed}, record {index}");
            if let Record::Step(step) = some {
                violations += step.violations.len();
            }
        }
    }
    violations
}

#[test]
fn the_models_of_this_project() {
    let found = ["examples", "library/patterns"].map(|folder| repository::files(folder, &["asm"])).concat();
    let seeds = if testkit::sample::is_full() { 2 } else { 1 };
    let mut checked = 0;
    for path in found {
        let program = load(Disk::read(&path).expect("a model is a text"));
        if program.main.is_some() {
            check(&program, 40, seeds, &path.display().to_string());
            checked += 1;
        }
    }
    assert!(checked > 15, "{checked} models");
}

/// What an invariant may depend on: locations, definitions, domains that grow, the clock, shared functions, inputs.
const DEPENDENCIES: &str = "asm test
import StandardLibrary
import TimeLibrary
signature:
    enum domain Colour = {RED | GREEN | BLUE}
    domain Small subsetof Integer
    dynamic abstract domain Job
    dynamic domain Chosen subsetof Job
    monitored colour: Colour
    monitored go: Boolean
    shared level: Integer
    controlled last: Colour
    controlled count: Colour -> Integer
    controlled idle: Integer
    controlled done: Job -> Boolean
    out shown: Integer
    derived many: Colour -> Boolean
    derived some: Boolean
definitions:
    domain Small = {0 : 3}
    function many($c in Colour) = count($c) > 3
    function some = (exist $c in Colour with many($c))
    invariant inv_constant over idle: 1 < 2
    invariant inv_never over idle: idle > 0
    invariant inv_location over count: count(RED) mod 3 != 1
    invariant inv_definition over count: not some
    invariant inv_jobs over Job: (forall $j in Job with isDef(done($j)))
    invariant inv_growth over Job: size({$j in Job : $j}) < 4
    invariant inv_clock over idle: currTimeSecs < 50
    invariant inv_shared over level: level < 5
    invariant inv_input over colour: colour != BLUE or last = BLUE
    invariant inv_shown over shown: shown mod 2 = 0
    main rule r_main = par
        if go then par last := colour count(colour) := count(colour) + 1 endpar endif
        if colour = GREEN then extend Job with $j do if go then done($j) := true endif endif
        if last = GREEN then forall $j in Job do done($j) := true endif
        if not go then level := level + 1 else if last = RED then level := 0 endif endif
        if last = BLUE then shown := shown + 1 endif
    endpar
default init s0:
    function count($c in Colour) = 0
    function idle = 0
    function shown = 0
    function level = 0
";

#[test]
fn everything_that_an_invariant_may_depend_on() {
    let program = load(SourceFile::new("test.asm", DEPENDENCIES));
    assert!(check(&program, 150, 2, "test.asm") > 300);
}
