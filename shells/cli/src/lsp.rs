//! `groundstate lsp`: the language server, for editors; the crate `lsp` is all of it.

use clap::Args;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;

/// Arguments of `lsp`.
#[derive(Debug, Args)]
#[command(after_help = "Editors start it; docs/editors.md says how to set them up.")]
pub struct Arguments {
    /// Speak over stdin and stdout, which is what it does in any case
    #[arg(long)]
    stdio: bool,
}

/// Runs the command.
pub fn run(_shell: &mut Shell, _arguments: &Arguments) -> Result<Exit, Failure> {
    match lsp::serve_stdio() {
        Ok(()) => Ok(Exit::Good),
        Err(reason) => Err(Failure::usage(reason)),
    }
}
