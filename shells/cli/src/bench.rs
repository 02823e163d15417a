//! `groundstate bench MODEL…`: steps per second and peak memory.
//!
//! A model is warmed up by a fixed number of steps, then stepped for several windows with random inputs. Its state
//! carries over from window to window; when a run ends, a new one starts. Median and spread are over the windows. The
//! digest is of the state after the fixed steps: with the same seed it is the same in every run and on every engine.
//! The share of steps that changed the state shows whether the model was active or had come to rest.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use clap::Args;
use groundstate::simulate::{Bounds, Choices, Inputs, Invariants, Options, Passed, RandomSource, Run};
use machine::{Machine, Show};
use program::Program;
use wire::Measured;

use crate::engine::Engine;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;

/// Arguments of `bench`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Models
    #[arg(required = true, value_name = "MODEL")]
    models: Vec<PathBuf>,
    /// Steps before the first window; the digest is of the state after them
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// How many windows; with 0, the steps before them are measured
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(0..=1_000))]
    windows: u32,
    /// The length of a window, in milliseconds
    #[arg(long, value_name = "MS", default_value_t = 300)]
    window_ms: u64,
    /// Seed of inputs and choices
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Also evaluate invariants
    #[arg(long)]
    invariants: bool,
    /// The engine that makes the steps
    #[arg(long, value_enum, default_value_t)]
    engine: Engine,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    interrupt::listen();
    let mut headed = false;
    for path in &arguments.models {
        if interrupt::asked() {
            return Ok(Exit::Unknown);
        }
        forget_peak();
        let began = Instant::now();
        let loaded = match load(shell, path)? {
            Ok(loaded) => loaded,
            Err(exit) => return Ok(exit),
        };
        let load_ms = began.elapsed().as_secs_f64() * 1e3;
        if loaded.program.main.is_none() {
            shell.note(&format!("note: {} has no main rule to run", path.display()))?;
            continue;
        }
        if !std::mem::replace(&mut headed, true) {
            head(shell)?;
        }
        let measured = measure(shell, arguments, path, loaded.program, load_ms)?;
        show(shell, &measured)?;
        shell.flush()?;
    }
    Ok(Exit::Good)
}

/// Writes the names of the columns.
fn head(shell: &mut Shell) -> Result<(), Failure> {
    if shell.talks() {
        let names = ["steps/s", "lowest..highest", "changed", "updates", "load ms", "peak MB", "digest"];
        let [rate, spread, changed, updates, load, peak, digest] = names;
        writeln!(
            shell.out(),
            "{rate:>12} {spread:>22} {changed:>7} {updates:>7} {load:>7} {peak:>7} {digest:>16}  model"
        )?;
    }
    shell.flush()
}

fn measure(
    shell: &Shell,
    arguments: &Arguments,
    path: &Path,
    program: Arc<Program>,
    load_ms: f64,
) -> Result<Measured, Failure> {
    let window = Duration::from_millis(arguments.window_ms.max(1));
    let mut stepper = Stepper::new(shell, arguments, program, path);
    let first = stepper.part(Until::Steps(arguments.steps))?;
    let digest = stepper.run.as_ref().map_or(0, |run| digest(run.machine()));
    let mut rates = Vec::new();
    if arguments.windows == 0 {
        rates.push(first);
    } else {
        stepper.part(Until::Time(window))?;
    }
    for _ in 0..arguments.windows {
        rates.push(stepper.part(Until::Time(window))?);
    }
    rates.sort_by(f64::total_cmp);
    let Stepper { total, restarts, .. } = stepper;
    let steps = total.steps.max(1) as f64;
    Ok(Measured {
        r#type: "bench",
        model: path.display().to_string(),
        steps_per_second: rates[rates.len() / 2],
        lowest: rates[0],
        highest: rates[rates.len() - 1],
        windows: arguments.windows,
        steps: arguments.steps,
        digest: format!("{digest:016x}"),
        changed_percent: total.changed as f64 / steps * 100.0,
        updates_per_step: total.updates as f64 / steps,
        restarts,
        load_ms,
        peak_memory_mb: peak_memory_mb(),
    })
}

/// FNV-1a over all locations and values of the state, as they are printed.
fn digest(machine: &Machine) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    for (location, value) in machine.locations() {
        let text = format!("{}={}\n", location.show(machine.program()), value.show(machine.program()));
        for byte in text.bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
    hash
}

/// How long a part of the measurement lasts.
#[derive(Clone, Copy)]
enum Until {
    Steps(u64),
    Time(Duration),
}

