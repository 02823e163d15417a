//! `groundstate report MODEL`: shows a run as a page, a picture, a summary.
//!
//! The report specification says which terms make which lane; they are evaluated in every state. Without a
//! specification, the system of the chart beside the model provides one. Scenarios run besides give verdicts and
//! coverage. The page contains no date, and no paths but those given, so the same model, options and version give the
//! same bytes.

mod evidence;
mod recorded;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ::report::{Fact, Report, SummaryOptions, SvgOptions};
use clap::Args;
use groundstate::Overlay;
use groundstate::job::{self, Cancel, RunEvent, RunRequest};
use groundstate::reporting::{Prepared, Reporter, prepare_report, specification_beside};
use groundstate::simulate::{Invariants, Options, Run};
use program::Program;
use syntax::{SourceFile, Sources};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{read_text, write_text};
use crate::inputs::{self, Asks, Assembled};
use crate::interrupt;
use crate::load::load;
use crate::progress::{Progress, now_and_then};
use crate::prompt::Desk;
use crate::shell::Shell;

/// The format of a specification.
const FORMAT: &str = "\
A report specification is a YAML file that says which terms of the model make which lane. Every part may be left out.

  title: Two tasks and a buffer
  tick: 100 us                       # how long a step is; left out, steps are counted
  window: 40 ms                      # what the first view shows
  activities:                        # values of the term `activity`: words and tone
    BUSY: [elaborating, work]        # tones: idle work read write hold message other wait
  tasks:
    each:                            # names in the model, and what to tell of them
      camera: {}
      robot: { name: robot controller, caption: at each set-point }
    terms:                           # {} stands for the name; an entry above may have its own
      activity: doing({})
      period: period({})             # ticks; also deadline, may_miss, release, cycles, met, missed, skipped
  buffers:
    each:
      frames: { from: camera, to: robot }
    terms:                           # also arrays, write_index, read_index, lock, swaps
      writing: writing({})
      reading: reading({})
    counters: { written: written({}) }
  queues:                            # each, terms (length, capacity), counters
  values:                            # shared values: each, terms (unread), counters
  series:
    Age of data: { caption: at the robot, value: age, unit: ticks, bound: 500 }
  flow:                              # the way of a datum: its identity at each hop
    noun: [frame, frames]
    hops:
      - { task: camera, event: captured, value: captured }
      - { task: robot, event: used, value: used }
  charts:                            # pictures in which the present control states are lit
    System.chart: {}                 # a system: its components' phases
    Patterns.chart:
      each: [camera, robot]          # for the parameter of the machines; all tasks unless given
      machines:                      # those to be shown; all unless given
        writing: { when: writes({}) }  # at work while this is true";

