//! `groundstate studio [FOLDER]`: the project in a browser; the crate `studio` is all of it.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::shell::Shell;

/// Arguments of `studio`.
#[derive(Debug, Args)]
#[command(
    after_help = "Only browsers of this machine are answered, and only by the address that is printed. docs/studio.md is a tour."
)]
pub struct Arguments {
    /// The project
    #[arg(default_value = ".")]
    folder: PathBuf,
    /// The port; 0 takes one that follows from the folder's path, so that open pages find a new start, or one that is free
    #[arg(long, default_value_t = 0, value_name = "N")]
    port: u16,
    /// Print the address and open no browser
    #[arg(long)]
    no_open: bool,
    /// Write nothing
    #[arg(long)]
    read_only: bool,
    /// Start nothing: write the project as a site that any static server shows, with charts, a run of each model and verdicts
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["port", "no_open", "read_only"])]
    export: Option<PathBuf>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let program = std::env::current_exe();
    let program = program.map_err(|error| Failure::usage(format!("this program cannot find itself: {error}")))?;
    if let Some(site) = &arguments.export {
        let export = studio::Export { folder: arguments.folder.clone(), site: site.clone(), program };
        let talks = shell.talks();
        let tell = |path: &str| {
            if talks {
                eprintln!("{path}");
            }
        };
        let count = studio::export(&export, tell).map_err(Failure::usage)?;
        if talks {
            writeln!(shell.out(), "{}: {count} files of the project; any static server shows it", site.display())?;
        }
        return Ok(Exit::Good);
    }
    let options = studio::Options {
        folder: arguments.folder.clone(),
        port: arguments.port,
        read_only: arguments.read_only,
        program,
    };
    let mut told = Ok(());
    let started = |started: &studio::Started| {
        let out = shell.out();
        told = writeln!(out, "{}\n{}\nCtrl-C ends the studio.", started.folder.display(), started.address)
            .and_then(|()| out.flush());
        if !arguments.no_open && open::that_detached(&started.address).is_err() {
            eprintln!("no browser could be opened: open the address yourself");
        }
    };
    studio::serve(&options, started, interrupt::asked).map_err(Failure::usage)?;
    told?;
    Ok(Exit::Good)
}
