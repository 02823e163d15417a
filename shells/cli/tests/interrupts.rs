//! Signals during a search: what it has found is reported, the rest is unknown.
#![cfg(unix)]
#![allow(clippy::disallowed_methods, reason = "the test makes the files it gives to the command")]

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};

/// Never ends; violates an invariant after some steps.
const ENDLESS: &str = "asm Endless\nimport StandardLibrary\nsignature:\n\tcontrolled n: Integer\n\tcontrolled s: Seq(Integer)\n\
                       definitions:\n\tinvariant inv_small over n: n < 5\n\tmain rule r_Main = choose $k in {1, 2} with true do \
                       if $k = 1 then n := n + 1 else s := append(s, n) endif\n\
                       default init s0:\n\tfunction n = 0\n\tfunction s = []\n";

/// Signals like GNU `timeout`, which signals both the process and its group.
fn terminate(child: &Child) {
    // Uses the `kill` built into the shell, since not every machine has a program of that name.
    let told =
        Command::new("sh").args(["-c", "kill -TERM $0 $0", &child.id().to_string()]).status().expect("it starts");
    assert!(told.success());
}

#[test]
fn a_violation_is_told_at_once_and_signals_that_come_together_are_one() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("Endless.asm"), ENDLESS).expect("the file can be written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    command.args(["verify", "Endless.asm", "--solver", "none", "--max-memory", "2000"]).current_dir(folder.path());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("it starts");
    let mut output = BufReader::new(child.stdout.take().expect("it is piped"));
    let mut line = String::new();
    output.read_line(&mut line).expect("it is told while the search goes on");
    assert_eq!(line, "violated  inv_small, after 5 steps\n");
    terminate(&child);
    let mut rest = String::new();
    output.read_to_string(&mut rest).expect("text");
    assert_eq!(child.wait().expect("it ends").code(), Some(1), "{rest}");
    assert_eq!(rest.matches("violated  inv_small, after 5 steps, as shown above").count(), 1, "{rest}");
    assert_eq!(rest.matches("interrupted").count(), 4, "{rest}");
    assert!(rest.contains("(not all reachable)"), "{rest}");
}

/// Stays as it is; one of its mutants grows for ever.
const STILL: &str = "asm Still\nimport StandardLibrary\nsignature:\n\tcontrolled n: Integer\ndefinitions:\n\
                     \tmain rule r_Main = n := 2 * n\ndefault init s0:\n\tfunction n = 0\n";

#[test]
fn mutants_that_were_judged_are_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("Still.asm"), STILL).expect("the file can be written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    let limits = ["--max-states", "4000000000", "--time", "1000", "--jobs", "1"];
    command.args(["mutate", "Still.asm"]).args(limits).current_dir(folder.path());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("it starts");
    std::thread::sleep(std::time::Duration::from_millis(700));
    terminate(&child);
    let mut told = String::new();
    child.stdout.take().expect("it is piped").read_to_string(&mut told).expect("text");
    assert!(matches!(child.wait().expect("it ends").code(), Some(1 | 3)), "{told}");
    assert!(told.contains("not judged: the command was interrupted"), "{told}");
}

/// What was proved of a part of a system stays; of the rest it is said that nothing is known.
#[test]
fn a_system_whose_search_has_not_begun_has_verdicts() {
    let folder = testkit::repository::root().join("examples/visual_servoing");
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    command.args(["verify", "ControllerSystem.chart", "--data", "--workers", "1"]);
    let mut child =
        command.current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("it starts");
    // A search of minutes, before which others of seconds try to prove what they can.
    std::thread::sleep(std::time::Duration::from_secs(5));
    terminate(&child);
    let mut rest = String::new();
    child.stdout.take().expect("it is piped").read_to_string(&mut rest).expect("text");
    assert_eq!(child.wait().expect("it ends").code(), Some(3), "{rest}");
    assert!(rest.contains("unknown   no deadlock: interrupted") && !rest.contains("initial states"), "{rest}");
}