/// Arguments of `report`.
#[derive(Debug, Args)]
#[command(after_long_help = FORMAT)]
pub struct Arguments {
    /// The model
    model: PathBuf,
    /// What to show. Default: MODEL.report.yaml beside the model, else what the system of MODEL.chart or the model itself says
    #[arg(long, value_name = "FILE")]
    spec: Option<PathBuf>,
    /// Write what is shown by default as a report specification, to be refined by hand, and make no run: to the file that
    /// --spec names, or MODEL.report.yaml
    #[arg(long, conflicts_with_all = ["output", "svg", "scenarios", "InputArguments"])]
    write_specification: bool,
    /// The steps to make
    #[arg(long, short = 'n', value_name = "N", default_value_t = 10_000, value_parser = crate::limits::count, allow_negative_numbers = true)]
    steps: u64,
    /// Write the page here
    #[arg(long, short = 'o', value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write a picture of the timeline here
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Steps in the picture. Default: those of the page's first view
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    svg_steps: u64,
    /// The first step in the picture
    #[arg(long, value_name = "N", default_value_t = 0)]
    svg_from: u64,
    /// Scenarios, or folders of them, to run as well; may be repeated
    #[arg(long, value_name = "PATH")]
    scenarios: Vec<PathBuf>,
    /// Instead of a run of the model, show a run of a program generated for it: its events (MCAP), or its JSON, which
    /// names them. The run is compared with the model; the page shows the first run in detail, and the figures of all;
    /// may be repeated
    #[arg(
        long = "run",
        value_name = "FILE",
        conflicts_with_all = ["spec", "steps", "svg", "svg_steps", "svg_from", "scenarios", "InputArguments"]
    )]
    runs: Vec<PathBuf>,
    /// With --run: write a file of inputs here, for `groundstate run MODEL --random --input FILE`. It draws the times of elaborations and releases that
    /// vary in the chart beside the model, as often as they were recorded
    #[arg(long, value_name = "FILE", requires = "runs")]
    write_inputs: Option<PathBuf>,
    #[command(flatten)]
    inputs: inputs::InputArguments,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    if !arguments.runs.is_empty() {
        return recorded::run(shell, arguments);
    }
    let loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    let path = arguments.spec.clone().unwrap_or_else(|| arguments.model.with_extension("report.yaml"));
    let named = arguments.spec.as_deref().filter(|_| !arguments.write_specification);
    let wanted = wanted(shell, named, &arguments.model, &loaded.program)?;
    if arguments.write_specification {
        return write_specification(shell, &path, &wanted);
    }
    let origin = wanted.name.clone();
    let mut asked = loaded.overlay();
    let Some(reporter) = prepare(shell, &mut asked, wanted, &path)? else { return Ok(Exit::World) };
    let Overlay { mut sources, program, .. } = asked;
    let Assembled { inputs, asks, draws, .. } =
        match inputs::assemble(shell, &arguments.inputs, Asks::Terminal, &mut sources, &program)? {
            Ok(assembled) => assembled,
            Err(faults) => {
                shell.diagnostics(&sources, &faults)?;
                return Ok(Exit::World);
            }
        };
    let options =
        Options { steps: Some(arguments.steps), invariants: Invariants::Report, keep: false, ..Options::default() };
    interrupt::listen();
    let request = RunRequest {
        program: Arc::clone(&program),
        limits: shell.global.limits.machine(),
        options,
        inputs,
        asks_inputs: asks,
        asks_choices: false,
        paused: false,
        states: false,
        frozen: false,
        due: now_and_then(),
    };
    let started = job::report(request, reporter, sources.clone(), Cancel::from(interrupt::request().clone()));
    let (job, remote) = started.map_err(|error| Failure::usage(format!("the run cannot be started: {error}")))?;
    let mut progress = Progress::new(Some(arguments.steps), shell.global.quiet);
    let mut desk = Desk::new(&program, &remote, None);
    while let Some(event) = job.next_event() {
        match event {
            RunEvent::Record { steps, .. } | RunEvent::Progress(steps) => progress.at(steps),
            other => desk.hear(other),
        }
    }
    let reporter = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    progress.done();
    let exit = match (reporter.was_interrupted(), reporter.is_at_fault()) {
        (true, _) => Exit::Unknown,
        (false, true) => Exit::Model,
        (false, false) => Exit::Good,
    };
    let mut report = reporter.finish();
    report.facts = facts(arguments, draws, &origin, &sources);
    let scenarios = evidence::add(shell, &mut report, &arguments.model, &arguments.scenarios, arguments.inputs.seed)?;
    write(shell, arguments, &report)?;
    let troubled = if report.troubles().is_empty() { Exit::Good } else { Exit::Model };
    Ok(exit.max(scenarios).max(troubled))
}

/// The page of a given run, as the specification beside the model says; `None` if there is no specification.
pub fn page_of(shell: &mut Shell, mut asked: Overlay, model: &Path, run: RunOf<'_>) -> Result<Option<String>, Failure> {
    let path = model.with_extension("report.yaml");
    let wanted = wanted(shell, None, model, &asked.program)?;
    let Some(mut reporter) = prepare(shell, &mut asked, wanted, &path)? else { return Ok(None) };
    let Overlay { sources, program, .. } = asked;
    let mut run = run(&program);
    while let Some(record) = run.advance() {
        reporter.note(&record, &mut run, &sources);
    }
    let mut report = reporter.finish();
    let fact = |label: &str, value: String| Fact { label: label.to_string(), value };
    report.facts = vec![
        fact("Model", model.display().to_string()),
        fact("Run", "a counterexample of `groundstate verify`".to_string()),
        fact("Fingerprint of all texts", groundstate::fingerprint(&sources)),
        fact("Groundstate", env!("CARGO_PKG_VERSION").to_string()),
    ];
    Ok(Some(::report::render_html(&report)))
}

