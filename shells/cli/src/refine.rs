//! `groundstate refine ABSTRACT CONCRETE`: proves or refutes that every run of the concrete model corresponds to a run of the abstract
//! one.
//!
//! Exit codes: 0 it refines, 1 it does not, or the question says nothing, 2 the coupling cannot be used, 3 not known.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use ::report::{Fact, LivePart, RefinementCheck, render_refinement, render_refinement_part};
use chart::Pictures;
use clap::{Args, ValueEnum};
use groundstate::inputs::bound;
use groundstate::job::{self, About, Ask, Cancel, How, RefineEvent};
use groundstate::refine::{
    ABSTRACT, CONCRETE, Coupling, Extent, Options, Report, SIDES, Trouble, Verdict, bad_coupling, read,
};
use groundstate::reporting::{NoPage, refinement_page};
use groundstate::tell::{Refinements, Standing, no_start, trace_of};
use groundstate::verify::{Outcome, Progress, Subject};
use groundstate::{Assumptions, Loaded, assume, refine, terms_of, verify_preserved};
use machine::Limits;
use syntax::{FileId, SourceFile, Sources};

use crate::checkpoint::Checkpoint;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{read_source, relative, write_text};
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;
use crate::solver::Process;
use crate::verify::beside::path_of;
use crate::verify::watch::Watch;

/// The time limit for each question to a solver, in seconds, where none is given for the whole.
const SECONDS: u32 = 60;
/// The most steps of runs that are looked at, where no limit is given; and where a proof by induction fails.
const DEPTH: u64 = 12;
const SHORT: u64 = 6;

/// Arguments of `refine`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The abstract and the concrete model; or one coupling file that names both
    #[arg(num_args = 1..=2, required = true, value_name = "MODEL")]
    models: Vec<PathBuf>,
    /// How they correspond (NAME.refine). Default: functions of equal names and domains are equal after every step
    #[arg(long, value_name = "FILE")]
    with: Option<PathBuf>,
    /// The values to try for an input of either model, as NAME=LOW..HIGH or NAME=VALUE,VALUE; may be repeated
    #[arg(long = "bound", value_name = "BOUND")]
    bounds: Vec<String>,
    /// An assumption about one of the machines, as INVAR: skip states in which it is false, or steps if it reads inputs. Names may
    /// begin with `abstract.` or `concrete.`. Default: those of MODEL.verify.yaml beside the model; may be repeated
    #[arg(long = "assume", value_name = "TERM")]
    assumptions: Vec<String>,
    /// The most pairs of states
    #[arg(long, value_name = "N", value_parser = crate::limits::count)]
    max_states: Option<u64>,
    /// The number of threads that make steps. Default: the number of processors
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=256))]
    workers: Option<u64>,
    /// The most memory that the program may take, in MiB
    #[arg(long, value_name = "MIB", default_value_t = 8192)]
    max_memory: u64,
    /// The most time, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = crate::limits::count)]
    time: Option<u64>,
    /// Save the search in this file from time to time, and when a limit or Ctrl-C ends it; continue from the file if it exists
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// Verify of the abstract model the properties that come along to the concrete one
    #[arg(long)]
    properties: bool,
    /// Explore the pairs of states; or ask solvers, for states without end: prove by induction, or look for bounded runs that refute
    #[arg(long, value_enum, default_value_t = Method::Explicit)]
    method: Method,
    /// The most steps of runs that --method bmc looks at (default 12), and --method induction where it fails (default 6)
    #[arg(long, value_name = "N")]
    depth: Option<u64>,
    /// Show all of the first states and of the coupling, not only what matters
    #[arg(long)]
    all: bool,
    /// Write what --method induction asks the solvers into this folder, as SMT-LIB
    #[arg(long, value_name = "FOLDER")]
    obligations: Option<PathBuf>,
    /// Write both runs of a refutation into this folder, as abstract.avalla and concrete.avalla
    #[arg(long, value_name = "FOLDER")]
    counterexample: Option<PathBuf>,
    /// Write a page (HTML): the verdict, both runs of a refutation as timelines and charts side by side, the part of the coupling that
    /// fails; with --format json, `-` puts its sections into the object
    #[arg(long, value_name = "FILE.html")]
    page: Option<PathBuf>,
}

/// How it is decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Method {
    /// By exploring the pairs of states
    Explicit,
    /// By an inductive proof, which z3 and cvc5 must both accept; where it fails, short runs are looked at
    Induction,
    /// By bounded runs from the initial states, which z3 or cvc5 finds and the machines make again
    Bmc,
}

