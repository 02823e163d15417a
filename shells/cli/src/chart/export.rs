//! `groundstate chart export FILE --to NOTATION`: writes a chart in the notation of another tool.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use draw::Notation;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::write_text;
use crate::shell::Shell;

/// Arguments of `chart export`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A chart
    file: PathBuf,
    /// The notation
    #[arg(long, value_enum, value_name = "NOTATION")]
    to: To,
    /// Export only this machine or system
    #[arg(long, value_name = "NAME")]
    machine: Option<String>,
    /// A folder, with a file for each machine. Default: stdout
    #[arg(long, short, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// A notation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum To {
    /// A flowchart for mermaid.js.org
    Mermaid,
    /// A graph for graphviz.org
    Dot,
    /// State Chart XML of the W3C
    Scxml,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let (_, chart) = match super::read(shell, &arguments.file)? {
        Ok(read) => read,
        Err(exit) => return Ok(exit),
    };
    let (notation, ending) = match arguments.to {
        To::Mermaid => (Notation::Mermaid, "mmd"),
        To::Dot => (Notation::Dot, "dot"),
        To::Scxml => (Notation::Scxml, "scxml"),
    };
    let wanted = |name: &str| arguments.machine.as_ref().is_none_or(|machine| machine == name);
    let drawings = draw::drawings(&chart);
    let texts = drawings.iter().filter(|drawing| wanted(drawing.name()));
    let texts: Vec<_> = texts.filter_map(|drawing| Some((drawing.name(), draw::export(drawing, notation)?))).collect();
    if texts.is_empty() {
        if !drawings.iter().any(|drawing| wanted(drawing.name())) {
            return Err(super::nothing_drawn(&drawings));
        }
        return Err(Failure::usage(
            "SCXML has state machines, and what the chart draws is a system: there is nothing to write in this notation",
        ));
    }
    let Some(folder) = &arguments.output else {
        for (_, text) in &texts {
            shell.out().write_all(text.as_bytes())?;
        }
        return Ok(Exit::Good);
    };
    std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    for (name, text) in &texts {
        let path = folder.join(format!("{name}.{ending}"));
        write_text(&path, text)?;
        if shell.talks() {
            writeln!(shell.out(), "{}", path.display())?;
        }
    }
    Ok(Exit::Good)
}
