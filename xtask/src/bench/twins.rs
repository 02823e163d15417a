//! The programs written by hand: each, its AsmetaL twin and the C++ generated from that, step by step the same, in one
//! session.
//!
//! In: bench/native/*.cpp, compiled with -O2, and the models. Out: steps per second of all three and their ratios.
//! All make the same number of steps from their initial states with the same choices, again and again for as long as
//! is measured; their final states are compared, location by location, and a difference is a fault. Without g++ there is
//! nothing to compare with, and that is said.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::{Duration, Instant};

use machine::{Choice, Environment, Limits, LocationRef, Machine, Passed, Show, Snapshot, TimeUnit, Value};
use model::Loader;
use program::{DomainId, DomainKind, Program};
use syntax::SourceFile;

use super::{Effort, figure, table};
use crate::{Failure, Outcome, repository};

/// A program and its model.
struct Pair {
    /// The program's file in bench/native, without its end.
    name: &'static str,
    /// The model's file, without its end.
    model: &'static str,
    /// How many steps both make from the initial state.
    steps: u64,
    /// Too large for its step to be flattened into the loop (bench/native/driver.hpp).
    large: bool,
}

const fn small(name: &'static str, model: &'static str, steps: u64) -> Pair {
    Pair { name, model, steps, large: false }
}

const TWINS: &[Pair] = &[
    small("bubble_sort", "bench/models/BubbleSort", 20_160),
    small("sieve", "bench/models/Sieve", 500),
    small("philosophers", "bench/models/Philosophers", 100_000),
    small("life", "bench/models/Life", 500),
    small("producer_consumer", "bench/models/ProducerConsumer", 100_000),
    Pair {
        name: "complete_controller",
        model: "examples/visual_servoing/CompleteController",
        steps: 10_000,
        large: true,
    },
];

impl Pair {
    fn path(&self) -> PathBuf {
        repository::root().join(format!("{}.asm", self.model))
    }

    /// A compiler with the flags of both programs.
    fn compiler(&self) -> Command {
        let mut command = Command::new("g++");
        command.args(["-std=c++20", "-O2"]);
        if self.large {
            command.arg("-DLARGE");
        }
        command
    }
}

/// Compares and measures all twins.
///
/// # Errors
/// A program does not compile, a model is faulty.
pub fn compare(binary: &Path, effort: Effort, only: &str) -> Result<Outcome, Failure> {
    let twins: Vec<_> = TWINS.iter().filter(|pair| pair.name.contains(only) || pair.model.contains(only)).collect();
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
    for pair in twins {
        let (name, steps) = (pair.name, pair.steps);
        let program = load(pair)?;
        let native = compile(pair, folder.path())?;
        let generated = generate(binary, pair, &program, folder.path())?;
        let differences = [difference(&native, &program, steps)?, difference(&generated, &program, steps)?];
        if let Some(difference) = differences.into_iter().flatten().next() {
            println!("{name}: after {steps} steps {difference}");
            outcome = Outcome::AtFault;
            continue;
        }
        let engine = engine_rate(&program, steps, effort)?;
        let (native, generated) = rates(&native, &generated, steps, effort)?;
        let cells = [engine, generated, native, native / engine, native / generated].map(figure);
        rows.push([name.to_string(), steps.to_string()].into_iter().chain(cells).collect());
    }
    println!("Native twins (g++ -O2), the same steps with the same choices, final states equal\n");
    let head = [
        "program",
        "steps",
        "engine steps/s",
        "generated steps/s",
        "native steps/s",
        "native/engine",
        "native/generated",
    ];
    println!("{}", table(&head, &rows));
    Ok(outcome)
}

fn compile(pair: &Pair, folder: &Path) -> Result<PathBuf, Failure> {
    let source = repository::root().join("bench/native").join(format!("{}.cpp", pair.name));
    let target = folder.join(pair.name);
    done(pair.compiler().arg("-o").arg(&target).arg(&source))?;
    Ok(target)
}

