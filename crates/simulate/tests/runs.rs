//! Runs as a whole: steps with and without records make the same run, and a seed draws the same values for ever.

use std::sync::Arc;

use machine::{EngineChoice, Limits, Show};
use program::Program;
use simulate::{Bounds, Choices, End, Inputs, Invariants, Options, RandomSource, Record, Recorded, Run};
use syntax::SourceFile;
use testkit::NoFiles;

/// Inputs of several domains, with arguments and without; choices; a domain that grows and is drawn from.
const MODEL: &str = "asm test
import StandardLibrary
signature:
    enum domain Colour = {RED | GREEN | BLUE}
    abstract domain Robot
    dynamic abstract domain Job
    domain Small subsetof Integer
    static wall: Robot
    static eve: Robot
    monitored colour: Colour
    monitored level: Small
    monitored anything: Integer
    monitored seen: Prod(Robot, Small) -> Boolean
    monitored liked: Colour -> Natural
    monitored job: Job
    controlled last: Colour
    controlled sum: Integer
    controlled count: Robot -> Integer
    controlled picked: Small
    controlled current: Job
definitions:
    domain Small = {1 : 4}
    invariant inv_sum over sum: sum < 1000000
    invariant inv_level over level: level > 0
    main rule r_main = par
        last := colour
        sum := sum + anything + liked(colour)
        forall $r in Robot with seen($r, level) do count($r) := count($r) + 1
        choose $s in Small, $t in Small with $s < $t do picked := $t - $s
        choose $c in Colour with true do skip
        if sum > 5 then extend Job with $j do current := $j
        else if (exist $k in Job with true) then current := job endif endif
    endpar
default init s0:
    function sum = 0
    function count($r in Robot) = 0
";

fn program() -> Arc<Program> {
    program_of(MODEL)
}

fn program_of(text: &str) -> Arc<Program> {
    let checked = model::check(SourceFile::new("test.asm", text), &mut NoFiles);
    let errors: Vec<_> = checked.diagnostics.iter().filter(|d| d.severity == syntax::Severity::Error).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    Arc::new(program::lower(&checked.model).expect("small enough"))
}

fn run(program: &Arc<Program>, keep: bool) -> Run {
    run_by(program, Options { keep, ..Options::default() })
}

fn run_by(program: &Arc<Program>, options: Options) -> Run {
    let inputs = Inputs::new().with(RandomSource::new(7, Bounds::default())).choosing(Choices::random(7));
    let invariants = if options.invariants == Invariants::Stop { Invariants::Report } else { options.invariants };
    let options = Options { steps: Some(300), invariants, ..options };
    Run::new(Arc::clone(program), Limits::default(), inputs, options)
}

#[test]
fn passing_makes_the_same_steps() {
    let program = program();
    let mut recorded = run(&program, true);
    let (mut steps, mut changed) = (0, 0);
    while let Some(record) = recorded.advance() {
        if let Record::Step(step) = record {
            steps += 1;
            changed += u64::from(step.changed);
        }
    }
    assert_eq!(steps, 300);
    // With invariants each state is looked at; without them nobody looks.
    for invariants in [Invariants::Report, Invariants::Ignore] {
        for engine in [EngineChoice::Interpreted, EngineChoice::Automatic, EngineChoice::Compiled] {
            let mut passed = run_by(&program, Options { keep: false, invariants, engine, ..Options::default() });
            let first = passed.pass(100);
            let rest = passed.pass(1_000);
            assert_eq!((first.steps, first.steps + rest.steps, first.changed + rest.changed), (100, steps, changed));
            assert_eq!(passed.machine().locations(), recorded.machine().locations());
            assert_eq!((passed.steps(), passed.machine().steps()), (300, 300));
        }
    }
}

#[test]
fn a_fault_ends_passing_where_it_ends_a_run() {
    let text = "asm test\nimport StandardLibrary\nsignature:\ncontrolled x: Integer\ncontrolled y: Integer\n\
        definitions:\nmain rule r_main = par x := x + 1 if x = 290 then par y := 1 y := 2 endpar endif endpar\n\
        default init s0: function x = 0\n";
    let checked = model::check(SourceFile::new("test.asm", text.to_string()), &mut NoFiles);
    let program = Arc::new(program::lower(&checked.model).expect("small enough"));
    for engine in [EngineChoice::Interpreted, EngineChoice::Automatic, EngineChoice::Compiled] {
        let mut run = run_by(&program, Options { keep: false, engine, ..Options::default() });
        assert_eq!(run.pass(1_000).steps, 290);
        let end = run.advance();
        let Some(Record::End(End::Fault(fault))) = end else { panic!("{end:?}") };
        assert!(matches!(fault.kind, machine::FaultKind::InconsistentUpdate { .. }), "{fault:?}");
        assert_eq!(run.machine().steps(), 290);
        assert!(run.advance().is_none());
    }
}

