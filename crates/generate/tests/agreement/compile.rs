//! Compiles generated code to programs, with many models in one translation unit.
//!
//! In: generated files. Out: programs, or the compiler's messages. The runtime's headers and their functions, which all
//! models share, are most of the work and are compiled once per unit. A unit that does not compile is halved until the
//! faulty models stand alone. Those are compiled as their users do, one model per unit.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Mutex, OnceLock};

use crate::run::Prepared;

/// The largest number of models in a unit.
const SHARED: usize = 24;
/// LIMIT: the most bytes of generated code in a unit.
const CODE: usize = 1_500_000;
/// LIMIT: how many seconds compiling a unit may take.
const SECONDS: u32 = 900;

/// Where generated code is compiled.
pub struct Compiler {
    folder: PathBuf,
    kept: bool,
}

/// A model's files, ready to compile.
#[derive(Clone)]
pub struct Unit {
    /// The name of its folder.
    pub name: String,
    /// The namespace of its code.
    pub namespace: String,
    pub folder: PathBuf,
    /// The size of its code.
    pub bytes: usize,
}

/// A compiled model: a program, and the argument that selects the model in it.
#[derive(Clone)]
pub struct Program {
    pub path: PathBuf,
    pub word: String,
}

impl Compiler {
    pub fn new(name: &str) -> Compiler {
        let kept = std::env::var("GROUNDSTATE_KEEP").ok();
        let folder = match &kept {
            Some(folder) => Path::new(folder).join(name),
            None => std::env::temp_dir().join(format!("groundstate-agreement-{}-{name}", std::process::id())),
        };
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("a folder of one's own");
        Compiler { folder, kept: kept.is_some() }
    }

    /// The folder for all files.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Compiles the code of all models, two units at a time; results are in the same order.
    pub fn compile_all(&self, units: &[Unit]) -> Vec<Result<Program, String>> {
        let header = precompiled();
        let waiting = Mutex::new(shared(units));
        let done: Mutex<BTreeMap<usize, Result<Program, String>>> = Mutex::new(BTreeMap::new());
        std::thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| {
                    loop {
                        let Some(group) = waiting.lock().expect("unpoisoned").pop() else { return };
                        let outcomes = self.compile(header, units, &group);
                        done.lock().expect("unpoisoned").extend(outcomes);
                    }
                });
            }
        });
        done.into_inner().expect("unpoisoned").into_values().collect()
    }

    /// Compiles some models as one unit, or in parts if that fails.
    fn compile(&self, header: &Path, units: &[Unit], group: &[usize]) -> Vec<(usize, Result<Program, String>)> {
        let first = &units[group[0]];
        let (source, path) = match group {
            [_] => (first.folder.join("all.cpp"), first.folder.join("replay")),
            _ => {
                let stem = self.folder.join(format!("{}-{}", first.name, group.len()));
                (stem.with_extension("cpp"), stem)
            }
        };
        let text = match group {
            [_] => format!("#include \"{}.cpp\"\n#include \"replay.cpp\"\n", first.namespace),
            _ => together(units, group),
        };
        let compiled = std::fs::write(&source, text).map_err(|error| error.to_string()).and_then(|()| {
            let mut command = strict();
            command.arg("-include").arg(header).arg(&source).arg("-o").arg(&path);
            within(SECONDS, &command)
        });
        match compiled {
            Ok(output) if output.status.success() => group
                .iter()
                .map(|index| (*index, Ok(Program { path: path.clone(), word: units[*index].name.clone() })))
                .collect(),
            _ if group.len() > 1 => {
                let (left, right) = group.split_at(group.len() / 2);
                let mut outcomes = self.compile(header, units, left);
                outcomes.extend(self.compile(header, units, right));
                outcomes
            }
            Ok(output) => {
                let text = String::from_utf8_lossy(&output.stderr);
                let shown: Vec<&str> = text.lines().filter(|line| line.contains("error")).take(6).collect();
                vec![(group[0], Err(format!("does not compile ({}):\n{}", output.status, shown.join("\n"))))]
            }
            Err(error) => vec![(group[0], Err(error))],
        }
    }

    /// Removes the files, unless they are to be kept.
    pub fn finish(&self) {
        if !self.kept {
            let _ = std::fs::remove_dir_all(&self.folder);
        }
    }
}

