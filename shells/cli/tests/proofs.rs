//! `groundstate refine --method induction` and `bmc`: what they say with both solvers, with one, and with none; and that the files that are
//! written are what the solvers were asked. Where a solver is missing what needs it is not tested, and stderr says so.

#![allow(clippy::disallowed_methods, reason = "a test runs the command on files, with another search path")]

use std::path::{Path, PathBuf};
use std::process::Command;

use testkit::solver::solvers;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cmd/refine.in")
}

/// The path of a program.
fn found(name: &str) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    std::env::split_paths(&folders).map(|folder| folder.join(name)).find(|path| path.is_file())
}

/// What the command says of a proof, by this search path if there is one.
fn said(coupling: &str, more: &[&str], path: Option<&Path>) -> (Option<i32>, String) {
    let arguments = [&[coupling, "--method", "induction"], more].concat();
    refine(&arguments, path)
}

/// What the command says.
fn refine(arguments: &[&str], path: Option<&Path>) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    command.arg("refine").args(arguments).current_dir(folder());
    if let Some(path) = path {
        command.env("PATH", path);
    }
    let output = command.output().expect("it starts");
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    (output.status.code(), text)
}

#[test]
fn both_solvers_prove() {
    if solvers(false).len() < 2 {
        return;
    }
    let asked = tempfile::tempdir().expect("a temporary folder");
    let (code, text) = said("Filter.refine", &["--obligations", &asked.path().display().to_string()], None);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("by induction: 3 obligations, accepted by z3 and cvc5"), "{text}");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(asked.path()).expect("the folder").map(|entry| entry.expect("a file").path()).collect();
    files.sort();
    assert_eq!(files.len(), 6, "{files:?}");
    for file in files {
        let script = std::fs::read_to_string(&file).expect("a script");
        let wanted =
            script.lines().find_map(|line| line.strip_prefix("; accepted if the answer is ")).expect("it says");
        for solver in ["z3", "cvc5"] {
            let output = Command::new(solver).arg(&file).output().expect("it starts");
            assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), wanted, "{solver} {}", file.display());
        }
    }
}

#[test]
fn assumptions_and_invariants_are_told() {
    if solvers(false).len() < 2 {
        return;
    }
    let (code, text) = said("Known.refine", &[], None);
    assert_eq!(code, Some(0), "{text}");
    for says in [
        "  invariants inv_peak (concrete)\n",
        "  not used   inv_small (concrete): the induction does not prove it\n",
        "  proved     by induction: 4 obligations, accepted by z3 and cvc5\n",
    ] {
        assert!(text.contains(says), "{says}: {text}");
    }
    let (code, text) = said("Known.refine", &["--assume", "concrete.reading < 0"], None);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("  assumed    reading < 0 (concrete, --assume)\n"), "{text}");
    let (code, text) = said("Known.refine", &["--assume", "concrete.reading < 0 and concrete.reading > 3"], None);
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("error[vacuous-refinement]: the assumptions leave reading no value"), "{text}");
}