struct Stepper<'a> {
    shell: &'a Shell,
    arguments: &'a Arguments,
    program: Arc<Program>,
    path: &'a Path,
    run: Option<Run>,
    seed: u64,
    restarts: u64,
    /// Totals over all steps.
    total: Passed,
    /// The number of steps between two looks at the clock.
    chunk: u64,
}

impl<'a> Stepper<'a> {
    fn new(shell: &'a Shell, arguments: &'a Arguments, program: Arc<Program>, path: &'a Path) -> Self {
        let (run, seed, total) = (None, arguments.seed, Passed::default());
        Stepper { shell, arguments, program, path, run, seed, restarts: 0, total, chunk: 1 }
    }

    /// Makes steps for a while and returns the rate. Starting a run is not timed.
    fn part(&mut self, until: Until) -> Result<f64, Failure> {
        let mut steps = 0u64;
        let mut spent = Duration::ZERO;
        let mut fruitless = 0;
        let over = |steps: u64, spent: Duration| match until {
            Until::Steps(wanted) => steps >= wanted,
            Until::Time(window) => spent >= window,
        };
        while !over(steps, spent) && !interrupt::asked() {
            let mut run = match self.run.take() {
                Some(run) => run,
                None => self.start(),
            };
            let before = steps;
            let began = Instant::now();
            let mut now = Duration::ZERO;
            let ended = loop {
                let wanted = match until {
                    Until::Steps(wanted) => self.chunk.min(wanted - steps),
                    Until::Time(_) => self.chunk,
                };
                let passed = run.pass(wanted);
                steps += passed.steps;
                self.total += passed;
                let looked = std::mem::replace(&mut now, began.elapsed());
                if passed.steps < wanted {
                    break true;
                }
                // Read the clock about every tenth of a millisecond.
                if now - looked < Duration::from_micros(50) && wanted == self.chunk {
                    self.chunk *= 2;
                }
                if over(steps, spent + now) || interrupt::asked() {
                    break false;
                }
            };
            spent += now;
            if ended {
                self.restarts += 1;
                fruitless = if steps == before { fruitless + 1 } else { 0 };
                if fruitless > 100 {
                    let message = format!("{} cannot make a step with random inputs", self.path.display());
                    return Err(Failure::usage_with_help(message, "`groundstate run --random` shows why"));
                }
                self.run = Some(self.again(run));
            } else {
                self.run = Some(run);
            }
        }
        Ok(steps as f64 / spent.as_secs_f64().max(1e-9))
    }

    /// Random inputs and choices, different each time.
    fn inputs(&mut self) -> Inputs {
        let seed = self.seed;
        self.seed = seed.wrapping_add(1);
        Inputs::new().with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed))
    }

    /// A run from the initial state, after another has ended.
    fn again(&mut self, ended: Run) -> Run {
        let inputs = self.inputs();
        ended.again(inputs)
    }

    fn start(&mut self) -> Run {
        let inputs = self.inputs();
        let invariants = if self.arguments.invariants { Invariants::Report } else { Invariants::Ignore };
        let options = Options {
            steps: None,
            invariants,
            keep: false,
            engine: self.arguments.engine.choice(),
            ..Options::default()
        };
        Run::new(Arc::clone(&self.program), self.shell.global.limits.machine(), inputs, options)
    }
}

/// Resets the peak for the next model. Where that is impossible, the peak is that of all models so far.
fn forget_peak() {
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// The peak memory of this process since the reset; known on Linux only.
fn peak_memory_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024.0)
}

fn show(shell: &mut Shell, measured: &Measured) -> Result<(), Failure> {
    if shell.json() {
        return shell.object(measured);
    }
    let memory = measured.peak_memory_mb.map_or("?".to_string(), |peak| format!("{peak:.1}"));
    let spread = format!("{}..{}", round(measured.lowest), round(measured.highest));
    let restarts = match measured.restarts {
        0 => String::new(),
        1 => " (restarted once)".to_string(),
        many => format!(" (restarted {many} times)"),
    };
    let changed = format!("{:.0} %", measured.changed_percent);
    writeln!(
        shell.out(),
        "{:>12} {spread:>22} {changed:>7} {:>7.1} {:>7.1} {memory:>7} {:>16}  {}{restarts}",
        round(measured.steps_per_second),
        measured.updates_per_step,
        measured.load_ms,
        measured.digest,
        measured.model,
    )?;
    Ok(())
}

/// A number with three significant digits.
fn round(rate: f64) -> String {
    let digits = rate.max(1.0).log10().floor() as i32;
    let unit = 10f64.powi((digits - 2).max(0));
    format!("{}", (rate / unit).round() * unit)
}
