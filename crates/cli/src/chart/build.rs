//! `groundstate chart build FILE`: the model that a chart stands for.

use std::io::Write;
use std::path::{Path, PathBuf};

use chart::Known;
use clap::Args;
use syntax::{SourceFile, Sources};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{read_text, write_text};
use crate::shell::Shell;

/// Arguments of `chart build`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A chart
    file: PathBuf,
    /// The model to write, or to bring up to date; `-` for stdout. Default: beside the chart, with the ending .asm
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let (sources, chart) = match super::read(shell, &arguments.file)? {
        Ok(read) => read,
        Err(exit) => return Ok(exit),
    };
    let beside = arguments.file.with_file_name("Imports.asm").display().to_string();
    let known = match Known::imported(&chart, &beside, &mut shell.disk()) {
        Ok(known) => known,
        Err(unknown) => {
            shell.diagnostics(&sources, &unknown.imports)?;
            shell.diagnostics(&unknown.checked.sources, &unknown.modules)?;
            return Ok(Exit::Model);
        }
    };
    let unbuilt = chart::unbuilt(&chart, &known);
    if !unbuilt.is_empty() {
        shell.diagnostics(&sources, &unbuilt)?;
        return Ok(Exit::Model);
    }
    let output = arguments.output.clone().unwrap_or_else(|| arguments.file.with_extension("asm"));
    let to_stdout = output == Path::new("-");
    let limit = shell.global.limits.max_file_size;
    let existing = match read_text(&output, limit) {
        _ if to_stdout => None,
        Ok(text) => Some(text),
        Err(Failure::Missing(_)) => None,
        Err(failure) => return Err(failure),
    };
    let built = match chart::build(&chart, &known, existing.as_deref()) {
        Ok(built) => built,
        Err(faults) => {
            let mut sources = Sources::default();
            sources.add(SourceFile::new(output.display().to_string(), existing.unwrap_or_default()));
            shell.diagnostics(&sources, &faults)?;
            return Ok(Exit::Model);
        }
    };
    if to_stdout {
        shell.out().write_all(built.text.as_bytes())?;
        return Ok(Exit::Good);
    }
    if existing.as_deref() != Some(&built.text) {
        write_text(&output, &built.text)?;
    }
    if shell.talks() {
        let to_write = match built.to_write.len() {
            0 => String::new(),
            _ => format!("; to be written: {}", built.to_write.join(", ")),
        };
        writeln!(shell.out(), "{}{to_write}", output.display())?;
    }
    Ok(Exit::Good)
}
