//! How long whole commands take, from start to exit.
//!
//! Each is run several times after one run that warms the file cache; the median and the best are printed.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use super::{Effort, figure, table};
use crate::{Failure, repository};

/// What is timed: a title, and the words of the command.
const COMMANDS: &[(&str, &[&str])] = &[
    ("check the complete controller", &["check", "examples/visual_servoing/CompleteController.asm"]),
    (
        "one step of the complete controller",
        &["run", "examples/visual_servoing/CompleteController.asm", "--steps", "1", "--random", "--quiet"],
    ),
    (
        "one step of visual servoing",
        &["run", "examples/visual_servoing/VisualServoing.asm", "--steps", "1", "--random", "--quiet"],
    ),
    (
        "one step of the coffee machine",
        &["run", "examples/coffee_machine/CoffeeMachine.asm", "--steps", "1", "--random", "--quiet"],
    ),
    ("one step of the game of life", &["run", "bench/models/Life.asm", "--steps", "1", "--quiet"]),
];

/// Times and prints the commands.
///
/// # Errors
/// A command cannot be run.
pub fn whole(binary: &Path, effort: Effort, only: &str) -> Result<(), Failure> {
    let mut rows = Vec::new();
    for (title, words) in COMMANDS.iter().filter(|(title, _)| title.contains(only)) {
        once(binary, words)?;
        let mut times = (0..effort.runs.max(1)).map(|_| once(binary, words)).collect::<Result<Vec<f64>, _>>()?;
        times.sort_by(f64::total_cmp);
        rows.push(vec![(*title).to_string(), figure(times[times.len() / 2]), figure(times[0])]);
    }
    if !rows.is_empty() {
        println!("Whole process, {} runs each\n", effort.runs);
        println!("{}", table(&["command", "median ms", "best ms"], &rows));
    }
    Ok(())
}

/// One run, in milliseconds.
pub fn once(binary: &Path, words: &[&str]) -> Result<f64, Failure> {
    let began = Instant::now();
    let status = Command::new(binary)
        .args(words)
        .current_dir(repository::root())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .map_err(|error| format!("{} cannot be run: {error}", binary.display()))?;
    let spent = began.elapsed().as_secs_f64() * 1e3;
    match status.code() {
        Some(0) => Ok(spent),
        code => Err(format!("`groundstate {}` ended with {code:?}", words.join(" "))),
    }
}
