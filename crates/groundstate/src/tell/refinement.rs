//! Describes the result of a refinement check as text for people: the verdict, and where it fails both runs side by side.
//!
//! In: a report, the coupling, the two models. Out: lines. INVARIANT: the steps have the words that [`Verdicts`] has for runs.

use std::collections::BTreeMap;

use explore::Told;
use model::PropertyKind;
use program::Property;
use refine::{
    ABSTRACT, Assumed, CONCRETE, Coupling, Ended, From, Incomparable, LeftOut, MOST, Preserved, Refutation, Report,
    Run, SIDES, Trouble, Vacuous, Verdict, Why,
};
use syntax::Diagnostic;
use verify::{Outcome, Trace};

use super::{FoundStep, Verdicts, plural};
use crate::Loaded;

/// LIMIT: the column of names is as wide at most.
const WIDTH: usize = 56;
/// LIMIT: so many parts of the coupling are listed.
const PARTS: usize = 8;
/// What is said in lines is broken behind so many characters.
const LINE: usize = 100;

/// Describes a refinement check.
#[derive(Debug)]
pub struct Refinements<'a> {
    /// The abstract and the concrete model.
    pub models: [&'a Loaded; 2],
    /// How they are coupled.
    pub coupling: &'a Coupling,
    /// Whether the search stopped because its time was up.
    pub timed_out: bool,
    /// Whether all of the first states and of the coupling is told, or what matters.
    pub all: bool,
    /// What was found of the abstract machine's properties, by their index; none if nobody asked.
    pub verified: Option<&'a BTreeMap<usize, Outcome>>,
}

/// What is known of a property of the abstract machine in the concrete one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// It does not come along.
    Stays,
    /// It comes along, and nobody asked whether the abstract machine has it.
    Conditional,
    /// It holds of the abstract machine, and so of the concrete one.
    Holds,
    /// The abstract machine does not have it.
    Violated,
    /// It is not known whether the abstract machine has it.
    Unknown,
}

/// A run of a machine as other commands know it.
pub fn trace_of(run: &Run) -> Trace {
    Trace { start: run.start.clone(), values: run.values.clone(), steps: run.steps.clone(), ..Trace::default() }
}