/// Writes generated files and their sources into a folder; returns the number of bytes of code.
pub fn write(folder: &Path, model: &str, prepared: &Prepared) -> std::io::Result<usize> {
    let generated = &prepared.generated;
    std::fs::create_dir_all(folder)?;
    for (name, text) in [("model.asm", model), ("script", &prepared.script), ("expected", &prepared.expected)] {
        std::fs::write(folder.join(name), text)?;
    }
    for file in &generated.files {
        std::fs::write(folder.join(&file.name), &file.text)?;
    }
    Ok(generated.files.iter().map(|file| file.text.len()).sum())
}

/// The headers that all models include, precompiled once for all tests.
fn precompiled() -> &'static Path {
    static HEADER: OnceLock<PathBuf> = OnceLock::new();
    HEADER.get_or_init(|| {
        // Only tests have a folder of their own in the build folder.
        let folder = match option_env!("CARGO_TARGET_TMPDIR") {
            Some(folder) => Path::new(folder).join("groundstate-headers"),
            None => std::env::temp_dir().join(format!("groundstate-headers-{}", std::process::id())),
        };
        std::fs::create_dir_all(&folder).expect("a folder of the tests' own");
        let header = folder.join("all.hpp");
        let mut names: Vec<String> = std::fs::read_dir(runtime().join("groundstate/machine"))
            .expect("the runtime's headers")
            .flatten()
            .map(|entry| format!("#include <groundstate/machine/{}>\n", entry.file_name().to_string_lossy()))
            .collect();
        names.sort();
        std::fs::write(&header, names.concat()).expect("a file of one's own");
        let compiled = strict().arg("-x").arg("c++-header").arg(&header).status().expect("g++ runs");
        assert!(compiled.success(), "the runtime's headers do not compile");
        header
    })
}

/// Groups the models into units. Models with the same namespace are separated.
fn shared(units: &[Unit]) -> Vec<Vec<usize>> {
    let mut groups: Vec<(Vec<usize>, usize)> = Vec::new();
    for (index, unit) in units.iter().enumerate() {
        let fits = |(group, bytes): &(Vec<usize>, usize)| {
            group.len() < SHARED
                && bytes + unit.bytes <= CODE
                && group.iter().all(|other| units[*other].namespace != unit.namespace)
        };
        match groups.iter_mut().find(|group| fits(group)) {
            Some((group, bytes)) => {
                group.push(index);
                *bytes += unit.bytes;
            }
            None => groups.push((vec![index], unit.bytes)),
        }
    }
    groups.into_iter().map(|(group, _)| group).rev().collect()
}

/// One source for several models; an argument tells its main program which one to run.
fn together(units: &[Unit], group: &[usize]) -> String {
    let (mut models, mut calls) = (String::new(), String::new());
    for unit in group.iter().map(|index| &units[*index]) {
        let Unit { name, namespace, folder, .. } = unit;
        let folder = folder.display();
        models.push_str(&format!(
            "#include \"{folder}/{namespace}.cpp\"\n#define main main_{name}\n#include \"{folder}/replay.cpp\"\n#undef main\n"
        ));
        calls.push_str(&format!("    if (word == \"{name}\") return main_{name}();\n"));
    }
    format!(
        "{models}int main(int count, char** words) {{\n    const std::string word = count > 1 ? words[1] : \"\";\n{calls}    return 2;\n}}\n"
    )
}

/// Runs a command with a time limit; the result says if the limit ended it.
pub fn within(seconds: u32, command: &Command) -> Result<Output, String> {
    let mut limited = Command::new("timeout");
    limited.arg(seconds.to_string()).arg(command.get_program()).args(command.get_args());
    let output = limited.output().map_err(|error| error.to_string())?;
    match output.status.code() {
        Some(124) => Err(format!("{} takes more than {seconds} s", command.get_program().display())),
        _ => Ok(output),
    }
}

/// The compiler with warnings as errors and the path of the runtime.
pub fn strict() -> Command {
    let mut command = Command::new("g++");
    command.args(["-std=c++20", "-O0", "-Wall", "-Wextra", "-Wconversion", "-Werror", "-I"]);
    command.arg(runtime());
    command
}

/// The folder of the runtime's headers.
pub fn runtime() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cpp/include")
}
