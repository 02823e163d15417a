//! `groundstate generate cpp FILE.chart`: writes the program of a chart's system, with the runtime's headers and the classes of the
//! components' machines.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use generate::model::Options;
use generate::system::{Form, MachineClass};
use groundstate::job::{self, Cancel, Folder};

use super::model::placed;
use super::{Cpp, finished, write};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::load::load;
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
    let mut form = Form { wait_free: arguments.wait_free, namespace: arguments.namespace.clone(), classes: Vec::new() };
    let mut of_machines = Vec::new();
    for machine in chart.system.iter().flat_map(|system| &system.computing.machines) {
        if form.classes.iter().any(|class| class.file == machine.source.name) {
            continue;
        }
        match machine_class(shell, &machine.source.name, &arguments.output)? {
            Ok((class, files)) => {
                form.classes.push(class);
                of_machines.extend(files);
            }
            Err(exit) => return Ok(exit),
        }
    }
    let folder = arguments.output.join("generated");
    std::fs::create_dir_all(&folder).map_err(|error| Failure::of_file("write", &folder, error))?;
    let cancel = Cancel::from(interrupt::request().clone());
    let job = job::generate_system(chart, placed(&sources, &folder), name, form, cancel);
    let Folder { decided, once, .. } = match finished(shell, &sources, job)? {
        Ok(folder) => folder,
        Err(exit) => return Ok(exit),
    };
    for (path, text) in decided.iter().chain(&of_machines) {
        write(shell, &arguments.output.join(path), text)?;
    }
    let mut kept = Vec::new();
    for (path, text) in once.iter().filter(|_| !arguments.only_generated) {
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

/// The class of a component's machine, and its files within the folder of the program.
type Made = (MachineClass, Vec<(String, String)>);

fn machine_class(shell: &mut Shell, file: &str, output: &Path) -> Result<Result<Made, Exit>, Failure> {
    let loaded = match load(shell, Path::new(file))? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(Err(exit)),
    };
    let folder = output.join("generated/machines");
    std::fs::create_dir_all(&folder).map_err(|error| Failure::of_file("write", &folder, error))?;
    let sources = placed(&loaded.sources, &folder);
    let cancel = Cancel::from(interrupt::request().clone());
    let job = job::generate_model(Arc::clone(&loaded.program), sources, Options::default(), cancel);
    let made = finished(shell, &loaded.sources, job)?;
    Ok(made
        .map(|folder| job::machine_of_component(file.to_string(), loaded.model.name.clone(), &loaded.program, folder)))
}