impl Refinements<'_> {
    /// Describes the runs of one side.
    pub fn side(&self, side: usize) -> Verdicts<'_> {
        Verdicts::new(&self.models[side].program, &self.models[side].sources, false)
    }

    /// The steps of a run in words, the initial state first.
    pub fn steps(&self, side: usize, run: &Run) -> Vec<FoundStep> {
        self.side(side).steps(&trace_of(run))
    }

    /// Steps of the abstract machine in words.
    pub fn tried(&self, steps: &[Told]) -> Vec<FoundStep> {
        let run = Run { steps: steps.to_vec(), ..Run::default() };
        self.steps(ABSTRACT, &run).into_iter().skip(1).collect()
    }

    /// The whole report as lines.
    pub fn report(&self, report: &Report) -> String {
        let mut lines = self.verdict(&report.verdict);
        if let (Verdict::Unknown(whys), Some(proof)) = (&report.verdict, &report.proof)
            && whys.contains(&Why::Unproved)
        {
            lines = vec![format!("not known: {}", self.gap(proof))];
        }
        if let (Verdict::Unknown(whys), Some(runs)) = (&report.verdict, &report.runs)
            && whys.contains(&Why::NoRun)
        {
            lines = vec![format!("not known: {}", self.no_run(runs))];
        }
        lines.extend(self.extent(report));
        lines.extend(self.properties(report));
        lines.iter().map(|line| format!("{}\n", line.trim_end())).collect()
    }

    fn verdict(&self, verdict: &Verdict) -> Vec<String> {
        match verdict {
            Verdict::Refines => vec!["refines".to_string()],
            Verdict::DoesNot(refutation) => {
                let mut lines = vec![format!("does not refine: {}", self.reason(verdict))];
                lines.extend(self.runs(refutation));
                lines.extend(self.end(refutation));
                lines
            }
            Verdict::Unknown(_) => vec![format!("not known: {}", self.reason(verdict))],
            Verdict::Vacuous(vacuous) => {
                let mut lines = vec![format!("says nothing: {}", self.reason(verdict))];
                if let Vacuous::NoInitialPair(refutation) = vacuous {
                    lines.extend(self.runs(refutation));
                    lines.extend(self.end(refutation));
                }
                lines
            }
        }
    }

    /// Why the verdict is what it is, in a sentence; nothing if it refines.
    pub fn reason(&self, verdict: &Verdict) -> String {
        match verdict {
            Verdict::Refines => String::new(),
            Verdict::DoesNot(refutation) => self.headline(refutation),
            Verdict::Unknown(whys) => whys.iter().map(|why| self.why(why)).collect::<Vec<_>>().join("; "),
            Verdict::Vacuous(vacuous) => self.emptiness(vacuous),
        }
    }

    /// Why it does not refine, in one line.
    pub fn headline(&self, refutation: &Refutation) -> String {
        let steps = refutation.runs[CONCRETE].steps.len();
        match &refutation.ended {
            Ended::Unmatched { .. } if steps == 0 => {
                "an initial state of the concrete machine has no match".to_string()
            }
            Ended::Unmatched { .. } => format!("nothing matches step {steps} of the concrete machine"),
            Ended::Fault => format!("the concrete machine cannot make step {steps}"),
            Ended::Waits(_) => "the concrete machine goes on for ever, and the abstract one makes no step".to_string(),
            Ended::Endless(_) => "the concrete machine goes on for ever, and the segment does not end".to_string(),
        }
    }

    /// Why it is not known, in words.
    pub fn why(&self, why: &Why) -> String {
        match why {
            Why::Pairs(most) => format!("the limit of {most} pairs of states was reached"),
            Why::Steps(most) => format!("the limit of {most} steps was reached"),
            Why::Stopped(machine::Cause::Memory) => "the limit of memory was reached".to_string(),
            Why::Stopped(machine::Cause::Asked) if self.timed_out => "the time was up".to_string(),
            Why::Stopped(machine::Cause::Asked) => "interrupted".to_string(),
            Why::Unbounded(side, unbounded) => {
                let message = self.unbounded(*side, unbounded).message;
                format!("in the {} machine {message}", SIDES[*side])
            }
            Why::Long(MOST) => {
                format!(
                    "a segment has more than {MOST} concrete steps, the most that a diagram may have: let `segment` hold in between"
                )
            }
            Why::Long(most) => format!(
                "a segment has more than {}; `diagrams` may allow more",
                plural(*most as usize, "concrete step")
            ),
            Why::Undistinguished(pairs) => {
                format!("the coupling holds of all {pairs} pairs of states that were compared: it may say nothing")
            }
            Why::Valuations => "inputs that the concrete machine does not look at have too many values".to_string(),
            Why::Unproved => "the proof by induction is not whole".to_string(),
            Why::NoRun => "solvers found no run that is refuted".to_string(),
            Why::Bounded(side, input) => {
                let name = &self.models[*side].program.function(*input).name;
                format!(
                    "the {} machine looks at {name}, and `--bound {name}` leaves out values that it may have",
                    SIDES[*side]
                )
            }
        }
    }

    /// What cannot be gone through, with its place.
    pub fn unbounded(&self, side: usize, unbounded: &explore::Unbounded) -> Diagnostic {
        crate::diagnose_unbounded(unbounded, &self.models[side].program, &self.models[side].sources)
    }

    /// How far the search came and what the verdict rests on.
    fn extent(&self, report: &Report) -> Vec<String> {
        let progress = &report.progress;
        let mut lines = Vec::new();
        if matches!(report.verdict, Verdict::Refines | Verdict::Unknown(_)) {
            lines.extend(self.observed());
        }
        if !report.diagrams.is_empty() {
            let used = report
                .diagrams
                .iter()
                .map(|((m, n), times)| format!("{m}:{n} in {}", plural(*times as usize, "place")));
            lines.push(format!("  diagrams   {}", used.collect::<Vec<_>>().join(", ")));
        }
        let refuted = matches!(report.verdict, Verdict::DoesNot(_));
        let is_reached = report.runs.as_ref().is_some_and(|runs| runs.reached.is_some());
        let proof = report.proof.as_ref().filter(|_| !refuted);
        lines.extend(proof.iter().flat_map(|proof| self.proof(proof, is_reached)));
        lines.extend(report.runs.iter().flat_map(|runs| self.sought(runs, proof.is_some())));
        for (word, names) in [("same input", &self.coupling.inputs), ("free input", &self.coupling.free)] {
            if !names.is_empty() && matches!(report.verdict, Verdict::Refines) {
                lines.push(format!("  {word} {}", names.join(", ")));
            }
        }
        if self.coupling.waiting {
            let what = "the concrete machine does not go on for ever while the abstract one makes no step";
            lines.push(format!("  assumed    {what}"));
        }
        if self.coupling.overflow {
            lines.push("  assumed    no number of the concrete machine leaves 64 bits".to_string());
        }
        for assumed in &report.assumed {
            lines.push(format!("  assumed    {}", self.assumed(assumed)));
        }
        if report.dead_ends > 0 {
            let states = plural(report.dead_ends as usize, "concrete state");
            lines.push(format!("  note: in {states} the assumptions leave no step; a run ends there"));
        }
        if report.idle && matches!(report.verdict, Verdict::Refines) {
            lines.push("  note: the abstract machine makes no step that changes its state".to_string());
        }
        let open = if progress.queue > 0 { format!(" ({} not looked at)", progress.queue) } else { String::new() };
        // What a proof rests on are not the pairs that were searched before it.
        let first = if report.proof.is_some() || report.runs.is_some() { "searched before: " } else { "" };
        lines.push(format!(
            "{first}{}{open} of {} and {}, {} and {}",
            plural(progress.pairs as usize, "pair"),
            plural(progress.states[ABSTRACT] as usize, "abstract state"),
            plural(progress.states[CONCRETE] as usize, "concrete state"),
            plural(progress.steps[ABSTRACT] as usize, "abstract step"),
            plural(progress.steps[CONCRETE] as usize, "concrete step"),
        ));
        lines
    }

    /// An assumption, with the machine that it is about, and where it is said unless that is the model itself.
    fn assumed(&self, assumed: &Assumed) -> String {
        let Assumed { side, .. } = *assumed;
        let (name, from) = self.assumed_from(assumed);
        match from {
            Some(from) => format!("{name} ({}, {from})", SIDES[side]),
            None => format!("{name} ({})", SIDES[side]),
        }
    }

    /// The words of an assumption, and where it is said unless that is the model itself.
    pub fn assumed_from(&self, assumed: &Assumed) -> (String, Option<String>) {
        let model = self.models[assumed.side];
        let from = match &assumed.from {
            From::File(name) => Some(name.clone()),
            From::Text(span) if model.sources.iter().any(|(id, _)| id == span.file) => {
                let name = &model.sources.file(span.file).name;
                (name.ends_with(".yaml") || name == crate::ASSUME).then(|| name.clone())
            }
            From::Text(_) => None,
        };
        // A file is named as beside its model.
        let from = from.map(|name| name.rsplit(['/', '\\']).next().unwrap_or(&name).to_string());
        (assumed.name.split_whitespace().collect::<Vec<_>>().join(" "), from)
    }

    /// The parts of the coupling, a line each.
    fn observed(&self) -> Vec<String> {
        let count = self.coupling.conjuncts();
        let told = if self.all || count <= PARTS { count } else { PARTS - 1 };
        let mut parts: Vec<String> =
            (0..told).flat_map(|index| broken_into(&self.coupling.conjunct(index), LINE)).collect();
        if told < count {
            parts.push(format!("… and {} more; --all lists them", count - told));
        }
        let left_out = self.left_out().flat_map(|part| broken_into(&part, LINE)).collect();
        let titled = |title: &'static str, parts: Vec<String>| {
            let word = move |index: usize| if index == 0 { title } else { "" };
            parts.into_iter().enumerate().map(move |(index, part)| format!("  {:9}  {part}", word(index)))
        };
        titled("observed", parts).chain(titled("left out", left_out)).collect()
    }

    /// The functions of both machines that are not compared by default, and why.
    pub fn left_out(&self) -> impl Iterator<Item = String> {
        let [one, other] = SIDES;
        self.coupling.left_out.iter().map(move |LeftOut { name, why }| match why {
            Incomparable::Arguments([here, there]) => {
                format!("{name}: {} in the {one} machine, {there} in the {other} one", plural(*here, "argument"))
            }
            Incomparable::Domains([here, there]) => {
                format!("{name}: {here} in the {one} machine, {there} in the {other} one")
            }
            Incomparable::Made(domain) => {
                format!("{name}: it has arguments in {domain}, of which a machine makes elements")
            }
        })
    }

    /// What is known of a property of the abstract machine in the concrete one.
    pub fn standing(&self, property: &Preserved) -> Standing {
        match (&property.form, self.verified) {
            (Err(_), _) => Standing::Stays,
            (Ok(_), None) => Standing::Conditional,
            (Ok(_), Some(found)) => match found.get(&property.property) {
                Some(Outcome::Holds) => Standing::Holds,
                Some(Outcome::Violated(_)) => Standing::Violated,
                Some(Outcome::Unknown(_)) | None => Standing::Unknown,
            },
        }
    }

    /// The abstract machine's properties, and what they are in the concrete one.
    fn properties(&self, report: &Report) -> Vec<String> {
        if report.properties.is_empty() {
            return Vec::new();
        }
        let standings: Vec<Standing> = report.properties.iter().map(|property| self.standing(property)).collect();
        let mut lines = vec![match standings.contains(&Standing::Conditional) {
            true => "properties of the abstract machine: what comes along holds of the concrete one if it holds there \
                     (`--properties` verifies that)"
                .to_string(),
            false => "properties of the abstract machine, in the concrete one".to_string(),
        }];
        let width =
            report.properties.iter().map(|property| property.name.chars().count()).max().unwrap_or(0).min(WIDTH);
        for (property, standing) in report.properties.iter().zip(standings) {
            let said = match (standing, &property.form) {
                (Standing::Conditional, Ok(form)) => format!("comes along: {form}"),
                (Standing::Holds, Ok(form)) => format!("holds: {form}"),
                (Standing::Violated, Ok(_)) => "does not hold of the abstract machine".to_string(),
                (Standing::Unknown, Ok(_)) => "not known of the abstract machine".to_string(),
                (_, Ok(form)) => form.clone(),
                (_, Err(why)) => format!("does not come along: {why}"),
            };
            lines.push(format!("  {:width$}  {said}", property.name));
        }
        let of_runs = |property: &&Preserved| matches!(property.kind, PropertyKind::Ctl | PropertyKind::Ltl);
        let is_fairness =
            |property: &Property| matches!(property.kind, PropertyKind::Justice | PropertyKind::Compassion);
        let concrete = &self.models[CONCRETE].program.properties;
        if concrete.iter().any(is_fairness) && report.properties.iter().filter(of_runs).any(|one| one.form.is_ok()) {
            lines.push(
                "  note: formulas are about the fair runs of the concrete machine; `verify` tells whether it has one"
                    .into(),
            );
        }
        lines
    }

    /// Why a question says nothing, in words.
    fn emptiness(&self, vacuous: &Vacuous) -> String {
        match vacuous {
            Vacuous::NoInitialPair(_) => {
                "no initial states correspond: the coupling holds of no initial pair".to_string()
            }
            Vacuous::NoStep => "the concrete machine makes no step that changes its state".to_string(),
            Vacuous::NoFairRun => "the concrete machine has no fair run, and it refines by fairness alone".to_string(),
            Vacuous::NoneLeft => {
                "the assumptions leave the concrete machine no step: there is nothing to refine".to_string()
            }
            Vacuous::Total => {
                "the coupling holds of every two states that are reached: nothing is observed".to_string()
            }
            Vacuous::NoStart(side) => {
                format!("the {} machine has no initial state that its assumptions admit", SIDES[*side])
            }
        }
    }

    /// A question that says nothing, as a fault of the coupling.
    pub fn vacuous(&self, vacuous: &Vacuous) -> Diagnostic {
        let span = syntax::Span { file: self.coupling.file, start: 0, end: 0 };
        Diagnostic::error("vacuous-refinement", span, self.emptiness(vacuous))
    }
}

/// Why a machine has no initial states, with the side and its place.
pub fn no_start(trouble: &Trouble, models: [&Loaded; 2]) -> Option<(usize, Diagnostic)> {
    match trouble {
        Trouble::Fault(side, fault) => Some((*side, crate::diagnose_fault(fault, &models[*side].program))),
        Trouble::Unbounded(side, unbounded) => {
            let Loaded { program, sources, .. } = models[*side];
            Some((*side, crate::diagnose_unbounded(unbounded, program, sources)))
        }
        Trouble::Stopped(_) | Trouble::Refused(_) => None,
    }
}

/// A text in lines of at most so many characters, where it has blanks.
fn broken_into(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            Some(_) => lines.push(format!("  {word}")),
            None => lines.push(word.to_string()),
        }
    }
    lines
}