/// The step code that `groundstate generate cpp` makes of a model, in the frame of the native programs.
fn generate(binary: &Path, pair: &Pair, program: &Program, folder: &Path) -> Result<PathBuf, Failure> {
    let (made, target) = (folder.join(format!("{}_made", pair.name)), folder.join(format!("{}_generated", pair.name)));
    done(Command::new(binary).args(["generate", "cpp"]).arg(pair.path()).arg("-o").arg(&made))?;
    let files = std::fs::read_dir(&made).map_err(|error| format!("{}: {error}", made.display()))?;
    let header =
        files.flatten().map(|entry| entry.path()).find(|path| path.extension().is_some_and(|end| end == "hpp"));
    let header = header.ok_or_else(|| format!("nothing was generated from {}.asm", pair.model))?;
    let name = header.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let names_file = made.join("bench_names.hpp");
    std::fs::write(&names_file, names(program)).map_err(|error| format!("{}: {error}", names_file.display()))?;
    let mut command = pair.compiler();
    command.arg(format!("-DSOURCE=<{name}.cpp>")).arg(format!("-DMODEL={name}")).arg("-DNAMES=<bench_names.hpp>");
    command.arg("-I").arg(&made).arg("-I").arg(made.join("runtime/include")).arg("-o").arg(&target);
    done(command.arg(repository::root().join("bench/native/generated.cpp")))?;
    Ok(target)
}

/// What the values of a model are printed by, as C++.
fn names(program: &Program) -> String {
    let quoted = |names: &[String]| names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let mut tables = String::new();
    let mut domains = Vec::new();
    for (index, domain) in program.domains.iter().enumerate() {
        let (names, is_abstract) = match &domain.kind {
            DomainKind::Enum { literals } => (literals.as_slice(), false),
            DomainKind::Abstract { elements, .. } => (elements.as_slice(), true),
            _ => (&[][..], false),
        };
        let mut table = "{}".to_string();
        if !names.is_empty() {
            table = format!("domain_{index}");
            tables += &format!(
                "    static constexpr std::array<std::string_view, {}> {table}{{{}}};\n",
                names.len(),
                quoted(names)
            );
        }
        domains.push(format!("{{\"{}\", {is_abstract}, {table}}}", domain.name));
    }
    let procedures: Vec<String> = program.procedures.iter().map(|procedure| procedure.name.clone()).collect();
    format!(
        "#include <array>\n#include <string_view>\n\n#include <groundstate/machine/names.hpp>\n\n\
         inline const groundstate::machine::Names& names() {{\n{tables}\
         \x20   static constexpr std::array<groundstate::machine::Names::Domain, {}> domains{{{{{}}}}};\n\
         \x20   static constexpr std::array<std::string_view, {}> procedures{{{}}};\n\
         \x20   static constexpr groundstate::machine::Names all{{domains, procedures}};\n    return all;\n}}\n",
        domains.len(),
        domains.join(", "),
        procedures.len(),
        quoted(&procedures),
    )
}

/// Runs a command that has to succeed.
fn done(command: &mut Command) -> Result<(), Failure> {
    let name = command.get_program().to_string_lossy().into_owned();
    match command.output() {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(format!("{name} fails: {}", String::from_utf8_lossy(&output.stderr))),
        Err(error) => Err(format!("{name} cannot be run: {error}")),
    }
}

struct Files;

impl Loader for Files {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let folder = Path::new(&importer.name).parent().unwrap_or(Path::new(""));
        read(&folder.join(format!("{path}.asm")))
    }
}

/// One file has one name, however it is reached.
fn read(path: &Path) -> Result<SourceFile, String> {
    let found = path.canonicalize().map_err(|error| format!("{}: {error}", path.display()))?;
    let text = std::fs::read_to_string(&found).map_err(|error| format!("{}: {error}", found.display()))?;
    Ok(SourceFile::new(found.to_string_lossy(), text))
}

fn load(pair: &Pair) -> Result<Arc<Program>, Failure> {
    let model = pair.model;
    let loaded = groundstate::load(read(&pair.path())?, &mut Files);
    match loaded {
        Ok(loaded) => Ok(loaded.program),
        Err(faulty) => {
            Err(format!("{model}.asm: {}", faulty.diagnostics.first().map_or("faulty", |fault| fault.message.as_str())))
        }
    }
}

/// xorshift64, the same as in bench/native/driver.hpp. SYNC(random)
struct Random(u64);

