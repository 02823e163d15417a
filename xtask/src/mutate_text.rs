//! `cargo xtask mutate-text --count N`: this repository's models, scenarios, charts and the like, wounded, through every
//! command that reads such a text.
//!
//! In: the texts under version control. Out: how many mutants of each kind came how far; exit code 1, with the mutant in a file,
//! where one made a command panic or came to no end. The same seed makes the same mutants. Report specifications are read by
//! the shell alone, so the tool itself is run on theirs.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use properties::commands::COMMANDS;
use properties::mutation::{SplitMix, mutated, with_lines_mutated};
use properties::seeds::{self, DIVIDER};

use crate::arguments::Arguments;
use crate::{Failure, Outcome, repository};

/// As much stack as the tool's own thread has.
const STACK: usize = 256 << 20;
/// One mutant takes milliseconds, or seconds; whoever takes this long has no end, also where others use the processors.
const NO_END: Duration = Duration::from_secs(600);
/// Of so many mutants one is of a report specification, for which a process is started.
const OF_REPORTS: u64 = 40;

/// A text to begin with, and the ending of its kind.
struct Seed {
    ending: &'static str,
    path: String,
    text: String,
}

/// The command.
///
/// # Errors
/// Usage; the repository cannot be read.
pub fn run(words: &[String]) -> Result<Outcome, Failure> {
    let arguments = Arguments::read(words, &["--count", "--seed", "--only", "--binary"], &[])?;
    let count = arguments.number("--count", 2_000)?;
    let first = arguments.number("--seed", 1)?;
    let only = arguments.option("--only").unwrap_or_default();
    let binary = arguments.option("--binary").map(PathBuf::from).or_else(beside);
    let seeds: Vec<Seed> = seeds()?.into_iter().filter(|seed| seed.ending.contains(only)).collect();
    if seeds.is_empty() {
        return Err(format!("no kind of text is called `{only}`"));
    }
    let dictionary = std::fs::read_to_string(repository::root().join("fuzz/asmetal.dict"));
    let words = seeds::words(&dictionary.map_err(|error| format!("fuzz/asmetal.dict: {error}"))?);
    let worker = std::thread::Builder::new().stack_size(STACK);
    let work = move || mutants(&seeds, &words, (first, count), binary.as_deref());
    let worker = worker.spawn(work).map_err(|error| error.to_string())?;
    worker.join().map_err(|_| "the mutants cannot be made".to_string())?
}

/// The tool that was built with this command.
fn beside() -> Option<PathBuf> {
    let path = std::env::current_exe().ok()?.with_file_name("groundstate");
    path.is_file().then_some(path)
}

fn mutants(
    seeds: &[Seed],
    words: &[String],
    (first, count): (u64, u64),
    binary: Option<&Path>,
) -> Result<Outcome, Failure> {
    let mut kinds: BTreeMap<&str, Vec<&Seed>> = BTreeMap::new();
    for seed in seeds {
        kinds.entry(seed.ending).or_default().push(seed);
    }
    let reports = kinds.remove("yaml").filter(|_| binary.is_some());
    // Models have the most that can be wrong with them; an export of another tool is rare.
    let weights = [("asm", 10), ("chart", 6), ("avalla", 3), ("scxml", 1)];
    let kinds: Vec<(&str, &Vec<&Seed>)> = weights
        .iter()
        .flat_map(|(ending, weight)| kinds.get_key_value(ending).into_iter().flat_map(|kind| vec![kind; *weight]))
        .map(|(ending, seeds)| (*ending, seeds))
        .collect();
    let others: BTreeMap<&str, Vec<String>> =
        kinds.iter().map(|(ending, seeds)| (*ending, seeds.iter().map(|seed| seed.text.clone()).collect())).collect();
    let watched = Watched::start();
    let mut tally: BTreeMap<&str, (u64, u64)> = BTreeMap::new();
    let mut broken = 0;
    for number in first..first.saturating_add(count) {
        let mut random = SplitMix::new(number);
        let of_report = random.below(OF_REPORTS) == 0;
        let (ending, seed) = match (&reports, of_report || kinds.is_empty()) {
            (Some(reports), true) => ("yaml", reports[random.below(reports.len() as u64) as usize]),
            _ if kinds.is_empty() => break,
            _ => {
                let (ending, seeds) = kinds[random.below(kinds.len() as u64) as usize];
                (ending, seeds[random.below(seeds.len() as u64) as usize])
            }
        };
        let none = Vec::new();
        let elsewhere = others.get(ending).unwrap_or(&none);
        let mutant = match random.below(3) {
            0 => with_lines_mutated(&seed.text, elsewhere, &mut random).into_bytes(),
            1 => mutated(&with_lines_mutated(&seed.text, elsewhere, &mut random), elsewhere, words, &mut random),
            _ => mutated(&seed.text, elsewhere, words, &mut random),
        };
        let file = repository::root().join(format!("target/mutant-in-{}.{ending}", std::process::id()));
        // What overflows the stack takes this process with it: the file is what is left.
        std::fs::write(&file, &mutant).map_err(|error| format!("{}: {error}", file.display()))?;
        watched.begin(number, &file);
        let came = match (COMMANDS.iter().find(|commands| commands.ending == ending), binary) {
            (Some(commands), _) => catch_unwind(AssertUnwindSafe(|| (commands.run)(&mutant))).ok(),
            (None, Some(binary)) => reported(binary, seed, &mutant)?,
            (None, None) => Some(0),
        };
        watched.set(None);
        let _ = std::fs::remove_file(&file);
        let tally = tally.entry(ending).or_default();
        tally.0 += 1;
        match came {
            Some(stages) => tally.1 += u64::from(stages > 1),
            None => {
                broken += 1;
                let kept = repository::root().join(format!("target/mutant-{number}.{ending}"));
                std::fs::write(&kept, &mutant).map_err(|error| format!("{}: {error}", kept.display()))?;
                println!("mutant {number}, of {}, makes a command panic: {}", seed.path, kept.display());
                println!("    again: cargo xtask mutate-text --seed {number} --count 1");
            }
        }
    }
    for (ending, (all, far)) in &tally {
        println!("{ending}: {all} mutants, {far} of them without errors at first");
    }
    if reports.is_none() {
        println!("report specifications: left out, as the tool is not built beside this command");
    }
    println!("{broken} panics");
    Ok(if broken == 0 { Outcome::Good } else { Outcome::AtFault })
}

