//! `groundstate dump STAGE FILE`: the result of a stage, as text.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::load::load;
use crate::shell::Shell;

/// Arguments of `dump`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The stage whose result is shown
    #[arg(value_enum)]
    stage: Stage,
    /// A model; `tree` also takes a scenario or a chart, `chart` takes a chart
    file: PathBuf,
}

/// A stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Stage {
    /// The lossless tree of one file
    Tree,
    /// The checked model
    Model,
    /// The program that the machine runs
    Program,
    /// The chart that a chart file means
    Chart,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let text = match arguments.stage {
        Stage::Tree => return tree(shell, arguments),
        Stage::Model => {
            let mut disk = shell.disk();
            let checked = groundstate::check(disk.root(&arguments.file)?, &mut disk);
            shell.diagnostics(&checked.sources, &checked.diagnostics)?;
            if groundstate::has_errors(&checked.diagnostics) {
                return Ok(Exit::Model);
            }
            checked.model.dump()
        }
        Stage::Chart => match crate::chart::read(shell, &arguments.file)? {
            Ok((_, chart)) => chart::dump(&chart),
            Err(exit) => return Ok(exit),
        },
        Stage::Program => match load(shell, &arguments.file)? {
            Ok(loaded) => program::dump(&loaded.program),
            Err(exit) => return Ok(exit),
        },
    };
    shell.out().write_all(text.as_bytes())?;
    Ok(Exit::Good)
}

fn tree(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let mut sources = syntax::Sources::default();
    let file = sources.add(shell.disk().root(&arguments.file)?);
    let text = &sources.file(file).text;
    let extension = arguments.file.extension().and_then(|extension| extension.to_str());
    let parse = match extension {
        Some("avalla") => syntax::parse_avalla(file, text),
        Some("chart") => syntax::parse_chart(file, text),
        _ => syntax::parse_asmetal(file, text),
    };
    write!(shell.out(), "{}", syntax::dump(&parse.syntax()))?;
    shell.diagnostics(&sources, &parse.diagnostics)?;
    Ok(if groundstate::has_errors(&parse.diagnostics) { Exit::Model } else { Exit::Good })
}
