//! The bench: whether models and scenarios accept the model as it is, and which mutants they are to judge.
//!
//! In: what is [`Wanted`], and the texts. Out: a [`Bench`], which all workers share. INVARIANT: a check that does not hold
//! of the model as it is judges nothing; one that a limit left open counts only as far as the search came.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use machine::Interrupt;
use mutate::mutants;
use scenario::Options;
use simulate::SplitMix;
use syntax::{Diagnostic, SourceFile, Sources};
use verify::{NoStart, Outcome, Reason, Report, Stop, Subject};

use super::ask::{Asked, Counting};
use super::{Candidate, Extent, Wanted};
use crate::tell::Verdicts;
use crate::workspace::{Files, NotLoaded, tidy};
use crate::{Faulty, Loaded, SeededChoices, Suite, Workspace, own_files};

/// A model or a scenario that cannot judge.
#[derive(Debug)]
pub struct Unfit {
    /// Its path.
    pub path: String,
    /// Why, as a clause after the path.
    pub why: String,
    /// The texts that the faults refer to.
    pub sources: Sources,
    /// The faults.
    pub faults: Vec<Diagnostic>,
}

/// A model that judges.
#[derive(Debug)]
pub(super) struct Judge {
    pub path: String,
    pub beside: Option<SourceFile>,
    /// The model as it is.
    pub asked: Asked,
    pub counting: Counting,
    /// The number of reachable states, if all were visited.
    pub states: Option<u64>,
    /// Places that no step runs: paths and bytes.
    pub never: Vec<(String, std::ops::Range<usize>)>,
}

/// A scenario that judges.
#[derive(Debug)]
pub(super) struct Play {
    pub path: String,
    /// The paths of the texts that it runs.
    pub files: BTreeSet<String>,
}

/// Who judges, and what.
#[derive(Debug)]
pub struct Bench {
    pub(super) wanted: Wanted,
    pub(super) judges: Vec<Judge>,
    pub(super) plays: Vec<Play>,
    /// The mutants to judge.
    pub candidates: Vec<Candidate>,
    /// How many mutants there are, of which these may be a sample.
    pub mutants: usize,
    /// Models and scenarios that cannot judge.
    pub unfit: Vec<Unfit>,
}

impl Bench {
    /// Verifies the models and runs the scenarios as they are, and makes the mutants. `say` hears what comes next.
    pub fn new<F: Files>(
        wanted: Wanted,
        workspace: &mut Workspace<F>,
        interrupt: &Interrupt,
        say: &mut dyn FnMut(&str),
    ) -> Bench {
        let mut bench = Bench { wanted, judges: vec![], plays: vec![], candidates: vec![], mutants: 0, unfit: vec![] };
        let mut made: BTreeMap<(String, usize, usize, Vec<String>), Candidate> = BTreeMap::new();
        for path in bench.wanted.models.clone() {
            if interrupt.is_raised() {
                break;
            }
            let loaded = match workspace.load(&path) {
                Ok(loaded) => loaded,
                Err(NotLoaded::Absent(absent)) => {
                    bench.unfit(&path, absent.told(&path), Sources::default(), Vec::new());
                    continue;
                }
                Err(NotLoaded::Faulty(faulty)) => {
                    let Faulty { sources, diagnostics } = *faulty;
                    bench.unfit(&path, "has faults".to_string(), sources, diagnostics);
                    continue;
                }
            };
            if loaded.model.main.is_none() || !bench.concerns(&loaded) {
                continue;
            }
            say(&path);
            if let Some(judge) = bench.judge(&path, &loaded, workspace, interrupt) {
                bench.collect(&loaded, &mut made);
                bench.judges.push(judge);
            }
        }
        if bench.wanted.test {
            bench.play(workspace, interrupt, say);
        }
        bench.candidates = made.into_values().collect();
        bench.mutants = bench.candidates.len();
        bench.draw();
        bench
    }

    /// The paths of the models and scenarios that judge.
    pub fn judging(&self) -> (Vec<&str>, Vec<&str>) {
        let models = self.judges.iter().map(|judge| judge.path.as_str());
        (models.collect(), self.plays.iter().map(|play| play.path.as_str()).collect())
    }

