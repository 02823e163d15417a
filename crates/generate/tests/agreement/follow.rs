//! Replays a run in a compiled model and compares its output with the machine's states.

use std::io::Write;
use std::process::{Command, Stdio};

use crate::compile::Program;

/// LIMIT: how many seconds a run may take.
const SECONDS: u32 = 120;

impl Program {
    /// Replays a run's script and compares the output.
    pub fn follow(&self, script: &str, expected: &str) -> Result<(), String> {
        let mut child = Command::new("timeout")
            .arg(SECONDS.to_string())
            .arg(&self.path)
            .arg(&self.word)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| error.to_string())?;
        let mut stdin = child.stdin.take().expect("piped");
        let script = script.to_string();
        // A program that ends early closes the pipe.
        let writer = std::thread::spawn(move || drop(stdin.write_all(script.as_bytes())));
        let output = child.wait_with_output().map_err(|error| error.to_string())?;
        let _ = writer.join();
        match output.status.code() {
            Some(0) => difference(expected, &without_places(&String::from_utf8_lossy(&output.stdout))),
            Some(124) => Err(format!("runs for more than {SECONDS} s")),
            _ => Err(format!("{}: {}", output.status, String::from_utf8_lossy(&output.stderr))),
        }
    }
}

/// Removes the places of faults, which are numbers of the generated code.
fn without_places(printed: &str) -> String {
    let line = |line: &str| match line.strip_prefix("fault ") {
        // Skips locations of a function called `fault`: `fault () i1`.
        Some(rest) if !rest.starts_with('(') => format!("fault {}\n", rest.split(' ').next().unwrap_or_default()),
        _ => format!("{line}\n"),
    };
    printed.lines().map(line).collect()
}

/// The first difference between two texts. The generated code may have more locations with undef arguments, for
/// functions with initial values (`replay::state`); otherwise both must be equal.
fn difference(expected: &str, printed: &str) -> Result<(), String> {
    let (expected, printed) = (states(expected), states(printed));
    for (at, state) in expected.iter().enumerate() {
        let nothing = Vec::new();
        let (machine, code) = (state, printed.get(at).unwrap_or(&nothing));
        let late = late(machine);
        let end = |line: &&&str| !line.starts_with(". ") && **line != ".";
        let missing = machine.iter().filter(end).find(|line| !code.contains(line));
        // The code counts rounds of loops alone: it may go on where the machine gives a step up, and then ask for more than it asked.
        if missing == Some(&"fault limit-reached") && code.contains(&"fault no-input") {
            continue;
        }
        let surplus = code.iter().filter(end).find(|line| !machine.contains(line) && !is_late(line, &late));
        if missing.is_some() || surplus.is_some() || machine.len().min(1) != code.len().min(1) {
            return Err(format!(
                "after {at} states: the machine has `{}`, the generated code `{}`",
                missing.unwrap_or(&"nothing more"),
                surplus.unwrap_or(&"nothing more")
            ));
        }
    }
    if printed.len() > expected.len() {
        return Err(format!("after {} states: the generated code goes on", expected.len()));
    }
    Ok(())
}

/// The lines of each state; the last state may end with a fault.
fn states(text: &str) -> Vec<Vec<&str>> {
    let mut states = vec![Vec::new()];
    for line in text.lines() {
        let state = states.last_mut().expect("never empty");
        state.push(line);
        if line == "." || line.starts_with(". ") {
            states.push(Vec::new());
        }
    }
    if states.last().is_some_and(Vec::is_empty) {
        states.pop();
    }
    states
}

/// The functions that a state lists on its last line.
fn late<'t>(state: &[&'t str]) -> Vec<&'t str> {
    state.last().and_then(|line| line.strip_prefix(". ")).map(|names| names.split(' ').collect()).unwrap_or_default()
}

/// Whether a line is a location of one of these functions with an undef argument.
fn is_late(line: &str, late: &[&str]) -> bool {
    line.strip_prefix("? ").and_then(|rest| rest.split(' ').next()).is_some_and(|name| late.contains(&name))
}

#[test]
fn what_parts_is_told() {
    let check = |expected: &str, printed: &str, parts: bool| {
        assert_eq!(difference(expected, printed).is_err(), parts, "{expected:?} {printed:?}");
    };
    check("n () i1\n. f\n", "n () i1\n.\n", false);
    check("n () i1\n. f\n", "n () i2\n.\n", true);
    check("n () i1\n. f\n", "n () i1\n? f (u) i0\n.\n", false);
    check("n () i1\n. f\n", "n () i1\n? g (u) i0\n.\n", true);
    check("? f (u) i1\n. f\n", ".\n", true);
    check("? f (u) i1\n. f\n", "? f (u) i0\n.\n", true);
    check(".\n.\n", ".\n", true);
    check(".\n", ".\n.\n", true);
    check(".\nfault overflow\n", ".\nfault bad-operand\n", true);
    check(".\nfault overflow\n", ".\nfault overflow\n", false);
}
