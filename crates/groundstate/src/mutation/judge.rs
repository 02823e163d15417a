//! Judges one mutant after the other.
//!
//! In: a [`Bench`], a mutant's number, a [`Timer`]. Out: the [`Outcome`]. First come the properties, model by model, then the
//! scenarios; the first check that notices the mutant ends it. What survives is compared with the model itself.
//! INVARIANT: a worker's texts are those of the disk again when a mutant is judged.

use std::sync::Arc;

use machine::{FaultKind, Interrupt};
use mutate::{Differs, Extent, Operator, Variant, same};
use scenario::FailureKind;
use verify::{NoStart, Reason, Report, Stop, Subject};

use super::ask::Asked;
use super::base::{Bench, Judge, asked, play_options, texts_of};
use super::drawn::{self, Trouble, declare_alike};
use super::link::{self, Link, Says};
use super::outcome::{By, Killed, Outcome, Proof, Unseen};
use super::{Candidate, Timer};
use crate::tell::Verdicts;
use crate::workspace::{Files, tidy};
use crate::{SeededChoices, Suite, Workspace};

/// Judges mutants.
#[derive(Debug)]
pub struct Worker<F> {
    bench: Arc<Bench>,
    workspace: Workspace<F>,
    version: i64,
}

/// What a model says of a mutant that it does not kill.
enum Said {
    /// All is as it was; so many states were visited, if all were.
    Passes(Option<u64>),
    /// A limit was reached.
    Open(String),
}

impl<F: Files> Worker<F> {
    /// A worker who reads texts from these files.
    pub fn new(bench: &Arc<Bench>, files: F) -> Worker<F> {
        let mut workspace = Workspace::new(files);
        for drawn in &bench.drawn {
            // Perhaps it was never written. No text is newer than the first one.
            let _ = workspace.set_text(&drawn.model, 0, drawn.text.as_str());
        }
        Worker { bench: Arc::clone(bench), workspace, version: 0 }
    }

    /// Judges the mutant of this number.
    pub fn judge(&mut self, number: usize, timer: &dyn Timer) -> Outcome {
        let bench = Arc::clone(&self.bench);
        let candidate = &bench.candidates[number];
        let text = mutate::applied(&candidate.file.text, &candidate.mutant.edits);
        self.version += 1;
        let path = candidate.file.name.as_str();
        if self.workspace.set_text(path, self.version, text).is_err() {
            return Outcome::Open("its text could not be set".to_string());
        }
        let interrupt = timer.begin();
        let outcome = self.build(&bench, candidate).and_then(|()| self.judged(&bench, candidate, &interrupt));
        timer.end(&interrupt);
        self.workspace.close(path);
        for drawn in bench.drawn.iter().filter(|drawn| candidate.builds.contains(&drawn.model)) {
            self.version += 1;
            let _ = self.workspace.set_text(&drawn.model, self.version, drawn.text.as_str());
        }
        outcome.unwrap_or_else(|outcome| outcome)
    }

    /// Builds the models of the charts of which the mutant is a part.
    fn build(&mut self, bench: &Bench, candidate: &Candidate) -> Result<(), Outcome> {
        for base in bench.drawn.iter().filter(|drawn| candidate.builds.contains(&drawn.model)) {
            let drawn = drawn::built(&base.chart.name, base.is_new, &mut self.workspace);
            let drawn = drawn.map_err(|trouble| not_compiled(&trouble.faults))?;
            // An initial state that is not the chart's own is kept, so the model would not show the fault.
            if candidate.mutant.operator == Operator::StartMoved && drawn.text == base.text {
                return Err(Outcome::Open(format!("{} keeps its own initial state", base.model)));
            }
            let set = self.workspace.set_text(&drawn.model, self.version, drawn.text);
            set.map_err(|_| Outcome::Open("its model could not be set".to_string()))?;
        }
        Ok(())
    }

    /// The outcome; as an error if it ends the judgement early.
    fn judged(&mut self, bench: &Bench, candidate: &Candidate, interrupt: &Interrupt) -> Result<Outcome, Outcome> {
        let mut open = None;
        let mut variants = Vec::new();
        let mut is_left_out = false;
        for judge in candidate.models.iter().map(|index| &bench.judges[*index]) {
            if judge.never_runs(candidate) {
                continue;
            }
            let asked = asked((&judge.path, judge.system.is_some()), judge.beside.as_ref(), &mut self.workspace);
            let (loaded, asked) = asked.map_err(refused)?;
            // A machine on which no property of the system rests is no part of the model that verifies it.
            if judge.system.as_ref().is_some_and(|texts| *texts == texts_of(&loaded)) {
                is_left_out = true;
                continue;
            }
            let asked = asked.counting(&judge.counting);
            let said = match bench.wanted.verify {
                true => verified(bench, judge, &asked, interrupt)?,
                false => Said::Passes(None),
            };
            match said {
                Said::Passes(states) => variants.push((judge, asked, states)),
                Said::Open(why) => open = Some(why),
            }
        }
        self.played(bench, candidate, interrupt, &mut open)?;
        self.refined(bench, candidate, interrupt, &mut open)?;
        if let Some(why) = open {
            return Ok(Outcome::Open(why));
        }
        Ok(match compared(bench, candidate, variants, interrupt) {
            Outcome::Survived(Unseen::Nowhere) if is_left_out => Outcome::Survived(Unseen::LeftOut),
            outcome => outcome,
        })
    }

