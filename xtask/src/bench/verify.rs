//! How fast states are explored: our reference systems, beside SPIN and TLC on their twins, in one run.
//!
//! In: the models of bench/models/verify and the classics' twins in Promela there (`spin/`); a folder with the other systems in
//! Promela (`spin/`) and TLA+ (`tla/`), and TLC's jar, where they are named. Out: a table. INVARIANT: a count of states of ours
//! that is not the one expected is a fault; a peer's is told.

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
    /// The Promela file and its parameters; none: the twin that stands in this project under the same name.
    spin: Option<(&'static str, &'static [&'static str])>,
    /// The TLA+ module and its configuration.
    tla: Option<(&'static str, &'static str)>,
    /// It takes minutes and gigabytes; TLC would take hours.
    large: bool,
}

const SYSTEMS: &[System] = &[
    System {
        name: "ChainS",
        states: 2_977_088,
        spin: Some(("chain.pml", &["-DE=3", "-DWD=3", "-DD=1"])),
        tla: Some(("Chain", "ChainS")),
        large: false,
    },
    System {
        name: "Phil12",
        states: 531_440,
        spin: Some(("phil.pml", &["-DN=12"])),
        tla: Some(("Phil", "Phil12")),
        large: false,
    },
    System {
        name: "ChainL",
        states: 28_820_352,
        spin: Some(("chain.pml", &["-DE=0", "-DWD=0", "-DD=2"])),
        tla: Some(("Chain", "ChainL")),
        large: true,
    },
    System {
        name: "ChainXL",
        states: 134_433_352,
        spin: Some(("chain.pml", &["-DE=1", "-DWD=1", "-DD=2"])),
        tla: Some(("Chain", "ChainXL")),
        large: true,
    },
    classic("Peterson", 1_119_560),
    classic("Bakery", 86_798),
    classic("Szymanski", 75_240),
    classic("GoBackN", 643_370),
    classic("AlternatingBit", 60_273),
    classic("RingElection", 236_186),
    classic("TwoPhaseCommit", 1_745_408),
    classic("German", 544_617),
    classic("ReadersWriters", 141_870),
    classic("Elevator", 331_104),
];

/// A classic system, whose twin is our own.
const fn classic(name: &'static str, states: u64) -> System {
    System { name, states, spin: None, tla: None, large: false }
}

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
    /// Not counted for peers.
    transitions: u64,
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
    transitions: u64,
    bytes: u64,
}

/// What is read of what `groundstate bench` prints.
#[derive(Debug, Deserialize)]
struct Stepped {
    steps_per_second: f64,
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
        match promela(system, peers).map(|(model, parameters)| spin(&model, parameters, system.states)) {
            Some(Ok(run)) => measured.push(("spin", run, None)),
            Some(Err(reason)) => println!("{} is not measured with SPIN: {reason}\n", system.name),
            None => {}
        }
        if let (Some(models), Some(jar), Some(twin), false) = (&peers.models, &peers.tlc, system.tla, system.large) {
            let (one, two) = (tlc(jar, models, twin, 1), tlc(jar, models, twin, 2));
            match (one, two) {
                (Ok(one), Ok(two)) => measured.push(("tlc", one, Some(two))),
                (Err(reason), _) | (_, Err(reason)) => {
                    println!("{} is not measured with TLC: {reason}\n", system.name);
                }
            }
        }
        let executed = executed(binary, system)?;
        for (who, one, two) in measured {
            if one.states != system.states || two.is_some_and(|two| two.states != system.states) {
                wrong.push(format!("{who} finds {} states of {}, not {}", one.states, system.name, system.states));
            }
            let ratio = measured_ratio(&rows, system.name, one.rate());
            rows.push((system.name, one.rate(), line(system.name, who, &one, two.as_ref(), ratio, executed)));
        }
    }
    if rows.is_empty() {
        return Ok(Outcome::Good);
    }
    println!("States explored; a second is one of user time on one core, a ratio how many times faster we are\n");
    let head = [
        "model",
        "by",
        "states",
        "states/s",
        "ratio",
        "bytes/state",
        "peak MiB",
        "1 worker s",
        "2 workers s",
        "gain",
        "search/run",
    ];
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

fn line(name: &str, who: &str, one: &Run, two: Option<&Run>, ratio: f64, executed: f64) -> Vec<String> {
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
        if one.transitions > 0 { figure(executed * one.spent.user / one.transitions as f64) } else { missing() },
    ]
}

/// Steps per second of a run.
fn executed(binary: &Path, system: &System) -> Result<f64, Failure> {
    let model = repository::root().join(format!("bench/models/verify/{}.asm", system.name));
    let mut command = Command::new(binary);
    command.args(["bench", "--format", "json", "--windows", "3", "--window-ms", "100"]).arg(&model);
    let (text, _) = run(&mut command)?;
    let line = text.lines().find(|line| line.contains(r#""type":"bench""#));
    let line = line.ok_or_else(|| format!("{}: no steps were measured", system.name))?;
    let stepped: Stepped = serde_json::from_str(line).map_err(|error| format!("{}: {error}", system.name))?;
    Ok(stepped.steps_per_second)
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
    Ok(Run { states: explored.states, transitions: explored.transitions, bytes: explored.bytes as f64, spent })
}

/// The twin in Promela and its parameters, if it stands here or where the peers' models are.
fn promela(system: &System, peers: &Peers) -> Option<(PathBuf, &'static [&'static str])> {
    match (system.spin, &peers.models) {
        (None, _) => Some((repository::root().join(format!("bench/models/verify/spin/{}.pml", system.name)), &[])),
        (Some((file, parameters)), Some(models)) => Some((models.join("spin").join(file), parameters)),
        (Some(_), None) => None,
    }
}

/// SPIN without partial orders, so that it goes through the same states.
fn spin(model: &Path, parameters: &[&str], expected: u64) -> Result<Run, Failure> {
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
    // Its stack and table are cleared at the beginning, which a small system should not pay for.
    let [stack, places] = if expected < 2_000_000 { ["-m1000000", "-w24"] } else { ["-m10000000", "-w27"] };
    // The whole graph: deadlocks do not end the search.
    let mut command = Command::new(folder.path().join("pan"));
    let (text, spent) = run(command.args([stack, "-c0", places]).current_dir(&folder))?;
    let count = text.lines().find_map(|line| line.trim().strip_suffix("states, stored"));
    let states = count.and_then(|count| count.trim().parse::<f64>().ok()).ok_or("it counts no states")?;
    let bytes = text.lines().find(|line| line.contains("actual memory usage for states"));
    let bytes = bytes.and_then(|line| line.split_whitespace().next()).and_then(|bytes| bytes.parse::<f64>().ok());
    Ok(Run { states: states as u64, transitions: 0, bytes: bytes.unwrap_or(spent.peak) * f64::from(1 << 20), spent })
}

fn tlc(jar: &Path, models: &Path, (module, configuration): (&str, &str), workers: usize) -> Result<Run, Failure> {
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
    Ok(Run { states, transitions: 0, bytes: spent.peak * f64::from(1 << 20), spent })
}
