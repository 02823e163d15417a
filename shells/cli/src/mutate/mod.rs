//! `groundstate mutate PATH…`: puts small faults into models and tells which no property, no scenario and no
//! refinement notices.
//!
//! Exit codes: 0 every mutant is killed or equivalent, 1 some survive or something does not pass as it is, 3 none survives
//! but some are not known.

mod find;
mod results;
mod since;
mod tell;
mod timer;

use std::io::Write;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use groundstate::Workspace;
use groundstate::job::{self, Cancel, Hands, MutateEvent};
use groundstate::mutate::Operator;
use groundstate::mutation::{Bench, Extent, Ledger, Wanted, machines_of, mutation_page};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{Disk, write_text};
use crate::interrupt;
use crate::progress::Progress;
use crate::shell::Shell;
use find::Found;
use results::Results;
use timer::Clock;

/// Arguments of `mutate`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The models and charts to mutate, or folders of models
    #[arg(required_unless_present = "list_operators", value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Models, scenarios and couplings that judge, or folders of them; may be repeated. Default: the models that are
    /// mutated, and the scenarios and couplings in their folders
    #[arg(long, value_name = "PATH")]
    by: Vec<PathBuf>,
    /// Who judges: properties, scenarios, refinements
    #[arg(long, value_enum, value_delimiter = ',', value_name = "WHO", default_values_t = [With::Verify, With::Test])]
    with: Vec<With>,
    /// Only these operators, by their ids
    #[arg(long, value_delimiter = ',', value_name = "ID", value_parser = operator)]
    operators: Vec<Operator>,
    /// List the operators
    #[arg(long)]
    list_operators: bool,
    /// Also mutate the files that the models import
    #[arg(long)]
    imports: bool,
    /// Judge only N mutants, drawn at random
    #[arg(long, value_name = "N")]
    sample: Option<usize>,
    /// Seed of the sample
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Only mutants of lines that changed since this revision of git
    #[arg(long, value_name = "REV")]
    since: Option<String>,
    /// The most time for one mutant, in seconds. The model as it is takes as long as it takes
    #[arg(long, value_name = "SECONDS", value_parser = crate::limits::count, default_value = "20")]
    time: u64,
    /// The most states for one mutant
    #[arg(long, value_name = "N", value_parser = crate::limits::count, default_value = "200000")]
    max_states: u64,
    /// The most memory that the program may take, in MiB
    #[arg(long, value_name = "MIB", default_value_t = 8192)]
    max_memory: u64,
    /// How many mutants are judged at a time. Default: the number of processors
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=256))]
    jobs: Option<u64>,
    /// Keep the outcomes in this file, and judge no mutant again whose outcome it has: by the same judges with the same texts
    #[arg(long, value_name = "FILE")]
    results: Option<PathBuf>,
    /// Write a page (HTML) with the survivors, and the texts with what became of the mutants of each line
    #[arg(long, value_name = "FILE.html")]
    page: Option<PathBuf>,
    /// Tell every mutant, not only those that survive
    #[arg(long)]
    all: bool,
}

/// Who judges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum With {
    /// The properties of models
    Verify,
    /// Scenarios
    Test,
    /// Couplings: what refines as it is must refine with the mutant, too
    Refine,
}

