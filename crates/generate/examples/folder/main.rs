//! Compares generated code with the machine on every model of a folder: how many are generated, compile, and agree.
//!
//!     cargo run --profile quick -p generate --example folder -- FOLDER [OPTIONS]
//!
//! Each model with a main rule that the machine runs is generated, compiled with warnings as errors, and fed the inputs
//! and choices of a run of at most 20 steps; the states must be the same after each step. Identical code is compiled
//! once and counts for each file that it comes from. Failures are printed as they are found; the last lines are the
//! counts. The exit code is 1 if some generated code does not compile or does not agree.
//!
//! `--scripts FOLDER`: also follow recorded runs, as `cargo xtask corpus CHECKOUT --scripts FOLDER` writes them. `--log
//! FILE`: one verdict per line; known verdicts on the same code, run, headers and compiler are not tried again.
//! `--every N`: only every Nth file. `--only TEXTS`: only files whose path contains one of these, separated by commas.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a tool reads files, runs a compiler, and tells what it found"
)]

#[path = "../../tests/agreement/compile.rs"]
mod compile;
mod counts;
#[path = "../../tests/agreement/follow.rs"]
mod follow;
mod judge;
mod log;
mod prepare;
#[path = "../../tests/agreement/run.rs"]
mod run;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use compile::Compiler;
use counts::Counts;
use log::Log;

/// The command line.
struct Asked {
    folder: PathBuf,
    every: usize,
    only: String,
    log: Option<PathBuf>,
    scripts: Option<PathBuf>,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if let [worker, work] = words.as_slice()
        && worker == prepare::WORKER
    {
        prepare::work(Path::new(work));
        return ExitCode::SUCCESS;
    }
    let Some(asked) = asked(&words) else {
        eprintln!("name a folder of models; --scripts FOLDER, --log FILE, --every N, --only TEXT");
        return ExitCode::from(2);
    };
    let mut paths = Vec::new();
    walk(&asked.folder, &mut paths);
    let name = |path: &Path| path.strip_prefix(&asked.folder).unwrap_or(path).display().to_string();
    let paths: Vec<(String, PathBuf)> = paths
        .into_iter()
        .step_by(asked.every)
        .map(|path| (name(&path), path))
        .filter(|(name, _)| asked.only.split(',').any(|text| name.contains(text)))
        .collect();
    let compiler = Compiler::new("folder");
    println!("{} models, in {}", paths.len(), compiler.folder().display());
    let mut log = Log::open(asked.log.as_deref());
    let prepared = prepare::all(compiler.folder(), &paths);
    let verdicts = judge::all(&compiler, &prepared, asked.scripts.as_deref(), &mut log);
    let counts = Counts::of(&prepared, &verdicts);
    compiler.finish();
    println!("\n{counts}");
    if counts.is_good() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn asked(words: &[String]) -> Option<Asked> {
    let (folder, mut options) = words.split_first()?;
    let mut asked = Asked { folder: PathBuf::from(folder), every: 1, only: String::new(), log: None, scripts: None };
    while let [option, value, rest @ ..] = options {
        match option.as_str() {
            "--every" => asked.every = value.parse().ok().filter(|every| *every > 0)?,
            "--only" => asked.only.clone_from(value),
            "--scripts" => asked.scripts = Some(PathBuf::from(value)),
            "--log" => asked.log = Some(PathBuf::from(value)),
            _ => return None,
        }
        options = rest;
    }
    options.is_empty().then_some(asked)
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
