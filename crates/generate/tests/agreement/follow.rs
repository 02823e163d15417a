//! A compiled model follows a run: what it prints is compared with what the machine came to.

use std::io::Write;
use std::process::{Command, Stdio};

use crate::compile::Program;

/// LIMIT: how many seconds a run may take.
const SECONDS: u32 = 120;

impl Program {
    /// Runs it on a run's script and compares what it prints.
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

/// The place of a fault is compared nowhere: its number is the generated code's own.
fn without_places(printed: &str) -> String {
    let line = |line: &str| match line.strip_prefix("fault ") {
        // Not the location of a function that is called so: `fault () i1`.
        Some(rest) if !rest.starts_with('(') => format!("fault {}\n", rest.split(' ').next().unwrap_or_default()),
        _ => format!("{line}\n"),
    };
    printed.lines().map(line).collect()
}

/// The first place where two texts part.
fn difference(expected: &str, printed: &str) -> Result<(), String> {
    if expected == printed {
        return Ok(());
    }
    let step = |lines: &[&str]| lines.iter().filter(|line| **line == ".").count();
    let (left, right): (Vec<&str>, Vec<&str>) = (expected.lines().collect(), printed.lines().collect());
    let at = left.iter().zip(&right).take_while(|(a, b)| a == b).count();
    Err(format!(
        "after {} states: the machine has `{}`, the generated code `{}`",
        step(&left[..at]),
        left.get(at).unwrap_or(&"nothing more"),
        right.get(at).unwrap_or(&"nothing more")
    ))
}
