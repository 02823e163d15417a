//! The options that say where inputs, choices and time come from, and what is made of them.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};
use groundstate::simulate::{
    Bounds, Choices, Clock, Constants, Inputs, Named, Positional, RandomSource, StepClock, Weighted,
};
use machine::TimeUnit;
use program::{FunctionKind, Program, Term};
use syntax::{Diagnostic, SourceFile, Sources};

use super::{prompt, table, yaml};
use crate::failure::Failure;
use crate::files::read_text;
use crate::shell::Shell;

/// Where inputs come from. Of several sources the first that has a value gives it, in this order: `--set`,
/// `--input`, `--env`, then `--random` or the terminal.
#[derive(Debug, Args)]
#[command(next_help_heading = "Inputs")]
pub struct InputArguments {
    /// Draw inputs at random from their domains
    #[arg(long)]
    pub random: bool,
    /// Seed of random inputs and choices
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Values by step and location: a .yaml or .csv file
    #[arg(long, value_name = "FILE")]
    pub input: Option<PathBuf>,
    /// Values in the order asked for, one a line
    #[arg(long, value_name = "FILE")]
    pub env: Option<PathBuf>,
    /// A value that holds in every step, such as passed=true or f(1)=RED
    #[arg(long, value_name = "LOCATION=VALUE")]
    pub set: Vec<String>,
    /// How often random values come, such as stop=true:1,false:99; values not named never do
    #[arg(long, value_name = "LOCATION=VALUE:N,…", requires = "random")]
    pub weight: Vec<String>,
    /// Which candidate a choose rule takes
    #[arg(long, value_enum, default_value_t = Chosen::First, value_name = "HOW")]
    pub choose: Chosen,
    #[command(flatten)]
    bounds: Random,
    /// Model time that passes in a step, such as 10ms; `system` for the real clock
    #[arg(long, value_name = "TIME", default_value = "1s")]
    clock: Ticking,
}

/// How choices are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Chosen {
    /// The first candidate
    First,
    /// Any, by the seed
    Random,
}

impl Chosen {
    /// The policy.
    pub fn choices(self, seed: u64) -> Choices {
        match self {
            Chosen::First => Choices::First,
            Chosen::Random => Choices::random(seed),
        }
    }
}

/// What infinite domains are cut to.
#[derive(Debug, Args)]
pub struct Random {
    /// Bounds of random Integers and Naturals
    #[arg(long, value_name = "LOW..HIGH", default_value = "-10..10", allow_hyphen_values = true, value_parser = integers)]
    integers: (i64, i64),
    /// Bounds of random Reals, which have two decimals
    #[arg(long, value_name = "LOW..HIGH", default_value = "-10..10", allow_hyphen_values = true, value_parser = reals)]
    reals: (f64, f64),
    /// Random Strings, separated by commas
    #[arg(long, value_name = "TEXTS", value_delimiter = ',')]
    strings: Vec<String>,
    /// Greatest length of random sequences, bags, sets and maps
    #[arg(long, value_name = "N", default_value_t = 3)]
    length: u64,
}

impl Random {
    /// The bounds as data.
    pub fn bounds(&self) -> Bounds {
        let default = Bounds::default();
        Bounds {
            integers: self.integers,
            reals: self.reals,
            strings: if self.strings.is_empty() { default.strings } else { self.strings.clone() },
            chars: default.chars,
            size: self.length,
        }
    }
}

fn range<T: std::str::FromStr + PartialOrd + Copy>(text: &str) -> Option<(T, T)> {
    let (low, high) = text.split_once("..")?;
    let (low, high) = (low.trim().parse().ok()?, high.trim().parse().ok()?);
    (low <= high).then_some((low, high))
}

fn integers(text: &str) -> Result<(i64, i64), String> {
    range(text).ok_or_else(|| "write the lowest and the highest whole number, such as -10..10".to_string())
}

fn reals(text: &str) -> Result<(f64, f64), String> {
    let finite = |(low, high): &(f64, f64)| low.abs() < 1e15 && high.abs() < 1e15;
    range(text).filter(finite).ok_or_else(|| "write the lowest and the highest number, such as -1.5..1.5".to_string())
}

/// How time passes.
#[derive(Debug, Clone, Copy)]
enum Ticking {
    Steps(u64),
    System,
}

impl std::str::FromStr for Ticking {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "system" {
            return Ok(Ticking::System);
        }
        let digits = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
        let (number, unit) = text.split_at(digits);
        let unit_ns: u64 = match unit {
            "ns" => 1,
            "us" => 1_000,
            "ms" => 1_000_000,
            "s" => 1_000_000_000,
            _ => return Err("write a time such as 100us, 10ms or 1s, or `system`".to_string()),
        };
        let number: u64 = number.parse().map_err(|_| "the time starts with a whole number".to_string())?;
        number.checked_mul(unit_ns).map(Ticking::Steps).ok_or_else(|| "the time is too long".to_string())
    }
}

/// The real clock, since 1970.
struct SystemClock;

