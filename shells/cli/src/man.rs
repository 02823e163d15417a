//! `groundstate man`: the manual pages of the program and of each of its commands.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, Command};
use clap_mangen::Man;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::write_bytes;
use crate::shell::Shell;

/// Arguments of `man`.
#[derive(Debug, Args)]
#[command(after_help = "For example: groundstate man -o ~/.local/share/man/man1")]
pub struct Arguments {
    /// Write a page for each command into this folder. Default: the first page, to stdout
    #[arg(long, short, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments, mut command: Command) -> Result<Exit, Failure> {
    let Some(folder) = &arguments.output else {
        let text = page(command)?;
        shell.out().write_all(&text)?;
        return Ok(Exit::Good);
    };
    // Building makes the global options known to each command.
    command.build();
    std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    let written = write_all(folder, &command, "groundstate")?;
    if shell.talks() {
        writeln!(shell.out(), "{}: {}", folder.display(), crate::check::plural(written, "page"))?;
    }
    Ok(Exit::Good)
}

/// Writes the pages of a command and of its subcommands; returns how many.
fn write_all(folder: &Path, command: &Command, name: &str) -> Result<usize, Failure> {
    let own = command.clone().display_name(name.to_string());
    write_bytes(&folder.join(format!("{name}.1")), &page(own)?)?;
    let mut written = 1;
    for below in command.get_subcommands().filter(|below| !below.is_hide_set() && below.get_name() != "help") {
        written += write_all(folder, below, &format!("{name}-{}", below.get_name()))?;
    }
    Ok(written)
}

fn page(command: Command) -> Result<Vec<u8>, Failure> {
    let mut text = Vec::new();
    Man::new(command).render(&mut text)?;
    Ok(text)
}
