//! Steps per second of models: this project's own, and those of the public corpus that have a reference.

use std::path::{Path, PathBuf};

use super::command::{Measured, measure};
use super::{Effort, figure, geometric_mean, table};
use crate::{Failure, repository};

/// This project's models that are measured, relative to its root.
const OWN: &[&str] = &[
    "examples/visual_servoing/VisualServoing.asm",
    "examples/visual_servoing/VisualServoingFeedback.asm",
    "examples/visual_servoing/CompleteController.asm",
    "examples/production_cell/ProductionCell.asm",
    "examples/philosophers/Philosophers.asm",
    "examples/coffee_machine/CoffeeMachine.asm",
    "examples/game_of_life/GameOfLife.asm",
    "examples/sorting/Sorting.asm",
    "examples/sieve/Sieve.asm",
    "examples/euclid/Euclid.asm",
    "examples/hanoi/Hanoi.asm",
    "examples/reachability/Reachability.asm",
    "examples/word_count/WordCount.asm",
    "bench/models/BubbleSort.asm",
    "bench/models/Sieve.asm",
    "bench/models/Philosophers.asm",
    "bench/models/Life.asm",
    "bench/models/ProducerConsumer.asm",
];

/// Measures and prints this project's models.
///
/// # Errors
/// A model cannot be run.
pub fn own(binary: &Path, effort: Effort, only: &str) -> Result<(), Failure> {
    let root = repository::root();
    let mut rows = Vec::new();
    for model in OWN.iter().filter(|model| model.contains(only)) {
        match measure(binary, &root.join(model), effort) {
            Ok(measured) => rows.push(row(model, &measured)),
            Err(reason) => rows.push(vec![(*model).to_string(), format!("({reason})")]),
        }
    }
    if !rows.is_empty() {
        println!("Steps per second on one core, random inputs, invariants not evaluated\n");
        let head = ["model", "steps/s", "lowest", "highest", "changed %", "restarts", "load ms", "peak MB"];
        println!("{}", table(&head, &rows));
    }
    Ok(())
}

fn row(model: &str, measured: &Measured) -> Vec<String> {
    vec![
        model.to_string(),
        figure(measured.steps_per_second),
        figure(measured.lowest),
        figure(measured.highest),
        figure(measured.changed_percent),
        measured.restarts.to_string(),
        figure(measured.load_ms),
        measured.peak_memory_mb.map_or_else(|| "?".to_string(), figure),
    ]
}

/// One line of bench/reference.csv.
struct Reference {
    name: String,
    path: PathBuf,
    steps_per_second: f64,
}

/// Measures the models of the corpus that have a reference, and prints how many times faster they are here.
///
/// # Errors
/// bench/reference.csv cannot be read.
pub fn reference(binary: &Path, effort: Effort, corpus: &Path, only: &str) -> Result<(), Failure> {
    let mut rows = Vec::new();
    let mut ratios = Vec::new();
    for reference in references()?.iter().filter(|reference| reference.name.contains(only)) {
        let peer = figure(reference.steps_per_second);
        match measure(binary, &corpus.join(&reference.path), effort) {
            Ok(measured) => {
                let ratio = measured.steps_per_second / reference.steps_per_second;
                ratios.push(ratio);
                let (here, changed) = (figure(measured.steps_per_second), figure(measured.changed_percent));
                let cells = [here, peer, figure(ratio), changed, measured.restarts.to_string()];
                rows.push([reference.name.clone()].into_iter().chain(cells).collect());
            }
            Err(reason) => rows.push(vec![reference.name.clone(), format!("({reason})"), peer]),
        }
    }
    println!("Models of the public corpus against the peer's published figures\n");
    println!("{}", table(&["model", "steps/s", "peer", "times", "changed %", "restarts"], &rows));
    if let Some(mean) = geometric_mean(&ratios) {
        let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
        println!("{} ratios: geometric mean {}, least {}\n", ratios.len(), figure(mean), figure(least));
    }
    Ok(())
}

fn references() -> Result<Vec<Reference>, Failure> {
    let path = repository::root().join("bench/reference.csv");
    let wrap = |error: csv::Error| format!("{}: {error}", path.display());
    let mut reader = csv::Reader::from_path(&path).map_err(wrap)?;
    let mut references = Vec::new();
    for row in reader.records() {
        let row = row.map_err(wrap)?;
        let field = |index: usize| row.get(index).unwrap_or_default().trim().to_string();
        let steps_per_second = field(2).parse().map_err(|_| format!("bench/reference.csv: no number: {}", field(2)))?;
        references.push(Reference { name: field(0), path: PathBuf::from(field(1)), steps_per_second });
    }
    Ok(references)
}
