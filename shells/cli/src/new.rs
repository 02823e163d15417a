//! `groundstate new NAME`: makes a folder with a first model, its scenario, and a page of commands that all work. The model of
//! a template that is a chart is built from it.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::chart;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::write_text;
use crate::shell::Shell;

/// Arguments of `new`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The folder to make; its name becomes the model's: letters, digits and _
    name: PathBuf,
    /// What to start with
    #[arg(long, value_enum, default_value_t = Template::Machine, value_name = "TEMPLATE")]
    template: Template,
}

/// What a new folder starts with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Template {
    /// A control-state machine with inputs
    Machine,
    /// Tasks at several rates, and channels between them
    System,
    /// A vision-based robot: a system with a camera, and its C++ program
    Robot,
}

macro_rules! files {
    ($folder:literal: $($name:literal),*) => {
        &[$(($name, include_str!(concat!("../templates/", $folder, "/", $name)))),*]
    };
}

impl Template {
    /// Names and texts of the files; NAME in them stands for the model's name.
    fn files(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Template::Machine => files!("machine": "NAME.asm", "NAME.avalla", "README.md"),
            Template::System => files!("system": "NAME.chart", "NAME.avalla", "README.md"),
            Template::Robot => files!("robot": "NAME.chart", "NAME.avalla", "README.md"),
        }
    }
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let folder = &arguments.name;
    let name = name(folder)?;
    match std::fs::read_dir(folder) {
        Ok(mut entries) => {
            if entries.next().is_some() {
                let message = format!("{} already exists and is not empty", folder.display());
                return Err(Failure::usage_with_help(message, "nothing was written; choose another name"));
            }
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
        Err(error) => return Err(Failure::of_file("write", folder, error)),
    }
    std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    for (file, text) in arguments.template.files() {
        let path = folder.join(file.replace("NAME", name));
        write_text(&path, &text.replace("NAME", name))?;
        if path.extension().is_some_and(|ending| ending == "chart") {
            let model = path.with_extension("asm");
            // A template's chart has faults if the name is a word of the language.
            let root = shell.disk().root(&path)?;
            let Some(built) = chart::build::build(shell, root, &model, None)? else { return Ok(Exit::Model) };
            write_text(&model, &built.text)?;
        }
    }
    if shell.talks() {
        let page = folder.join("README.md");
        writeln!(shell.out(), "{}: `cd {}`, and go on with its commands", page.display(), folder.display())?;
    }
    Ok(Exit::Good)
}

/// The model's name, taken from the folder's.
fn name(folder: &Path) -> Result<&str, Failure> {
    let name = folder.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let fits = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let said = |reason: &str| {
        let message = format!("`{}` is no name for a model: {reason}", folder.display());
        Failure::usage_with_help(message, "a letter first, then letters, digits and _: MyRobot")
    };
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) || !name.chars().all(fits) {
        return Err(said("its last part may contain only letters, digits and _"));
    }
    if name.len() > 64 {
        return Err(said("it has more than 64 characters"));
    }
    // Imports of such names find the built-in libraries, whatever lies beside the model.
    if name.to_ascii_lowercase().ends_with("library") {
        return Err(said("names ending in Library belong to the built-in libraries"));
    }
    Ok(name)
}
