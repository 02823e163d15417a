//! `groundstate bench` called from here, its JSON read.

use std::path::Path;
use std::process::Command;

use serde::Deserialize;

use super::Effort;
use crate::Failure;

/// What is read of its answer.
#[derive(Debug, Deserialize)]
pub struct Measured {
    /// The median over the windows.
    pub steps_per_second: f64,
    /// The slowest window.
    pub lowest: f64,
    /// The fastest window.
    pub highest: f64,
    /// Of a hundred steps, how many changed the state.
    pub changed_percent: f64,
    /// How often the model could not go on and began again.
    pub restarts: u64,
    /// Reading, checking and lowering.
    pub load_ms: f64,
    /// The most memory the process held.
    pub peak_memory_mb: Option<f64>,
}

/// Measures one model in a process of its own, so that its memory is its own.
///
/// # Errors
/// What the command says against the model.
pub fn measure(binary: &Path, model: &Path, effort: Effort) -> Result<Measured, Failure> {
    let (windows, window) = (effort.windows.to_string(), effort.window_ms.to_string());
    bench(binary, model, &["--windows", &windows, "--window-ms", &window])
}

/// Makes so many steps of one model, with random inputs, and measures them as a whole.
///
/// # Errors
/// What the command says against the model.
pub fn make_steps(binary: &Path, model: &Path, steps: u64) -> Result<Measured, Failure> {
    bench(binary, model, &["--windows", "0", "--steps", &steps.to_string()])
}

fn bench(binary: &Path, model: &Path, options: &[&str]) -> Result<Measured, Failure> {
    let output = Command::new(binary)
        .args(["bench", "--format", "json"])
        .args(options)
        .arg(model)
        .output()
        .map_err(|error| format!("{} cannot be run: {error}", binary.display()))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().find(|line| line.contains("steps_per_second"));
    match line {
        Some(line) => serde_json::from_str(line).map_err(|error| format!("{}: {error}", model.display())),
        None => {
            let said = String::from_utf8_lossy(&output.stderr);
            let said = said.lines().find(|line| !line.trim().is_empty()).unwrap_or("no figures");
            Err(format!("{}: {said}", model.display()))
        }
    }
}
