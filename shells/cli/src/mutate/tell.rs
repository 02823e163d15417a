//! Tells what became of mutants: those that survive as differences with places, then the count.
//!
//! In: the outcomes. Out: text or JSON, and the exit code.

use std::collections::BTreeMap;
use std::io::Write;

use groundstate::job::Mutated;
use groundstate::mutate::Change;
use groundstate::mutation::{Candidate, Judging, Outcome, Score, score, surprising};
use groundstate::tell::plural;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::shell::Shell;

/// LIMIT: so many lines of a change are shown on each side.
const LINES: usize = 6;

/// Tells all.
pub fn told(shell: &mut Shell, mutated: &Mutated, sampled: bool, all: bool) -> Result<Exit, Failure> {
    let bench = &mutated.bench;
    let judged: Vec<(Candidate, Outcome)> = bench
        .candidates
        .iter()
        .zip(&mutated.outcomes)
        .filter_map(|(candidate, outcome)| Some((candidate.clone(), outcome.clone()?)))
        .collect();
    let score = score(judged.iter().map(|(_, outcome)| outcome));
    let left = bench.candidates.len() - judged.len();
    if shell.json() {
        for (candidate, outcome) in &judged {
            shell.object(&wire::Mutant::new(candidate, outcome))?;
        }
        let count = (bench.mutants, judged.len());
        shell.object(&wire::Mutation::new(bench.judging(), count, &score, sampled))?;
    } else {
        mutants(shell, &judged, all)?;
        summary(shell, mutated, &score, sampled)?;
    }
    let unknown = left > 0 || score.open > 0 || score.not_compiled > 0 || interrupt::asked();
    Ok(match score.survived {
        0 if unknown => Exit::Unknown,
        0 => Exit::Good,
        _ => Exit::Model,
    })
}

fn mutants(shell: &mut Shell, judged: &[(Candidate, Outcome)], all: bool) -> Result<(), Failure> {
    if all && shell.talks() {
        for (candidate, outcome) in judged {
            match outcome {
                Outcome::Killed(_) => one(shell, "killed", candidate, outcome)?,
                Outcome::Equivalent(_) => one(shell, "equivalent", candidate, outcome)?,
                Outcome::Survived(_) | Outcome::Open(_) | Outcome::NotCompiled(_) => {}
            }
        }
    }
    for (candidate, outcome) in judged {
        match outcome {
            Outcome::Open(_) => one(shell, "unknown", candidate, outcome)?,
            Outcome::NotCompiled(_) => one(shell, "refused", candidate, outcome)?,
            Outcome::Killed(_) | Outcome::Survived(_) | Outcome::Equivalent(_) => {}
        }
    }
    for (candidate, unseen) in surprising(judged) {
        one(shell, "survived", candidate, &Outcome::Survived(unseen))?;
    }
    Ok(())
}

/// Which components decide by what is mutated, as an addition.
fn within(components: &[String]) -> String {
    if components.is_empty() { String::new() } else { format!(" of {}", components.join(", ")) }
}

/// A mutant: what became of it, where it is, what it changes.
fn one(shell: &mut Shell, word: &str, candidate: &Candidate, outcome: &Outcome) -> Result<(), Failure> {
    let (place, name) = (candidate.place(), &candidate.file.name);
    let operator = candidate.mutant.operator.id();
    let within = within(&candidate.components);
    writeln!(shell.out(), "{word:<9} {name}:{}:{} {operator}{within}: {}", place.line, place.column, outcome.remark())?;
    let Change { before, after, .. } = candidate.change();
    let indent = before.iter().chain(&after).filter(|line| !line.trim().is_empty());
    let indent = indent.map(|line| line.len() - line.trim_start().len()).min().unwrap_or(0);
    for (sign, lines) in [('-', before), ('+', after)] {
        for line in lines.iter().take(LINES) {
            writeln!(shell.out(), "  {sign} {}", line.get(indent..).unwrap_or_default().replace('\t', "    "))?;
        }
        if lines.len() > LINES {
            writeln!(shell.out(), "  {sign} and {} more", plural(lines.len() - LINES, "line"))?;
        }
    }
    Ok(())
}

fn summary(shell: &mut Shell, mutated: &Mutated, score: &Score, sampled: bool) -> Result<(), Failure> {
    if !shell.talks() {
        return Ok(());
    }
    let bench = &mutated.bench;
    let Judging { models, scenarios, couplings } = bench.judging();
    let (models, scenarios) = (plural(models.len(), "model"), plural(scenarios.len(), "scenario"));
    let (judges, refined) = match couplings {
        None => (format!("{models} and {scenarios}"), String::new()),
        Some(couplings) => (
            format!("{models}, {scenarios} and {}", plural(couplings.len(), "refinement")),
            format!(", {} by refinements", score.by_refine),
        ),
    };
    let drawn = bench.candidates.len();
    let of = if sampled && drawn < bench.mutants { format!("{drawn} of {}", bench.mutants) } else { drawn.to_string() };
    let word = if drawn == 1 && !of.contains(' ') { "mutant" } else { "mutants" };
    if drawn == 0 {
        writeln!(shell.out(), "no mutants: {judges} had nothing to judge")?;
        return Ok(());
    }
    writeln!(shell.out(), "{of} {word}, judged by {judges}")?;
    let by = format!("{} by properties, {} by scenarios{refined}", score.by_verify, score.by_test);
    let mut parts = vec![format!("{} killed ({by})", score.killed())];
    parts.push(format!("{} survived", score.survived));
    let judged = mutated.outcomes.iter().flatten().count();
    for (count, what) in [
        (score.equivalent, "equivalent"),
        (score.open, "not known"),
        (score.not_compiled, "refused by the checker"),
        (drawn - judged, "not judged: the command was interrupted"),
    ] {
        if count > 0 {
            parts.push(format!("{count} {what}"));
        }
    }
    writeln!(shell.out(), "{}", parts.join(", "))?;
    if mutated.kept > 0 {
        writeln!(shell.out(), "{} judged before, with the same texts", mutated.kept)?;
    }
    if let (Some(percent), Some(of_all)) = (score.percent(), score.percent_of_all()) {
        let mut line = format!("score {percent:.1} %");
        if let Some(interval) = score.interval().filter(|_| sampled && drawn < bench.mutants) {
            line += &format!(", of all between {:.1} % and {:.1} %", 100.0 * interval.low, 100.0 * interval.high);
        }
        if score.equivalent > 0 {
            line += &format!("; {of_all:.1} % with the equivalent ones counted as survivors");
        }
        writeln!(shell.out(), "{line}")?;
    }
    if bench.candidates.iter().any(|candidate| !candidate.components.is_empty()) {
        writeln!(shell.out(), "killed of those killed or survived:")?;
        parts_of_system(shell, mutated)?;
    }
    Ok(())
}

/// Of a system, how many mutants of the chart were killed, and of each machine by which its components decide.
fn parts_of_system(shell: &mut Shell, mutated: &Mutated) -> Result<(), Failure> {
    let mut parts: BTreeMap<(&[String], &str), Vec<&Outcome>> = BTreeMap::new();
    for (candidate, outcome) in mutated.bench.candidates.iter().zip(&mutated.outcomes) {
        let part = (candidate.components.as_slice(), candidate.file.name.as_str());
        parts.entry(part).or_default().extend(outcome);
    }
    for ((components, name), outcomes) in parts {
        let score = score(outcomes);
        let (killed, of, within) = (score.killed(), score.noticeable(), within(components));
        writeln!(shell.out(), "  {killed} of {of} in {name}{within}")?;
    }
    Ok(())
}