/// What is asked: the paths of the models, and the coupling's text.
struct Question {
    models: [PathBuf; 2],
    coupling: Option<SourceFile>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    fits_method(arguments)?;
    if arguments.page.as_deref() == Some(Path::new("-")) && !shell.json() {
        return Err(Failure::usage_with_help(
            "a page goes into a file",
            "name it, `--page FILE.html`; or add --format json",
        ));
    }
    let question = match question(shell, arguments)? {
        Ok(question) => question,
        Err(exit) => return Ok(exit),
    };
    let mut models = Vec::new();
    for path in &question.models {
        let loaded = match load(shell, path)? {
            Ok(loaded) => loaded,
            Err(exit) => return Ok(exit),
        };
        if loaded.program.main.is_none() {
            return crate::run::no_main(shell, &loaded);
        }
        models.push(loaded);
    }
    let Ok(models) = <[Loaded; 2]>::try_from(models) else { unreachable!("there are two models") };
    let Some(assumed) = assumed(shell, arguments, &question, &models)? else { return Ok(Exit::World) };
    let models = [&assumed[ABSTRACT].model, &assumed[CONCRETE].model];
    let programs = [&models[0].program, &models[1].program];
    let limits = shell.global.limits.uninterrupted();
    let coupling = match Coupling::new(programs, question.coupling, &limits) {
        Ok(coupling) => coupling,
        Err(faulty) => {
            shell.diagnostics(&faulty.sources, &faulty.faults)?;
            return Ok(Exit::World);
        }
    };
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let workers = arguments.workers.map_or(processors, |workers| workers as usize);
    let max_pairs = arguments.max_states.unwrap_or(u64::MAX);
    let mut options = Options { max_pairs, workers, ..Options::default() };
    for (side, model) in models.iter().enumerate() {
        options.extents[side] = Extent { limits: limits.clone(), ..Extent::default() };
        assumed[side].put(&mut options.extents[side]);
        for text in &arguments.bounds {
            // An input that only the other model has is bounded there.
            if bound::is_of_input(&model.program, text) || !bound::is_of_input(&models[1 - side].program, text) {
                let wrong = |refused| Failure::usage_with_help(format!("--bound {refused}"), bound::HELP);
                let bounds = bound::read(&model.program, std::slice::from_ref(text)).map_err(wrong)?;
                let extent = &mut options.extents[side];
                extent.assumed.retain(|function, _| !bounds.contains_key(function));
                extent.bounds.extend(bounds);
            }
        }
    }
    let checkpoint = match &arguments.checkpoint {
        Some(path) => {
            let fingerprints = models.map(|model| groundstate::fingerprint(&model.sources));
            Some(Checkpoint::new(path, &fingerprints.each_ref().map(String::as_str))?)
        }
        None => None,
    };
    interrupt::listen();
    interrupt::bound_memory(arguments.max_memory);
    let mut watch = Watch::new(arguments.time, shell.global.quiet || shell.json());
    let cancel = Cancel::from(interrupt::request().clone());
    let how = match arguments.method {
        Method::Explicit => How::Search(checkpoint),
        Method::Induction => How::Ask(ask(arguments, About::Induction, SHORT)?),
        Method::Bmc => How::Ask(ask(arguments, About::Runs, DEPTH)?),
    };
    let job = job::refine(coupling, options, how, cancel);
    let job = job.map_err(|error| Failure::usage(format!("the search cannot be started: {error}")))?;
    while let Some(RefineEvent(progress)) = job.next_event() {
        let shown = Progress { states: progress.pairs, queue: progress.queue, ..Progress::default() };
        if !watch.at(&shown) {
            job.cancel().cancel();
        }
    }
    let (outcome, coupling, checkpoint) = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    let verified = match &outcome {
        Ok(report) if arguments.properties => {
            Some(verify_abstract(&assumed[ABSTRACT], report, arguments, limits, &mut watch))
        }
        _ => None,
    };
    let timed_out = watch.done();
    let words = Refinements { models, coupling: &coupling, timed_out, all: arguments.all, verified: verified.as_ref() };
    let report = match outcome {
        Ok(report) => report,
        Err(Trouble::Refused(refusal)) => {
            return Err(checkpoint.map_or_else(
                || Failure::usage("no checkpoint"),
                |kept| kept.refused(refusal, "another coupling, other assumptions"),
            ));
        }
        Err(trouble) => return no_report(shell, &trouble, models),
    };
    if let (Some(folder), Some(proof)) = (&arguments.obligations, &report.proof) {
        write_obligations(folder, proof)?;
    }
    let is_inline = arguments.page.as_deref() == Some(Path::new("-"));
    let mut part = None;
    if is_inline {
        let Some(check) = page_of(shell, &question.models, &words, &report, &draw::Embedded)? else {
            return Ok(Exit::World);
        };
        part = Some(render_refinement_part(&check));
    }
    tell(shell, &words, &report, part)?;
    if let (Some(folder), Verdict::DoesNot(refutation)) = (&arguments.counterexample, &report.verdict) {
        write_scenarios(shell, folder, &question.models, &words, refutation)?;
    }
    if let Some(path) = arguments.page.as_ref().filter(|_| !is_inline)
        && !write_page(shell, path, &question.models, &words, &report)?
    {
        return Ok(Exit::World);
    }
    checkpoint.map_or(Ok(()), Checkpoint::done)?;
    Ok(match report.verdict {
        Verdict::Refines => of_properties(&words, &report),
        Verdict::DoesNot(_) | Verdict::Vacuous(_) => Exit::Model,
        Verdict::Unknown(_) => Exit::Unknown,
    })
}

