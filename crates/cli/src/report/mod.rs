//! `groundstate report MODEL`: a run, shown: a page, a picture, a summary.
//!
//! The report specification says which terms make which lane; they are evaluated in every state. Where there is none the
//! system of the chart beside the model says it. Scenarios run
//! beside it give verdicts and coverage. The page holds no date and no path of this machine but those given, so the
//! same model, options and version give the same bytes.

mod charts;
mod derived;
mod evidence;
mod recorded;
mod specification;
mod watch;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ::report::{Fact, Invariant, Report, ReportBuilder, SummaryOptions, SvgOptions};
use clap::Args;
use groundstate::Overlay;
use groundstate::simulate::{End, Invariants, Options, Record, Run, Violation};
use program::{Program, PropertyKind};
use syntax::{Diagnostic, SourceFile, Sources, Span};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{Disk, read_text, write_text};
use crate::inputs::{self, Assembled};
use crate::interrupt;
use crate::load::load;
use crate::progress::Progress;
use crate::shell::Shell;
use specification::{Specification, specification};
use watch::Watch;

/// The id of what is wrong with a specification.
const ID: &str = "bad-report-specification";

fn fault(span: Span, message: impl Into<String>) -> Diagnostic {
    Diagnostic::error(ID, span, message)
}

/// What a specification looks like.
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
      period: period({})             # ticks; also release, cycles, met, missed, skipped
  buffers:
    each:
      frames: { from: camera, to: robot }
    terms:                           # also arrays, write_index, read_index, lock, swaps
      writing: writing({})
      reading: reading({})
    counters: { written: written({}) }
  queues:                            # each, terms (length, capacity), counters
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
    /// What to show of it. Default: MODEL.report.yaml beside the model; where there is none, the system of MODEL.chart
    #[arg(long, value_name = "FILE")]
    spec: Option<PathBuf>,
    /// The steps to make
    #[arg(long, short = 'n', value_name = "N", default_value_t = 10_000, value_parser = crate::limits::count, allow_negative_numbers = true)]
    steps: u64,
    /// Write the page here
    #[arg(long, short = 'o', value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write a picture of the timeline here
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Steps that the picture shows; those of the page's first view unless given
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    svg_steps: u64,
    /// The first step that the picture shows
    #[arg(long, value_name = "N", default_value_t = 0)]
    svg_from: u64,
    /// Scenarios, or folders of them, to run beside it; may be given several times
    #[arg(long, value_name = "PATH")]
    scenarios: Vec<PathBuf>,
    /// A run of a program that was made for the model, instead of a run of the model: its events (MCAP), or its JSON,
    /// which names them. It is held to the model; the page shows the first run in detail, and the figures of all; may be
    /// given several times
    #[arg(
        long = "run",
        value_name = "FILE",
        conflicts_with_all = ["spec", "steps", "svg", "svg_steps", "svg_from", "scenarios", "InputArguments"]
    )]
    runs: Vec<PathBuf>,
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
    let wanted = match wanted(shell, &path, arguments.spec.is_some())? {
        Some(wanted) => wanted,
        None => return Err(nothing_wanted(&path, false)),
    };
    let origin = wanted.name.clone();
    let mut asked = loaded.overlay();
    let Some((mut builder, mut watch)) = prepare(shell, &mut asked, wanted, &path)? else { return Ok(Exit::World) };
    let Overlay { mut sources, program, .. } = asked;
    let Assembled { inputs, .. } = match inputs::assemble(shell, &arguments.inputs, &mut sources, &program)? {
        Ok(assembled) => assembled,
        Err(faults) => {
            shell.diagnostics(&sources, &faults)?;
            return Ok(Exit::World);
        }
    };
    let options =
        Options { steps: Some(arguments.steps), invariants: Invariants::Report, keep: false, ..Options::default() };
    let mut run = Run::new(Arc::clone(&program), shell.global.limits.machine(), inputs, options);
    interrupt::listen();
    let mut story = Story { invariants: invariants(&program, &sources), stopped: None, exit: Exit::Good };
    let mut progress = Progress::new(Some(arguments.steps), shell.global.quiet);
    while let Some(record) = run.advance() {
        story.note(&record, &run, &program, &sources);
        look(&record, &mut run, &mut watch, &mut builder);
        progress.at(run.steps());
        if interrupt::asked() {
            run.stop(End::Interrupted);
        }
    }
    progress.done();
    let mut report = builder.finish(&program.name);
    report.invariants = story.invariants;
    report.stopped = story.stopped;
    report.facts = facts(arguments, &origin, &sources);
    let scenarios = evidence::add(shell, &mut report, &arguments.model, &arguments.scenarios, arguments.inputs.seed)?;
    write(shell, arguments, &report)?;
    let troubled = if report.troubles().is_empty() { Exit::Good } else { Exit::Model };
    Ok(story.exit.max(scenarios).max(troubled))
}

