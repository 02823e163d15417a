//! With lossy storage, violations are still found, with real runs, and nothing holds.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Location, Value};
use program::{Program, PropertyKind};
use syntax::SourceFile;
use testkit::repository;
use verify::{EngineKind, Options, Outcome, Reason, Report, Storage, Subject, Trace, verify};

use crate::models::{Disk, lowered};

fn program(name: &str) -> Arc<Program> {
    let path = repository::root().join(format!("bench/models/verify/{name}.asm"));
    lowered(Disk::read(&path).expect("the model is there"))
}

fn check(program: &Arc<Program>, options: &Options) -> Report {
    verify(program, options, &mut |_| true).expect("there is an initial state")
}

/// The violated checks, with their runs.
fn violated(report: &Report) -> BTreeMap<Subject, &Trace> {
    let of = |verdict: &verify::Verdict| verdict.subject;
    let each = report.verdicts.iter().filter_map(|verdict| match &verdict.outcome {
        Outcome::Violated(trace) => Some((of(verdict), &**trace)),
        _ => None,
    });
    each.collect()
}

/// Each step of a run begins in the state that the previous one led to.
fn is_a_run(trace: &Trace) {
    let mut values: BTreeMap<&Location, &Value> =
        trace.values.iter().map(|(location, value)| (location, value)).collect();
    for step in &trace.steps {
        for change in &step.changes {
            let before = values.insert(&change.location, &change.after).unwrap_or(&Value::Undef);
            assert_eq!(*before, change.before);
        }
    }
}

/// The same checks are violated after as many steps, and nothing holds.
fn agrees(program: &Arc<Program>, options: &Options) {
    let exact = check(program, &Options { engine: EngineKind::Explicit, ..options.clone() });
    for (storage, workers) in
        [(Storage::Compact, 1), (Storage::Compact, 3), (Storage::BitState(8 << 20), 1), (Storage::BitState(8 << 20), 2)]
    {
        let report = check(program, &Options { storage, workers, ..options.clone() });
        assert!(report.progress.states <= exact.progress.states);
        let omission = report.omission.expect("some of each state was left out").0;
        if omission < 1e-6 {
            assert_eq!(report.progress.states, exact.progress.states);
        }
        assert!(!report.complete && report.unreachable.is_empty());
        for verdict in &report.verdicts {
            match &verdict.outcome {
                Outcome::Holds => panic!("{:?} holds by {storage:?}", verdict.subject),
                Outcome::Unknown(reasons) => assert!(reasons.contains(&Reason::Compacted)),
                Outcome::Violated(trace) => is_a_run(trace),
            }
        }
        let steps =
            |report| violated(report).into_iter().map(|(subject, trace)| (subject, trace.steps.len())).collect();
        let (ours, theirs): (Vec<_>, Vec<_>) = (steps(&report), steps(&exact));
        // Temporal properties are not compared.
        let temporal = |subject: &Subject| match subject {
            Subject::Property(index) => {
                matches!(program.properties[*index].kind, PropertyKind::Ctl | PropertyKind::Ltl)
            }
            _ => false,
        };
        assert_eq!(
            ours,
            theirs.into_iter().filter(|(subject, _)| !temporal(subject)).collect::<Vec<_>>(),
            "{storage:?}"
        );
    }
}

#[test]
fn the_reference_systems_are_violated_by_the_same_runs() {
    for name in ["Swing", "SwingLive", "SwingUnlocked", "ChainXS", "Phil12"] {
        agrees(&program(name), &Options::default());
    }
}

#[test]
fn assumptions_leave_the_same_states_out() {
    let text = "asm Walk\nimport StandardLibrary\nsignature:\n domain Place subsetof Integer\n monitored push: Boolean\n \
                controlled place: Place -> Place\n controlled sum: Integer\ndefinitions:\n domain Place = {0 : 6}\n \
                INVAR place(3) < 3\n invariant inv_sum over sum: sum < 12\n invariant inv_push over push: push implies sum != 10\n \
                main rule r_Main = choose $p in Place with place($p) < 5 do par place($p) := place($p) + 1 sum := sum + 1 endpar\n\
                default init s0:\n function place($p in Place) = 0\n function sum = 0\n";
    let program = lowered(SourceFile::new("Walk.asm", text));
    agrees(&program, &Options::default());
    agrees(&program, &Options { first: true, ..Options::default() });
    agrees(&program, &Options { max_depth: 11, ..Options::default() });
}

#[test]
fn a_small_array_leaves_states_out_and_says_so() {
    let program = program("ChainXS");
    let exact = check(&program, &Options::default()).progress.states;
    let mut before = f64::INFINITY;
    for bytes in [1 << 12, 1 << 16, 1 << 24] {
        let storage = Storage::BitState(bytes);
        let report = check(&program, &Options { storage, ..Options::default() });
        let omission = report.omission.expect("bits alone were kept").0;
        assert!(omission < before, "{omission} {before}");
        assert_eq!(report.progress.states < exact, omission > 0.5, "{omission}, {} of {exact}", report.progress.states);
        before = omission;
        // Another hash omits other states.
        let other = check(&program, &Options { storage, seed: 1, ..Options::default() });
        assert_eq!(other.progress.states == report.progress.states, omission < 0.5);
    }
}

/// Runs are found by halving distances; lengths that are powers of two are no exception.
#[test]
fn ways_of_all_lengths_are_found() {
    for steps in 1..18 {
        let text = format!(
            "asm Walk\nimport StandardLibrary\nsignature:\n domain Place subsetof Integer\n controlled place: Place\n\
             definitions:\n domain Place = {{0 : 20}}\n invariant inv_p over place: place != {steps}\n \
             main rule r_Main = if place < 20 then place := place + 1 endif\ndefault init s0:\n function place = 0\n"
        );
        let options = Options { terminal: None, first: true, ..Options::default() };
        agrees(&lowered(SourceFile::new("Walk.asm", text)), &options);
    }
}