#[test]
fn what_is_not_proved_is_not_refuted() {
    if solvers(false).len() < 2 {
        return;
    }
    let (code, text) = said("Unsaid.refine", &[], None);
    assert_eq!(code, Some(3), "{text}");
    assert!(text.contains("not known: the induction fails at `step 1 made`"), "{text}");
    assert!(text.contains("no run need reach"), "{text}");
    let (code, text) = said("Unsaid.refine", &["--format", "json"], None);
    assert_eq!(code, Some(3), "{text}");
    assert!(text.contains(r#""verdict":"unknown""#) && text.contains(r#""stuck":{"#), "{text}");
}

#[test]
fn one_solver_proves_nothing_and_none_is_asked_for() {
    let empty = tempfile::tempdir().expect("a temporary folder");
    let (code, text) = said("Filter.refine", &[], Some(empty.path()));
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("needs z3 and cvc5") && text.contains("cpp/install.sh z3 cvc5"), "{text}");
    for (name, other) in [("z3", "cvc5"), ("cvc5", "z3")] {
        let Some(solver) = found(name) else { continue };
        let alone = tempfile::tempdir().expect("a temporary folder");
        std::os::unix::fs::symlink(solver, alone.path().join(name)).expect("a link");
        let (code, text) = said("Filter.refine", &[], Some(alone.path()));
        assert_eq!(code, Some(3), "{text}");
        assert!(text.contains(&format!("only {name} accepts the proof")), "{text}");
        assert!(text.contains(&format!("cpp/install.sh {other}")), "{text}");
    }
}

/// A wrong machine whose inputs cannot be gone through is refuted by either solver, and both runs are scenarios that pass.
#[test]
fn a_run_that_a_solver_finds_is_made_again() {
    for name in ["z3", "cvc5"] {
        let Some(solver) = found(name) else { continue };
        let alone = tempfile::tempdir().expect("a temporary folder");
        std::os::unix::fs::symlink(solver, alone.path().join(name)).expect("a link");
        let into = alone.path().join("runs").display().to_string();
        let asked = ["Peak.asm", "Hurried.asm", "--with", "Filter.refine", "--method", "bmc"];
        let (code, text) = refine(&[&asked[..], &["--counterexample", &into]].concat(), Some(alone.path()));
        assert_eq!(code, Some(1), "{text}");
        assert!(text.contains("does not refine: nothing matches step 2 of the concrete machine"), "{text}");
        assert!(
            text.contains(&format!("found by   {name}: a run of 2 steps, which both machines make again")),
            "{text}"
        );
        let again = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(["test", &into]).output().expect("it starts");
        let text = String::from_utf8_lossy(&again.stdout).into_owned();
        assert!(again.status.success() && text.contains("2 passed"), "{text}");
        let (code, text) = refine(&[&asked[..], &["--format", "json"]].concat(), Some(alone.path()));
        assert_eq!(code, Some(1), "{text}");
        for says in
            [r#""method":"bmc","verdict":"does-not-refine""#, r#""bmc":{"solvers":[""#, r#""found":{"steps":2,"#]
        {
            assert!(text.contains(says), "{says}: {text}");
        }
        let (code, text) = refine(&["Filter.refine", "--method", "bmc", "--depth", "4"], Some(alone.path()));
        assert_eq!(code, Some(3), "{text}");
        let says = "not known: no run of at most 4 steps of the concrete machine is refuted";
        assert!(text.contains(says) && text.contains(&format!("all runs of at most 4 steps, by {name}")), "{text}");
    }
    let empty = tempfile::tempdir().expect("a temporary folder");
    let (code, text) = refine(&["Filter.refine", "--method", "bmc"], Some(empty.path()));
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("--method bmc needs z3 or cvc5"), "{text}");
}

/// Where a proof fails, runs of a few steps tell a wrong machine from a weak coupling.
#[test]
fn where_a_proof_fails_runs_are_looked_at() {
    if solvers(false).len() < 2 {
        return;
    }
    let (code, text) = said("Unsaid.refine", &["--depth", "3"], None);
    assert_eq!(code, Some(3), "{text}");
    assert!(text.contains("no run of at most 3 steps comes to such a pair, by z3 and cvc5"), "{text}");
    assert!(text.contains("no run of at most 3 steps of the concrete machine is refuted, by z3 and cvc5"), "{text}");
    let (code, text) = said("Unsaid.refine", &["--depth", "0"], None);
    assert_eq!(code, Some(3), "{text}");
    assert!(!text.contains("no run of at most"), "{text}");
    let wrong = ["Peak.asm", "Hurried.asm", "--with", "Filter.refine", "--method", "induction"];
    let (code, text) = refine(&wrong, None);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("does not refine: nothing matches step 2") && text.contains("  found by   "), "{text}");
}

/// `--time` ends all questions together, not each of them. The solvers here are there and never answer.
#[test]
fn the_time_ends_a_proof_by_solvers_that_do_not_answer() {
    use std::os::unix::fs::PermissionsExt;
    let silent = tempfile::tempdir().expect("a temporary folder");
    for name in ["z3", "cvc5"] {
        let path = silent.path().join(name);
        let text =
            format!("#!/bin/sh\nif [ \"$1\" = --version ]; then echo {name} 1.2.3; else exec /bin/sleep 1000; fi\n");
        std::fs::write(&path, text).expect("it is written");
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).expect("it can be run");
    }
    let (code, text) = said("Filter.refine", &["--time", "1"], Some(silent.path()));
    assert_eq!(code, Some(3), "{text}");
    assert!(text.contains("not known: the time was up"), "{text}");
    // Nobody says that a solver has had its time for a question.
    assert!(!text.contains("no answer in time") && !text.contains("not all solvers decide"), "{text}");
}
