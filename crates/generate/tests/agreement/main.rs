//! Generated code agrees with the machine, on every model of examples/ and on random models. Besides: no identifier is
//! a macro (`macros`), and the programs of the examples are generated from their charts (`programs`).
//!
//! A model is generated, compiled, and fed the inputs and choices of a run of the machine; the states must be equal
//! step by step, and a fault must come in the same step. `GROUNDSTATE_FULL` takes every model and more random ones;
//! otherwise every fifth model is taken. `GROUNDSTATE_CASES` sets how many random models, `GROUNDSTATE_SEED` the first
//! seed, `GROUNDSTATE_MODEL` the only file to test, `GROUNDSTATE_KEEP` a folder to keep the generated code in.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a test reads files and the environment, runs a compiler, and tells what it found"
)]

mod bare;
mod compile;
mod follow;
mod forms;
mod initial;
mod late;
mod macros;
mod places;
mod programs;
mod run;
mod unusual;
mod warnings;

use std::path::{Path, PathBuf};

use model::Loader;
use syntax::SourceFile;
use testkit::repository;
use testkit::sample::{is_full as full, setting};

use compile::{Compiler, Unit, write};
use run::{Disk, Prepared, read, record};

/// A model, and the words that identify it in messages.
struct Case {
    name: String,
    text: String,
    prepared: Prepared,
}

/// Generates a model and runs it in the machine; `None` if there is nothing to run. An error is the reason for failing.
fn prepare(file: SourceFile, disk: &mut dyn Loader, steps: u64, seed: u64) -> Result<Option<Prepared>, String> {
    let Some(subject) = read(file, disk)? else { return Ok(None) };
    let generated = subject.generate()?;
    let (script, expected) = record(&subject.program, steps, seed);
    Ok(Some(Prepared { generated, script, expected }))
}

/// Generates, compiles and compares all of them.
fn judge(folder: &str, cases: Vec<Case>) {
    let compiler = Compiler::new(folder);
    let mut built = Vec::new();
    let mut failures = Vec::new();
    for (index, case) in cases.iter().enumerate() {
        let name = format!("m{index}");
        let folder = compiler.folder().join(&name);
        match write(&folder, &case.text, &case.prepared) {
            Ok(bytes) => {
                let namespace = case.prepared.generated.name.clone();
                built.push((case, Unit { name, namespace, folder, bytes }));
            }
            Err(error) => failures.push(format!("{}: {error}", case.name)),
        }
    }
    let programs = compiler.compile_all(&built.iter().map(|(_, unit)| unit.clone()).collect::<Vec<_>>());
    for ((case, unit), compiled) in built.iter().zip(programs) {
        let outcome = compiled.and_then(|program| program.follow(&case.prepared.script, &case.prepared.expected));
        if let Err(reason) = outcome {
            failures.push(format!("{} ({}): {reason}", case.name, unit.folder.display()));
        }
    }
    assert!(failures.is_empty(), "{} of {}:\n{}", failures.len(), cases.len(), failures.join("\n\n"));
    compiler.finish();
}

#[test]
fn examples() {
    let root = repository::root();
    let mut paths = Vec::new();
    match std::env::var("GROUNDSTATE_MODEL") {
        Ok(path) => paths.push(PathBuf::from(path)),
        Err(_) => {
            ["examples", "bench/models", "library/patterns/tests"].iter().for_each(|f| walk(&root.join(f), &mut paths))
        }
    }
    let mut cases = Vec::new();
    for path in paths.into_iter().step_by(if full() { 1 } else { 5 }) {
        let text = std::fs::read_to_string(&path).expect("a readable file");
        let file = SourceFile::new(path.to_string_lossy(), text.clone());
        let name = path.strip_prefix(&root).unwrap_or(&path).display().to_string();
        match prepare(file, &mut Disk, 30, 1) {
            Ok(Some(prepared)) => cases.push(Case { name, text, prepared }),
            Ok(None) => {}
            Err(why) => panic!("{name}: {why}"),
        }
    }
    assert!(!cases.is_empty());
    judge("examples", cases);
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            // The reference systems of verification never end.
            if path.file_name().is_none_or(|name| name != "verify") {
                walk(&path, found);
            }
        } else if path.extension().is_some_and(|extension| extension == "asm") {
            found.push(path);
        }
    }
}

#[test]
fn random_models() {
    let (wanted, first) = (setting("GROUNDSTATE_CASES", if full() { 24 } else { 4 }), setting("GROUNDSTATE_SEED", 1));
    let mut cases = Vec::new();
    for seed in first..first + 4 * wanted {
        if cases.len() as u64 == wanted {
            break;
        }
        let text = oracle::generate::model(seed, 2 + (seed % 3) as u32).to_string();
        let file = SourceFile::new("Model.asm", text.clone());
        if let Ok(Some(prepared)) = prepare(file, &mut Disk, 6, seed) {
            cases.push(Case { name: format!("seed {seed}"), text, prepared });
        }
    }
    judge("random", cases);
}
