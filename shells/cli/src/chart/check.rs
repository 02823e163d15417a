//! `groundstate chart check FILE`: checks that a chart and its model agree.

use std::io::Write;
use std::path::PathBuf;

use chart::Known;
use clap::Args;
use syntax::{Severity, SourceFile, Sources};

use crate::check::plural;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::read_text;
use crate::shell::Shell;
use crate::solver::Process;

use super::obligation::{self, Asked, Told};

/// Arguments of `chart check`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A chart
    file: PathBuf,
    /// The model. Default: beside the chart, with the ending .asm
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    /// The SMT solver that decides guards over numbers: a program or `none`. Default: z3 or cvc5 from the PATH
    #[arg(long, value_name = "PROGRAM")]
    solver: Option<PathBuf>,
    /// Prove or refute that the machines named behind `to refine by` refine the actions
    #[arg(long)]
    prove: bool,
    /// Take for granted that a machine which waits for something outside is not kept waiting for ever
    #[arg(long, requires = "prove")]
    allow_waiting: bool,
    /// The most time for one proof, in seconds
    #[arg(long, value_name = "SECONDS", requires = "prove", value_parser = crate::limits::count)]
    time: Option<u64>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let (_, chart) = match super::read(shell, &arguments.file)? {
        Ok(read) => read,
        Err(exit) => return Ok(exit),
    };
    if chart.machines.is_empty() && chart.system.is_none() {
        return not_compared(shell, arguments, "the chart has no machine and no system");
    }
    let path = arguments.model.clone().unwrap_or_else(|| arguments.file.with_extension("asm"));
    let name = path.display().to_string();
    let specification = match read_text(&path, shell.global.limits.max_file_size) {
        Err(Failure::Missing(_)) if arguments.model.is_none() => {
            return not_compared(shell, arguments, &format!("there is no model {name}"));
        }
        read => read?,
    };
    let probed = match chart::probed(&chart, &specification) {
        Ok(probed) => probed,
        Err(faults) => {
            let mut sources = Sources::default();
            sources.add(SourceFile::new(name, specification));
            shell.diagnostics(&sources, &faults)?;
            return Ok(Exit::Model);
        }
    };
    let root = shell.disk().root(&arguments.file)?;
    let mut checked = groundstate::check(SourceFile::new(name, probed.text.clone()), &mut shell.disk());
    // Faults may point into the chart, besides the model.
    let loaded = chart::load_beside(std::mem::take(&mut checked.sources), root.clone(), &mut shell.disk());
    let mut chart = loaded.chart;
    checked.sources = loaded.sources;
    // Faults of the imports are also the model's and are reported there.
    let known = Known::completed(
        &mut chart,
        &arguments.file.with_file_name("Imports.asm").display().to_string(),
        &mut shell.disk(),
    );
    let model = SourceFile::new(path.display().to_string(), specification);
    let mut solver = Process::find(arguments.solver.as_deref());
    let mut faults = chart::check(&chart, &probed, &checked, &mut solver);
    // What is told already may be why it is outdated.
    if !groundstate::has_errors(&faults) {
        faults.extend(match known {
            Ok(known) => chart::outdated(&chart, &known, checked.model.root, &model.text),
            // Without the chart's imports it is not known what building would write.
            Err(unknown) => unknown.imports,
        });
    }
    let (mut notes, faults): (Vec<_>, Vec<_>) = faults.into_iter().partition(|fault| fault.severity == Severity::Note);
    let differs = groundstate::has_errors(&faults);
    let owed = groundstate::owed(&root, &chart, &model, &mut shell.disk());
    let asked = arguments.prove.then_some(Asked { waiting: arguments.allow_waiting, time: arguments.time });
    let told = obligation::told(shell, &arguments.file, &owed, asked, differs);
    for (owed, told) in owed.iter().zip(&told) {
        let note = notes.iter_mut().find(|note| note.primary.span == owed.obligation.span);
        note.into_iter().for_each(|note| note.help = Some(told.words()));
    }
    shell.diagnostics(&checked.sources, &faults)?;
    if shell.json() {
        shell.diagnostics(&checked.sources, &notes)?;
    }
    if shell.talks() {
        let errors = faults.iter().filter(|fault| fault.severity == Severity::Error).count();
        let warnings = faults.len() - errors;
        let differ = faults
            .iter()
            .all(|fault| fault.severity != Severity::Error || ["chart-differs", "system-differs"].contains(&fault.id));
        let verdict = match errors {
            0 => "agrees with its specification".to_string(),
            count if differ => plural(count, "difference"),
            count => plural(count, "fault"),
        };
        let more = if warnings == 0 { String::new() } else { format!(", {}", plural(warnings, "warning")) };
        let verdict = verdict + &more;
        writeln!(shell.out(), "{}: {verdict}", arguments.file.display())?;
        for note in notes.iter().filter(|note| note.id != "to-refine") {
            writeln!(shell.out(), "  {}: {}", checked.sources.position(note.primary.span), note.message)?;
        }
        for (owed, told) in owed.iter().zip(&told) {
            let (place, name) = (checked.sources.position(owed.obligation.span), &owed.obligation.shape);
            let by = owed.obligation.by.as_ref().map_or_else(String::new, |by| format!(" by `{by}`"));
            writeln!(shell.out(), "  {place}: `{name}`, to refine{by}: {}", told.words())?;
            if let Told::Refuted { report, .. } = told {
                report.lines().try_for_each(|line| writeln!(shell.out(), "    {line}"))?;
            }
        }
    }
    let refuted = told.iter().any(|told| matches!(told, Told::Refuted { .. }));
    let unknown = told.iter().any(|told| matches!(told, Told::Unknown(_)));
    Ok(match (differs || refuted, unknown) {
        (true, _) => Exit::Model,
        (_, true) => Exit::Unknown,
        _ => Exit::Good,
    })
}

/// Nothing was compared.
fn not_compared(shell: &mut Shell, arguments: &Arguments, reason: &str) -> Result<Exit, Failure> {
    let text = format!("{}: not compared: {reason}", arguments.file.display());
    if shell.talks() {
        writeln!(shell.out(), "{text}")?;
    } else {
        shell.note(&text)?;
    }
    Ok(Exit::Unknown)
}