impl Default for Random {
    fn default() -> Self {
        Random(88_172_645_463_325_252)
    }
}

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

/// A model at its initial state, to which it can go back.
struct Twin {
    machine: Machine,
    initial: Snapshot,
    random: Random,
}

impl Twin {
    fn new(program: &Arc<Program>) -> Result<Twin, Failure> {
        let mut machine = Machine::new(Arc::clone(program), Limits::default());
        let mut random = Random::default();
        machine.start(&mut random).map_err(|fault| fault.show(program).to_string())?;
        let initial = machine.snapshot();
        Ok(Twin { machine, initial, random })
    }

    /// Makes steps. One that has nothing to do (the array is sorted) does not count: the machine goes back to its
    /// initial state, as the native program does.
    fn make(&mut self, steps: u64) -> Result<(), Failure> {
        let mut made = Passed::default();
        while made.steps < steps {
            let passed = self.machine.pass(steps, &mut self.random, &mut made);
            passed.map_err(|fault| fault.show(self.machine.program()).to_string())?;
            if made.empty > 0 {
                self.machine.restore(&self.initial);
                made.steps -= std::mem::take(&mut made.empty);
            }
        }
        Ok(())
    }

    fn go_back(&mut self) {
        self.machine.restore(&self.initial);
        self.random = Random::default();
    }
}

/// The first location in which the two differ after so many steps.
fn difference(native: &Path, program: &Arc<Program>, steps: u64) -> Result<Option<String>, Failure> {
    let mut twin = Twin::new(program)?;
    twin.make(steps)?;
    let machine = twin.machine;
    let ours: BTreeMap<String, String> = machine
        .locations()
        .iter()
        .map(|(location, value)| (location.show(program).to_string(), value.show(program).to_string()))
        .collect();
    let (_, theirs) = run_native(native, steps, 1)?;
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
fn run_native(native: &Path, steps: u64, rounds: u64) -> Result<(f64, Vec<(String, String)>), Failure> {
    let output = Command::new(native).args([steps.to_string(), rounds.to_string()]).output();
    let output = output.map_err(|error| format!("{}: {error}", native.display()))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let seconds = text.lines().find_map(|line| line.strip_prefix("# seconds ")).and_then(|rest| rest.parse().ok());
    let values = text.lines().filter_map(|line| line.split_once('=')).map(|(a, b)| (a.to_string(), b.to_string()));
    Ok((seconds.ok_or("a native program does not tell its time")?, values.collect()))
}

/// The median of the windows, each at least as long as asked for: rounds of so many steps from the initial state,
/// the going back not timed.
fn engine_rate(program: &Arc<Program>, steps: u64, effort: Effort) -> Result<f64, Failure> {
    let mut twin = Twin::new(program)?;
    let mut window = || -> Result<f64, Failure> {
        let (mut spent, mut rounds) = (Duration::ZERO, 0u64);
        while (spent.as_millis() as u64) < effort.window_ms {
            twin.go_back();
            let began = Instant::now();
            twin.make(steps)?;
            spent += began.elapsed();
            rounds += 1;
        }
        Ok((rounds * steps) as f64 / spent.as_secs_f64())
    };
    window()?;
    median((0..effort.windows.max(1)).map(|_| window()).collect::<Result<Vec<f64>, _>>()?)
}

/// Of the program written by hand and the generated one, window by window in turn.
fn rates(native: &Path, generated: &Path, steps: u64, effort: Effort) -> Result<(f64, f64), Failure> {
    let mut rounds = 1;
    // As many rounds as fill a window.
    while run_native(native, steps, rounds)?.0 * 1e3 < effort.window_ms as f64 && rounds < 1 << 32 {
        rounds *= 2;
    }
    let rate = |program: &Path| Ok::<f64, Failure>((rounds * steps) as f64 / run_native(program, steps, rounds)?.0);
    let mut found = (Vec::new(), Vec::new());
    for _ in 0..effort.windows.max(1) {
        found.0.push(rate(native)?);
        found.1.push(rate(generated)?);
    }
    Ok((median(found.0)?, median(found.1)?))
}

fn median(mut rates: Vec<f64>) -> Result<f64, Failure> {
    rates.sort_by(f64::total_cmp);
    Ok(rates[rates.len() / 2])
}
