//! The compiler: generated code to programs, and what they print.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::run::Prepared;

/// Where generated code is compiled.
pub struct Compiler {
    folder: PathBuf,
    kept: bool,
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

    /// Where everything is written.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Writes generated files, and what they come from; gives their folder.
    pub fn write(&self, name: &str, model: &str, prepared: &Prepared) -> Result<PathBuf, String> {
        let generated = &prepared.generated;
        let folder = self.folder.join(name);
        std::fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
        for (name, text) in [("model.asm", model), ("script", &prepared.script), ("expected", &prepared.expected)] {
            std::fs::write(folder.join(name), text).map_err(|error| error.to_string())?;
        }
        for file in &generated.files {
            std::fs::write(folder.join(&file.name), &file.text).map_err(|error| error.to_string())?;
        }
        let unit = format!("#include \"{}.cpp\"\n#include \"replay.cpp\"\n", generated.name);
        std::fs::write(folder.join("all.cpp"), unit).map_err(|error| error.to_string())?;
        Ok(folder)
    }

    /// Compiles the code of each folder, two at a time. What all of them include is compiled beforehand, once.
    pub fn compile_all(&self, folders: Vec<PathBuf>) -> Vec<Result<PathBuf, String>> {
        let header = self.folder.join("all.hpp");
        std::fs::write(
            &header,
            "#include <groundstate/machine/replay.hpp>\n#include <groundstate/machine/elements.hpp>\n\
            #include <groundstate/machine/membership.hpp>\n#include <groundstate/machine/numbers.hpp>\n\
            #include <groundstate/machine/text.hpp>\n#include <groundstate/machine/units.hpp>\n",
        )
        .expect("a file of one's own");
        let compiled = strict().arg("-x").arg("c++-header").arg(&header).status().expect("g++ runs");
        assert!(compiled.success(), "the runtime's headers do not compile");
        let next = AtomicUsize::new(0);
        let done: Mutex<Vec<(usize, Result<PathBuf, String>)>> = Mutex::new(Vec::new());
        std::thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| {
                    loop {
                        let index = next.fetch_add(1, Ordering::Relaxed);
                        let Some(folder) = folders.get(index) else { return };
                        let outcome = compile(folder, &header);
                        done.lock().expect("unpoisoned").push((index, outcome));
                    }
                });
            }
        });
        let mut done = done.into_inner().expect("unpoisoned");
        done.sort_by_key(|(index, _)| *index);
        done.into_iter().map(|(_, outcome)| outcome).collect()
    }

    /// Runs a program on a run's script and compares what it prints.
    pub fn replay(&self, program: &Path, prepared: &Prepared) -> Result<(), String> {
        let mut child = Command::new(program)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| error.to_string())?;
        let mut stdin = child.stdin.take().expect("piped");
        let script = prepared.script.clone();
        // A program that ends early closes the pipe.
        let writer = std::thread::spawn(move || drop(stdin.write_all(script.as_bytes())));
        let output = child.wait_with_output().map_err(|error| error.to_string())?;
        let _ = writer.join();
        if !output.status.success() {
            return Err(format!("{}: {}", output.status, String::from_utf8_lossy(&output.stderr)));
        }
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        // The place of a fault is compared nowhere: its number is the generated code's own.
        let printed: String = printed
            .lines()
            .map(|line| match line.strip_prefix("fault ") {
                // Not the location of a function that is called so: `fault () i1`.
                Some(rest) if !rest.starts_with('(') => {
                    format!("fault {}\n", rest.split(' ').next().unwrap_or_default())
                }
                _ => format!("{line}\n"),
            })
            .collect();
        difference(&prepared.expected, &printed)
    }

    /// Removes what was written, unless it is to be looked at.
    pub fn finish(&self) {
        if !self.kept {
            let _ = std::fs::remove_dir_all(&self.folder);
        }
    }
}

/// The compiler with its warnings as errors, and where the runtime is.
pub fn strict() -> Command {
    let mut command = Command::new("g++");
    command.args(["-std=c++20", "-O0", "-Wall", "-Wextra", "-Wconversion", "-Werror", "-I"]);
    command.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cpp/include"));
    command
}

fn compile(folder: &Path, header: &Path) -> Result<PathBuf, String> {
    let program = folder.join("replay");
    let output = strict()
        .arg("-include")
        .arg(header)
        .arg(folder.join("all.cpp"))
        .arg("-o")
        .arg(&program)
        .output()
        .map_err(|error| format!("g++: {error}"))?;
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr);
        let shown: Vec<&str> = text.lines().filter(|line| line.contains("error")).take(6).collect();
        return Err(format!("does not compile:\n{}", shown.join("\n")));
    }
    Ok(program)
}

/// The first place where two texts part.
fn difference(expected: &str, printed: &str) -> Result<(), String> {
    if expected == printed {
        return Ok(());
    }
    let step = |lines: &[&str]| lines.iter().filter(|line| **line == ".").count();
    let (left, right): (Vec<&str>, Vec<&str>) = (expected.lines().collect(), printed.lines().collect());
    let at = left.iter().zip(&right).take_while(|(a, b)| a == b).count();
    Err(format!(
        "after {} states: the machine has `{}`, the generated code `{}`",
        step(&left[..at]),
        left.get(at).unwrap_or(&"nothing more"),
        right.get(at).unwrap_or(&"nothing more")
    ))
}
