//! `cargo xtask fuzz --seconds N`: every fuzz target for N seconds.
//!
//! In: the workspace fuzz/, whose targets are the functions of `properties`. Out: a line a target; exit code 1 and how to
//! make it again where one crashed. The targets are built by stable Rust with the compiler's own coverage pass and
//! libFuzzer; `--target` keeps build scripts and procedural macros free of it. The seeds are those of `properties`.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use properties::Property;

use crate::arguments::Arguments;
use crate::{Failure, Outcome, repository};

/// Counters at every edge, their places, and the operands of comparisons.
const FLAGS: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares --cfg fuzzing";

/// The command.
///
/// # Errors
/// Usage; the targets do not build.
pub fn run(words: &[String]) -> Result<Outcome, Failure> {
    let arguments = Arguments::read(words, &["--seconds", "--only", "--reproduce", "--seed"], &[])?;
    let seconds = arguments.number("--seconds", 20)?;
    let seed = arguments.number("--seed", 1)?;
    let only = arguments.option("--only").unwrap_or_default();
    let home = repository::root().join("target/fuzz");
    let binaries = build(&home)?;
    let targets: Vec<&Property> = properties::ALL.iter().filter(|property| property.name.contains(only)).collect();
    if targets.is_empty() {
        return Err(format!("no target's name has `{only}` in it"));
    }
    if let Some(input) = arguments.option("--reproduce") {
        return reproduce(&binaries, targets[0].name, Path::new(input));
    }
    let mut outcome = Outcome::Good;
    let files = files()?;
    for property in targets {
        let seeds = home.join("seeds").join(property.name);
        write_seeds(&seeds, &properties::seeds::seeds(property, &files))?;
        if !fuzz(&home, &binaries, property.name, &seeds, seconds, seed)? {
            outcome = Outcome::AtFault;
        }
    }
    Ok(outcome)
}

/// Builds all targets; gives the folder they are in.
fn build(home: &Path) -> Result<PathBuf, Failure> {
    let host = host()?;
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_string());
    let status = Command::new(cargo)
        .args(["build", "--quiet", "--release", "--target", &host, "--manifest-path"])
        .arg(repository::root().join("fuzz/Cargo.toml"))
        .arg("--target-dir")
        .arg(home.join("build"))
        .env("RUSTFLAGS", FLAGS)
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .status()
        .map_err(|error| format!("cargo cannot be run: {error}"))?;
    if !status.success() {
        return Err("the fuzz targets do not build; they need a C++ compiler for libFuzzer".to_string());
    }
    Ok(home.join("build").join(host).join("release"))
}

fn host() -> Result<String, Failure> {
    let output = Command::new("rustc").arg("-vV").output().map_err(|error| format!("rustc cannot be run: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(String::from).ok_or_else(|| "rustc does not name its host".to_string())
}

/// Runs one target; whether it held.
fn fuzz(home: &Path, binaries: &Path, name: &str, seeds: &Path, seconds: u64, seed: u64) -> Result<bool, Failure> {
    let (corpus, found) = (home.join("corpus").join(name), home.join("found"));
    for folder in [&corpus, &found] {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    let output = Command::new(binaries.join(name))
        .args([&corpus, seeds])
        .arg(format!("-max_total_time={seconds}"))
        .arg(format!("-seed={seed}"))
        .args(["-timeout=10", "-rss_limit_mb=2048", "-max_len=16384", "-len_control=20", "-print_final_stats=1"])
        .arg(format!("-dict={}", repository::root().join("fuzz/asmetal.dict").display()))
        .arg(format!("-artifact_prefix={}/{name}-", found.display()))
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("{name} cannot be run: {error}"))?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let statistic = |key: &str| {
        let value = said.lines().find_map(|line| line.strip_prefix(&format!("stat::{key}:")));
        value.map_or_else(|| "?".to_string(), |value| value.trim().to_string())
    };
    if output.status.success() {
        let edges = said.lines().rev().find_map(|line| line.split("cov: ").nth(1)?.split(' ').next()).unwrap_or("?");
        let inputs = statistic("number_of_executed_units");
        println!("{name}: held for {seconds} s, {inputs} inputs, {edges} edges covered");
        return Ok(true);
    }
    println!("{name}: broken");
    let telling =
        said.lines().filter(|line| ["panicked", "assert", "ERROR:", "SUMMARY"].iter().any(|word| line.contains(word)));
    telling.take(8).for_each(|line| println!("    {line}"));
    let artifact = said.lines().find_map(|line| line.split("Test unit written to ").nth(1)).unwrap_or("its input");
    println!("    again: cargo xtask fuzz --only {name} --reproduce {artifact}");
    Ok(false)
}

fn reproduce(binaries: &Path, name: &str, input: &Path) -> Result<Outcome, Failure> {
    let status = Command::new(binaries.join(name)).arg(input).status();
    match status {
        Ok(status) if status.success() => Ok(Outcome::Good),
        Ok(_) => Ok(Outcome::AtFault),
        Err(error) => Err(format!("{name} cannot be run: {error}")),
    }
}

/// Writes the seeds of a target, replacing older ones.
fn write_seeds(folder: &Path, seeds: &[String]) -> Result<(), Failure> {
    let wrap = |error: std::io::Error| format!("{}: {error}", folder.display());
    if folder.exists() {
        std::fs::remove_dir_all(folder).map_err(wrap)?;
    }
    std::fs::create_dir_all(folder).map_err(wrap)?;
    for (number, seed) in seeds.iter().enumerate() {
        std::fs::write(folder.join(format!("{number:04}")), seed).map_err(wrap)?;
    }
    Ok(())
}

/// Every file that seeds are made of.
fn files() -> Result<Vec<(String, String)>, Failure> {
    let root = repository::root();
    let mut files = Vec::new();
    for path in repository::files()? {
        if [".asm", ".avalla", ".md"].iter().any(|ending| path.ends_with(ending)) {
            // A transcript's file may be of another encoding on purpose.
            let bytes = std::fs::read(root.join(&path)).map_err(|error| format!("{path}: {error}"))?;
            files.push((path, String::from_utf8_lossy(&bytes).into_owned()));
        }
    }
    Ok(files)
}
