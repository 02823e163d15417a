//! A search that is interrupted, kept and continued ends like one that is not; a damaged checkpoint is refused.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::sync::Arc;

use program::Program;
use syntax::SourceFile;
use testkit::memory::{Memory, damaged};
use testkit::repository;
use verify::{NoSolvers, NoStart, Options, Outcome, Progress, Refusal, Report, Request, Stop};

use crate::models::{Disk, lowered};

fn program(name: &str) -> Arc<Program> {
    let path = repository::root().join(format!("bench/models/verify/{name}.asm"));
    lowered(Disk::read(&path).expect("the model is there"))
}

/// Integers, a domain that grows, and a function that becomes undef only after some steps.
fn growing(most: u32) -> Arc<Program> {
    let text = format!(
        "asm Grow\nimport StandardLibrary\nsignature:\n dynamic abstract domain Part\n monitored more: Boolean\n \
         controlled size: Part -> Integer\n controlled sum: Integer\n controlled square: Integer\n controlled last: Boolean\n\
         definitions:\n invariant inv_sum over sum: sum < {most}\n \
         main rule r_Main = if sum < 21 then if more then extend Part with $p do par size($p) := sum sum := sum + 2 endpar\n \
         else par sum := sum + 3 square := square + sum * sum if sum > 9 then last := undef endif endpar endif endif\n\
         default init s0:\n function sum = 0\n function square = 0\n function last = false\n"
    );
    lowered(SourceFile::new("Grow.asm", text))
}

fn check(program: &Arc<Program>, options: &Options, keeper: &mut Memory) -> Result<Report, NoStart> {
    let request = Request::of(program, options.clone()).kept(true).build().expect("nothing is in conflict");
    request.verify_kept(&mut NoSolvers, keeper, &mut |_: &Progress| true)
}

fn straight(program: &Arc<Program>, options: &Options) -> Report {
    verify::verify(program, options, &mut |_| true).expect("there is an initial state")
}

/// Interrupted again and again, with these numbers of workers in turn, a search ends as it does without interruptions.
fn agrees(program: &Arc<Program>, options: &Options, steps: u64, workers: &[usize]) {
    let whole = straight(program, &Options { workers: 1, engine: verify::EngineKind::Explicit, ..options.clone() });
    let mut keeper = Memory::default();
    for (index, workers) in workers.iter().copied().cycle().enumerate() {
        let max_states = steps * (index as u64 + 1);
        let report = check(program, &Options { workers, max_states, alone: Some(0), ..options.clone() }, &mut keeper);
        let report = report.expect("it goes on");
        if report.stop == Some(Stop::States) {
            assert!(keeper.kept.is_some() && report.verdicts.iter().all(|v| v.outcome != Outcome::Holds));
            continue;
        }
        // A search that ended at the first violation might continue without --first.
        assert_eq!(keeper.kept.is_some(), report.stop.is_some(), "a search that has ended is not kept");
        assert!(keeper.times > 2, "{}", keeper.times);
        assert_eq!(report.verdicts, whole.verdicts);
        assert_eq!(report.unreachable, whole.unreachable);
        let numbers = |report: &Report| (report.progress.states, report.progress.transitions, report.progress.depth);
        assert_eq!(numbers(&report), numbers(&whole));
        return;
    }
}

/// A sequence that becomes longer again and again, and a set that gets an element of no domain.
#[test]
fn what_becomes_too_narrow_on_the_way_is_found_again() {
    let text = "asm Longer\nimport StandardLibrary\nsignature:\n domain Small subsetof Integer\n controlled a: Seq(Small)\n \
                controlled n: Integer\n controlled s: Powerset(Prod(Small, Small))\ndefinitions:\n domain Small = {0 : 3}\n \
                invariant inv_short over a: length(a) < 4\n \
                main rule r_Main = choose $x in Small with length(a) < 6 and (n < 3 or $x > 1) do par a := append(a, $x) n := n + 1 \
                s := including(s, ($x, n)) endpar\ndefault init s0:\n function a = []\n function n = 0\n function s = {}\n";
    let program = lowered(SourceFile::new("Longer.asm", text));
    for workers in [&[1][..], &[2], &[1, 3]] {
        agrees(&program, &Options::default(), 100, workers);
    }
}

