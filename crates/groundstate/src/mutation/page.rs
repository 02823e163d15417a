//! A mutation analysis as the page of `report` shows it.
//!
//! In: the bench, and the outcomes by mutant. Out: plain data. INVARIANT: each mutant is on the page, also one that was not judged.

use report::{Fate, JudgedMutant, MutatedFile, MutationAnalysis};

use super::{Bench, By, Candidate, Judging, Killed, Outcome, score, surprising};

/// The analysis; `sampled` if the mutants are a sample of all.
pub fn mutation_page(bench: &Bench, outcomes: &[Option<Outcome>], sampled: bool) -> MutationAnalysis {
    let mut files: Vec<MutatedFile> = Vec::new();
    let mut mutants = Vec::new();
    let with: Vec<(Candidate, Outcome)> = bench
        .candidates
        .iter()
        .zip(outcomes)
        .filter_map(|(candidate, outcome)| Some((candidate.clone(), outcome.clone()?)))
        .collect();
    let left = bench.candidates.iter().zip(outcomes).filter(|(_, outcome)| outcome.is_none());
    let survivors =
        surprising(&with).into_iter().map(|(candidate, unseen)| (candidate, Some(Outcome::Survived(unseen))));
    let others = with.iter().filter(|(_, outcome)| !matches!(outcome, Outcome::Survived(_)));
    let others = others.map(|(candidate, outcome)| (candidate, Some(outcome.clone())));
    for (candidate, outcome) in survivors.chain(others).chain(left.map(|(candidate, _)| (candidate, None))) {
        let path = &candidate.file.name;
        let file = files.iter().position(|file| file.path == *path).unwrap_or_else(|| {
            files.push(MutatedFile { path: path.clone(), text: candidate.file.text.to_string() });
            files.len() - 1
        });
        let (place, change) = (candidate.place(), candidate.change());
        let last = candidate.file.line_column(candidate.mutant.place.end as u32);
        mutants.push(JudgedMutant {
            file,
            lines: (place.line as usize, last.line as usize),
            column: place.column as usize,
            operator: candidate.mutant.operator.id().to_string(),
            meaning: candidate.mutant.operator.meaning().to_string(),
            fate: fate(outcome.as_ref()),
            remark: outcome.as_ref().map_or("the analysis was ended before".to_string(), Outcome::remark),
            before: change.before,
            after: change.after,
        });
    }
    // The survivors come first on the page; the texts come in the order of their names.
    let mut order: Vec<usize> = (0..files.len()).collect();
    order.sort_by(|one, other| files[*one].path.cmp(&files[*other].path));
    for mutant in &mut mutants {
        mutant.file = order.iter().position(|file| *file == mutant.file).unwrap_or_default();
    }
    files.sort_by(|one, other| one.path.cmp(&other.path));
    let score = score(with.iter().map(|(_, outcome)| outcome));
    let Judging { models, scenarios, couplings } = bench.judging();
    let texts = |paths: Vec<&str>| paths.into_iter().map(str::to_string).collect();
    let interval = score.interval().filter(|_| sampled && bench.candidates.len() < bench.mutants);
    MutationAnalysis {
        title: title(&files),
        score: score.percent(),
        interval: interval.map(|interval| (100.0 * interval.low, 100.0 * interval.high)),
        total: bench.mutants,
        models: texts(models),
        scenarios: texts(scenarios),
        couplings: couplings.map(texts),
        files,
        mutants,
    }
}

fn title(files: &[MutatedFile]) -> String {
    let name = |file: &MutatedFile| file.path.rsplit(['/', '\\']).next().unwrap_or_default().to_string();
    match files {
        [] => "no text".to_string(),
        [one] => name(one),
        [one, other] => format!("{} and {}", name(one), name(other)),
        [one, others @ ..] => format!("{} and {} other texts", name(one), others.len()),
    }
}

fn fate(outcome: Option<&Outcome>) -> Fate {
    match outcome {
        None => Fate::NotJudged,
        Some(Outcome::Killed(Killed { by: By::Property { name, .. }, .. })) => Fate::Killed(name.clone()),
        Some(Outcome::Killed(Killed { by: By::Scenario { path } | By::Refinement { path }, .. })) => {
            Fate::Killed(path.clone())
        }
        Some(Outcome::Survived(_)) => Fate::Survived,
        Some(Outcome::Equivalent(_)) => Fate::Equivalent,
        Some(Outcome::Open(_)) => Fate::Unknown,
        Some(Outcome::NotCompiled(_)) => Fate::Refused,
    }
}
