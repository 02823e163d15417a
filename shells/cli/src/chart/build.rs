//! `groundstate chart build FILE`: writes the model that a chart means.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use groundstate::BuiltChart;
use groundstate::chart::Built;
use syntax::SourceFile;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{present_text, write_text};
use crate::overwrite;
use crate::shell::Shell;

/// Arguments of `chart build`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A chart
    file: PathBuf,
    /// The model to write or to update; `-` for stdout. Default: beside the chart, with the ending .asm
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    super::is_chart(&arguments.file)?;
    let root = shell.disk().root(&arguments.file)?;
    let output = arguments.output.clone().unwrap_or_else(|| arguments.file.with_extension("asm"));
    let to_stdout = output == Path::new("-");
    // An existing model is updated, but the chart itself and what it imports are never overwritten.
    overwrite::refuse(&output)?;
    let existing = if to_stdout { None } else { present_text(&output, shell.global.limits.max_file_size)? };
    let name = if to_stdout { arguments.file.with_extension("asm") } else { output.clone() };
    let Some(built) = build(shell, root, &name, existing.as_deref())? else {
        if shell.talks() {
            shell.note(&format!("{} has faults and was not built", arguments.file.display()))?;
        }
        return Ok(Exit::Model);
    };
    if to_stdout {
        shell.out().write_all(built.text.as_bytes())?;
        return Ok(Exit::Good);
    }
    overwrite::refuse(&output)?;
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

/// Builds the model of a chart under a file's name, into the existing text, and shows the chart's faults. None if one of them
/// is an error.
pub fn build(
    shell: &mut Shell,
    root: SourceFile,
    output: &Path,
    existing: Option<&str>,
) -> Result<Option<Built>, Failure> {
    let BuiltChart { built, faults, .. } =
        groundstate::build_chart(root, &output.display().to_string(), existing, &mut shell.disk());
    for (sources, faults) in &faults {
        shell.diagnostics(sources, faults)?;
    }
    Ok(built)
}