/// What a search has compiled is no part of the question that it answers.
#[test]
fn a_search_whose_steps_are_compiled_goes_on() {
    let may_grow = |name: &str| format!("if d{name} and {name} < 20 then {name} := {name} + 1 endif ");
    let text = format!(
        "asm Grid\nimport StandardLibrary\nsignature:\n domain Small subsetof Integer\n{}definitions:\n domain Small = {{0 : 20}}\n \
         main rule r_Main = par {} endpar\ndefault init s0:\n{}",
        ["x", "y", "z"].map(|name| format!(" controlled {name}: Small\n monitored d{name}: Boolean\n")).concat(),
        ["x", "y", "z"].map(may_grow).concat(),
        ["x", "y", "z"].map(|name| format!(" function {name} = 0\n")).concat(),
    );
    let program = lowered(SourceFile::new("Grid.asm", text));
    let options = Options { engine: verify::EngineKind::Explicit, ..Options::default() };
    assert!(straight(&program, &options).progress.compiled > 0, "its steps are to be compiled");
    agrees(&program, &options, 3_000, &[1, 2]);
}

#[test]
fn an_interrupted_search_ends_as_one_that_is_not() {
    agrees(&program("Swing"), &Options::default(), 20, &[1]);
    agrees(&program("SwingUnlocked"), &Options::default(), 20, &[2, 1, 3]);
    agrees(&program("ChainXS"), &Options::default(), 3_000, &[1, 2]);
    agrees(&program("Phil12"), &Options::default(), 100_000, &[2, 1]);
}

#[test]
fn values_without_bound_are_numbered_again() {
    for (most, first) in [(14, false), (14, true), (1000, false)] {
        let (program, terminal) = (growing(most), None);
        agrees(&program, &Options { first, terminal, ..Options::default() }, 6, &[2, 1]);
    }
}

#[test]
fn pauses_change_nothing() {
    for (program, every) in [(program("ChainXS"), 3), (growing(14), 2)] {
        let whole = straight(&program, &Options { engine: verify::EngineKind::Explicit, ..Options::default() });
        for workers in [1, 2] {
            let mut keeper = Memory::every(every);
            let report = check(&program, &Options { workers, alone: Some(0), ..Options::default() }, &mut keeper)
                .expect("it starts");
            assert!(keeper.times > 2);
            assert_eq!((report.verdicts, report.unreachable), (whole.verdicts.clone(), whole.unreachable.clone()));
            assert_eq!(report.progress.states, whole.progress.states);
        }
    }
}

/// A checkpoint of an incomplete search.
fn kept(program: &Arc<Program>) -> Memory {
    let mut keeper = Memory::of(7, None);
    check(program, &Options { max_states: 60, ..Options::default() }, &mut keeper).expect("it starts");
    assert!(keeper.kept.is_some());
    keeper
}

fn refused(program: &Arc<Program>, options: &Options, keeper: &mut Memory) -> Option<Refusal> {
    match check(program, options, keeper) {
        Err(NoStart::Refused(refusal)) => Some(refusal),
        _ => None,
    }
}

#[test]
fn what_is_of_something_else_is_refused() {
    let program = program("Swing");
    let mut keeper = kept(&program);
    keeper.model = 8;
    assert_eq!(refused(&program, &Options::default(), &mut keeper), Some(Refusal::Model));
    keeper.model = 7;
    let other = Options { limits: machine::Limits { iterations: 3, ..Default::default() }, ..Options::default() };
    assert_eq!(refused(&program, &other, &mut keeper), Some(Refusal::Question));
    assert_eq!(refused(&growing(14), &Options::default(), &mut keeper), Some(Refusal::Question));
    keeper.kept.as_mut().expect("kept")[1] += 1;
    assert_eq!(refused(&program, &Options::default(), &mut keeper), Some(Refusal::Version));
    keeper.kept = Some(vec![1, 2, 3]);
    assert_eq!(refused(&program, &Options::default(), &mut keeper), Some(Refusal::Foreign));
    keeper.kept = Some(Vec::new());
    assert_eq!(refused(&program, &Options::default(), &mut keeper), Some(Refusal::Foreign));
}

#[test]
fn what_is_damaged_is_refused() {
    for program in [program("Swing"), growing(14)] {
        let whole = kept(&program).kept.expect("kept");
        for (what, kept) in damaged(&whole) {
            let mut keeper = Memory::of(7, Some(kept));
            assert!(refused(&program, &Options::default(), &mut keeper).is_some(), "{what}");
        }
        let longer = [&whole[..], &[0]].concat();
        let mut keeper = Memory::of(7, Some(longer));
        assert_eq!(refused(&program, &Options::default(), &mut keeper), Some(Refusal::Damaged));
    }
}
