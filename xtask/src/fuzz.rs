//! `cargo xtask fuzz --seconds N`: every fuzz target for N seconds.
//!
//! In: the workspace fuzz/. Out: a line a target; exit code 1 and how to make it again where one crashed. The targets
//! are built by stable Rust with the compiler's own coverage pass and libFuzzer; `--target` keeps build scripts and
//! procedural macros free of it. Seeds are this project's models and scenarios and the blocks of spec/.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::arguments::Arguments;
use crate::{Failure, Outcome, repository};

/// The targets, and whether their inputs are a model and a scenario or a model alone.
const TARGETS: &[(&str, bool)] = &[
    ("parse_is_total_and_lossless", false),
    ("check_never_panics", false),
    ("step_never_panics", false),
    ("a_failed_step_leaves_the_state", false),
    ("scenario_never_panics", true),
];

/// Counters at every edge, their places, and the operands of comparisons.
const FLAGS: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares --cfg fuzzing";

/// Parts model and scenario in an input. SYNC(divider): fuzz/src/lib.rs
const DIVIDER: &str = "\n%%%%\n";

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
    let targets: Vec<_> = TARGETS.iter().filter(|(name, _)| name.contains(only)).collect();
    if targets.is_empty() {
        return Err(format!("no target's name has `{only}` in it"));
    }
    if let Some(input) = arguments.option("--reproduce") {
        return reproduce(&binaries, targets[0].0, Path::new(input));
    }
    let mut outcome = Outcome::Good;
    for (name, with_scenario) in targets {
        let seeds = home.join("seeds").join(name);
        write_seeds(&seeds, *with_scenario)?;
        if !fuzz(&home, &binaries, name, &seeds, seconds, seed)? {
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
fn write_seeds(folder: &Path, with_scenario: bool) -> Result<(), Failure> {
    let wrap = |error: std::io::Error| format!("{}: {error}", folder.display());
    if folder.exists() {
        std::fs::remove_dir_all(folder).map_err(wrap)?;
    }
    std::fs::create_dir_all(folder).map_err(wrap)?;
    for (number, seed) in seeds(with_scenario)?.iter().enumerate() {
        std::fs::write(folder.join(format!("{number:04}")), seed).map_err(wrap)?;
    }
    Ok(())
}

fn seeds(with_scenario: bool) -> Result<Vec<String>, Failure> {
    let root = repository::root();
    // A transcript's file may be of another encoding on purpose.
    let read = |path: &str| match std::fs::read(root.join(path)) {
        Ok(bytes) => Ok(String::from_utf8_lossy(&bytes).into_owned()),
        Err(error) => Err(format!("{path}: {error}")),
    };
    let mut seeds = Vec::new();
    for path in repository::files()?.iter().filter(|path| !path.starts_with("web/")) {
        if with_scenario && path.ends_with(".avalla") {
            let scenario = read(path)?;
            let model = loaded_model(path, &scenario).and_then(|model| read(&model).ok()).unwrap_or_default();
            let scenario: Vec<&str> = scenario
                .lines()
                .map(|line| if line.trim_start().starts_with("load ") { "load Model.asm" } else { line })
                .collect();
            seeds.push(format!("{model}{DIVIDER}{}\n", scenario.join("\n")));
        } else if !with_scenario && (path.ends_with(".asm") || path.ends_with(".avalla")) {
            seeds.push(read(path)?);
        } else if !with_scenario && path.starts_with("spec/") && path.ends_with(".md") {
            seeds.extend(blocks(&read(path)?));
        }
    }
    Ok(seeds)
}

/// The path of the model that a scenario loads.
fn loaded_model(path: &str, scenario: &str) -> Option<String> {
    let written = scenario.lines().find_map(|line| line.trim().strip_prefix("load "))?;
    let written = written.trim().trim_matches('"');
    let mut parts: Vec<&str> = path.split('/').collect();
    parts.pop();
    for part in written.split('/') {
        match part {
            "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

/// The fenced blocks of a Markdown page.
fn blocks(page: &str) -> Vec<String> {
    let mut blocks = Vec::new();
    let mut open: Option<Vec<&str>> = None;
    for line in page.lines() {
        match (&mut open, line.trim_start().starts_with("```")) {
            (None, true) => open = Some(Vec::new()),
            (Some(_), true) => blocks.extend(open.take().map(|lines| lines.join("\n") + "\n")),
            (Some(lines), false) => lines.push(line),
            (None, false) => {}
        }
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_taken_out_of_pages() {
        assert_eq!(blocks("a\n```asmetal\nx := 1\n```\nb\n```\ny\n```\n"), ["x := 1\n", "y\n"]);
    }

    #[test]
    fn a_scenario_leads_to_its_model() {
        assert_eq!(loaded_model("a/b/S.avalla", "scenario s\nload ../M.asm\n").as_deref(), Some("a/M.asm"));
    }
}
