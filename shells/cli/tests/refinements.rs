//! The refinements of the library: each is proved, each wrong sibling is refuted, and both runs of a refutation are made again by scenarios.

#![allow(clippy::disallowed_methods, reason = "a test runs the command on files")]

use std::path::{Path, PathBuf};
use std::process::Command;

use testkit::solver::solvers;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../library/refinement").canonicalize().expect("the folder")
}

fn check(arguments: &[&str], code: i32, says: &str) {
    let output = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(arguments).current_dir(folder()).output();
    let output = output.expect("it starts");
    let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
    assert!(said.contains(says), "{arguments:?}: {said}");
}

#[test]
fn each_refinement_is_proved_and_each_wrong_sibling_refuted() {
    let list = std::fs::read_to_string(folder().join("expected.txt")).expect("the list");
    let (mut counts, both) = ([0; 2], solvers(false).len() == 2);
    for line in list.lines().filter(|line| !line.starts_with('#')) {
        let (arguments, expected) = line.split_once(';').expect("arguments; what is expected");
        let arguments: Vec<&str> = std::iter::once("refine").chain(arguments.split_whitespace()).collect();
        match expected.split_once(' ') {
            Some(("refines", pairs)) => check(&arguments, 0, &format!("\n{pairs} pairs of ")),
            Some(("proved" | "unproved", _)) if !both => continue,
            Some(("proved", count)) => {
                check(&arguments, 0, &format!("  proved     by induction: {count} obligations"));
                continue;
            }
            Some(("unproved", name)) => {
                check(&arguments, 3, &format!("not known: the induction fails at `{name}`"));
                continue;
            }
            Some(("refuted", why)) => check(&arguments, 1, &format!("does not refine: {why}")),
            _ => panic!("{line}"),
        }
        counts[usize::from(expected.starts_with("refuted"))] += 1;
    }
    // Each that is searched is there with at least three that it is not.
    assert!(counts[0] >= 4 && counts[1] >= 3 * counts[0], "{counts:?}");
}

#[test]
fn couplings_are_checked_and_are_nothing_else() {
    check(&["check", "."], 0, "Ticks.refine: no faults");
    check(&["run", "Manage.refine"], 2, "Manage.refine is a coupling");
    check(&["fmt", "--check", "."], 0, "");
}

#[test]
fn each_wrong_sibling_is_refuted_and_its_runs_are_made_again() {
    let runs = tempfile::tempdir().expect("a temporary folder");
    let siblings: [(&str, &[&str], &str, i32, &str); 3] = [
        (
            "Permit",
            &["Permit.asm", "../verification/PermitLineFaulty.asm"],
            "0:1 again and again",
            1,
            "inv_noLostWakeUp",
        ),
        (
            "Queue",
            &["Queue.asm", "../verification/QueueStepsFaulty.asm", "--bound", "fault=PUBLISHES_FIRST"],
            "nothing matches step",
            0,
            "2 passed",
        ),
        (
            "Manage",
            &["ManageAtOnce.asm", "ManageEarly.asm"],
            "`abstract.index = concrete.index` is false",
            0,
            "2 passed",
        ),
    ];
    for (name, models, says, code, again) in siblings {
        let (coupling, into) = (format!("{name}.refine"), runs.path().join(name).display().to_string());
        let mut arguments = vec!["refine"];
        arguments.extend(models);
        arguments.extend(["--with", &coupling, "--counterexample", &into]);
        check(&arguments, 1, says);
        // The model's own invariant ends the run of the semaphore sooner than it goes round.
        check(&["test", &into], code, again);
    }
}