/// Makes a run of a program.
pub type RunOf<'a> = &'a dyn Fn(&Arc<Program>) -> Run;

/// The text of the specification: from the file that was named, or what stands beside the model, or what the model itself says.
fn wanted(
    shell: &mut Shell,
    named: Option<&Path>,
    model: &Path,
    program: &Arc<Program>,
) -> Result<SourceFile, Failure> {
    if let Some(path) = named {
        return match read_text(path, shell.global.limits.max_file_size) {
            Ok(text) => Ok(SourceFile::new(path.display().to_string(), text)),
            Err(Failure::Missing(_)) => Err(nothing_wanted(path)),
            Err(failure) => Err(failure),
        };
    }
    let beside = specification_beside(&model.display().to_string(), program, &mut shell.disk());
    beside.map_err(|(path, absent)| Failure::usage(absent.told(&path)))
}

fn nothing_wanted(path: &Path) -> Failure {
    let message = format!("there is no file {}, so nothing says what to show of the model", path.display());
    let help = "leave --spec out: then the chart beside the model, or the model itself, says what to show";
    Failure::usage_with_help(message, help.to_string())
}

/// Reads the specification and checks its terms. If it has faults, shows them and returns `None`.
fn prepare(
    shell: &mut Shell,
    asked: &mut Overlay,
    source: SourceFile,
    path: &Path,
) -> Result<Option<Reporter>, Failure> {
    let prepared = prepare_report(asked, source, &path.display().to_string(), &mut shell.disk(), &draw::Page);
    let Prepared { reporter, faults } = prepared.map_err(|fault| Failure::usage(fault.to_string()))?;
    shell.diagnostics(&asked.sources, &faults)?;
    Ok(reporter)
}

fn facts(arguments: &Arguments, draws: bool, spec: &str, sources: &Sources) -> Vec<Fact> {
    let fact = |label: &str, value: String| Fact { label: label.to_string(), value };
    let inputs = &arguments.inputs;
    let mut facts = vec![
        fact("Model", arguments.model.display().to_string()),
        fact("Report specification", spec.to_string()),
        fact("Fingerprint of all texts", groundstate::fingerprint(sources)),
        fact("Steps asked for", arguments.steps.to_string()),
        fact(
            "Choices",
            if inputs.choose == inputs::Chosen::Random { "random" } else { "the first candidate" }.to_string(),
        ),
    ];
    if draws {
        facts.push(fact("Seed", inputs.seed.to_string()));
    }
    facts.push(fact("Groundstate", env!("CARGO_PKG_VERSION").to_string()));
    facts
}

/// Writes the specification into a file that is not there yet.
fn write_specification(shell: &mut Shell, path: &Path, wanted: &SourceFile) -> Result<Exit, Failure> {
    if path.exists() {
        let message = format!("{} is there already, and stays as it is", path.display());
        return Err(Failure::usage_with_help(message, "name another file with --spec FILE".to_string()));
    }
    write_beside(path, &wanted.text)?;
    if shell.talks() {
        writeln!(shell.out(), "written: {}", path.display())?;
    }
    Ok(Exit::Good)
}

fn write(shell: &mut Shell, arguments: &Arguments, report: &Report) -> Result<(), Failure> {
    let mut written = Vec::new();
    if let Some(path) = &arguments.output {
        write_beside(path, &::report::render_html(report))?;
        written.push(path);
    }
    if let Some(path) = &arguments.svg {
        let options = SvgOptions { start: arguments.svg_from, ticks: arguments.svg_steps, ..SvgOptions::default() };
        write_beside(path, &::report::render_svg(report, &options))?;
        written.push(path);
    }
    if shell.json() {
        let written: Vec<String> = written.iter().map(|path| path.display().to_string()).collect();
        return shell.object(&wire::ReportMade::new(report, written));
    }
    if shell.talks() {
        let options = SummaryOptions { colour: shell.color_out(), ..SummaryOptions::default() };
        write!(shell.out(), "{}", ::report::summarise(report, &options))?;
        for path in written {
            writeln!(shell.out(), "written: {}", path.display())?;
        }
    }
    Ok(())
}

/// Writes a file, and creates its folder.
fn write_beside(path: &Path, text: &str) -> Result<(), Failure> {
    if let Some(folder) = path.parent().filter(|folder| *folder != Path::new("")) {
        std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    }
    write_text(path, text)
}
