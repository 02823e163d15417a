//! The options for inputs, choices and time, and the sources made from them.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use groundstate::inputs::{self, Form};
use groundstate::simulate::{Bounds, Choices, Clock, Inputs, Named, Positional, RandomSource, StepClock};
use machine::TimeUnit;
use program::Program;
use syntax::{Diagnostic, SourceFile, Sources};

use crate::failure::Failure;
use crate::files::read_text;
use crate::shell::Shell;

/// Where inputs come from. The first source that has a value gives it, in this order: `--set`, `--input`, `--env`, then
/// `--random` or the terminal.
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
    /// Values in the order in which they are asked for, one per line
    #[arg(long, value_name = "FILE")]
    pub env: Option<PathBuf>,
    /// A value that holds in every step, such as passed=true or f(1)=RED
    #[arg(long, value_name = "LOCATION=VALUE")]
    pub set: Vec<String>,
    /// How often random values come, such as stop=true:1,false:99; values not listed never come
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
    /// A random one, from the seed
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

/// Bounds of random values from infinite domains.
#[derive(Debug, Args)]
pub struct Random {
    /// Bounds of random Integers and Naturals
    #[arg(long, value_name = "LOW..HIGH", default_value = "-10..10", allow_hyphen_values = true, value_parser = inputs::integers)]
    integers: (i64, i64),
    /// Bounds of random Reals, which have two decimals
    #[arg(long, value_name = "LOW..HIGH", default_value = "-10..10", allow_hyphen_values = true, value_parser = inputs::reals)]
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

/// How model time passes.
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
        inputs::step_ns(text).map(Ticking::Steps)
    }
}

/// The real clock, since 1970.
struct SystemClock;

impl Clock for SystemClock {
    fn now(&mut self, unit: TimeUnit) -> Result<i64, String> {
        let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
        let since = since.map_err(|_| "the system's clock is before 1970".to_string())?;
        let now = match unit {
            TimeUnit::Nanoseconds => since.as_nanos(),
            TimeUnit::Milliseconds => since.as_millis(),
            TimeUnit::Seconds => u128::from(since.as_secs()),
        };
        i64::try_from(now).map_err(|_| "the system's clock is beyond 64 bits".to_string())
    }
}

/// The result of the options.
pub struct Assembled {
    /// Adds the sources.
    pub inputs: Sourcing,
    /// Draws the inputs that no source has and that are asked for, if the prompt leaves them to chance; none: they are not asked for.
    pub asks: Option<RandomSource>,
    /// Whether the model has inputs that may be asked for.
    pub interactive: bool,
    /// Whether the seed decides something.
    pub draws: bool,
}

/// Adds sources to the present ones.
pub type Sourcing = Box<dyn FnOnce(Inputs) -> Inputs + Send>;

/// Whom the inputs are asked of that no source has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asks {
    /// The terminal, if there is one.
    Terminal,
    /// Whoever writes to the standard input.
    Anyone,
}

/// Makes the sources. Faults in input files are returned as diagnostics over `sources`, to which the files are added.
pub fn assemble(
    shell: &Shell,
    arguments: &InputArguments,
    asks: Asks,
    sources: &mut Sources,
    program: &Program,
) -> Result<Result<Assembled, Vec<Diagnostic>>, Failure> {
    let mut layers: Vec<Sourcing> = Vec::new();
    let mut draws = arguments.random || arguments.choose == Chosen::Random;
    let constants = inputs::constants(program, &arguments.set);
    let constants = constants.map_err(|refused| Failure::usage(format!("--set {refused}")))?;
    layers.push(Box::new(|inputs| inputs.with(constants)));
    if let Some(path) = &arguments.input {
        match named(shell, path, sources, program)? {
            Ok(named) => {
                draws |= named.draws();
                let named = named.seeded(arguments.seed);
                layers.push(Box::new(|inputs| inputs.with(named)));
            }
            Err(faults) => return Ok(Err(faults)),
        }
    }
    if let Some(path) = &arguments.env {
        let text = read_text(path, shell.global.limits.max_file_size)?;
        let positional = Positional::new(&path.display().to_string(), &text);
        layers.push(Box::new(|inputs| inputs.with(positional)));
    }
    let (mut asked, mut interactive) = (None, false);
    let random = || RandomSource::new(arguments.seed, arguments.bounds.bounds());
    if arguments.random {
        let weighted = inputs::weighted(program, arguments.seed, &arguments.weight);
        let weighted = weighted.map_err(|refused| Failure::usage(format!("--weight {refused}")))?;
        let random = random();
        layers.push(Box::new(|inputs| inputs.with(weighted).with(random)));
    } else if asks == Asks::Anyone || std::io::stdin().is_terminal() {
        (asked, interactive) = (Some(random()), !inputs::asked(program).is_empty());
    } else if arguments.input.is_none()
        && arguments.env.is_none()
        && arguments.set.is_empty()
        && let Some(lack) = inputs::without_source(program)
    {
        return Err(Failure::usage_with_help(format!("{lack}, and there is no terminal to ask at"), HELP));
    }
    let (choose, seed, clock) = (arguments.choose, arguments.seed, arguments.clock);
    layers.push(Box::new(move |inputs| inputs.choosing(choose.choices(seed))));
    layers.push(Box::new(move |inputs| match clock {
        Ticking::Steps(step_ns) => inputs.timed_by(StepClock::new(step_ns)),
        Ticking::System => inputs.timed_by(SystemClock),
    }));
    let inputs: Sourcing = Box::new(|inputs| layers.into_iter().fold(inputs, |inputs, layer| layer(inputs)));
    Ok(Ok(Assembled { inputs, asks: asked, interactive, draws }))
}

/// What to do if inputs are missing.
pub const HELP: &str =
    "pass --random for random values, --input FILE or --env FILE to read them, or --set LOCATION=VALUE for a fixed one";

fn named(
    shell: &Shell,
    path: &Path,
    sources: &mut Sources,
    program: &Program,
) -> Result<Result<Named, Vec<Diagnostic>>, Failure> {
    let text = read_text(path, shell.global.limits.max_file_size)?;
    let file = sources.add(SourceFile::new(path.display().to_string(), text.as_str()));
    let Some(form) = Form::of(path) else {
        return Err(Failure::usage_with_help(
            format!("{} is neither .yaml nor .csv", path.display()),
            "--input takes values by step and location; --env takes the values alone, one a line",
        ));
    };
    Ok(inputs::named(program, form, file, &text))
}
