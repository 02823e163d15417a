//! How fast states are explored: our reference systems, beside SPIN and TLC on their twins, in one run.
//!
//! In: the models of bench/models/verify; a folder with the same systems in Promela (`spin/`) and TLA+ (`tla/`), and TLC's
//! jar, where they are named. Out: a table. INVARIANT: a count of states of ours that is not the one expected is a fault; a
//! peer's is told.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use super::child::{Spent, run};
use super::{figure, table};
use crate::{Failure, Outcome, repository};

/// A reference system.
struct System {
    name: &'static str,
    states: u64,
    /// The Promela file and its parameters.
    spin: (&'static str, &'static [&'static str]),
    /// The TLA+ module and its configuration.
    tla: (&'static str, &'static str),
    /// It takes minutes and gigabytes; TLC would take hours.
    large: bool,
}

const SYSTEMS: &[System] = &[
    System {
        name: "ChainS",
        states: 2_977_088,
        spin: ("chain.pml", &["-DE=3", "-DWD=3", "-DD=1"]),
        tla: ("Chain", "ChainS"),
        large: false,
    },
    System { name: "Phil12", states: 531_440, spin: ("phil.pml", &["-DN=12"]), tla: ("Phil", "Phil12"), large: false },
    System {
        name: "ChainL",
        states: 28_820_352,
        spin: ("chain.pml", &["-DE=0", "-DWD=0", "-DD=2"]),
        tla: ("Chain", "ChainL"),
        large: true,
    },
    System {
        name: "ChainXL",
        states: 134_433_352,
        spin: ("chain.pml", &["-DE=1", "-DWD=1", "-DD=2"]),
        tla: ("Chain", "ChainXL"),
        large: true,
    },
];

/// What is measured beside our own.
#[derive(Debug, Clone, Default)]
pub struct Peers {
    /// The folder with their models.
    pub models: Option<PathBuf>,
    /// TLC.
    pub tlc: Option<PathBuf>,
    /// The systems that take minutes and gigabytes, too.
    pub large: bool,
}

/// One run.
#[derive(Debug, Clone, Copy)]
struct Run {
    states: u64,
    bytes: f64,
    spent: Spent,
}

impl Run {
    fn rate(&self) -> f64 {
        self.states as f64 / self.spent.user
    }
}

/// What is read of what `groundstate verify` prints.
#[derive(Debug, Deserialize)]
struct Explored {
    states: u64,
    bytes: u64,
}

/// Measures and prints.
///
/// # Errors
/// A command cannot be run.
pub fn explored(binary: &Path, peers: &Peers, only: &str) -> Result<Outcome, Failure> {
    let mut rows = Vec::new();
    let mut wrong = Vec::new();
    for system in SYSTEMS.iter().filter(|system| peers.large || !system.large) {
        if !system.name.contains(only) && only != "verify" {
            continue;
        }
        let one = ours(binary, system, 1)?;
        let two = ours(binary, system, 2)?;
        let mut measured = vec![("groundstate", one, Some(two))];
        if let Some(models) = &peers.models {
            match spin(models, system) {
                Ok(run) => measured.push(("spin", run, None)),
                Err(reason) => println!("{} is not measured with SPIN: {reason}\n", system.name),
            }
            if let (Some(jar), false) = (&peers.tlc, system.large) {
                let (one, two) = (tlc(jar, models, system, 1), tlc(jar, models, system, 2));
                match (one, two) {
                    (Ok(one), Ok(two)) => measured.push(("tlc", one, Some(two))),
                    (Err(reason), _) | (_, Err(reason)) => {
                        println!("{} is not measured with TLC: {reason}\n", system.name);
                    }
                }
            }
        }
        for (who, one, two) in measured {
            if one.states != system.states || two.is_some_and(|two| two.states != system.states) {
                wrong.push(format!("{who} finds {} states of {}, not {}", one.states, system.name, system.states));
            }
            let ratio = measured_ratio(&rows, system.name, one.rate());
            rows.push((system.name, one.rate(), line(system.name, who, &one, two.as_ref(), ratio)));
        }
    }
    if rows.is_empty() {
        return Ok(Outcome::Good);
    }
    println!("States explored; a second is one of user time on one core, a ratio how many times faster we are\n");
    let head =
        ["model", "by", "states", "states/s", "ratio", "bytes/state", "peak MiB", "1 worker s", "2 workers s", "gain"];
    let rows: Vec<Vec<String>> = rows.into_iter().map(|(_, _, row)| row).collect();
    println!("{}", table(&head, &rows));
    wrong.iter().for_each(|wrong| println!("{wrong}"));
    let ours = wrong.iter().any(|wrong| wrong.starts_with("groundstate "));
    Ok(if ours { Outcome::AtFault } else { Outcome::Good })
}

/// Our rate over this one; ours comes first.
fn measured_ratio(rows: &[(&str, f64, Vec<String>)], name: &str, rate: f64) -> f64 {
    rows.iter().find(|(other, ..)| *other == name).map_or(1.0, |(_, ours, _)| ours / rate)
}

fn line(name: &str, who: &str, one: &Run, two: Option<&Run>, ratio: f64) -> Vec<String> {
    let missing = || "-".to_string();
    vec![
        name.to_string(),
        who.to_string(),
        one.states.to_string(),
        figure(one.rate()),
        figure(ratio),
        figure(one.bytes / one.states as f64),
        figure(one.spent.peak),
        figure(one.spent.wall),
        two.map_or_else(missing, |two| figure(two.spent.wall)),
        two.map_or_else(missing, |two| figure(one.spent.wall / two.spent.wall)),
    ]
}

fn ours(binary: &Path, system: &System, workers: usize) -> Result<Run, Failure> {
    let model = repository::root().join(format!("bench/models/verify/{}.asm", system.name));
    let workers = workers.to_string();
    let mut command = Command::new(binary);
    command.args(["verify", "--engine", "explicit", "--format", "json", "--workers", &workers]).arg(&model);
    let (text, spent) = run(&mut command)?;
    let line = text.lines().find(|line| line.contains(r#""type":"explored""#));
    let line = line.ok_or_else(|| format!("{}: nothing was explored", system.name))?;
    let explored: Explored = serde_json::from_str(line).map_err(|error| format!("{}: {error}", system.name))?;
    Ok(Run { states: explored.states, bytes: explored.bytes as f64, spent })
}

/// SPIN without partial orders, so that it goes through the same states.
fn spin(models: &Path, system: &System) -> Result<Run, Failure> {
    let (file, parameters) = system.spin;
    let model = models.join("spin").join(file);
    let model = model.canonicalize().map_err(|error| format!("{}: {error}", model.display()))?;
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let made = Command::new("spin").arg("-a").args(parameters).arg(&model).current_dir(&folder).output();
    if !made.is_ok_and(|made| made.status.success()) {
        return Err("there is no `spin` on the path, or it cannot read the model".to_string());
    }
    let options = ["-O2", "-DNOREDUCE", "-DSAFETY", "-DMEMLIM=16000", "-o", "pan", "pan.c"];
    let built = Command::new("gcc").args(options).current_dir(&folder).output();
    if !built.is_ok_and(|built| built.status.success()) {
        return Err("what it writes does not build".to_string());
    }
    // The whole graph: deadlocks do not end the search.
    let mut command = Command::new(folder.path().join("pan"));
    let (text, spent) = run(command.args(["-m10000000", "-c0", "-w27"]).current_dir(&folder))?;
    let count = text.lines().find_map(|line| line.trim().strip_suffix("states, stored"));
    let states = count.and_then(|count| count.trim().parse::<f64>().ok()).ok_or("it counts no states")?;
    let bytes = text.lines().find(|line| line.contains("actual memory usage for states"));
    let bytes = bytes.and_then(|line| line.split_whitespace().next()).and_then(|bytes| bytes.parse::<f64>().ok());
    Ok(Run { states: states as u64, bytes: bytes.unwrap_or(spent.peak) * f64::from(1 << 20), spent })
}

fn tlc(jar: &Path, models: &Path, system: &System, workers: usize) -> Result<Run, Failure> {
    let (module, configuration) = system.tla;
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let tla = models.join("tla");
    let jar = jar.canonicalize().map_err(|error| format!("{}: {error}", jar.display()))?;
    let mut command = Command::new("java");
    command.args(["-XX:+UseParallelGC", "-cp"]).arg(jar).args(["tlc2.TLC", "-deadlock", "-workers"]);
    command.arg(workers.to_string()).arg("-metadir").arg(folder.path());
    command.args(["-config", &format!("{configuration}.cfg"), module]).current_dir(&tla);
    let (text, spent) = run(&mut command)?;
    let last = text.lines().rfind(|line| line.contains("distinct states found"));
    let number = last.and_then(|line| line.split(", ").nth(1)).and_then(|part| part.split(' ').next());
    let states = number.and_then(|number| number.replace(',', "").parse().ok()).ok_or("it counts no states")?;
    Ok(Run { states, bytes: spent.peak * f64::from(1 << 20), spent })
}
