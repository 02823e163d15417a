//! `groundstate conform MODEL RECORDING`: whether a running program did what its ground model says.
//!
//! Exit code 0: it did. 1: the two differ; the place and the rule are shown. 3: not known, because the recording has a
//! gap.

mod follow;

use std::io::Write;
use std::path::{Path, PathBuf};

use ::conform::{Event, Kind, Malformed, Parted, Reader, Recording, Refusal, Verdict, diagnose_parted};
use clap::Args;
use groundstate::Loaded;
use groundstate::job::{self, Cancel, ConformRequest, Conformed, Events, NoTail, NotConformed};
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
        Ok(conformed) => tell(shell, &conformed),
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

fn tell(shell: &mut Shell, conformed: &Conformed) -> Result<Exit, Failure> {
    let Conformed { sources, recording, verdict, way, decisions } = conformed;
    let way = way.words();
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
            let (missed, silent) = (missed(recording) + &outside(recording), silent(recording));
            format!("conforms {way}: {events} events, {steps} steps of the model{after}{decisions}{missed}{silent}")
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

/// The deadlines that were missed before the tasks were asked to stop: a run that has its events in order may have missed all of them.
fn missed(recording: &Recording) -> String {
    let until_ns = recording.stopped_ns.unwrap_or(i64::MAX);
    let misses = |event: &&Event| event.kind == Kind::Misses && event.time_ns <= until_ns;
    let tasks = recording.tracks.iter().map(|track| (&track.task, track.events.iter().filter(misses).count()));
    let tasks: Vec<_> = tasks.filter(|(_, count)| *count > 0).collect();
    let each = tasks.iter().map(|(task, count)| format!("{task} {count}")).collect::<Vec<_>>().join(", ");
    match tasks.iter().map(|(_, count)| count).sum::<usize>() {
        0 => String::new(),
        1 => format!("\n1 deadline was missed ({each}); whether the model forbids that is not looked at"),
        more => format!("\n{more} deadlines were missed ({each}); whether the model forbids that is not looked at"),
    }
}

/// What the program counted as outside the bounds of its chart. The events of such a run may be in order.
fn outside(recording: &Recording) -> String {
    let told = recording.bounds.iter().filter(|bound| bound.outside() > 0).map(|bound| {
        let (what, limit, outside, seen) = (&bound.what, &bound.limit, bound.outside(), bound.seen);
        format!("\n{outside} of {seen} were outside the chart's bounds, as the program counted: {what} ({limit})")
    });
    told.collect()
}

/// LIMIT: periods without an event that are told of.
const SILENT: i64 = 4;

/// The synchronous tasks of which nothing is recorded for several periods before they were asked to stop, and the others of which nothing
/// is recorded at all. An order of events says nothing of what did not come.
fn silent(recording: &Recording) -> String {
    let Some(stopped_ns) = recording.stopped_ns else { return String::new() };
    let told = recording.tracks.iter().filter_map(|track| {
        let last_ns = track.events.iter().map(|event| event.time_ns).filter(|time_ns| *time_ns <= stopped_ns).max();
        let silent_ns = stopped_ns - last_ns.unwrap_or(0);
        let when = match track.rhythm.map(|rhythm| rhythm.period_ns).filter(|period_ns| *period_ns > 0) {
            Some(period_ns) if silent_ns > SILENT * period_ns => {
                let (silent, periods) = (ms(silent_ns), silent_ns / period_ns);
                format!("in the last {silent} ms before the stop, {periods} of its periods")
            }
            None if last_ns.is_none() => "before the stop".to_string(),
            _ => return None,
        };
        Some(format!("\nnothing is recorded of {} {when}: whether it stood still is not looked at", track.task))
    });
    told.collect()
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

#[cfg(test)]
mod tests {
    use ::conform::{Rhythm, Track};

    use super::*;
    #[test]
    fn missed_deadlines_are_told_of_each_task_until_the_stop() {
        let missed_at = |time_ns: i64| Event { time_ns, kind: Kind::Misses, ..Event::default() };
        let track = |task: &str, times: &[i64]| Track {
            task: task.to_string(),
            events: times.iter().copied().map(missed_at).collect(),
            ..Track::default()
        };
        let tracks = vec![track("drive", &[1, 5, 9]), track("arm", &[2]), track("eye", &[])];
        let recording = Recording { tracks, stopped_ns: Some(6), ..Recording::default() };
        let unsaid = "whether the model forbids that is not looked at";
        assert_eq!(missed(&recording), format!("\n3 deadlines were missed (drive 2, arm 1); {unsaid}"));
        let one = Recording { stopped_ns: Some(1), ..recording };
        assert_eq!(missed(&one), format!("\n1 deadline was missed (drive 1); {unsaid}"));
        assert_eq!(missed(&Recording { stopped_ns: Some(0), ..one }), "");
    }

    #[test]
    fn a_task_that_records_nothing_more_is_told_of() {
        let track = |task: &str, period_ns: i64, times: &[i64]| Track {
            task: task.to_string(),
            rhythm: (period_ns > 0).then_some(Rhythm { period_ns, offset_ns: 0, deadline_ns: period_ns }),
            events: times.iter().map(|time_ns| Event { time_ns: *time_ns, ..Event::default() }).collect(),
            ..Track::default()
        };
        let tracks = vec![
            track("drive", 10_000_000, &[0, 12_000_000, 501_000_000]),
            track("arm", 100_000_000, &[0, 100_000_000]),
            // Nobody says when it is due.
            track("plan", 0, &[0]),
            track("eye", 10_000_000, &[]),
            track("radio", 0, &[]),
            track("late", 0, &[501_000_000]),
        ];
        let recording = Recording { tracks, stopped_ns: Some(500_000_000), ..Recording::default() };
        let end = "whether it stood still is not looked at";
        let said = format!(
            "\nnothing is recorded of drive in the last 488.0000 ms before the stop, 48 of its periods: {end}\
             \nnothing is recorded of eye in the last 500.0000 ms before the stop, 50 of its periods: {end}\
             \nnothing is recorded of radio before the stop: {end}\
             \nnothing is recorded of late before the stop: {end}"
        );
        assert_eq!(silent(&recording), said);
        assert_eq!(silent(&Recording { stopped_ns: None, ..recording }), "");
    }
}
