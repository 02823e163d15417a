//! Generated code against the machine on every model of a folder: how many are generated, compile, and agree.
//!
//!     cargo run -p generate --example folder -- FOLDER [EVERY]
//!
//! Each model with a main rule that the machine runs for a step at least is generated, compiled with warnings as errors,
//! and fed the inputs and choices of a run of at most 20 steps; the states must be the same step by step. With EVERY, only
//! each so many-th file is looked at. What goes wrong is told as it is found; the last lines are the counts. Ends with 1
//! if some generated code does not compile or does not agree.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a tool reads files, runs a compiler, and tells what it found"
)]

#[path = "../tests/agreement/compile.rs"]
mod compile;
#[path = "../tests/agreement/run.rs"]
mod run;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use syntax::SourceFile;

use compile::Compiler;
use run::{Disk, prepare};

/// How many models are compiled before the next ones are generated.
const BATCH: usize = 40;

fn main() -> ExitCode {
    let mut words = std::env::args().skip(1);
    let Some(folder) = words.next().map(PathBuf::from) else {
        eprintln!("name a folder of models");
        return ExitCode::from(2);
    };
    let every = words.next().and_then(|word| word.parse().ok()).unwrap_or(1usize).max(1);
    let mut paths = Vec::new();
    walk(&folder, &mut paths);
    let paths: Vec<PathBuf> = paths.into_iter().step_by(every).collect();
    let mut counts = Counts::default();
    for batch in paths.chunks(BATCH) {
        counts.look_at(&folder, batch);
    }
    counts.tell(paths.len());
    if counts.agreed == counts.generated { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// What came of the models.
#[derive(Default)]
struct Counts {
    /// The machine runs it for a step at least.
    run: usize,
    generated: usize,
    compiled: usize,
    agreed: usize,
    /// Why others were not generated, and how often.
    refused: BTreeMap<String, usize>,
}

impl Counts {
    fn look_at(&mut self, root: &Path, paths: &[PathBuf]) {
        let compiler = Compiler::new("folder");
        println!("{} models in {}", paths.len(), compiler.folder().display());
        let mut written = Vec::new();
        for (index, path) in paths.iter().enumerate() {
            let name = path.strip_prefix(root).unwrap_or(path).display().to_string();
            let Ok(bytes) = std::fs::read(path) else { continue };
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let file = SourceFile::new(path.to_string_lossy(), text.clone());
            let prepared = catch_unwind(AssertUnwindSafe(|| prepare(file, &mut Disk, 20, 1)));
            let prepared = match prepared {
                Ok(Ok(Some(prepared))) => prepared,
                Ok(Ok(None)) => continue,
                Ok(Err(reason)) if !reason.refused => continue,
                Ok(Err(run::Reason { why, .. })) => {
                    println!("{name}: refused: {why}");
                    self.run += 1;
                    *self.refused.entry(why).or_default() += 1;
                    continue;
                }
                Err(_) => {
                    println!("{name}: panicked");
                    self.run += 1;
                    *self.refused.entry("panicked".to_string()).or_default() += 1;
                    continue;
                }
            };
            // A run that ends before its first step says nothing.
            if !prepared.expected.contains(".\n") {
                continue;
            }
            self.run += 1;
            self.generated += 1;
            match compiler.write(&format!("m{index}"), &text, &prepared) {
                Ok(folder) => written.push((name, prepared, folder)),
                Err(why) => println!("{name}: {why}"),
            }
        }
        let programs = compiler.compile_all(written.iter().map(|(_, _, folder)| folder.clone()).collect());
        for ((name, prepared, _), program) in written.iter().zip(programs) {
            self.compiled += usize::from(program.is_ok());
            match program.and_then(|program| compiler.replay(&program, prepared)) {
                Ok(()) => self.agreed += 1,
                Err(why) => println!("{name}: {why}"),
            }
        }
        compiler.finish();
    }

    fn tell(&self, files: usize) {
        let percent = |part: usize| 100.0 * part as f64 / (self.run.max(1)) as f64;
        println!("\nfiles                {files:6}");
        println!("run in the machine   {:6}", self.run);
        for (what, count) in [("generated", self.generated), ("compiled", self.compiled), ("agreed", self.agreed)] {
            println!("{what:20} {count:6}  {:.1} %", percent(count));
        }
        for (why, count) in &self.refused {
            println!("  {count:4}  {why}");
        }
    }
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            walk(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "asm") {
            found.push(path);
        }
    }
}
