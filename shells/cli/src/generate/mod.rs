//! `groundstate generate …`: generates programs from models and charts. The file's ending decides which.

mod model;
mod system;

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use groundstate::job::{Folder, GenerateJob, NotGenerated};
use syntax::Sources;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{present_text, write_text};
use crate::shell::Shell;

/// Arguments of `generate`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Write a C++20 program
    Cpp(Cpp),
}

/// Arguments of `generate cpp`.
#[derive(Debug, Args)]
pub struct Cpp {
    /// A model, or a chart that has a system
    file: PathBuf,
    /// The folder to write to; your own files in it stay as they are
    #[arg(long, short, value_name = "DIR")]
    output: PathBuf,
    /// For a model: without heap, exceptions, RTTI and threads, for microcontrollers
    #[arg(long)]
    bare: bool,
    /// With --bare: how many locations outside of arrays a function may have, or elements a growing domain
    #[arg(long, value_name = "NAME=NUMBER", value_parser = capacity, requires = "bare")]
    capacity: Vec<(String, u32)>,
    /// For a chart: hand buffers over by one atomic exchange instead of a lock
    #[arg(long)]
    wait_free: bool,
    /// For a chart: the namespace of the classes. Default: from the system's name
    #[arg(long, value_name = "NAME")]
    namespace: Option<String>,
    /// For a chart: write `generated/` alone, and none of your own files, also if they are missing
    #[arg(long)]
    only_generated: bool,
}

fn capacity(text: &str) -> Result<(String, u32), String> {
    let (name, number) = text.split_once('=').ok_or("a capacity is written NAME=NUMBER")?;
    let number = number.parse().map_err(|_| format!("`{number}` is no number"))?;
    Ok((name.to_string(), number))
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let Command::Cpp(arguments) = &arguments.command;
    let chart = match arguments.file.extension().and_then(|extension| extension.to_str()) {
        Some("chart") => true,
        Some("asm") => false,
        _ => {
            return Err(Failure::usage_with_help(
                format!("{} is neither a model nor a chart", arguments.file.display()),
                "C++ is generated from a model, FILE.asm, or from a chart with a system, FILE.chart",
            ));
        }
    };
    if chart && arguments.bare {
        return Err(Failure::usage("--bare is for models: a system's tasks are threads"));
    }
    if !chart && (arguments.wait_free || arguments.namespace.is_some() || arguments.only_generated) {
        return Err(Failure::usage("--wait-free, --namespace and --only-generated are for charts with a system"));
    }
    if chart { system::run(shell, arguments) } else { model::run(shell, arguments) }
}

/// The result of a generation; shows what cannot be generated.
fn finished(
    shell: &mut Shell,
    sources: &Sources,
    job: std::io::Result<GenerateJob>,
) -> Result<Result<Folder, Exit>, Failure> {
    let job = job.map_err(|error| Failure::usage(format!("the generation cannot be started: {error}")))?;
    match job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0)) {
        Ok(folder) => Ok(Ok(folder)),
        Err(NotGenerated::Refused(faults)) => {
            shell.diagnostics(sources, &faults)?;
            Ok(Err(Exit::Model))
        }
        Err(NotGenerated::NoSystem) => unreachable!("a chart without a system is refused before"),
        Err(NotGenerated::Cancelled) => Ok(Err(Exit::Unknown)),
    }
}

/// Writes a file of a generated folder, unless it has that text already.
fn write(shell: &Shell, path: &Path, text: &str) -> Result<(), Failure> {
    if matches!(present_text(path, shell.global.limits.max_file_size), Ok(Some(there)) if there == text) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    }
    write_text(path, text)
}