/// Both models with what is assumed of them; if that has faults, shows them and returns `None`.
fn assumed(
    shell: &mut Shell,
    arguments: &Arguments,
    question: &Question,
    models: &[Loaded; 2],
) -> Result<Option<[Assumptions; 2]>, Failure> {
    let terms = match terms_of([&models[ABSTRACT], &models[CONCRETE]], &arguments.assumptions) {
        Ok(terms) => terms,
        Err(trouble) => {
            shell.diagnostics(&trouble.0, &trouble.1)?;
            return Ok(None);
        }
    };
    let mut all = Vec::new();
    for (side, model) in models.iter().enumerate() {
        let path = path_of(&question.models[side]);
        let beside = match read_source(&path, shell.global.limits.max_file_size) {
            Err(Failure::Missing(_)) => None,
            read => Some(read?),
        };
        match assume(model, beside.as_ref(), &terms[side]) {
            Ok(assumptions) => all.push(assumptions),
            Err(trouble) => {
                shell.diagnostics(&trouble.0, &trouble.1)?;
                return Ok(None);
            }
        }
    }
    Ok(<[Assumptions; 2]>::try_from(all).ok())
}

/// Whether the options are those of the method.
fn fits_method(arguments: &Arguments) -> Result<(), Failure> {
    let refused = |option: &str, help: &str| Err(Failure::usage_with_help(option.to_string(), help));
    match arguments.method {
        Method::Induction | Method::Bmc if arguments.checkpoint.is_some() => {
            refused("--checkpoint is about the search of pairs of states", "leave out --checkpoint, or --method")
        }
        Method::Explicit | Method::Bmc if arguments.obligations.is_some() => {
            refused("--obligations is about proofs", "add --method induction")
        }
        Method::Explicit if arguments.depth.is_some() => refused(
            "--depth is about runs that solvers look at",
            "add --method bmc; without a method, --max-states and --time limit the search",
        ),
        Method::Bmc if arguments.depth == Some(0) => {
            refused("--depth 0 leaves no run to look at", "give a number of steps from 1 on")
        }
        Method::Induction if !arguments.bounds.is_empty() => {
            refused("--method induction is about all values of inputs", "leave out --bound, or --method")
        }
        Method::Bmc if !arguments.bounds.is_empty() => {
            refused("--method bmc is about all values of inputs", "leave out --bound, or --method")
        }
        Method::Bmc if arguments.properties => refused(
            "--properties is about what comes along if it refines, and --method bmc never says so",
            "leave out --properties, or --method",
        ),
        Method::Explicit | Method::Induction | Method::Bmc => Ok(()),
    }
}

/// The solvers that are there.
fn solvers(method: Method) -> Result<Vec<Process>, Failure> {
    let both = Process::both();
    if both.is_empty() {
        let message = match method {
            Method::Bmc => "--method bmc needs z3 or cvc5, and neither is on the PATH",
            Method::Explicit | Method::Induction => "--method induction needs z3 and cvc5, and neither is on the PATH",
        };
        return Err(Failure::usage_with_help(
            message,
            "install both: sh cpp/install.sh z3 cvc5, or apt-get install z3 cvc5",
        ));
    }
    Ok(both)
}