/// The page of a run that is told beside, as the specification beside the model says; none where there is none.
pub fn page_of(shell: &mut Shell, mut asked: Overlay, model: &Path, run: RunOf<'_>) -> Result<Option<String>, Failure> {
    let path = model.with_extension("report.yaml");
    let Some(wanted) = wanted(shell, &path, false)? else { return Ok(None) };
    let Some((mut builder, mut watch)) = prepare(shell, &mut asked, wanted, &path)? else { return Ok(None) };
    let Overlay { sources, program, .. } = asked;
    let mut run = run(&program);
    let mut story = Story { invariants: invariants(&program, &sources), stopped: None, exit: Exit::Good };
    while let Some(record) = run.advance() {
        story.note(&record, &run, &program, &sources);
        look(&record, &mut run, &mut watch, &mut builder);
    }
    let mut report = builder.finish(&program.name);
    report.invariants = story.invariants;
    report.stopped = story.stopped;
    let fact = |label: &str, value: String| Fact { label: label.to_string(), value };
    report.facts = vec![
        fact("Model", model.display().to_string()),
        fact("Run", "a counterexample of `groundstate verify`".to_string()),
        fact("Fingerprint of all texts", groundstate::fingerprint(&sources)),
        fact("Groundstate", env!("CARGO_PKG_VERSION").to_string()),
    ];
    Ok(Some(::report::render_html(&report)))
}

/// Shows a record of a run.
fn look(record: &Record, run: &mut Run, watch: &mut Watch, builder: &mut ReportBuilder) {
    match record {
        Record::Initial { .. } => {
            watch.look(run.machine_mut(), builder);
            builder.begin();
        }
        Record::Step(_) => {
            watch.look(run.machine_mut(), builder);
            builder.step();
        }
        _ => {}
    }
}

/// Makes a run of a program.
pub type RunOf<'a> = &'a dyn Fn(&Arc<Program>) -> Run;

/// The text of the specification: of the file, or, where the file is not there and nobody named it, of the system of the
/// chart beside the model; none where there is neither.
fn wanted(shell: &mut Shell, path: &Path, given: bool) -> Result<Option<SourceFile>, Failure> {
    match read_text(path, shell.global.limits.max_file_size) {
        Ok(text) => Ok(Some(SourceFile::new(path.display().to_string(), text))),
        Err(Failure::Missing(_)) if given => Err(nothing_wanted(path, true)),
        Err(Failure::Missing(_)) => {
            let chart = derived::chart_beside(path);
            let text = derived::text(shell, &chart)?;
            Ok(text.map(|text| SourceFile::new(format!("<what {} says>", chart.display()), text)))
        }
        Err(failure) => Err(failure),
    }
}

fn nothing_wanted(path: &Path, given: bool) -> Failure {
    let message = format!("there is no file {}, so nothing says what to show of the model", path.display());
    let mut help = "name a report specification with --spec FILE".to_string();
    if !given {
        let chart = derived::chart_beside(path);
        help += &format!(", or build the model from a chart with a system ({})", chart.display());
    }
    Failure::usage_with_help(message, help)
}

/// The specification read, its terms checked; none where it has faults, which are then shown.
fn prepare(
    shell: &mut Shell,
    asked: &mut Overlay,
    source: SourceFile,
    path: &Path,
) -> Result<Option<(ReportBuilder, Watch)>, Failure> {
    let Checked { ready, faults } = checked(&mut shell.disk(), asked, source, path)?;
    shell.diagnostics(&asked.sources, &faults)?;
    Ok(ready)
}

