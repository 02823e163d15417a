//! Every property holds of this project's own texts, and of mutations of them.
//!
//! `GROUNDSTATE_CASES` sets how many mutations a property is tried on, `GROUNDSTATE_SEED` the first seed. An input that
//! breaks one is written to a file, and `cargo xtask fuzz --only NAME --reproduce FILE` runs it again.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a test reads files and the environment, and tells what it found"
)]

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};

use properties::mutation::{SplitMix, mutated};
use properties::{ALL, seeds};
use testkit::repository;

/// As much as the main thread has, in which fuzz targets run.
const STACK: usize = 8 << 20;

/// The number in an environment variable.
fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// The models, scenarios and pages below a folder, in order.
fn files(folder: &str) -> Vec<seeds::File> {
    let read = |path: PathBuf| {
        // A transcript's file may be of another encoding on purpose.
        let bytes = std::fs::read(&path).expect("a readable file");
        let name = path.strip_prefix(repository::root()).expect("a path below").display().to_string();
        (name, String::from_utf8_lossy(&bytes).into_owned())
    };
    repository::files(folder, &["asm", "avalla", "md"]).into_iter().map(read).collect()
}

/// Checks the property of that name on every seed, then on so many mutations.
fn holds(name: &str, cases: u64) {
    let property = ALL.iter().find(|property| property.name == name).expect("a property of that name");
    let files = ["library", "examples", "bench/models", "spec", "crates", "cpp/systems"].map(files).concat();
    let seeds = seeds::seeds(property, &files);
    assert!(seeds.len() > 50, "only {} seeds", seeds.len());
    let words = repository::text("fuzz/asmetal.dict");
    let words = seeds::words(&words);
    assert!(words.len() > 50, "only {} words", words.len());

    let check = |bytes: &[u8], what: String| match catch_unwind(AssertUnwindSafe(|| (property.check)(bytes))) {
        Ok(far) => far,
        Err(panic) => {
            let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-broken"));
            std::fs::write(&file, bytes).expect("a file of one's own");
            eprintln!("{name} does not hold of {what}: cargo xtask fuzz --only {name} --reproduce {}", file.display());
            resume_unwind(panic);
        }
    };
    let (first, cases) = (setting("GROUNDSTATE_SEED", 1), setting("GROUNDSTATE_CASES", cases));
    let work = || {
        let mut reaching = Vec::new();
        for (number, seed) in seeds.iter().enumerate() {
            if check(seed.as_bytes(), format!("seed {number}")) {
                reaching.push(number);
            }
        }
        println!("{name}: {} of {} seeds come to the last stage", reaching.len(), seeds.len());
        assert!(reaching.len() > 50, "too few to tell anything");
        let mut far = 0;
        for case in first..first + cases {
            let mut random = SplitMix::new(case);
            // Many blocks of pages are no models; three of four cases are.
            let number = match random.below(4) {
                0 => random.below(seeds.len() as u64) as usize,
                _ => reaching[random.below(reaching.len() as u64) as usize],
            };
            let bytes = mutated(&seeds[number], &seeds, &words, &mut random);
            far += u64::from(check(&bytes, format!("mutation {case}, of seed {number}")));
        }
        println!("{name}: {far} of {cases} mutations do");
        assert!(far * 20 >= cases, "too few to tell anything");
    };
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work).expect("a thread");
        thread.join().unwrap_or_else(|panic| resume_unwind(panic));
    });
}

#[test]
fn parse_is_total_and_lossless() {
    holds("parse_is_total_and_lossless", 2000);
}

#[test]
fn check_never_panics() {
    holds("check_never_panics", 1000);
}

#[test]
fn step_never_panics() {
    holds("step_never_panics", 1000);
}

#[test]
fn a_failed_step_leaves_the_state() {
    holds("a_failed_step_leaves_the_state", 1000);
}

#[test]
fn scenario_never_panics() {
    holds("scenario_never_panics", 600);
}

#[test]
fn all_are_tried_here() {
    let here = include_str!("mutated.rs");
    for property in ALL {
        assert!(here.contains(&format!("holds(\"{}\"", property.name)), "{} is not tried", property.name);
    }
}
