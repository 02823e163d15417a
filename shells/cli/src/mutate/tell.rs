//! Tells what became of mutants: those that survive as differences with places, then the count.
//!
//! In: the outcomes. Out: text or JSON, and the exit code.

use std::io::Write;

use groundstate::job::Mutated;
use groundstate::mutate::Change;
use groundstate::mutation::{By, Candidate, Killed, Outcome, Proof, Score, Unseen, score, surprising};
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
            let told = match outcome {
                Outcome::Killed(Killed { by: By::Property { model, name }, steps }) => {
                    format!("by {name} of {model}, after {}", plural(*steps as usize, "step"))
                }
                Outcome::Killed(Killed { by: By::Scenario { path }, steps }) => {
                    format!("by {path}, after {}", plural(*steps as usize, "step"))
                }
                Outcome::Equivalent(Proof::NeverRuns) => "no reachable state runs it".to_string(),
                Outcome::Equivalent(Proof::SameSteps) => "the same steps from every reachable state".to_string(),
                Outcome::Survived(_) | Outcome::Open(_) | Outcome::NotCompiled(_) => continue,
            };
            let word = if matches!(outcome, Outcome::Killed(_)) { "killed" } else { "equivalent" };
            one(shell, word, candidate, &told)?;
        }
    }
    for (candidate, outcome) in judged {
        match outcome {
            Outcome::Open(why) => one(shell, "unknown", candidate, why)?,
            Outcome::NotCompiled(why) => one(shell, "refused", candidate, why)?,
            Outcome::Killed(_) | Outcome::Survived(_) | Outcome::Equivalent(_) => {}
        }
    }
    for (candidate, unseen) in surprising(judged) {
        let told = match unseen {
            Unseen::States(1) => "one reachable state more or less".to_string(),
            Unseen::States(more) => format!("{more} reachable states more or fewer"),
            Unseen::Steps => "as many states, other steps".to_string(),
            Unseen::Nowhere => "no reachable state differs".to_string(),
            Unseen::WithinBounds => "no reachable state differs within the bounds of inputs".to_string(),
            Unseen::Unmeasured => "not compared in every state".to_string(),
        };
        one(shell, "survived", candidate, &told)?;
    }
    Ok(())
}

/// A mutant: what became of it, where it is, what it changes.
fn one(shell: &mut Shell, word: &str, candidate: &Candidate, told: &str) -> Result<(), Failure> {
    let (place, name) = (candidate.place(), &candidate.file.name);
    let operator = candidate.mutant.operator.id();
    writeln!(shell.out(), "{word:<9} {name}:{}:{} {operator}: {told}", place.line, place.column)?;
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
    let (models, scenarios) = bench.judging();
    let drawn = bench.candidates.len();
    let of = if sampled && drawn < bench.mutants { format!("{drawn} of {}", bench.mutants) } else { drawn.to_string() };
    let word = if drawn == 1 && !of.contains(' ') { "mutant" } else { "mutants" };
    writeln!(
        shell.out(),
        "{of} {word}, judged by {} and {}",
        plural(models.len(), "model"),
        plural(scenarios.len(), "scenario")
    )?;
    let mut parts =
        vec![format!("{} killed ({} by properties, {} by scenarios)", score.killed(), score.by_verify, score.by_test)];
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
    Ok(())
}
