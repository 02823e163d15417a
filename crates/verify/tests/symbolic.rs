//! Symbolic and explicit search agree: the same verdicts, the same counts, shortest runs of equal length.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::Duration;

use machine::{Bounds, Cause, Interrupt, Limits, Value};
use model::Basic;
use program::{DomainKind, FunctionId, FunctionKind, Program};
use syntax::{Severity, SourceFile};
use testkit::{repository, sample};
use verify::{EngineKind, Options, Outcome, Report, Subject, verify};

use crate::models::{Disk, lowered};

fn reference(name: &str, change: impl Fn(&str) -> String) -> Arc<Program> {
    let path = repository::root().join("bench/models/verify").join(name);
    let file = Disk::read(&path).expect("the model is there");
    lowered(SourceFile::new(file.name.clone(), change(&file.text)))
}

fn model(text: &str) -> Arc<Program> {
    lowered(SourceFile::new("example.asm", format!("asm example\nimport StandardLibrary\nsignature:\n{text}\n")))
}

fn by(engine: EngineKind, program: &Arc<Program>) -> Report {
    let options = Options { engine, ..Options::default() };
    verify(program, &options, &mut |_| true).expect("there is an initial state")
}

/// A request to stop that comes after some seconds, unless the sender is dropped before: a single state may have more alternatives
/// than anybody goes through.
fn patience() -> (Interrupt, Sender<()>) {
    let interrupt = Interrupt::new();
    let (sender, done) = channel();
    let late = interrupt.clone();
    std::thread::spawn(move || {
        if done.recv_timeout(Duration::from_secs(10)) == Err(RecvTimeoutError::Timeout) {
            late.raise(Cause::Asked);
        }
    });
    (interrupt, sender)
}

/// Each verdict, with the length of its run.
fn verdicts(report: &Report) -> Vec<(Subject, String)> {
    let word = |outcome: &Outcome| match outcome {
        Outcome::Holds => "holds".to_string(),
        Outcome::Violated(trace) => format!("violated in {} steps", trace.steps.len()),
        Outcome::Unknown(reasons) => format!("unknown {reasons:?}"),
    };
    report.verdicts.iter().map(|verdict| (verdict.subject, word(&verdict.outcome))).collect()
}

/// The values that inputs over infinite domains are given.
fn bounds(program: &Program) -> Bounds {
    let infinite = |domain| matches!(program.domain(domain).kind, DomainKind::Basic(Basic::Integer | Basic::Natural));
    let inputs = program.functions.iter().zip(0..).filter(|(function, _)| {
        matches!(function.kind, FunctionKind::Monitored | FunctionKind::Shared) && infinite(function.codomain)
    });
    inputs.map(|(_, index)| (FunctionId(index), vec![Value::Integer(0), Value::Integer(1)])).collect()
}

#[track_caller]
fn agree(program: &Arc<Program>) -> Report {
    let explicit = by(EngineKind::Explicit, program);
    let symbolic = by(EngineKind::Symbolic, program);
    assert_eq!(symbolic.engine, EngineKind::Symbolic);
    assert_eq!(verdicts(&symbolic), verdicts(&explicit));
    assert_eq!(symbolic.progress.states, explicit.progress.states);
    assert_eq!(symbolic.unreachable, explicit.unreachable);
    symbolic
}

#[test]
fn the_swinging_buffer() {
    assert_eq!(agree(&reference("Swing.asm", str::to_string)).progress.states, 203);
    let unlocked = agree(&reference("SwingUnlocked.asm", str::to_string));
    assert!(verdicts(&unlocked).iter().any(|(_, word)| word == "violated in 12 steps"), "{:?}", verdicts(&unlocked));
}

#[test]
fn philosophers() {
    let of = |count: u32| {
        reference("Phil12.asm", move |text| {
            text.replace("{0 : 11}", &format!("{{0 : {}}}", count - 1)).replace("mod 12", &format!("mod {count}"))
        })
    };
    assert_eq!(agree(&of(7)).progress.states, 3u64.pow(7) - 1);
    // No other engine would finish.
    let count = if testkit::sample::is_full() { 24 } else { 18 };
    let many = by(EngineKind::Symbolic, &of(count));
    assert_eq!(many.progress.states, 3u64.pow(count) - 1);
    let stuck = verdicts(&many);
    assert!(stuck.contains(&(Subject::NoDeadlock, format!("violated in {count} steps"))), "{stuck:?}");
}

