//! `groundstate completions SHELL`: a script that completes commands, options and their values in a shell.

use std::io::Write;

use clap::{Args, Command};
use clap_complete::Shell as Language;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;

/// Arguments of `completions`.
#[derive(Debug, Args)]
#[command(
    after_help = "For example: groundstate completions bash > ~/.local/share/bash-completion/completions/groundstate"
)]
pub struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Language,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments, mut command: Command) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "groundstate", &mut script);
    shell.out().write_all(&script)?;
    Ok(Exit::Good)
}
