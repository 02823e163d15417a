//! `cargo xtask mutate-log [--only WORD] [--every N] [--output FILE]`: whether `conform` sees every change of a single event.
//!
//! In: the systems of this repository. Out: a table, and each change that it took for a run of the system although it is none
//! by the `judge`, another decision than its own; exit code 1 if there is one, or if an untouched log does not conform. With
//! `--every N` only each N-th change is looked at.

mod judge;
mod mutants;
mod systems;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::Arc;

use ::chart::system::System;
use conform::{Session, Verdict};
use machine::Limits;
use recording::Recording;

use crate::arguments::Arguments;
use crate::{Failure, Outcome};
use mutants::{Change, changes, mutant};
use systems::{Log, SUBJECTS, Subject};

/// What became of a changed log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fate {
    Parts,
    Refused,
    NotKnown,
    /// It conforms, and the judge says that the system may have written it.
    Legal,
    /// It conforms, and should not.
    Missed,
}

/// How many of each fate.
#[derive(Debug, Clone, Copy, Default)]
struct Count([usize; 5]);

impl Count {
    fn add(&mut self, other: Count) {
        self.0.iter_mut().zip(other.0).for_each(|(own, other)| *own += other);
    }

    fn of(&self, fate: Fate) -> usize {
        self.0[fate as usize]
    }

    fn row(&self, name: &str) -> String {
        let Count([parts, refused, not_known, legal, missed]) = self;
        let all: usize = self.0.iter().sum();
        format!("| {name} | {all} | {parts} | {refused} | {not_known} | {legal} | {missed} |\n")
    }
}

const HEAD: &str =
    "changes | parts | refused | not known | legal | missed |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";

/// Runs the command.
///
/// # Errors
/// A system cannot be made.
pub fn run(words: &[String]) -> Result<Outcome, Failure> {
    let arguments = Arguments::read(words, &["--only", "--every", "--output"], &[])?;
    let every = usize::try_from(arguments.number("--every", 1)?.max(1)).unwrap_or(1);
    let only = arguments.option("--only").unwrap_or_default();
    let below = crate::repository::root().join("target/mutate-log");
    let mut by_log: Vec<(String, Count)> = Vec::new();
    let mut by_change: BTreeMap<&str, Count> = BTreeMap::new();
    for subject in SUBJECTS.iter().filter(|subject| subject.name.contains(only)) {
        for log in subject.logs(&below)? {
            let looked = look(subject, &log, every)?;
            let mut sum = Count::default();
            for (row, count) in looked {
                sum.add(count);
                by_change.entry(row).or_default().add(count);
            }
            println!("{}: {} events; {sum:?}", log.name, log.recording.events());
            by_log.push((log.name, sum));
        }
    }
    let mut text = format!("| log | {HEAD}");
    by_log.iter().for_each(|(name, count)| text += &count.row(name));
    let _ = write!(text, "\n| change | {HEAD}");
    for row in Change::ROWS {
        text += &by_change.get(row).copied().unwrap_or_default().row(row);
    }
    println!("{text}");
    if let Some(path) = arguments.option("--output").map(PathBuf::from) {
        std::fs::write(&path, &text).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    let missed = by_log.iter().any(|(_, count)| count.of(Fate::Missed) > 0);
    Ok(if missed || by_log.is_empty() { Outcome::AtFault } else { Outcome::Good })
}

/// All changes of a log, by the rows of the report; what is missed is printed.
fn look(subject: &Subject, log: &Log, every: usize) -> Result<BTreeMap<&'static str, Count>, Failure> {
    let chart = subject.chart()?;
    let system = chart.system.as_ref().ok_or("the chart has no system")?;
    let mut bench = Bench::new(subject, system, &log.recording)?;
    let mut counts: BTreeMap<&str, Count> = BTreeMap::new();
    for (place, change) in changes(&log.recording).into_iter().step_by(every) {
        let Some(changed) = mutant(&log.recording, place, change) else { continue };
        let fate = bench.fate(&changed);
        if fate == Fate::Missed {
            let (track, at) = (&log.recording.tracks[place.0], place.1);
            let event = &track.events[at];
            let instant = event.time_ns as f64 / 1e6;
            println!("missed in {}: {change:?} of {}, {instant:.4} ms: {}", log.name, track.task, event.words());
        }
        counts.entry(change.row()).or_default().0[fate as usize] += 1;
    }
    Ok(counts)
}

/// Where changed logs are looked at, one after the other.
struct Bench<'a> {
    session: Session,
    plan: judge::Plan<'a>,
    untouched: &'a Recording,
}

impl<'a> Bench<'a> {
    /// Looks at the untouched log first: it conforms, and the judge agrees.
    fn new(subject: &Subject, system: &'a System, untouched: &'a Recording) -> Result<Bench<'a>, Failure> {
        let groundstate::Loaded { sources, model, program, .. } = subject.model()?;
        let (model, program) = (Arc::unwrap_or_clone(model), Arc::unwrap_or_clone(program));
        let session = Session::new(sources, model, program, Limits::default(), untouched, false)
            .map_err(|refusal| format!("{refusal:?}"))?;
        let mut bench = Bench { session, plan: judge::Plan::new(system, untouched), untouched };
        match bench.verdict(untouched) {
            Some(Verdict::Conforms { .. }) => {}
            other => return Err(format!("an untouched log of {} does not conform: {other:#?}", subject.name)),
        }
        if untouched.pace != "modelled" {
            let allowed = bench.plan.allows(untouched);
            allowed.map_err(|reason| format!("the judge of an untouched log of {}: {reason}", subject.name))?;
        }
        Ok(bench)
    }

    /// None: it is refused.
    fn verdict(&mut self, recording: &Recording) -> Option<Verdict> {
        self.session.begin_again(recording, false).ok()?;
        self.session.go_on(recording, false).ok().flatten()
    }

    fn fate(&mut self, changed: &Recording) -> Fate {
        let way = self.untouched.pace.as_str();
        match self.verdict(changed) {
            None => Fate::Refused,
            Some(Verdict::Parts(_)) => Fate::Parts,
            Some(Verdict::Unknown { .. }) => Fate::NotKnown,
            // A run that follows the ticks and passes over a writing is compared by order.
            Some(Verdict::Conforms { .. }) if way == "modelled" && self.session.way() == conform::Way::Timed => {
                if judge::is_the_run(changed, self.untouched) {
                    Fate::Legal
                } else {
                    Fate::Missed
                }
            }
            Some(Verdict::Conforms { .. }) => match self.plan.allows(changed) {
                Ok(()) => Fate::Legal,
                Err(_) => Fate::Missed,
            },
        }
    }
}

#[cfg(test)]
mod tests;