    fn unfit(&mut self, path: &str, why: String, sources: Sources, faults: Vec<Diagnostic>) {
        self.unfit.push(Unfit { path: path.to_string(), why, sources, faults });
    }

    /// Whether a text is to be mutated.
    fn is_mutated(&self, name: &str) -> bool {
        self.wanted.mutated.contains(&tidy(name))
    }

    /// Whether a model has a text to be mutated.
    fn concerns(&self, loaded: &Loaded) -> bool {
        loaded.sources.iter().any(|(_, file)| self.is_mutated(&file.name))
    }

    fn collect(&self, loaded: &Loaded, made: &mut BTreeMap<(String, usize, usize, Vec<String>), Candidate>) {
        let own = own_files(&loaded.sources);
        for (id, file) in loaded.sources.iter() {
            let name = tidy(&file.name);
            if !own(id) || !(self.wanted.imports || self.is_mutated(&name)) {
                continue;
            }
            let shared = Arc::new(SourceFile::new(name.clone(), Arc::clone(&file.text)));
            for mutant in mutants(&loaded.model, &loaded.sources, id) {
                let line = file.line_column(mutant.place.start as u32).line;
                let last = file.line_column(mutant.place.end as u32).line;
                let lines = self.wanted.lines.as_ref().map(|lines| lines.get(&name).map_or(&[][..], Vec::as_slice));
                let touched = |lines: &[_]| {
                    lines
                        .iter()
                        .any(|range: &std::ops::RangeInclusive<u32>| *range.start() <= last && line <= *range.end())
                };
                if !self.wanted.operators.contains(&mutant.operator) || !lines.is_none_or(touched) {
                    continue;
                }
                let texts = mutant.edits.iter().map(|edit| edit.text.clone()).collect();
                let key = (name.clone(), mutant.place.start, mutant.place.end, texts);
                let new = Candidate { file: Arc::clone(&shared), mutant, models: Vec::new() };
                made.entry(key).or_insert(new).models.push(self.judges.len());
            }
        }
    }

    /// Draws a sample.
    fn draw(&mut self) {
        let Some((size, seed)) = self.wanted.sample else { return };
        let mut random = SplitMix::new(seed);
        let mut left = std::mem::take(&mut self.candidates);
        let mut drawn: Vec<usize> = Vec::new();
        let mut numbers: Vec<usize> = (0..left.len()).collect();
        while drawn.len() < size && !numbers.is_empty() {
            drawn.push(numbers.swap_remove(random.below(numbers.len() as u64) as usize));
        }
        drawn.sort_unstable();
        let mut index = 0;
        left.retain(|_| {
            index += 1;
            drawn.binary_search(&(index - 1)).is_ok()
        });
        self.candidates = left;
    }

    /// A model as a judge; none if it does not pass itself.
    fn judge<F: Files>(
        &mut self,
        path: &str,
        loaded: &Loaded,
        workspace: &mut Workspace<F>,
        interrupt: &Interrupt,
    ) -> Option<Judge> {
        let spec = Path::new(path).with_extension("verify.yaml");
        let beside = workspace.text(&spec.to_string_lossy()).ok();
        let asked = match Asked::of(loaded, beside.as_ref(), &mut workspace.texts()) {
            Ok(asked) => asked,
            Err((sources, faults)) => {
                self.unfit(path, "has a .verify.yaml with faults".to_string(), sources, faults);
                return None;
            }
        };
        let mut judge = Judge {
            path: path.to_string(),
            beside,
            asked,
            counting: Counting::default(),
            states: None,
            never: Vec::new(),
        };
        if self.wanted.verify {
            match judge.asked.verified(&self.wanted.extent, (None, false), interrupt) {
                Ok(report) => match counting(&report, &judge.asked) {
                    Ok(counting) => {
                        judge.note(&report, loaded, counting);
                    }
                    Err(why) => {
                        self.unfit(path, why, Sources::default(), Vec::new());
                        return None;
                    }
                },
                Err(NoStart::Fault(fault)) => {
                    let fault = crate::diagnose_fault(&fault, judge.asked.program());
                    self.unfit(path, "has no initial state".to_string(), loaded.sources.clone(), vec![fault]);
                    return None;
                }
                Err(NoStart::Stopped(_)) if interrupt.is_raised() => return None,
                Err(_) => {
                    let why = "has initial states that cannot be listed".to_string();
                    self.unfit(path, why, Sources::default(), Vec::new());
                    return None;
                }
            }
        }
        judge.asked = judge.asked.clone().counting(&judge.counting);
        Some(judge)
    }