    /// Runs the scenarios that run the mutated text.
    fn played(
        &mut self,
        bench: &Bench,
        candidate: &Candidate,
        interrupt: &Interrupt,
        open: &mut Option<String>,
    ) -> Result<(), Outcome> {
        let mut suite = Suite::new();
        let options = play_options(&bench.wanted.extent, interrupt);
        for play in bench.plays.iter().filter(|play| candidate.is_in(&play.files)) {
            let Ok(source) = self.workspace.text(&play.path) else { continue };
            let texts = &mut self.workspace.texts();
            let tested = suite.test(source, texts, options.clone(), &mut SeededChoices::new(0));
            let Some(verdict) = &tested.verdict else { return Err(not_compiled(&tested.failures())) };
            if verdict.passed() {
                continue;
            }
            let at_limit = verdict.failures().iter().any(|failure| {
                matches!(&failure.kind, FailureKind::Fault { fault, .. }
                    if matches!(fault.kind, FaultKind::Limit { .. } | FaultKind::Interrupted(_)))
            });
            if at_limit {
                *open = Some(format!("{} reached a limit", play.path));
                continue;
            }
            let by = By::Scenario { path: play.path.clone() };
            return Err(Outcome::Killed(Killed { by, steps: verdict.steps }));
        }
        Ok(())
    }
}

impl<F: Files> Worker<F> {
    /// Asks the couplings that are about the mutated text.
    fn refined(
        &mut self,
        bench: &Bench,
        candidate: &Candidate,
        interrupt: &Interrupt,
        open: &mut Option<String>,
    ) -> Result<(), Outcome> {
        for link in bench.links.iter().filter(|link| candidate.is_in(&link.files)) {
            match link::ask(&link.path, &mut self.workspace, &bench.wanted.extent, interrupt).1 {
                Says::Refines => {}
                Says::DoesNot(steps) => {
                    let by = By::Refinement { path: link.path.clone() };
                    return Err(Outcome::Killed(Killed { by, steps }));
                }
                Says::Open(why) => *open = Some(why),
                Says::Unfit(_, _, faults) => return Err(not_compiled(&faults)),
            }
        }
        Ok(())
    }
}

impl Judge {
    /// Whether the mutant is in a rule that no reachable state runs.
    fn never_runs(&self, candidate: &Candidate) -> bool {
        let place = &candidate.mutant.place;
        candidate.mutant.function.is_none()
            && self.never.iter().any(|(path, bytes)| {
                tidy(&candidate.file.name) == *path && bytes.start <= place.start && place.end <= bytes.end
            })
    }
}

fn refused(trouble: Trouble) -> Outcome {
    match trouble.faults.is_empty() {
        true => Outcome::Open(trouble.why),
        false => not_compiled(&trouble.faults),
    }
}

fn not_compiled(faults: &[syntax::Diagnostic]) -> Outcome {
    let error = faults.iter().find(|fault| fault.severity == syntax::Severity::Error);
    Outcome::NotCompiled(error.map_or_else(String::new, |fault| fault.message.clone()))
}

/// Verifies a mutant, up to the first violation.
fn verified(bench: &Bench, judge: &Judge, asked: &Asked, interrupt: &Interrupt) -> Result<Said, Outcome> {
    let killed =
        |name: String, steps| Outcome::Killed(Killed { by: By::Property { model: judge.path.clone(), name }, steps });
    let depth = judge.counting.depth;
    let report = match asked.verified(&bench.wanted.extent, (depth, true), interrupt) {
        Ok(report) => report,
        Err(NoStart::Fault(_)) => return Err(killed("the initial state can be made".to_string(), 0)),
        Err(_) => return Ok(Said::Open(limit(None, interrupt))),
    };
    // Without any run, everything holds.
    if report.progress.states == 0 && judge.states.is_some_and(|states| states > 0) && report.stop.is_none() {
        return Err(killed("some initial state satisfies the assumptions".to_string(), 0));
    }
    let mut violated: Vec<(Subject, u64)> = report
        .verdicts
        .iter()
        .filter_map(|verdict| match &verdict.outcome {
            verify::Outcome::Violated(trace) => Some((verdict.subject, trace.steps.len() as u64)),
            _ => None,
        })
        .collect();
    violated.retain(|(_, steps)| depth.is_none_or(|depth| *steps <= depth));
    // A property says more than a built-in check.
    violated.sort_by_key(|(subject, steps)| (!matches!(subject, Subject::Property(_)), *steps));
    if let Some((subject, steps)) = violated.first() {
        let name = Verdicts::new(asked.program(), &asked.overlay.sources, false).name(*subject);
        return Err(killed(name, *steps));
    }
    Ok(match open(&report, depth) {
        Some(stop) => Said::Open(limit(stop, interrupt)),
        None => Said::Passes(report.stop.is_none().then_some(report.progress.states)),
    })
}

