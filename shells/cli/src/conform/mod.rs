//! `groundstate conform MODEL RECORDING`: whether a running program did what its ground model says.
//!
//! Exit code 0: it did. 1: the two differ; the place and the rule are shown. 3: not known, because the recording has a
//! gap.

mod follow;

use std::io::Write;
use std::path::{Path, PathBuf};

use ::conform::{Malformed, Parted, Reader, Recording, Refusal, Verdict, diagnose_parted};
use clap::Args;
use groundstate::Loaded;
use groundstate::job::{self, Cancel, ConformRequest, Conformed, Events, NoTail, NotConformed};
use groundstate::tell;
use syntax::Sources;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::Bounded;
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;

/// Arguments of `conform`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The ground model, built from the pattern library
    model: PathBuf,
    /// The events of a generated program, an MCAP file
    recording: PathBuf,
    /// Compare only the order of events, even if the recording follows the model's ticks
    #[arg(long)]
    untimed: bool,
    /// Follow the recording while the program writes it, and report a difference at once; Ctrl-C ends it
    #[arg(long)]
    follow: bool,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    if arguments.follow {
        return follow::run(shell, arguments);
    }
    let recording = read(shell, &arguments.recording)?;
    let loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    match hold(shell, loaded, &arguments.model, recording, arguments.untimed)? {
        Ok(conformed) => say(shell, &conformed),
        Err(exit) => Ok(exit),
    }
}

/// Reads the events of a generated program piece by piece.
pub fn read(shell: &Shell, path: &Path) -> Result<Recording, Failure> {
    let mut file = Bounded::open(path, shell.global.limits.recording())?;
    let mut reader = Reader::default();
    while let Some(piece) = file.piece()? {
        reader.feed(piece).map_err(|malformed| unreadable(path, &malformed))?;
    }
    reader.finish().map_err(|malformed| unreadable(path, &malformed))
}

fn unreadable(path: &Path, Malformed(reason): &Malformed) -> Failure {
    Failure::usage_with_help(
        format!("{} cannot be replayed: {reason}", path.display()),
        "a generated program writes its events with `--log FILE`",
    )
}

/// Compares a recording with a model: tick by tick if it follows the model's ticks, else by the order of events.
pub fn hold(
    shell: &mut Shell,
    loaded: Loaded,
    path: &Path,
    recording: Recording,
    untimed: bool,
) -> Result<Result<Conformed, Exit>, Failure> {
    let limits = shell.global.limits.uninterrupted();
    let events = Events::<NoTail>::Whole(recording);
    let request = ConformRequest { loaded, events, limits, by_order: untimed };
    let job = job::conform(request, Cancel::from(interrupt::request().clone())).map_err(not_started)?;
    match job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0)) {
        Ok(conformed) => Ok(Ok(conformed)),
        Err(NotConformed::Refused(refusal)) => refused(shell, path, refusal).map(Err),
        Err(NotConformed::Unread(never)) => match never {},
        Err(NotConformed::Malformed(_) | NotConformed::NoEvents) => unreachable!("it was read before"),
    }
}

fn not_started(error: std::io::Error) -> Failure {
    Failure::usage(format!("the comparison cannot be started: {error}"))
}

fn refused(shell: &mut Shell, path: &Path, refusal: Refusal) -> Result<Exit, Failure> {
    match refusal {
        Refusal::Words(reason) => Err(Failure::usage(format!("{} cannot be replayed: {reason}", path.display()))),
        Refusal::Model(sources, faults) => {
            shell.diagnostics(&sources, &faults)?;
            Ok(Exit::Model)
        }
    }
}

fn say(shell: &mut Shell, conformed: &Conformed) -> Result<Exit, Failure> {
    let Conformed { sources, recording, verdict, way, decisions, accesses, .. } = conformed;
    let (way, made) = (way.words(), way.steps());
    let words = match verdict {
        Verdict::Conforms { events, steps, after } => {
            let after = match after {
                0 => String::new(),
                1 => "; 1 event after the tasks were asked to stop is not compared".to_string(),
                more => format!("; {more} events after the tasks were asked to stop are not compared"),
            };
            let decisions = decisions
                .map(|decisions| format!("\n{decisions} decisions are those of the components' machines"))
                .unwrap_or_default();
            let but = tell::but(accesses);
            let beside = tell::beside(conformed).into_iter().chain(tell::outside(recording));
            let beside: String = beside.map(|words| format!("\n{words}")).collect();
            format!("conforms {way}{but}: {events} events, {steps} {made}{after}{decisions}{beside}")
        }
        Verdict::Unknown { events, reason } => {
            format!("not known, {way}: {reason}; {events} events agree before")
        }
        Verdict::Parts(parted) => difference(recording, parted, way),
    };
    if shell.json() {
        shell.object(&wire::Conformance::new(sources, verdict, way, words))?;
    } else if let Verdict::Parts(parted) = verdict {
        writeln!(shell.out(), "{words}")?;
        parting(shell, sources, parted)?;
    } else if shell.talks() {
        writeln!(shell.out(), "{words}")?;
    }
    Ok(match verdict {
        Verdict::Conforms { .. } => Exit::Good,
        Verdict::Unknown { .. } => Exit::Unknown,
        Verdict::Parts(_) => Exit::Model,
    })
}

fn ms(ns: i64) -> String {
    format!("{:.4}", ns as f64 / 1e6)
}

/// Where the two differ, in a few lines.
fn difference(recording: &Recording, parted: &Parted, way: &str) -> String {
    let at = ms(parted.event.as_ref().map_or(parted.tick * recording.tick_ns, |event| event.time_ns));
    let agreed = if parted.decides { "decisions" } else { "events" };
    let mut out = format!("parts {way}, at {at} ms (tick {}), after {} {agreed}", parted.tick, parted.agreed);
    let task = &parted.task;
    if parted.decides {
        return out + &format!("\n  {task} {}", parted.reason.as_deref().unwrap_or_default());
    }
    let did = match &parted.event {
        Some(event) => event.words(),
        None => "nothing more".to_string(),
    };
    out += &format!("\n  {task} did: {did}");
    out += &match parted.claims.iter().map(|claim| claim.event.words()).collect::<Vec<_>>() {
        claims if claims.is_empty() => "\n  the model: nothing".to_string(),
        claims => format!("\n  the model: {}", claims.join("; ")),
    };
    if let Some(reason) = &parted.reason {
        out += &format!("\n  {reason}");
    }
    out
}

/// Prints what is known of a difference: the preceding events, the state, the rule.
fn parting(shell: &mut Shell, sources: &Sources, parted: &Parted) -> Result<(), Failure> {
    let out = shell.out();
    if parted.decides {
        writeln!(out, "\n  its machine's state, after the step:")?;
        for (location, value) in &parted.state {
            writeln!(out, "    {location} = {value}")?;
        }
        return Ok(());
    }
    writeln!(out, "\n  before:")?;
    for recorded in &parted.before {
        writeln!(out, "  {:>12} ms  {:<20} {}", ms(recorded.event.time_ns), recorded.task, recorded.event.words())?;
    }
    writeln!(out, "\n  the model's state:")?;
    for (location, value) in &parted.state {
        writeln!(out, "    {location} = {value}")?;
    }
    writeln!(out)?;
    if let Some(rule) = diagnose_parted(parted) {
        shell.details(sources, &[rule])?;
    }
    Ok(())
}
