//! `groundstate chart import FILE`: reads a chart in another tool's notation.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use groundstate::has_errors;
use syntax::{SourceFile, Sources};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{read_text, write_text};
use crate::shell::Shell;

/// Arguments of `chart import`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A state chart in SCXML
    file: PathBuf,
    /// The chart to write. Default: stdout
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let text = read_text(&arguments.file, shell.global.limits.max_file_size)?;
    let named = arguments.output.as_ref().unwrap_or(&arguments.file);
    let name = named.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut sources = Sources::default();
    let file = sources.add(SourceFile::new(arguments.file.display().to_string(), text.as_str()));
    let imported = chart::import::scxml(file, &text, &name);
    shell.diagnostics(&sources, &imported.diagnostics)?;
    let Some(text) = imported.text else { return Ok(Exit::Model) };
    // SCXML says more than a chart does: what no chart can be is not written.
    let read = chart::load(SourceFile::new(format!("{name}.chart"), text.as_str()), &mut shell.disk());
    if has_errors(&read.diagnostics) {
        shell.diagnostics(&read.sources, &read.diagnostics)?;
        return Ok(Exit::Model);
    }
    match &arguments.output {
        None => shell.out().write_all(text.as_bytes())?,
        Some(path) => {
            write_text(path, &text)?;
            if shell.talks() {
                writeln!(shell.out(), "{}", path.display())?;
            }
        }
    }
    Ok(Exit::Good)
}
