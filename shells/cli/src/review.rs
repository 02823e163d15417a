//! `groundstate review MODEL`: finds oddities in any model, by the seven meta-properties.
//!
//! Exit codes: 0 all hold, 1 one is violated, 3 none is violated but one is unknown.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use groundstate::job::{self, Cancel, ReviewEvent, ReviewRequest};
use groundstate::own_files;
use groundstate::tell::says;
use groundstate::verify::review::{Finding, Meta, MetaOutcome, Review};
use groundstate::verify::{Reason, Stop};
use syntax::FileId;
use wire::{Fault, MetaProperty, RunStep};

use crate::check::plural;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;
use crate::verify::{Bounded, Teller, no_start};

/// Arguments of `review`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model
    model: PathBuf,
    /// Check only these meta-properties, such as mp1,mp3
    #[arg(long, value_name = "MP", value_delimiter = ',', value_parser = meta)]
    only: Vec<Meta>,
    /// Also report findings in imported files
    #[arg(long)]
    imports: bool,
    /// Show the run that leads to each finding, if there is one
    #[arg(long)]
    runs: bool,
    #[command(flatten)]
    bounded: Bounded,
}

fn meta(text: &str) -> Result<Meta, String> {
    let number = text.trim().to_lowercase().strip_prefix("mp").and_then(|number| number.parse::<usize>().ok());
    let meta = number.and_then(|number| Meta::ALL.into_iter().find(|meta| meta.number() == number));
    meta.ok_or_else(|| "write mp1 to mp7".to_string())
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    if loaded.program.main.is_none() {
        return crate::run::no_main(shell, &loaded);
    }
    let mut sources = loaded.sources.clone();
    let Some(beside) = arguments.bounded.beside(shell, &loaded.program, &mut sources, &arguments.model)? else {
        return Ok(Exit::World);
    };
    let program = Arc::clone(&loaded.program);
    let (bounded, by_default) = arguments.bounded.with_end();
    let (options, mut watch) = bounded.options(shell, &program, &beside)?;
    let users = own_files(&sources);
    let is_told = |file: FileId| file == loaded.model.root || (arguments.imports && users(file));
    let request = ReviewRequest {
        model: Arc::clone(&loaded.model),
        program: Arc::clone(&program),
        options,
        metas: if arguments.only.is_empty() { Meta::ALL.to_vec() } else { arguments.only.clone() },
        files: sources.iter().map(|(file, _)| file).filter(|file| is_told(*file)).collect(),
    };
    let started = job::review(request, Cancel::from(interrupt::request().clone()));
    let job = started.map_err(|error| Failure::usage(format!("the review cannot be started: {error}")))?;
    while let Some(ReviewEvent(progress)) = job.next_event() {
        watch.at(&progress);
    }
    let outcome = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    let timed_out = watch.done();
    let teller = Teller::new(&program, &sources, timed_out);
    let review = match outcome {
        Ok(review) => review,
        Err(trouble) => return no_start(shell, &teller, trouble),
    };
    for finding in &review.findings {
        tell(shell, &teller, &review, finding, arguments.runs)?;
    }
    summary(shell, &teller, &review)?;
    let stopped = |reason: &Reason| matches!(reason, Reason::Stopped(Stop::States)) || timed_out;
    if by_default && review.reasons.iter().any(stopped) {
        Bounded::at_end(shell)?;
    }
    Ok(exit(&review))
}

fn tell(shell: &mut Shell, teller: &Teller<'_>, review: &Review, finding: &Finding, runs: bool) -> Result<(), Failure> {
    let diagnostic = groundstate::diagnose_finding(finding, review, teller.words.program);
    if shell.json() {
        let witness = finding.witness.as_deref().map(|trace| RunStep::all(&teller.words, trace));
        let fault = Fault::new(teller.words.sources, &diagnostic);
        return shell.object(&wire::Finding::new(finding.meta.number(), fault, witness));
    }
    shell.details(teller.words.sources, &[diagnostic])?;
    if let (Some(trace), true) = (&finding.witness, shell.talks()) {
        if runs {
            write!(shell.out(), "{}", teller.words.run(trace))?;
        } else {
            writeln!(shell.out(), "  in step {} of a run that --runs shows", trace.steps.len())?;
        }
        writeln!(shell.out())?;
    }
    Ok(())
}

fn summary(shell: &mut Shell, teller: &Teller<'_>, review: &Review) -> Result<(), Failure> {
    for (meta, outcome) in &review.outcomes {
        let findings = review.findings.iter().filter(|finding| finding.meta == *meta).count();
        let computed = review.unclear.iter().filter(|(of, _)| of == meta).map(|(_, function)| {
            let name = &teller.words.program.function(*function).name;
            format!("initial values of {name} are computed, and too many to be listed")
        });
        let reasons: Vec<String> = match outcome {
            MetaOutcome::Unknown => {
                review.reasons.iter().map(|reason| teller.words.reason(reason)).chain(computed).collect()
            }
            _ => Vec::new(),
        };
        let word = match outcome {
            MetaOutcome::Holds => "holds",
            MetaOutcome::Violated => "violated",
            MetaOutcome::Unknown => "unknown",
        };
        let number = format!("MP{}", meta.number());
        if shell.json() {
            shell.object(&MetaProperty::new(meta.number(), word, findings, reasons))?;
        } else if shell.talks() {
            let says = says(*meta);
            let more = match outcome {
                MetaOutcome::Holds => String::new(),
                MetaOutcome::Violated => format!(": {}", plural(findings, "finding")),
                MetaOutcome::Unknown => format!(": {}", reasons.join("; ")),
            };
            writeln!(shell.out(), "{number} {word:<9} {says}{more}")?;
        }
    }
    teller.explored(shell, &review.progress, review.reasons.is_empty())
}

fn exit(review: &Review) -> Exit {
    let any = |wanted| review.outcomes.iter().any(|(_, outcome)| *outcome == wanted);
    if any(MetaOutcome::Violated) {
        Exit::Model
    } else if any(MetaOutcome::Unknown) {
        Exit::Unknown
    } else {
        Exit::Good
    }
}
