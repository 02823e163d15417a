//! `groundstate chart draw FILE`: the machines of a chart as SVG.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;

/// Arguments of `chart draw`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A chart
    file: PathBuf,
    /// Draw this machine or system alone
    #[arg(long, value_name = "NAME")]
    machine: Option<String>,
    /// A folder for the pictures, NAME.svg for each machine; or a file, where there is one picture. Default: stdout
    #[arg(long, short, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Colours: as the reader's screen is, or fixed
    #[arg(long, value_enum, default_value_t = Theme::Auto)]
    theme: Theme,
}

/// Colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Theme {
    /// As the reader's screen is
    Auto,
    /// Dark on light
    Light,
    /// Light on dark
    Dark,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let (_, chart) = match super::read(shell, &arguments.file)? {
        Ok(read) => read,
        Err(exit) => return Ok(exit),
    };
    let wanted = |name: &str| arguments.machine.as_ref().is_none_or(|machine| machine == name);
    let all = chart::drawings(&chart);
    let machines: Vec<_> = all.iter().filter(|drawing| wanted(drawing.name())).collect();
    if machines.is_empty() {
        let names: Vec<&str> = all.iter().map(chart::draw::Drawing::name).collect();
        let help = format!("it has: {}", names.join(", "));
        return Err(Failure::usage_with_help("the chart has no such machine", help));
    }
    let theme = match arguments.theme {
        Theme::Auto => chart::draw::Theme::Auto,
        Theme::Light => chart::draw::Theme::Light,
        Theme::Dark => chart::draw::Theme::Dark,
    };
    let several = machines.len() > 1;
    let folder = arguments.output.as_ref().filter(|path| path.extension().is_none_or(|extension| extension != "svg"));
    if several && folder.is_none() {
        let help = "name a folder with --output, or one machine with --machine";
        return Err(Failure::usage_with_help(format!("the chart has {} machines", machines.len()), help));
    }
    for machine in machines {
        let svg = machine.svg(theme).map_err(|fault| Failure::usage(fault.to_string()))?;
        match (&arguments.output, folder) {
            (None, _) => shell.out().write_all(svg.as_bytes())?,
            (Some(_), Some(folder)) => {
                std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
                written(shell, &folder.join(format!("{}.svg", machine.name())), &svg)?;
            }
            (Some(file), None) => written(shell, file, &svg)?,
        }
    }
    Ok(Exit::Good)
}

fn written(shell: &mut Shell, path: &std::path::Path, svg: &str) -> Result<(), Failure> {
    crate::files::write_text(path, svg)?;
    if shell.talks() {
        writeln!(shell.out(), "{}", path.display())?;
    }
    Ok(())
}