/// Why it is not known whether a mutant passes, if it is not.
fn open(report: &Report, depth: Option<u64>) -> Option<Option<Stop>> {
    let as_the_model = |reason: &Reason| match reason {
        Reason::Bounded(_) => true,
        Reason::Stopped(Stop::Depth) => depth.is_some(),
        _ => false,
    };
    let known = report.verdicts.iter().all(|verdict| match &verdict.outcome {
        verify::Outcome::Holds => true,
        verify::Outcome::Violated(_) => false,
        verify::Outcome::Unknown(reasons) => reasons.iter().all(as_the_model),
    });
    (!known).then_some(report.stop)
}

/// The limit that was reached, as a clause.
fn limit(stop: Option<Stop>, interrupt: &Interrupt) -> String {
    let reached = match stop {
        _ if interrupt.is_raised() => "the time was up",
        Some(Stop::States) => "the limit of states was reached",
        Some(Stop::Memory) => "the limit of memory was reached",
        Some(Stop::Depth | Stop::Disk | Stop::Asked | Stop::Found) | None => "a check could not be decided",
    };
    reached.to_string()
}

/// Compares a mutant that nobody noticed with the model.
fn compared(
    bench: &Bench,
    candidate: &Candidate,
    variants: Vec<(&Judge, Asked, Option<u64>)>,
    interrupt: &Interrupt,
) -> Outcome {
    let runs = !variants.is_empty();
    let is_bounded = candidate.models.iter().any(|index| !bench.judges[*index].asked.bounds.is_empty());
    let (mut more, mut steps, mut unmeasured) = (0, false, false);
    for (judge, mutated, states) in variants {
        match (judge.states, states) {
            (Some(one), Some(other)) if one != other => {
                more += one.abs_diff(other);
                continue;
            }
            // The model's own states were not all visited.
            (None, _) if bench.wanted.verify => {
                unmeasured = true;
                continue;
            }
            _ => {}
        }
        match are_same(bench, candidate, judge, mutated, interrupt) {
            Ok(()) => {}
            Err(Differs::Somewhere) => steps = true,
            Err(Differs::TooFar | Differs::Beyond) => unmeasured = true,
        }
    }
    // A model of a coupling that does not judge by its properties was not explored.
    let explored = |model: &String| candidate.models.iter().any(|index| bench.judges[*index].path == *model);
    let about = |link: &&Link| candidate.is_in(&link.files);
    let all = bench.links.iter().filter(about).all(|link| link.models.iter().all(explored));
    // The model that verifies a system leaves out what no property looks at.
    let all = all && !candidate.models.iter().any(|index| bench.judges[*index].system.is_some());
    match (more, steps, unmeasured) {
        (0, false, false) if candidate.models.is_empty() => Outcome::Survived(Unseen::Unmeasured),
        (0, false, false) if !(bench.wanted.whole && all) => Outcome::Survived(Unseen::Nowhere),
        // Other values of the inputs may get to where it shows.
        (0, false, false) if is_bounded => Outcome::Survived(Unseen::WithinBounds),
        (0, false, false) if runs => Outcome::Equivalent(Proof::SameSteps),
        (0, false, false) => Outcome::Equivalent(Proof::NeverRuns),
        (0, true, _) => Outcome::Survived(Unseen::Steps),
        (0, false, true) => Outcome::Survived(Unseen::Unmeasured),
        (more, ..) => Outcome::Survived(Unseen::States(more)),
    }
}

fn are_same(
    bench: &Bench,
    candidate: &Candidate,
    judge: &Judge,
    mut mutated: Asked,
    interrupt: &Interrupt,
) -> Result<(), Differs> {
    let mut asked = judge.asked.clone();
    if !candidate.builds.is_empty() && !declare_alike(asked.program(), mutated.program()) {
        return Err(Differs::Beyond);
    }
    let mut observed = [Vec::new(), Vec::new()];
    // In a system, functions of a machine have other names; nothing is equivalent there.
    let function = candidate.mutant.function.as_ref().filter(|_| judge.system.is_none());
    if let Some(function) = function {
        for (asked, observed) in [&mut asked, &mut mutated].into_iter().zip(&mut observed) {
            observed.push(asked.values_of(&function.name, &function.parameters).ok_or(Differs::Beyond)?);
        }
    }
    let extent = Extent {
        limits: bench.wanted.extent.limits.clone(),
        bounds: asked.bounds.clone(),
        undefined: asked.undefined.clone(),
        max_states: bench.wanted.extent.max_states,
        interrupt: interrupt.clone(),
    };
    let [one, other] = &observed;
    let one = Variant { program: asked.program(), observed: one };
    same(one, Variant { program: mutated.program(), observed: other }, &extent)
}