#[test]
fn a_seed_draws_the_same_values_for_ever() {
    let program = program();
    let mut run = run(&program, true);
    let mut shown = String::new();
    for _ in 0..4 {
        match run.advance() {
            Some(Record::Step(step)) => {
                for (location, value) in &step.inputs {
                    shown += &format!("{}={} ", location.show(&program), value.show(&program));
                }
                let chosen: Vec<_> = step.choices.iter().map(|choice| choice.index).collect();
                shown += &format!("chosen {chosen:?}\n");
            }
            _ => continue,
        }
    }
    expect_test::expect![[r#"
        colour=BLUE anything=5 liked(BLUE)=10 level=1 seen(wall,1)=true seen(eve,1)=true chosen [2, 2]
        colour=BLUE anything=-4 liked(BLUE)=9 level=1 seen(wall,1)=true seen(eve,1)=false chosen [1, 1]
        colour=BLUE anything=-1 liked(BLUE)=4 level=4 seen(wall,4)=true seen(eve,4)=true chosen [4, 1]
    "#]]
    .assert_eq(&shown);
}

/// Initial values that are due when they are first read, in a later step: of an input that was asked for at the start, and
/// of one that was not.
const LATE: &str = "asm test
import StandardLibrary
signature:
    monitored first: Integer
    monitored other: Natural -> Integer
    controlled start: Integer
    controlled n: Natural
    controlled early: Natural -> Integer
    controlled late: Natural -> Integer
    controlled kept: Natural -> Integer
    controlled seen: Natural -> Prod(Integer, Integer)
definitions:
    main rule r_main = par
        n := n + 1n
        kept(n) := first
        seen(n) := (early(n), late(n))
    endpar
default init s0:
    function start = first
    function n = 0n
    function early($x in Natural) = first
    function late($x in Natural) = other($x)
";

#[test]
fn late_initial_values_read_inputs() {
    let program = program_of(LATE);
    let inputs = Inputs::new().with(RandomSource::new(4, Bounds::default()));
    let mut run =
        Run::new(Arc::clone(&program), Limits::default(), inputs, Options { steps: Some(4), ..Options::default() });
    let mut told = String::new();
    while let Some(record) = run.advance() {
        if let Record::Step(step) = record {
            let inputs = step.inputs.iter().map(|(l, v)| format!("{} = {}", l.show(&program), v.show(&program)));
            told.push_str(&format!("{}\n", inputs.collect::<Vec<_>>().join(", ")));
        }
    }
    for (location, value) in run.machine().locations() {
        told.push_str(&format!("{} = {}\n", location.show(&program), value.show(&program)));
    }
    expect_test::expect![[r#"
        first = 2, other(0) = 7
        first = 1, other(1) = 9
        first = -4, other(2) = 4
        first = 7, other(3) = 6
        first = 7
        other(3) = 6
        start = 2
        n = 4
        early(0) = 2
        early(1) = 2
        early(2) = 2
        early(3) = 2
        late(0) = 7
        late(1) = 9
        late(2) = 4
        late(3) = 6
        kept(0) = 2
        kept(1) = 1
        kept(2) = -4
        kept(3) = 7
        seen(0) = (2,7)
        seen(1) = (2,9)
        seen(2) = (2,4)
        seen(3) = (2,6)
    "#]]
    .assert_eq(&told);
}

/// Also where the initial state is one of several.
#[test]
fn records_are_enough_to_make_the_run_again() {
    let choosing = MODEL.replace("function sum = 0", "function sum = chooseone({10, 20, 30})");
    let options = || Options { steps: Some(5), ..Options::default() };
    for (text, seed) in [(MODEL, 1), (&choosing, 1), (&choosing, 2), (&choosing, 3), (LATE, 1)] {
        let program = program_of(text);
        let inputs = Inputs::new().with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed));
        let mut run = Run::new(Arc::clone(&program), Limits::default(), inputs, options());
        let mut again = Recorded::new(Arc::clone(&program), Limits::default(), options());
        while let Some(record) = run.advance() {
            if let Record::Initial { choices, .. } = &record {
                assert_eq!(choices.len(), usize::from(text == choosing));
            }
            again.follow(&record).unwrap_or_else(|parted| panic!("seed {seed}: {parted:?}"));
        }
    }
}