#[test]
fn a_chain_of_buffers() {
    agree(&reference("ChainXS.asm", str::to_string));
}

#[test]
fn channels() {
    let small = |text: &str| text.replace("capacity = 8", "capacity = 2").replace("Datum = {0 : 7}", "Datum = {0 : 1}");
    agree(&reference("AlternatingBit.asm", small));
}

#[test]
fn faults_and_rest() {
    let report = agree(&model(
        "enum domain Light = {RED | GREEN | YELLOW}
        domain Small subsetof Integer
        monitored go: Boolean
        controlled light: Light
        controlled count: Small
        controlled mark: Integer
        definitions:
        domain Small = {0 : 5}
        invariant inv_mark over mark: mark < 3
        invariant inv_go over go: go or count < 4
        main rule r_main = par
            if go then count := count + 1 endif
            if count = 2 then light := GREEN endif
            if count = 2 and light = YELLOW then light := RED endif
            if not go and light = GREEN then par light := YELLOW mark := count endpar endif
        endpar
        default init s: function light = RED function count = 0 function mark = 0",
    ));
    let words: Vec<String> = verdicts(&report).into_iter().map(|(_, word)| word).collect();
    assert!(words.contains(&"violated in 6 steps".to_string()), "{words:?}");
}

#[test]
fn choices_without_a_candidate() {
    agree(&model(
        "domain Small subsetof Integer
        controlled left: Small -> Boolean
        controlled rounds: Small
        definitions:
        domain Small = {0 : 3}
        main rule r_main = choose $s in Small with left($s) do left($s) := false
            ifnone if rounds < 3 then par rounds := rounds + 1 forall $t in Small with true do left($t) := true endpar endif
        default init s: function left($s in Small) = true function rounds = 0",
    ));
}

#[test]
fn values_without_a_bound_of_their_own() {
    agree(&model(
        "controlled x: Integer
        controlled word: Seq(Integer)
        definitions:
        invariant inv_x over x: x < 60
        main rule r_main = choose $d in {1, 2} with x + $d < 64 do par x := x + $d if x mod 8 = 0 then word := [x] endif endpar
        default init s: function x = 0 function word = [0]",
    ));
}

/// `GROUNDSTATE_CASES` sets how many models, `GROUNDSTATE_SEED` the first seed.
#[test]
fn random_models() {
    const STATES: u64 = 400;
    let seeds = sample::seeds(120, 1_000);
    let cases = seeds.end - seeds.start;
    let (mut compared, mut several) = (0, 0);
    for seed in seeds {
        let text = oracle::generate::model(seed, 1).to_string();
        let checked = model::check(SourceFile::new("Model.asm", text.clone()), &mut Disk);
        if checked.diagnostics.iter().any(|found| found.severity == Severity::Error) {
            continue;
        }
        let Ok(program) = program::lower(&checked.model) else { continue };
        let program = Arc::new(program);
        let limits = Limits { iterations: 200, call_depth: 50, collection: 2000, ..Limits::default() };
        let (interrupt, _waiting) = patience();
        let options = Options { limits, bounds: bounds(&program), max_bytes: 4 << 20, interrupt, ..Options::default() };
        let few = Options { engine: EngineKind::Explicit, max_states: STATES, ..options.clone() };
        let Ok(explicit) = verify(&program, &few, &mut |progress| progress.transitions < 20_000) else { continue };
        if explicit.stop.is_some() {
            continue;
        }
        let sets = Options { engine: EngineKind::Symbolic, ..options };
        let symbolic = verify(&program, &sets, &mut |_| true).expect("it has begun before");
        if symbolic.stop.is_some() {
            continue;
        }
        assert_eq!(verdicts(&symbolic), verdicts(&explicit), "seed {seed}\n{text}");
        assert_eq!(symbolic.progress.states, explicit.progress.states, "seed {seed}\n{text}");
        assert_eq!(symbolic.unreachable, explicit.unreachable, "seed {seed}\n{text}");
        compared += 1;
        several += u64::from(symbolic.progress.states > 2);
    }
    assert!(compared > cases / 10 && several > cases / 30, "{compared} models, {several} with several states");
}
