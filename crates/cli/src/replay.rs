//! stub
use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;
/// Arguments.
#[derive(Debug, clap::Args)]
pub struct Arguments {}
/// Runs the command.
pub fn run(_shell: &mut Shell, _arguments: &Arguments) -> Result<Exit, Failure> {
    Ok(Exit::Good)
}