    /// Runs the scenarios that run a text to be mutated, and keeps those that pass.
    fn play<F: Files>(&mut self, workspace: &mut Workspace<F>, interrupt: &Interrupt, say: &mut dyn FnMut(&str)) {
        let mut suite = Suite::new();
        for path in self.wanted.scenarios.clone() {
            if interrupt.is_raised() {
                break;
            }
            let source = match workspace.text(&path) {
                Ok(source) => source,
                Err(absent) => {
                    self.unfit(&path, absent.told(&path), Sources::default(), Vec::new());
                    continue;
                }
            };
            say(&path);
            let tested = suite.test(
                source,
                &mut workspace.texts(),
                play_options(&self.wanted.extent, interrupt),
                &mut SeededChoices::new(0),
            );
            let files: BTreeSet<String> = tested.sources.iter().map(|(_, file)| tidy(&file.name)).collect();
            let concerned = match self.wanted.imports {
                true => self.judges.iter().any(|judge| files.contains(&tidy(&judge.path))),
                false => files.iter().any(|file| self.wanted.mutated.contains(file)),
            };
            match (concerned, tested.passed()) {
                (true, true) => self.plays.push(Play { path, files }),
                (true, false) if interrupt.is_raised() => break,
                (true, false) => {
                    let faults = tested.failures();
                    self.unfit(&path, "fails with the model as it is".to_string(), tested.sources, faults);
                }
                (false, _) => {}
            }
        }
    }
}

/// How scenarios are run.
pub(super) fn play_options(extent: &Extent, interrupt: &Interrupt) -> Options {
    let mut options = Options { limits: extent.limits.clone(), ..Options::default() };
    options.limits.interrupt = interrupt.clone();
    options
}

impl Judge {
    fn note(&mut self, report: &Report, loaded: &Loaded, counting: Counting) {
        let stopped = report.stop.is_some();
        self.states = (!stopped).then_some(report.progress.states);
        self.counting = counting;
        let place = |span: &syntax::Span| (tidy(&loaded.sources.file(span.file).name), span.range());
        // The list is empty unless every state was visited.
        self.never = report.unreachable.iter().map(place).collect();
    }
}

/// Which checks count, or why none does, as a clause about the model.
fn counting(report: &Report, asked: &Asked) -> Result<Counting, String> {
    let program = asked.program();
    let mut counting = Counting { left_out: vec![false; program.properties.len()], ..Counting::default() };
    if report.stop.is_some() {
        counting.depth = Some(report.progress.depth.saturating_sub(1));
    }
    for verdict in &report.verdicts {
        match (&verdict.outcome, verdict.subject) {
            (Outcome::Holds, _) => {}
            (Outcome::Violated(_), Subject::NoDeadlock) => counting.may_rest = true,
            (Outcome::Violated(_), subject) => {
                let name = Verdicts::new(program, &asked.overlay.sources, false).name(subject);
                return Err(format!("does not pass as it is: {name} is violated"));
            }
            (Outcome::Unknown(reasons), _) if reasons.contains(&Reason::Vacuous) => {
                return Err("has no initial state that satisfies its assumptions".to_string());
            }
            (Outcome::Unknown(reasons), subject) => {
                // What was not found within the same bounds, or in the same number of steps, counts if it is found then.
                let bounded = |reason: &Reason| {
                    matches!(reason, Reason::Bounded(_) | Reason::Stopped(Stop::States | Stop::Depth | Stop::Memory))
                };
                match subject {
                    // With bounds no state is known to have no step.
                    Subject::NoDeadlock => counting.may_rest = true,
                    _ if !reasons.is_empty() && reasons.iter().all(bounded) => {}
                    Subject::Property(index) => counting.left_out[index] = true,
                    Subject::Consistent | Subject::InDomain | Subject::Defined => {}
                }
            }
        }
    }
    Ok(counting)
}
