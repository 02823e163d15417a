//! `groundstate generate …`: programs made of models and charts. What is made depends on the file's ending.

mod system;

use std::path::PathBuf;

use clap::{Args, Subcommand};

use crate::exit::Exit;
use crate::failure::Failure;
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
    /// A chart that has a system
    file: PathBuf,
    /// The folder to write to; files of yours that are there stay as they are
    #[arg(long, short, value_name = "DIR")]
    output: PathBuf,
    /// Hand buffers over by one atomic exchange, instead of the protocol with a lock
    #[arg(long)]
    wait_free: bool,
    /// The namespace of the classes; made of the system's name if not given
    #[arg(long, value_name = "NAME")]
    namespace: Option<String>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let Command::Cpp(arguments) = &arguments.command;
    match arguments.file.extension().and_then(|extension| extension.to_str()) {
        Some("chart") => system::run(shell, arguments),
        _ => Err(Failure::usage_with_help(
            format!("{} is no chart", arguments.file.display()),
            "C++ is generated from a chart with a system",
        )),
    }
}
