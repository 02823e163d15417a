//! Compiles the generated code and follows its runs; each distinct code once.
//!
//! In: prepared models, and perhaps a folder of recorded runs (`cargo xtask corpus … --scripts`). Out: a verdict for
//! each run of each model that is ready. INVARIANT: two models share a verdict only if code and run are identical,
//! except for the lines that name the model's file.

use std::collections::{BTreeMap, BTreeSet};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use crate::compile::{Compiler, Program, Unit, runtime, strict};
use crate::log::{Log, Verdict};
use crate::prepare::{Fate, Model};

/// How many models are compiled before verdicts are logged.
const CHUNK: usize = 96;

/// The verdicts on a model's runs.
pub struct Judged {
    /// The number of its code; equal code has the same number.
    pub code: u64,
    /// The verdict on the run with random inputs.
    pub random: Verdict,
    /// The verdicts on the runs that the peer recorded.
    pub recorded: Vec<Verdict>,
}

/// A run to follow.
struct Task {
    /// Hash of everything that the verdict depends on.
    key: u64,
    name: String,
    script: PathBuf,
    expected: PathBuf,
}

/// A model with its runs, the random one first.
struct Ready<'a> {
    unit: &'a Unit,
    code: u64,
    tasks: Vec<Task>,
}

/// Judges all models that are ready; keyed by the model's index.
pub fn all(compiler: &Compiler, models: &[Model], scripts: Option<&Path>, log: &mut Log) -> BTreeMap<usize, Judged> {
    let base = base();
    let mut ready: BTreeMap<usize, Ready> = BTreeMap::new();
    for (index, model) in models.iter().enumerate() {
        if let Fate::Ready(unit) = &model.fate {
            let code = code(base, unit);
            ready.insert(index, Ready { unit, code, tasks: tasks(model, unit, code, scripts) });
        }
    }
    let mut by_code: BTreeMap<u64, Vec<&Ready>> = BTreeMap::new();
    for model in ready.values() {
        by_code.entry(model.code).or_default().push(model);
    }
    println!("{} are ready, {} of them distinct", ready.len(), by_code.len());
    let mut open: Vec<&Vec<&Ready>> = by_code.values().collect();
    open.retain(|same| same.iter().flat_map(|model| &model.tasks).any(|task| log.known(task.key).is_none()));
    if open.len() < by_code.len() {
        println!("the log has {} of these", by_code.len() - open.len());
    }
    let mut done = 0;
    for chunk in open.chunks(CHUNK) {
        let units: Vec<Unit> = chunk.iter().map(|same| same[0].unit.clone()).collect();
        let programs = compiler.compile_all(&units);
        for (same, program) in chunk.iter().zip(&programs) {
            judge(same, program, log);
        }
        let programs: BTreeSet<&PathBuf> = programs.iter().flatten().map(|program| &program.path).collect();
        for program in programs {
            let _ = std::fs::remove_file(program);
        }
        done += chunk.len();
        println!("judged {done} of {}", open.len());
    }
    ready.into_iter().filter_map(|(index, model)| Some((index, judged(&model, log)?))).collect()
}

fn judged(model: &Ready, log: &Log) -> Option<Judged> {
    let mut verdicts = model.tasks.iter().filter_map(|task| log.known(task.key).cloned());
    let random = verdicts.next()?;
    Some(Judged { code: model.code, random, recorded: verdicts.collect() })
}

/// Follows the runs of all models with this code.
fn judge(same: &[&Ready], program: &Result<Program, String>, log: &mut Log) {
    for task in same.iter().flat_map(|model| &model.tasks) {
        if log.known(task.key).is_some() {
            continue;
        }
        let verdict = match program {
            Err(why) => Verdict::DoesNotCompile(why.clone()),
            Ok(program) => match program.follow(&text(&task.script), &text(&task.expected)) {
                Ok(()) => Verdict::Agrees,
                Err(why) => Verdict::Differs(why),
            },
        };
        match &verdict {
            Verdict::Agrees => {}
            Verdict::Differs(why) | Verdict::DoesNotCompile(why) => println!("{}: {why}", task.name),
        }
        log.note(task.key, &task.name, &verdict);
    }
}

/// The runs of a model.
fn tasks(model: &Model, unit: &Unit, code: u64, scripts: Option<&Path>) -> Vec<Task> {
    let mut runs = vec![(String::new(), unit.folder.join("script"))];
    let recorded = scripts.and_then(|folder| std::fs::read_dir(folder.join(&model.name)).ok());
    let mut recorded: Vec<PathBuf> = recorded.into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    recorded.retain(|path| path.extension().is_some_and(|ending| ending == "script"));
    recorded.sort();
    for path in recorded {
        runs.push((format!(" ({})", path.file_stem().unwrap_or_default().display()), path));
    }
    let task = |(name, script): (String, PathBuf)| {
        let expected = script.with_file_name(match script.extension() {
            Some(_) => format!("{}.expected", script.file_stem().unwrap_or_default().display()),
            None => "expected".to_string(),
        });
        let mut hasher = DefaultHasher::new();
        (code, text(&script), text(&expected)).hash(&mut hasher);
        Task { key: hasher.finish(), name: format!("{}{name}", model.name), script, expected }
    };
    runs.into_iter().map(task).collect()
}

/// What all verdicts depend on: the runtime's headers, the compiler and its options.
fn base() -> u64 {
    let mut hasher = DefaultHasher::new();
    let headers = std::fs::read_dir(runtime().join("groundstate/machine")).expect("the runtime's headers");
    let mut headers: Vec<PathBuf> = headers.flatten().map(|entry| entry.path()).collect();
    headers.sort();
    headers.iter().for_each(|header| text(header).hash(&mut hasher));
    strict().get_args().for_each(|word| word.hash(&mut hasher));
    strict().arg("--version").output().expect("g++ runs").stdout.hash(&mut hasher);
    hasher.finish()
}

/// The hash of a model's code.
fn code(base: u64, unit: &Unit) -> u64 {
    let mut hasher = DefaultHasher::new();
    base.hash(&mut hasher);
    let stem = &unit.namespace;
    for name in [&format!("{stem}.hpp"), &format!("{stem}.cpp"), "replay.cpp"] {
        let text = text(&unit.folder.join(name));
        // Copies of a model stand in different folders, so `#line` directives do not count.
        text.lines().filter(|line| !line.starts_with("#line ")).for_each(|line| line.hash(&mut hasher));
    }
    hasher.finish()
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).expect("written before")
}
