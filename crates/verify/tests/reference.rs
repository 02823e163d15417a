//! The systems of the reference models, with the numbers of states that other checkers find, and the faults of the
//! faulty ones. A step here is a step there.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::sync::Arc;

use machine::{EngineChoice, Show};
use program::Program;
use testkit::repository;
use verify::{Options, Outcome, Report, Subject, verify};

use crate::models::{Disk, lowered};

fn program(name: &str) -> Arc<Program> {
    let path = repository::root().join(format!("bench/models/verify/{name}.asm"));
    lowered(Disk::read(&path).expect("the model is there"))
}

fn check(program: &Arc<Program>, options: &Options) -> Report {
    verify(program, options, &mut |_| true).expect("there is an initial state")
}

/// The violated checks, each with the number of steps.
fn violated(program: &Program, report: &Report) -> Vec<(String, usize)> {
    let name = |subject: &Subject| match subject {
        Subject::Property(index) => program.properties[*index].name.clone(),
        other => format!("{other:?}"),
    };
    let verdicts = report.verdicts.iter();
    verdicts
        .filter_map(|verdict| match &verdict.outcome {
            Outcome::Violated(trace) => Some((name(&verdict.subject), trace.steps.len())),
            Outcome::Holds => None,
            Outcome::Unknown(reasons) => panic!("{:?}: {reasons:?}", verdict.subject),
        })
        .collect()
}

#[test]
fn the_swinging_buffer_is_right() {
    let program = program("Swing");
    for forgetful in [false, true] {
        let report = check(&program, &Options { forgetful, ..Options::default() });
        assert_eq!(report.progress.states, 203);
        assert_eq!(violated(&program, &report), []);
        assert_eq!(report.unreachable, []);
    }
}

#[test]
fn without_the_lock_the_twelfth_step_reads_half_of_a_datum() {
    let program = program("SwingUnlocked");
    let mut told = Vec::new();
    for (workers, alone) in [(1, 0), (2, 0), (2, 64), (3, 0), (3, 64)] {
        let report = check(&program, &Options { workers, alone: Some(alone), ..Options::default() });
        assert_eq!(violated(&program, &report), [("inv_whole".to_string(), 12)]);
        let Outcome::Violated(trace) = &report.verdicts[4].outcome else { panic!("the invariant is violated") };
        let changes = trace.steps[11].changes.iter();
        told.push(changes.map(|c| format!("{} = {}", c.location.show(&program), c.after.show(&program))).collect());
        assert_eq!(told[0], told[told.len() - 1]);
    }
    let last: &Vec<String> = &told[0];
    assert_eq!(last, &["place(CONSUMER) = 2", "word(CONSUMER) = 0", "copy(1) = 1"]);
}

#[test]
fn philosophers_have_three_to_the_n_states_but_one_and_one_deadlock() {
    let program = program("Phil12");
    let report = check(&program, &Options::default());
    assert_eq!(report.progress.states, 531_440);
    assert_eq!(violated(&program, &report), [("NoDeadlock".to_string(), 12)]);
}

#[test]
fn each_choice_of_six_amounts_is_an_initial_state() {
    let program = program("Starts");
    let counts = [1, 2].map(|workers| {
        let report = check(&program, &Options { workers, ..Options::default() });
        (report.progress.states, report.progress.transitions, report.progress.depth)
    });
    assert_eq!(counts, [(117_649, 0, 0); 2]);
}

#[test]
fn a_panic_ends_all_workers() {
    let program = program("Swing");
    for (workers, alone) in [(1, 0), (2, 0), (2, 64), (3, 0)] {
        let options = Options { workers, alone: Some(alone), ..Options::default() };
        let mut seen = 0;
        let searched = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            let mut watch = |_: &_| {
                seen += 1;
                assert!(seen < 3, "enough");
                true
            };
            verify(&program, &options, &mut watch).is_ok()
        }));
        assert!(searched.is_err(), "{workers} workers, alone below {alone}, go on after a panic");
    }
}

#[test]
fn what_is_remembered_changes_nothing() {
    use EngineChoice::{Automatic, Compiled};
    let program = program("ChainXS");
    let ways = [
        (1, false, Automatic),
        (1, true, Automatic),
        (3, false, Automatic),
        (1, false, Compiled),
        (2, false, Compiled),
    ];
    let reports = ways.map(|(workers, forgetful, steps)| {
        let report = check(&program, &Options { workers, forgetful, steps, ..Options::default() });
        assert_eq!(violated(&program, &report), []);
        (report.progress.states, report.progress.transitions, report.progress.depth, report.unreachable)
    });
    assert!(reports.iter().all(|report| *report == reports[0]), "{reports:?}");
}
