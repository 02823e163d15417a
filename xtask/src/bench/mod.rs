//! `cargo xtask bench`: steps per second, memory and start-up time of this project's models.
//!
//! In: the models of examples/ and bench/models/, the native programs of bench/native/, and, where a checkout of the
//! public corpus is named, the models of bench/reference.csv. Out: tables with ratios, never a pass or fail by the
//! clock; wrong results of a twin are a fault. bench/README.md says how each figure is made.

mod charts;
mod child;
mod command;
mod memory;
mod models;
mod process;
mod twins;
mod verify;

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::arguments::Arguments;
use crate::{Failure, Outcome, repository};

/// How long and how often is measured.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Windows of one model.
    pub windows: u64,
    /// The length of a window.
    pub window_ms: u64,
    /// Runs of a whole process.
    pub runs: u64,
}

/// The command.
///
/// # Errors
/// Usage; the binary cannot be built; a model cannot be run.
pub fn run(words: &[String]) -> Result<Outcome, Failure> {
    let arguments = Arguments::read(
        words,
        &["--windows", "--window-ms", "--runs", "--corpus", "--only", "--peer", "--tlc"],
        &["--quick", "--large"],
    )?;
    let quick = arguments.flag("--quick");
    let effort = Effort {
        windows: arguments.number("--windows", if quick { 3 } else { 7 })?,
        window_ms: arguments.number("--window-ms", if quick { 50 } else { 300 })?,
        runs: arguments.number("--runs", if quick { 5 } else { 25 })?,
    };
    let only = arguments.option("--only").unwrap_or_default();
    let binary = build()?;
    println!("{}", describe_machine());
    models::own(&binary, effort, only)?;
    process::whole(&binary, effort, only)?;
    charts::drawn(&binary, effort, only)?;
    memory::peaks(&binary, if quick { 10_000 } else { 1_000_000 }, only)?;
    let peers = verify::Peers {
        models: arguments.option("--peer").map(PathBuf::from),
        tlc: arguments.option("--tlc").map(PathBuf::from),
        large: arguments.flag("--large"),
    };
    let explored = verify::explored(&binary, &peers, only)?;
    let twins = twins::compare(&binary, effort, only)?;
    if let Some(corpus) = arguments.option("--corpus") {
        models::reference(&binary, effort, Path::new(corpus), only)?;
    }
    Ok(if explored == Outcome::Good { twins } else { explored })
}

/// Builds the command as users have it.
fn build() -> Result<PathBuf, Failure> {
    let root = repository::root();
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_string());
    let mut command = Command::new(cargo);
    command.args(["build", "--quiet", "--release", "--package", "cli"]).current_dir(&root);
    match command.status() {
        Ok(status) if status.success() => {}
        Ok(_) => return Err("the groundstate command does not build".to_string()),
        Err(error) => return Err(format!("cargo cannot be run: {error}")),
    }
    let target = std::env::var("CARGO_TARGET_DIR").map_or_else(|_| root.join("target"), |folder| root.join(folder));
    Ok(target.join("release/groundstate"))
}

/// The processor, for whoever reads the figures later.
fn describe_machine() -> String {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = cpu.lines().find_map(|line| line.strip_prefix("model name")).and_then(|rest| rest.split(':').nth(1));
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load = load.split(' ').next().unwrap_or("?").to_string();
    format!("one core of {}; load average {load} when this began\n", name.unwrap_or("an unknown processor").trim())
}

/// A table with aligned columns, the first one left, the others right.
pub fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count());
        cells.chain([head[column].chars().count()]).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..head.len()).map(width).collect();
    let line = |cells: &mut dyn Iterator<Item = &str>| {
        let cells: Vec<String> = cells
            .zip(&widths)
            .enumerate()
            .map(
                |(column, (cell, width))| {
                    if column == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
                },
            )
            .collect();
        cells.join("  ").trim_end().to_string() + "\n"
    };
    let mut out = line(&mut head.iter().copied());
    for row in rows {
        out.push_str(&line(&mut row.iter().map(String::as_str)));
    }
    out
}

/// A number with three digits that matter and its thousands apart: `1 230 000`, `4.56`.
pub fn figure(number: f64) -> String {
    if !number.is_finite() {
        return "?".to_string();
    }
    if number < 1000.0 {
        let decimals = if number >= 100.0 {
            0
        } else if number >= 10.0 {
            1
        } else {
            2
        };
        return format!("{number:.decimals$}");
    }
    let scale = 10f64.powi(number.log10().floor() as i32 - 2);
    let digits = format!("{:.0}", (number / scale).round() * scale);
    let groups: Vec<String> =
        digits.as_bytes().rchunks(3).rev().map(|group| String::from_utf8_lossy(group).into_owned()).collect();
    groups.join("\u{202f}")
}

/// The geometric mean; none of nothing.
pub fn geometric_mean(ratios: &[f64]) -> Option<f64> {
    let logarithms: f64 = ratios.iter().map(|ratio| ratio.ln()).sum();
    (!ratios.is_empty()).then(|| (logarithms / ratios.len() as f64).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_short() {
        assert_eq!(figure(1_234_567.0), "1\u{202f}230\u{202f}000");
        assert_eq!(figure(4.5678), "4.57");
        assert_eq!(figure(99.96), "100.0");
        assert_eq!(figure(1000.4), "1\u{202f}000");
    }

    #[test]
    fn means_are_geometric() {
        assert!((geometric_mean(&[2.0, 8.0]).unwrap() - 4.0).abs() < 1e-9);
        assert_eq!(geometric_mean(&[]), None);
    }

    #[test]
    fn tables_are_aligned() {
        assert_eq!(table(&["a", "bb"], &[vec!["xyz".into(), "1".into()]]), "a    bb\nxyz   1\n");
    }
}