/// What reading a specification came to; without faults it is ready, with warnings alone too.
pub struct Checked {
    ready: Option<(ReportBuilder, Watch)>,
    pub faults: Vec<Diagnostic>,
}

/// Reads a specification and checks it against its model. What it names lies relative to `path`.
pub fn checked(disk: &mut Disk, asked: &mut Overlay, source: SourceFile, path: &Path) -> Result<Checked, Failure> {
    let text = source.text.clone();
    let file = asked.add(source);
    let mut wanted = match specification(file, &text) {
        Ok(wanted) => wanted,
        Err(faults) => return Ok(Checked { ready: None, faults }),
    };
    let mut faults = charts::add(disk, &mut asked.sources, &mut wanted, path)?;
    if groundstate::has_errors(&faults) {
        return Ok(Checked { ready: None, faults });
    }
    let Specification { spec, places, .. } = wanted;
    let builder = ReportBuilder::new(spec);
    match Watch::new(asked, builder.terms(), &places) {
        Ok(watch) => Ok(Checked { ready: Some((builder, watch)), faults }),
        Err(found) => {
            faults.extend(found);
            Ok(Checked { ready: None, faults })
        }
    }
}

fn invariants(program: &Program, sources: &Sources) -> Vec<Invariant> {
    let invariants = program.properties.iter().filter(|property| property.kind == PropertyKind::Invariant);
    let invariant = |name: &str, position: String| Invariant { name: name.to_string(), position, violated: None };
    invariants.map(|property| invariant(&property.name, sources.position(property.span).to_string())).collect()
}

/// What is noted of the run beside its lanes.
struct Story {
    invariants: Vec<Invariant>,
    stopped: Option<String>,
    exit: Exit,
}

impl Story {
    fn note(&mut self, record: &Record, run: &Run, program: &Program, sources: &Sources) {
        match record {
            Record::Initial { violations, .. } => self.violated(violations, "in the initial state", sources),
            Record::Step(step) | Record::Attempt(step) => {
                self.violated(&step.violations, &format!("first in step {}", step.step), sources);
            }
            Record::End(End::Fault(fault)) => {
                let found = groundstate::diagnose_fault(fault, program);
                let place = sources.position(found.primary.span);
                self.stopped = Some(format!("step {} could not be made: {} ({place})", run.steps() + 1, found.message));
                self.exit = self.exit.max(Exit::Model);
            }
            Record::End(End::Interrupted) => {
                self.stopped = Some(format!("the run was interrupted after step {}", run.steps()));
                self.exit = self.exit.max(Exit::Unknown);
            }
            Record::Back { .. } | Record::End(_) => {}
        }
    }

    fn violated(&mut self, violations: &[Violation], when: &str, sources: &Sources) {
        for violation in violations {
            let position = sources.position(violation.span).to_string();
            let known = self.invariants.iter_mut().find(|known| known.position == position);
            if let Some(invariant) = known.filter(|known| known.violated.is_none()) {
                invariant.violated = Some(when.to_string());
            }
            self.exit = self.exit.max(Exit::Model);
        }
    }
}

fn facts(arguments: &Arguments, spec: &str, sources: &Sources) -> Vec<Fact> {
    let fact = |label: &str, value: String| Fact { label: label.to_string(), value };
    let inputs = &arguments.inputs;
    let random = inputs.random || inputs.choose == inputs::Chosen::Random;
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
    if random {
        facts.push(fact("Seed", inputs.seed.to_string()));
    }
    facts.push(fact("Groundstate", env!("CARGO_PKG_VERSION").to_string()));
    facts
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
        let object = serde_json::json!({
            "type": "report", "model": report.model, "steps": report.ticks, "troubles": report.troubles(), "files": written,
        });
        return shell.object(&object);
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

/// Writes a file, and makes the folder it is to be in.
fn write_beside(path: &Path, text: &str) -> Result<(), Failure> {
    if let Some(folder) = path.parent().filter(|folder| *folder != Path::new("")) {
        std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    }
    write_text(path, text)
}
