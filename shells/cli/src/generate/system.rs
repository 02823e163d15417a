//! `groundstate generate cpp FILE.chart`: writes the program of a chart's system, with the runtime's headers.

use std::io::Write;

use generate::system::Form;
use groundstate::job::{self, Cancel, Folder};

use super::{Cpp, finished, write};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::shell::Shell;

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Cpp) -> Result<Exit, Failure> {
    let (sources, chart) = match crate::chart::read(shell, &arguments.file)? {
        Ok(read) => read,
        Err(exit) => return Ok(exit),
    };
    if chart.system.is_none() {
        return Err(Failure::usage_with_help(
            format!("{} has no system", arguments.file.display()),
            "tasks are generated from the components of a system",
        ));
    }
    let name = arguments.file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let form = Form { wait_free: arguments.wait_free, namespace: arguments.namespace.clone() };
    let job = job::generate_system(chart, name, form, Cancel::from(interrupt::request().clone()));
    let Folder { decided, once, .. } = match finished(shell, &sources, job)? {
        Ok(folder) => folder,
        Err(exit) => return Ok(exit),
    };
    for (path, text) in &decided {
        write(shell, &arguments.output.join(path), text)?;
    }
    let mut kept = Vec::new();
    for (path, text) in &once {
        if arguments.output.join(path).exists() {
            kept.push(path.as_str());
        } else {
            write(shell, &arguments.output.join(path), text)?;
        }
    }
    if shell.talks() {
        writeln!(shell.out(), "{}", arguments.output.join(&decided[0].0).display())?;
        if !kept.is_empty() {
            writeln!(shell.out(), "your files, left as they are: {}", kept.join(", "))?;
        }
    }
    Ok(Exit::Good)
}