/// What solvers are asked; all questions together end with the time.
fn ask(arguments: &Arguments, about: About, depth: u64) -> Result<Ask<Process>, Failure> {
    let seconds = arguments.time.map_or(SECONDS, |time| u32::try_from(time).unwrap_or(u32::MAX));
    let depth = arguments.depth.unwrap_or(depth);
    Ok(Ask { about, solvers: solvers(arguments.method)?, seconds, depth })
}

/// Writes what was asked, one file a question.
fn write_obligations(folder: &Path, proof: &refine::Proof) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    for (number, obligation) in proof.obligations.iter().enumerate() {
        let file = folder.join(format!("{:02}-{}.smt2", number + 1, obligation.name.replace(' ', "-")));
        write_text(&file, &obligation.script)?;
    }
    Ok(())
}

/// Verifies the properties of the abstract machine that come along.
fn verify_abstract(
    assumed: &Assumptions,
    report: &Report,
    arguments: &Arguments,
    limits: Limits,
    watch: &mut Watch,
) -> BTreeMap<usize, Outcome> {
    let options = groundstate::verify::Options {
        limits,
        max_states: arguments.max_states.unwrap_or(u64::MAX),
        // The refinement is of the abstract machine under its assumptions.
        bounds: assumed.bounds.clone(),
        undefined: assumed.undefined.clone(),
        interrupt: interrupt::request().clone(),
        ..groundstate::verify::Options::default()
    };
    let found =
        verify_preserved(&assumed.model.program, &report.properties, &options, &mut |progress| watch.at(progress));
    // A machine without initial states refines nothing; an interrupt leaves all of it open.
    found.unwrap_or_default()
}

/// The exit code of a refinement that holds: that of the properties that were asked for.
fn of_properties(words: &Refinements<'_>, report: &Report) -> Exit {
    let has = |wanted: Standing| report.properties.iter().any(|property| words.standing(property) == wanted);
    match (has(Standing::Violated), has(Standing::Unknown)) {
        (true, _) => Exit::Model,
        (_, true) => Exit::Unknown,
        _ => Exit::Good,
    }
}

/// The models and the coupling; the exit code if the coupling file is at fault.
fn question(shell: &mut Shell, arguments: &Arguments) -> Result<Result<Question, Exit>, Failure> {
    let limit = shell.global.limits.max_file_size;
    let is_coupling = |path: &Path| path.extension().is_some_and(|extension| extension == "refine");
    let (path, models) = match &arguments.models[..] {
        [one] if is_coupling(one) => {
            if arguments.with.is_some() {
                return Err(Failure::usage("two coupling files are named: one of them is enough"));
            }
            (one, None)
        }
        [one] => {
            let help =
                "write `groundstate refine ABSTRACT.asm CONCRETE.asm`, or name a file NAME.refine that names both";
            return Err(Failure::usage_with_help(format!("{} alone has nothing to refine", one.display()), help));
        }
        [one, other] => {
            if let Some(path) = [one, other].into_iter().find(|path| is_coupling(path)) {
                let help = format!("write --with {}", path.display());
                return Err(Failure::usage_with_help(format!("{} is a coupling file", path.display()), help));
            }
            let models = [one.clone(), other.clone()];
            match &arguments.with {
                None => return Ok(Ok(Question { models, coupling: None })),
                Some(path) => (path, Some(models)),
            }
        }
        _ => unreachable!("one or two are required"),
    };
    let file = read_source(path, limit)?;
    let models = match models {
        Some(models) => models,
        None => {
            let mut sources = Sources::default();
            sources.add(file.clone());
            let written = match read(FileId(0), &file.text) {
                Ok(written) => written,
                Err(fault) => {
                    shell.diagnostic(&sources, &fault)?;
                    return Ok(Err(Exit::World));
                }
            };
            let folder = path.parent().unwrap_or(Path::new(""));
            let mut named = Vec::new();
            for (side, model) in written.models.iter().enumerate() {
                let Some(model) = model else {
                    let word = SIDES[side];
                    let help = format!("write `{word} \"Model.asm\";` in it, or name both models before --with");
                    let message = format!("{} does not name the {word} model", path.display());
                    return Err(Failure::usage_with_help(message, help));
                };
                let path = folder.join(&model.text);
                if !path.exists() {
                    let fault = bad_coupling(model.span, format!("there is no file {}", path.display()));
                    shell.diagnostic(&sources, &fault)?;
                    return Ok(Err(Exit::World));
                }
                named.push(path);
            }
            let Ok(named) = <[PathBuf; 2]>::try_from(named) else { unreachable!("there are two sides") };
            named
        }
    };
    Ok(Ok(Question { models, coupling: Some(file) }))
}

