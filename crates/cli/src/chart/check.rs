//! `groundstate chart check FILE`: whether a chart and its specification say the same.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use syntax::{Severity, SourceFile, Sources};

use crate::check::plural;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::read_text;
use crate::shell::Shell;
use crate::solver::Process;

/// Arguments of `chart check`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A chart
    file: PathBuf,
    /// The specification. Default: beside the chart, with the ending .asm
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    /// The SMT solver that decides about guards over numbers, a program or `none`. Default: z3 or cvc5 from the PATH
    #[arg(long, value_name = "PROGRAM")]
    solver: Option<PathBuf>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let root = shell.disk().root(&arguments.file)?;
    let (_, chart) = match super::read(shell, &arguments.file)? {
        Ok(read) => read,
        Err(exit) => return Ok(exit),
    };
    let path = arguments.model.clone().unwrap_or_else(|| arguments.file.with_extension("asm"));
    let name = path.display().to_string();
    let specification = read_text(&path, shell.global.limits.max_file_size)?;
    let probed = match chart::probed(&chart, &specification) {
        Ok(probed) => probed,
        Err(faults) => {
            let mut sources = Sources::default();
            sources.add(SourceFile::new(name, specification));
            shell.diagnostics(&sources, &faults)?;
            return Ok(Exit::Model);
        }
    };
    let mut checked = groundstate::check(SourceFile::new(name, probed.text.clone()), &mut shell.disk());
    // The chart's own places, beside those of the specification.
    let loaded = chart::load_beside(std::mem::take(&mut checked.sources), root, &mut shell.disk());
    let chart = loaded.chart;
    checked.sources = loaded.sources;
    let mut solver = Process::find(arguments.solver.as_deref());
    let faults = chart::check(&chart, &probed, &checked, &mut solver);
    let (notes, faults): (Vec<_>, Vec<_>) = faults.into_iter().partition(|fault| fault.severity == Severity::Note);
    shell.diagnostics(&checked.sources, &faults)?;
    if shell.json() {
        shell.diagnostics(&checked.sources, &notes)?;
    }
    if shell.talks() {
        let errors = faults.iter().filter(|fault| fault.severity == Severity::Error).count();
        let warnings = faults.len() - errors;
        let differ = faults.iter().all(|fault| fault.severity != Severity::Error || fault.id == "chart-differs");
        let verdict = match errors {
            0 => "agrees with its specification".to_string(),
            count if differ => plural(count, "difference"),
            count => plural(count, "fault"),
        };
        let more = if warnings == 0 { String::new() } else { format!(", {}", plural(warnings, "warning")) };
        let verdict = verdict + &more;
        writeln!(shell.out(), "{}: {verdict}", arguments.file.display())?;
        for note in &notes {
            writeln!(shell.out(), "  {}: {}", checked.sources.position(note.primary.span), note.message)?;
        }
    }
    Ok(if groundstate::has_errors(&faults) { Exit::Model } else { Exit::Good })
}
