//! `groundstate dap`: the debug adapter, for editors; the crate `dap` is all of it.

use clap::Args;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;

/// Arguments of `dap`.
#[derive(Debug, Args)]
#[command(after_help = "Editors start it; docs/editors.md says how to set them up.")]
pub struct Arguments {}

/// Runs the command.
pub fn run(shell: &mut Shell, _arguments: &Arguments) -> Result<Exit, Failure> {
    match ::dap::serve_stdio(shell.disk()) {
        Ok(()) => Ok(Exit::Good),
        Err(reason) => Err(Failure::usage(reason)),
    }
}