fn no_report(shell: &mut Shell, trouble: &Trouble, models: [&Loaded; 2]) -> Result<Exit, Failure> {
    if let Some((side, fault)) = no_start(trouble, models) {
        shell.diagnostic(&models[side].sources, &fault)?;
    } else {
        shell.note("not known: stopped before all initial states were found")?;
    }
    Ok(if matches!(trouble, Trouble::Fault(..)) { Exit::Model } else { Exit::Unknown })
}

fn tell(shell: &mut Shell, words: &Refinements<'_>, report: &Report, page: Option<LivePart>) -> Result<(), Failure> {
    if let Verdict::Vacuous(vacuous) = &report.verdict {
        shell.diagnostic(words.coupling.sources(), &words.vacuous(vacuous))?;
    }
    if shell.json() {
        return shell.object(&wire::Refinement::new(words, report, page));
    }
    if shell.talks() || !matches!(report.verdict, Verdict::Refines) {
        write!(shell.out(), "{}", words.report(report))?;
    }
    Ok(())
}

/// The page of the check; if what stands beside a model has faults, shows them and returns `None`.
fn page_of(
    shell: &mut Shell,
    models: &[PathBuf; 2],
    words: &Refinements<'_>,
    report: &Report,
    pictures: &dyn Pictures,
) -> Result<Option<RefinementCheck>, Failure> {
    let paths = models.each_ref().map(|path| path.display().to_string());
    let paths = [paths[ABSTRACT].as_str(), paths[CONCRETE].as_str()];
    let limits = shell.global.limits.uninterrupted();
    let mut check = match refinement_page(words, report, paths, &mut shell.disk(), pictures, &limits) {
        Ok(check) => check,
        Err(NoPage::Faulty(sources, faults)) => {
            shell.diagnostics(&sources, &faults)?;
            return Ok(None);
        }
        Err(NoPage::Unread(path, absent)) => return Err(Failure::usage(absent.told(&path))),
        Err(NoPage::NotDrawn(fault)) => return Err(Failure::usage(fault.to_string())),
    };
    let fact = |label: &str, value: String| Fact { label: label.to_string(), value };
    check.facts = vec![
        fact("Abstract model", paths[ABSTRACT].to_string()),
        fact("Concrete model", paths[CONCRETE].to_string()),
        fact("Fingerprint of the abstract model", groundstate::fingerprint(&words.models[ABSTRACT].sources)),
        fact("Fingerprint of the concrete model", groundstate::fingerprint(&words.models[CONCRETE].sources)),
        fact("Groundstate", env!("CARGO_PKG_VERSION").to_string()),
    ];
    Ok(Some(check))
}

/// Writes the page into a file; whether there was one.
fn write_page(
    shell: &mut Shell,
    path: &Path,
    models: &[PathBuf; 2],
    words: &Refinements<'_>,
    report: &Report,
) -> Result<bool, Failure> {
    let Some(check) = page_of(shell, models, words, report, &draw::Page)? else { return Ok(false) };
    write_text(path, &render_refinement(&check))?;
    if shell.talks() {
        writeln!(shell.out(), "wrote {}", path.display())?;
    }
    Ok(true)
}

/// Writes both runs as scenarios.
fn write_scenarios(
    shell: &mut Shell,
    folder: &Path,
    models: &[PathBuf; 2],
    words: &Refinements<'_>,
    refutation: &refine::Refutation,
) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    for side in [ABSTRACT, CONCRETE] {
        let file = folder.join(format!("{}.avalla", SIDES[side]));
        let (program, model) = (&words.models[side].program, relative(&models[side], folder));
        let (trace, name) = (trace_of(&refutation.runs[side]), format!("{}_run", SIDES[side]));
        let text = groundstate::counterexample_scenario(program, &trace, Subject::Consistent, &name, &model);
        write_text(&file, &text)?;
        if shell.talks() {
            writeln!(shell.out(), "wrote {}", file.display())?;
        }
        if groundstate::leaves_out(&text) {
            shell.note(&crate::verify::counterexample::left_out(&file))?;
        }
    }
    Ok(())
}
