//! Whether memory grows with the number of steps: the peak of a process that made ten times as many.

use std::path::Path;

use super::command::make_steps;
use super::{figure, table};
use crate::{Failure, repository};

/// What is run: a model whose every step changes the state, one that chooses, one with sets and new elements.
const MODELS: &[&str] = &[
    "bench/models/Philosophers.asm",
    "examples/coffee_machine/CoffeeMachine.asm",
    "examples/visual_servoing/VisualServoing.asm",
];

/// Runs and prints; `steps` are made first, then ten times as many in another process.
///
/// # Errors
/// A model cannot be run.
pub fn peaks(binary: &Path, steps: u64, only: &str) -> Result<(), Failure> {
    let root = repository::root();
    let mut rows = Vec::new();
    for model in MODELS.iter().filter(|model| model.contains(only)) {
        let mut row = vec![(*model).to_string()];
        for steps in [steps, 10 * steps] {
            let measured = make_steps(binary, &root.join(model), steps)?;
            row.push(measured.peak_memory_mb.map_or_else(|| "?".to_string(), figure));
        }
        rows.push(row);
    }
    if !rows.is_empty() {
        let head = [format!("MB after {}", figure(steps as f64)), format!("after {}", figure(10.0 * steps as f64))];
        println!("Peak of memory by the number of steps\n");
        println!("{}", table(&["model", &head[0], &head[1]], &rows));
    }
    Ok(())
}
