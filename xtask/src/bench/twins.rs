//! The five programs: a C++ program and its AsmetaL twin, step by step the same, in one session.
//!
//! In: bench/native/*.cpp, compiled with -O2, and bench/models/*.asm. Out: steps per second of both and their ratio.
//! First both make the same number of steps with the same choices and their final states are compared, location by
//! location; a difference is a fault. Without g++ there is nothing to compare with, and that is said.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;

use machine::{Choice, Environment, Limits, LocationRef, Machine, Show, TimeUnit, Value};
use model::Loader;
use program::{DomainId, Program};
use syntax::SourceFile;

use super::{Effort, figure, table};
use crate::{Failure, Outcome, repository};

/// A program, its model, and after how many steps their states are compared.
const TWINS: &[(&str, &str, u64)] = &[
    ("bubble_sort", "BubbleSort", 5000),
    ("sieve", "Sieve", 200),
    ("philosophers", "Philosophers", 20_000),
    ("life", "Life", 200),
    ("producer_consumer", "ProducerConsumer", 20_000),
];

/// Compares and measures all twins.
///
/// # Errors
/// A program does not compile, a model is faulty.
pub fn compare(effort: Effort, only: &str) -> Result<Outcome, Failure> {
    let twins: Vec<_> = TWINS.iter().filter(|(name, model, _)| name.contains(only) || model.contains(only)).collect();
    if twins.is_empty() {
        return Ok(Outcome::Good);
    }
    if Command::new("g++").arg("--version").output().is_err() {
        println!("There is no g++ here, so the native programs are not compared with.\n");
        return Ok(Outcome::Good);
    }
    let folder = tempfile::tempdir().map_err(|error| format!("no temporary folder: {error}"))?;
    let mut outcome = Outcome::Good;
    let mut rows = Vec::new();
    for (name, model, steps) in twins {
        let native = compile(name, folder.path())?;
        let program = load(model)?;
        if let Some(difference) = difference(&native, &program, *steps)? {
            println!("{name}: after {steps} steps {difference}");
            outcome = Outcome::AtFault;
            continue;
        }
        let here = engine_rate(&program, effort)?;
        let there = native_rate(&native, effort)?;
        rows.push(vec![(*name).to_string(), figure(here), figure(there), figure(there / here)]);
    }
    println!("Native twins (g++ -O2), the same steps with the same choices, final states equal\n");
    println!("{}", table(&["program", "engine steps/s", "native steps/s", "native is … times faster"], &rows));
    Ok(outcome)
}

fn compile(name: &str, folder: &Path) -> Result<PathBuf, Failure> {
    let source = repository::root().join("bench/native").join(format!("{name}.cpp"));
    let target = folder.join(name);
    let built = Command::new("g++").args(["-std=c++20", "-O2", "-o"]).arg(&target).arg(&source).output();
    match built {
        Ok(built) if built.status.success() => Ok(target),
        Ok(built) => Err(format!("{name}.cpp does not compile: {}", String::from_utf8_lossy(&built.stderr))),
        Err(error) => Err(format!("g++ cannot be run: {error}")),
    }
}

struct Files;

impl Loader for Files {
    fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        Err(format!("{path} is no library"))
    }
}

fn load(model: &str) -> Result<Arc<Program>, Failure> {
    let path = repository::root().join("bench/models").join(format!("{model}.asm"));
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let loaded = groundstate::load(SourceFile::new(format!("{model}.asm"), text), &mut Files);
    match loaded {
        Ok(loaded) => Ok(Arc::new(loaded.program)),
        Err(faulty) => {
            Err(format!("{model}.asm: {}", faulty.diagnostics.first().map_or("faulty", |fault| fault.message.as_str())))
        }
    }
}

/// xorshift64, the same as in bench/native/driver.hpp. SYNC(random)
struct Random(u64);

impl Environment for Random {
    fn monitored(
        &mut self,
        program: &Program,
        location: LocationRef<'_>,
        _codomain: DomainId,
    ) -> Result<Value, String> {
        Err(format!("a twin has no inputs, not even {}", location.show(program)))
    }

    fn choose(&mut self, _program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        Ok((((self.0 >> 32) * choice.candidates() as u64) >> 32) as usize)
    }

    fn time(&mut self, _unit: TimeUnit) -> Result<i64, String> {
        Err("a twin has no clock".to_string())
    }
}

fn started(program: &Arc<Program>) -> Result<(Machine, Random), Failure> {
    let mut machine = Machine::new(Arc::clone(program), Limits::default());
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    machine.start(&mut random).map_err(|fault| fault.show(program).to_string())?;
    Ok((machine, random))
}

/// The first location in which the two differ after so many steps.
fn difference(native: &Path, program: &Arc<Program>, steps: u64) -> Result<Option<String>, Failure> {
    let (mut machine, mut random) = started(program)?;
    for _ in 0..steps {
        machine.step(&mut random).map_err(|fault| fault.show(program).to_string())?;
    }
    let ours: BTreeMap<String, String> = machine
        .locations()
        .iter()
        .map(|(location, value)| (location.show(program).to_string(), value.show(program).to_string()))
        .collect();
    let (_, theirs) = run_native(native, steps)?;
    for (location, value) in &theirs {
        let mine = ours.get(location).map_or("undef", String::as_str);
        if mine != value {
            return Ok(Some(format!("`{location}` is {mine} in AsmetaL and {value} in C++")));
        }
    }
    let unknown = ours.keys().find(|location| !theirs.iter().any(|(name, _)| name == *location));
    Ok(unknown.map(|location| format!("`{location}` is not printed by the C++ program")))
}

/// The seconds a native program took, and its final state.
fn run_native(native: &Path, steps: u64) -> Result<(f64, Vec<(String, String)>), Failure> {
    let output = Command::new(native).arg(steps.to_string()).output();
    let output = output.map_err(|error| format!("{}: {error}", native.display()))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let seconds = text.lines().find_map(|line| line.strip_prefix("# seconds ")).and_then(|rest| rest.parse().ok());
    let values = text.lines().filter_map(|line| line.split_once('=')).map(|(a, b)| (a.to_string(), b.to_string()));
    Ok((seconds.ok_or("a native program does not tell its time")?, values.collect()))
}

/// The median of the windows, each at least as long as asked for.
fn engine_rate(program: &Arc<Program>, effort: Effort) -> Result<f64, Failure> {
    let (mut machine, mut random) = started(program)?;
    let mut window = || -> Result<f64, Failure> {
        let (began, mut steps) = (Instant::now(), 0u64);
        loop {
            for _ in 0..8 {
                machine.step(&mut random).map_err(|fault| fault.show(program).to_string())?;
            }
            steps += 8;
            let spent = began.elapsed();
            if spent.as_millis() as u64 >= effort.window_ms {
                return Ok(steps as f64 / spent.as_secs_f64());
            }
        }
    };
    window()?;
    median((0..effort.windows.max(1)).map(|_| window()).collect::<Result<Vec<f64>, _>>()?)
}

fn native_rate(native: &Path, effort: Effort) -> Result<f64, Failure> {
    let mut steps = 64;
    // As many steps as fill a window.
    while run_native(native, steps)?.0 * 1e3 < effort.window_ms as f64 && steps < 1 << 40 {
        steps *= 2;
    }
    let rates = (0..effort.windows.max(1)).map(|_| Ok(steps as f64 / run_native(native, steps)?.0));
    median(rates.collect::<Result<Vec<f64>, Failure>>()?)
}

fn median(mut rates: Vec<f64>) -> Result<f64, Failure> {
    rates.sort_by(f64::total_cmp);
    Ok(rates[rates.len() / 2])
}
