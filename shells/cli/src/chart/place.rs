//! `groundstate chart place FILE`: writes the places of shapes into the chart.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{rewrite_text, write_text};
use crate::overwrite;
use crate::shell::Shell;

/// Arguments of `chart place`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A chart
    file: PathBuf,
    /// Place only this machine or system
    #[arg(long, value_name = "NAME")]
    machine: Option<String>,
    /// Write the chart to this file; `-` for stdout. Default: into the chart itself
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let (sources, chart) = match super::read(shell, &arguments.file)? {
        Ok(read) => read,
        Err(exit) => return Ok(exit),
    };
    let wanted = |name: &str| arguments.machine.as_ref().is_none_or(|machine| machine == name);
    let drawings = draw::drawings(&chart);
    if !drawings.iter().any(|drawing| wanted(drawing.name())) {
        return Err(super::nothing_drawn(&drawings));
    }
    let file = syntax::FileId(0);
    let text = &sources.file(file).text;
    let parse = syntax::parse_chart(file, text);
    let placed = draw::place(&chart, &parse, text, wanted).map_err(|fault| Failure::usage(fault.to_string()))?;
    let output = arguments.output.as_deref().unwrap_or(&arguments.file);
    if output == Path::new("-") {
        shell.out().write_all(placed.as_bytes())?;
        return Ok(Exit::Good);
    }
    let in_place = output == arguments.file || overwrite::same(output, &arguments.file);
    if !in_place {
        write_text(output, &placed)?;
    } else if *placed != **text {
        rewrite_text(output, &placed)?;
    }
    if shell.talks() {
        writeln!(shell.out(), "{}", output.display())?;
    }
    Ok(Exit::Good)
}