impl Clock for SystemClock {
    fn now(&mut self, unit: TimeUnit) -> Result<i64, String> {
        let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
        let since = since.map_err(|_| "the system's clock stands before 1970".to_string())?;
        let now = match unit {
            TimeUnit::Nanoseconds => since.as_nanos(),
            TimeUnit::Milliseconds => since.as_millis(),
            TimeUnit::Seconds => u128::from(since.as_secs()),
        };
        i64::try_from(now).map_err(|_| "the system's clock is beyond 64 bits".to_string())
    }
}

/// What the options come to.
pub struct Assembled {
    /// The sources.
    pub inputs: Inputs,
    /// Somebody at a terminal is asked, so steps can be taken back.
    pub interactive: bool,
    /// What who is asked can look at.
    pub told: prompt::Told,
}

/// Makes the sources. Faults in input files are given as diagnostics over `sources`, which takes in their texts.
pub fn assemble(
    shell: &Shell,
    arguments: &InputArguments,
    sources: &mut Sources,
    program: &Program,
) -> Result<Result<Assembled, Vec<Diagnostic>>, Failure> {
    let mut inputs = Inputs::new();
    inputs = inputs.with(constants(program, &arguments.set)?);
    if let Some(path) = &arguments.input {
        match named(shell, path, sources, program)? {
            Ok(named) => inputs = inputs.with(named),
            Err(faults) => return Ok(Err(faults)),
        }
    }
    if let Some(path) = &arguments.env {
        let text = read_text(path, shell.global.limits.max_file_size)?;
        inputs = inputs.with(Positional::new(&path.display().to_string(), &text));
    }
    let mut interactive = false;
    let told = prompt::Told::default();
    if arguments.random {
        let mut weighted = Weighted::new(arguments.seed);
        for text in &arguments.weight {
            weighted.add(program, text).map_err(|message| Failure::usage(format!("--weight {text}: {message}")))?;
        }
        inputs = inputs.with(weighted);
        inputs = inputs.with(RandomSource::new(arguments.seed, arguments.bounds.bounds()));
    } else if std::io::stdin().is_terminal() {
        interactive = !asked(program).is_empty();
        inputs = inputs.with(prompt::Prompt::new(Arc::clone(&told)));
    } else if arguments.input.is_none() && arguments.env.is_none() && arguments.set.is_empty() {
        refuse_without_source(program)?;
    }
    inputs = inputs.choosing(arguments.choose.choices(arguments.seed));
    inputs = match arguments.clock {
        Ticking::Steps(step_ns) => inputs.timed_by(StepClock::new(step_ns)),
        Ticking::System => inputs.timed_by(SystemClock),
    };
    Ok(Ok(Assembled { inputs, interactive, told }))
}

/// What to pass when inputs are missing.
pub const HELP: &str =
    "pass --random for random ones, --input FILE or --env FILE to read them, or --set LOCATION=VALUE for a fixed one";

fn refuse_without_source(program: &Program) -> Result<(), Failure> {
    let asked = asked(program);
    let (Some(first), more) = (asked.first(), asked.len().saturating_sub(1)) else { return Ok(()) };
    let names = match more {
        0 => first.clone(),
        1 | 2 => asked.join(", "),
        _ => format!("{}, {} and {} more", asked[0], asked[1], asked.len() - 2),
    };
    Err(Failure::usage_with_help(
        format!("the model takes inputs ({names}), but nothing says where from, and there is no terminal to ask at"),
        HELP,
    ))
}

/// The monitored functions that the program reads.
fn asked(program: &Program) -> Vec<String> {
    let mut read = vec![false; program.functions.len()];
    for term in &program.terms {
        if let Term::Read { function, .. } = term {
            read[function.0 as usize] = true;
        }
    }
    let functions = program.functions.iter().zip(read);
    functions
        .filter(|(function, read)| *read && function.kind == FunctionKind::Monitored && !function.library)
        .map(|(function, _)| function.name.clone())
        .collect()
}

/// The `--set` options.
pub fn constants(program: &Program, texts: &[String]) -> Result<Constants, Failure> {
    let mut constants = Constants::default();
    for text in texts {
        constants.set(program, text).map_err(|message| Failure::usage(format!("--set {text}: {message}")))?;
    }
    Ok(constants)
}

fn named(
    shell: &Shell,
    path: &Path,
    sources: &mut Sources,
    program: &Program,
) -> Result<Result<Named, Vec<Diagnostic>>, Failure> {
    let text = read_text(path, shell.global.limits.max_file_size)?;
    let file = sources.add(SourceFile::new(path.display().to_string(), text.as_str()));
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let read = match extension {
        "yaml" | "yml" => yaml::read(file, &text),
        "csv" => table::read(file, &text),
        _ => {
            return Err(Failure::usage_with_help(
                format!("{} is neither .yaml nor .csv", path.display()),
                "--input takes values by step and location; --env takes the values alone, one a line",
            ));
        }
    };
    let given = match read {
        Ok(given) => given,
        Err(fault) => return Ok(Err(vec![*fault])),
    };
    Ok(Named::new(program, &given).map_err(|problems| {
        let diagnostic = |problem: groundstate::simulate::Problem| {
            let id = if problem.value { "bad-input-value" } else { "unknown-input" };
            Diagnostic::error(id, problem.span, problem.message)
        };
        problems.into_iter().map(diagnostic).collect()
    }))
}
