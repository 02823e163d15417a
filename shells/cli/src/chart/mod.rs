//! `groundstate chart …`: draws charts, builds models from them, compares the two. One file per subcommand.

pub mod build;
mod check;
mod draw;
mod export;
mod extract;
mod import;
mod obligation;
mod place;
mod times;

use std::path::Path;

use ::chart::Chart;
use clap::{Args, Subcommand};
use syntax::Sources;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::load::another;
use crate::shell::Shell;

/// Arguments of `chart`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Write the model that a chart means; keep what is written by hand in it
    Build(build::Arguments),
    /// Compare a chart with its model, transition by transition
    Check(check::Arguments),
    /// Write the chart of a model's rules in control-state form
    Extract(extract::Arguments),
    /// Write a chart in the notation of another tool: Mermaid, Graphviz DOT, SCXML
    Export(export::Arguments),
    /// Write a chart from another tool's notation: SCXML
    Import(import::Arguments),
    /// Draw a chart's machines and system
    Draw(draw::Arguments),
    /// Write the places of a chart's shapes into the chart, so that they stay there
    Place(place::Arguments),
    /// Tell load, responses and ages of data before anything runs
    Times(times::Arguments),
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    match &arguments.command {
        Command::Build(arguments) => build::run(shell, arguments),
        Command::Check(arguments) => check::run(shell, arguments),
        Command::Extract(arguments) => extract::run(shell, arguments),
        Command::Export(arguments) => export::run(shell, arguments),
        Command::Import(arguments) => import::run(shell, arguments),
        Command::Draw(arguments) => draw::run(shell, arguments),
        Command::Place(arguments) => place::run(shell, arguments),
        Command::Times(arguments) => times::run(shell, arguments),
    }
}

/// Reads a chart and those it imports, and shows their faults. If there are errors, returns the exit code.
pub fn read(shell: &mut Shell, path: &Path) -> Result<Result<(Sources, Chart), Exit>, Failure> {
    is_chart(path)?;
    let mut disk = shell.disk();
    let root = disk.root(path)?;
    let ::chart::Loaded { sources, chart, diagnostics } = ::chart::load(root, &mut disk);
    shell.diagnostics(&sources, &diagnostics)?;
    if groundstate::has_errors(&diagnostics) {
        return Ok(Err(Exit::Model));
    }
    Ok(Ok((sources, chart)))
}

/// Why no drawing is meant: the chart has none at all, or none of the name that `--machine` gives.
fn nothing_drawn(all: &[::draw::Drawing]) -> Failure {
    if all.is_empty() {
        return Failure::usage_with_help(
            "the chart has no machine and no system: there is nothing to draw",
            "write a `machine`, a `pattern` or a `system`, or name the chart that has it",
        );
    }
    let names: Vec<&str> = all.iter().map(::draw::Drawing::name).collect();
    Failure::usage_with_help("the chart has no such machine", format!("it has: {}", names.join(", ")))
}

/// Refuses a model or a scenario, whatever it contains.
fn is_chart(path: &Path) -> Result<(), Failure> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("asm") => Err(another(path, "model", "`groundstate chart extract` writes the chart of a model's rules")),
        Some("avalla") => Err(another(path, "scenario", "charts end with .chart")),
        _ => Ok(()),
    }
}