/// The mutant that is being tried.
struct Tried {
    number: u64,
    file: PathBuf,
    began: Instant,
}

/// Looks at the clock while a mutant is tried, and ends the program with a word where one has no end.
struct Watched(Arc<Mutex<Option<Tried>>>);

impl Watched {
    fn start() -> Watched {
        let shared: Arc<Mutex<Option<Tried>>> = Arc::default();
        let watched = Watched(Arc::clone(&shared));
        std::thread::spawn(move || {
            while let Ok(tried) = shared.lock().map(|mut tried| tried.take_if(|tried| tried.began.elapsed() > NO_END)) {
                if let Some(Tried { number, file, .. }) = tried {
                    println!("mutant {number} comes to no end: {}", file.display());
                    std::process::exit(1);
                }
                std::thread::sleep(Duration::from_secs(1));
            }
        });
        watched
    }

    fn begin(&self, number: u64, file: &Path) {
        let tried = Tried { number, file: file.to_path_buf(), began: Instant::now() };
        self.set(Some(tried));
    }

    fn set(&self, tried: Option<Tried>) {
        if let Ok(mut current) = self.0.lock() {
            *current = tried;
        }
    }
}

/// Whether a report specification beside its model leads to a page or to faults; none where the tool panics.
fn reported(binary: &Path, seed: &Seed, mutant: &[u8]) -> Result<Option<usize>, Failure> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let specification = folder.path().join("mutant.report.yaml");
    std::fs::write(&specification, mutant).map_err(|error| error.to_string())?;
    let original = repository::root().join(&seed.path);
    let model = original.to_string_lossy().replace(".report.yaml", ".asm");
    let status = Command::new(binary)
        .args(["report", &model, "--steps", "3", "--random", "--spec"])
        .arg(&specification)
        .arg("-o")
        .arg(folder.path().join("page.html"))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .map_err(|error| format!("{}: {error}", binary.display()))?;
    Ok(match status.code() {
        Some(0) => Some(2),
        Some(1..=3) => Some(1),
        _ => None,
    })
}

/// What mutants are made of.
fn seeds() -> Result<Vec<Seed>, Failure> {
    let files = repository::files()?;
    let root = repository::root();
    let mut read: Vec<(String, String)> = Vec::new();
    for path in files {
        let wanted = [".asm", ".avalla", ".chart", ".scxml", ".report.yaml", ".md"];
        if wanted.iter().any(|ending| path.ends_with(ending)) {
            let bytes = std::fs::read(root.join(&path)).map_err(|error| format!("{path}: {error}"))?;
            read.push((path, String::from_utf8_lossy(&bytes).into_owned()));
        }
    }
    let mut all = Vec::new();
    for (path, text) in &read {
        let ending = ["asm", "chart", "scxml", "yaml"].into_iter().find(|ending| path.ends_with(&format!(".{ending}")));
        if let Some(ending) = ending {
            all.push(Seed { ending, path: path.clone(), text: text.clone() });
        }
    }
    let property = |of_scenario| properties::ALL.iter().find(|property| property.of_scenario == of_scenario);
    let of_property = |of_scenario| property(of_scenario).map(|known| seeds::seeds(known, &read)).unwrap_or_default();
    let scenarios = of_property(true).into_iter().filter(|text| text.contains(DIVIDER));
    all.extend(scenarios.map(|text| Seed { ending: "avalla", path: "a scenario with its model".to_string(), text }));
    // The blocks of the pages: models, scenarios and charts by what they begin with.
    let pages: Vec<(String, String)> = read.iter().filter(|(path, _)| path.ends_with(".md")).cloned().collect();
    for text in property(false).map(|known| seeds::seeds(known, &pages)).unwrap_or_default() {
        let ending = if text.trim_start().starts_with("chart ") { "chart" } else { "asm" };
        all.push(Seed { ending, path: "a page".to_string(), text });
    }
    Ok(all)
}
