//! How long charts take to be laid out and drawn, as whole processes from start to exit.
//!
//! In: charts made here, of 50 to 500 shapes, with and without places, and the largest one of the library. Out: a table.
//! A chart is a ladder: each state leads over two guards and an action to others, one of them far back.

use std::fmt::Write;
use std::path::Path;

use super::process::once;
use super::{Effort, figure, table};
use crate::Failure;

/// Times and prints the drawing of charts.
///
/// # Errors
/// A command cannot be run, a file cannot be written.
pub fn drawn(binary: &Path, effort: Effort, only: &str) -> Result<(), Failure> {
    if !"charts".contains(only) {
        return Ok(());
    }
    let folder = tempfile::tempdir().map_err(|error| format!("no temporary folder: {error}"))?;
    let mut rows = Vec::new();
    let mut row = |title: String, words: &[&str]| -> Result<(), Failure> {
        once(binary, words)?;
        let runs = effort.runs.clamp(1, 5);
        let mut times = (0..runs).map(|_| once(binary, words)).collect::<Result<Vec<f64>, _>>()?;
        times.sort_by(f64::total_cmp);
        rows.push(vec![title, figure(times[times.len() / 2]), figure(times[0])]);
        Ok(())
    };
    let library = ["chart", "draw", "library/patterns/PatternMachines.chart", "--machine", "syncSlave"];
    row("synchronous slave, 21 shapes".to_string(), &library)?;
    for states in [12, 50, 125] {
        let shapes = states * 4;
        let path = folder.path().join(format!("Ladder{shapes}.chart"));
        std::fs::write(&path, ladder(states))
            .map_err(|error| format!("{} cannot be written: {error}", path.display()))?;
        let file = path.display().to_string();
        row(format!("{shapes} shapes"), &["chart", "draw", &file])?;
        once(binary, &["chart", "place", &file])?;
        row(format!("{shapes} shapes, places given"), &["chart", "draw", &file])?;
    }
    let file = folder.path().join("Ladder48.chart").display().to_string();
    row("48 shapes, as PNG".to_string(), &["chart", "draw", &file, "--as", "png"])?;
    row("48 shapes, as PDF".to_string(), &["chart", "draw", &file, "--as", "pdf"])?;
    println!("Charts laid out and drawn\n");
    println!("{}", table(&["chart", "median ms", "best ms"], &rows));
    Ok(())
}

fn ladder(states: usize) -> String {
    let mut text = "chart Ladder\n\nmachine ladder\n\tcontrol rung\n".to_string();
    for n in 0..states {
        let initial = if n == 0 { "initial " } else { "" };
        let _ = writeln!(
            text,
            "\t{initial}state s{n}\n\tguard a{n}\n\tguard b{n} {{test{n}}}\n\taction d{n} {{r_do{n}[]}}"
        );
    }
    for n in 0..states {
        let (next, back) = ((n + 1) % states, n / 2);
        let _ = writeln!(
            text,
            "\ts{n} -> a{n} yes -> d{n} -> s{next}\n\ta{n} no -> b{n}\n\tb{n} yes -> s{back}\n\tb{n} no -> s{n}"
        );
    }
    text + "endmachine\n"
}