fn operator(id: &str) -> Result<Operator, String> {
    Operator::of(id).ok_or_else(|| "there is no such operator; --list-operators lists them".to_string())
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    if arguments.list_operators {
        for operator in Operator::ALL {
            writeln!(shell.out(), "{:<20} {}", operator.id(), operator.meaning())?;
        }
        return Ok(Exit::Good);
    }
    let found = Found::new(&arguments.paths, &arguments.by)?;
    let lines = match &arguments.since {
        Some(revision) => {
            let mut workspace = Workspace::new(Disk { limit: shell.global.limits.max_file_size });
            let machines = found.charts.iter().flat_map(|chart| machines_of(chart, &mut workspace));
            let texts = found.mutated.iter().cloned().chain(machines).collect();
            Some(since::changed_lines(revision, &texts)?)
        }
        None => None,
    };
    let jobs = arguments
        .jobs
        .map_or_else(|| std::thread::available_parallelism().map_or(1, usize::from), |jobs| jobs as usize);
    let operators = match arguments.operators.is_empty() {
        true => Operator::ALL.to_vec(),
        false => arguments.operators.clone(),
    };
    let strict = found.strict;
    let wanted = Wanted {
        models: found.models,
        charts: found.charts,
        scenarios: found.scenarios,
        couplings: found.couplings,
        mutated: found.mutated,
        imports: arguments.imports,
        whole: arguments.by.is_empty(),
        verify: arguments.with.contains(&With::Verify),
        test: arguments.with.contains(&With::Test),
        refine: arguments.with.contains(&With::Refine),
        operators,
        lines,
        sample: arguments.sample.map(|size| (size, arguments.seed)),
        extent: Extent {
            limits: shell.global.limits.uninterrupted(),
            max_states: arguments.max_states,
            max_bytes: arguments.max_memory.saturating_mul(1 << 20) / jobs as u64,
        },
    };
    interrupt::listen();
    interrupt::bound_memory(arguments.max_memory);
    let limit = shell.global.limits.max_file_size;
    let results = arguments.results.as_deref().map(Results::open).transpose()?;
    let (ledger, trouble) = results.unzip();
    let hands = Hands {
        files: Box::new(move || Disk { limit }),
        timer: Clock::start(Duration::from_secs(arguments.time)),
        ledger: ledger.map(|ledger| Box::new(ledger) as Box<dyn Ledger>),
        workers: jobs,
    };
    let started = job::mutate(wanted, hands, strict, Cancel::from(interrupt::request().clone()));
    let job = started.map_err(|error| Failure::usage(format!("the analysis cannot be started: {error}")))?;
    let mut progress: Option<Progress> = None;
    let silent = shell.global.quiet || shell.json();
    let mut judged = 0;
    while let Some(event) = job.next_event() {
        match event {
            MutateEvent::Tried(path) => {
                progress.iter_mut().for_each(Progress::done);
                progress = Some(Progress::busy_with(&format!("{path} as it is"), silent));
            }
            MutateEvent::Begun(count) => {
                progress.iter_mut().for_each(Progress::done);
                progress = Some(Progress::of("mutants", count as u64, silent));
            }
            MutateEvent::Judged(..) => {
                judged += 1;
                progress.iter_mut().for_each(|progress| progress.at(judged));
            }
        }
    }
    let mutated = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    progress.iter_mut().for_each(Progress::done);
    if let Some(exit) = unfit(shell, &mutated.bench, strict)? {
        return Ok(exit);
    }
    if let Some(path) = &arguments.page {
        let page = mutation_page(&mutated.bench, &mutated.outcomes, arguments.sample.is_some());
        write_text(path, &::report::render_mutation(&page))?;
    }
    let exit = tell::told(shell, &mutated, arguments.sample.is_some(), arguments.all)?;
    let failed = arguments.results.as_deref().zip(trouble).and_then(|(path, trouble)| results::failed(path, &trouble));
    failed.map_or(Ok(exit), Err)
}

const MUST_PASS: &str = "a model must pass its properties and scenarios before they can be judged by mutants";

/// Says who cannot judge; an exit code if nobody judges.
fn unfit(shell: &mut Shell, bench: &Bench, strict: bool) -> Result<Option<Exit>, Failure> {
    for unfit in &bench.unfit {
        if strict {
            shell.diagnostics(&unfit.sources, &unfit.faults)?;
        }
        if strict && shell.json() {
            shell.report_failure(&Failure::usage(format!("{} {}; {MUST_PASS}", unfit.path, unfit.why)));
        } else if strict || shell.talks() {
            let left_out = if strict { "" } else { "left out: " };
            shell.note(&format!("{left_out}{} {}", unfit.path, unfit.why))?;
        }
    }
    if strict && !bench.unfit.is_empty() {
        if !shell.json() {
            shell.note(MUST_PASS)?;
        }
        return Ok(Some(Exit::Model));
    }
    if bench.judging().is_empty() && !interrupt::asked() {
        let help = "name models with a main rule, or with --by those that import the files to be mutated";
        return Err(Failure::usage_with_help("nothing judges these files", help));
    }
    Ok(None)
}
