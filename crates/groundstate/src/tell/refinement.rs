//! Describes the result of a refinement check as text for people: the verdict, and where it fails both runs side by side.
//!
//! In: a report, the coupling, the two models. Out: lines. INVARIANT: the steps have the words that [`Verdicts`] has for runs.

use std::collections::BTreeMap;

use explore::Told;
use refine::{
    ABSTRACT, CONCRETE, Coupling, Ended, Part, Preserved, Refutation, Report, Run, SIDES, Trouble, Vacuous, Verdict,
    Why,
};
use syntax::Diagnostic;
use verify::{Outcome, Trace};

use super::{FoundStep, Verdicts, plural};
use crate::Loaded;

/// LIMIT: so many lines of an initial state are shown.
const STATE_LINES: usize = 24;
/// LIMIT: the left column is as wide at most.
const WIDTH: usize = 56;

/// Describes a refinement check.
#[derive(Debug)]
pub struct Refinements<'a> {
    /// The abstract and the concrete model.
    pub models: [&'a Loaded; 2],
    /// How they are coupled.
    pub coupling: &'a Coupling,
    /// Whether the search stopped because its time was up.
    pub timed_out: bool,
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
    Trace { start: run.start.clone(), values: run.values.clone(), steps: run.steps.clone(), turn: None, branch: false }
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
        lines.extend(self.extent(report));
        lines.extend(self.properties(report));
        lines.iter().map(|line| format!("{}\n", line.trim_end())).collect()
    }

    fn verdict(&self, verdict: &Verdict) -> Vec<String> {
        match verdict {
            Verdict::Refines => vec!["refines".to_string()],
            Verdict::DoesNot(refutation) => {
                let mut lines = vec![format!("does not refine: {}", self.headline(refutation))];
                lines.extend(self.runs(refutation));
                lines.extend(self.end(refutation));
                lines
            }
            Verdict::Unknown(whys) => {
                let whys: Vec<String> = whys.iter().map(|why| self.why(why)).collect();
                vec![format!("not known: {}", whys.join("; "))]
            }
            Verdict::Vacuous(Vacuous::NoInitialPair(refutation)) => {
                let mut lines = self.runs(refutation);
                lines.extend(self.end(refutation));
                lines
            }
            Verdict::Vacuous(_) => Vec::new(),
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
            Why::Long(most) => format!(
                "a segment has more than {}; `diagrams` may allow more",
                plural(*most as usize, "concrete step")
            ),
            Why::Undistinguished(pairs) => {
                format!("the coupling holds of all {pairs} pairs of states that were compared: it may say nothing")
            }
            Why::Valuations => "inputs that the concrete machine does not look at have too many values".to_string(),
            Why::Unproved => "the proof by induction is not whole".to_string(),
            Why::Bounded(side) => {
                format!("inputs of the {} machine had only the values that were given as bounds", SIDES[*side])
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
            let names: Vec<String> =
                (0..self.coupling.conjuncts()).map(|index| self.coupling.conjunct(index)).collect();
            lines.push(format!("  observed   {}", names.join("; ")));
        }
        if !report.diagrams.is_empty() {
            let used = report
                .diagrams
                .iter()
                .map(|((m, n), times)| format!("{m}:{n} in {}", plural(*times as usize, "place")));
            lines.push(format!("  diagrams   {}", used.collect::<Vec<_>>().join(", ")));
        }
        lines.extend(report.proof.iter().flat_map(|proof| self.proof(proof)));
        for (word, names) in [("same input", &self.coupling.inputs), ("free input", &self.coupling.free)] {
            if !names.is_empty() && matches!(report.verdict, Verdict::Refines) {
                lines.push(format!("  {word} {}", names.join(", ")));
            }
        }
        if self.coupling.waiting {
            let what = "the concrete machine does not go on for ever while the abstract one makes no step";
            lines.push(format!("  assumed    {what}"));
        }
        for assumed in &report.assumed {
            lines.push(format!("  assumed    {} ({})", assumed.name, SIDES[assumed.side]));
        }
        if report.idle && matches!(report.verdict, Verdict::Refines) {
            lines.push("  note: the abstract machine makes no step that changes its state".to_string());
        }
        let open = if progress.queue > 0 { format!(" ({} not looked at)", progress.queue) } else { String::new() };
        // What a proof rests on are not the pairs that were searched before it.
        let first = if report.proof.is_some() { "searched before: " } else { "" };
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
        lines
    }

    /// Both runs side by side.
    fn runs(&self, refutation: &Refutation) -> Vec<String> {
        let runs = [ABSTRACT, CONCRETE].map(|side| self.steps(side, &refutation.runs[side]));
        let mut rows: Vec<(String, Vec<String>, Vec<String>)> = Vec::new();
        let begun = |side: usize| {
            let values = &runs[side][0];
            let mut lines: Vec<String> =
                values.inputs.iter().map(|(location, value)| format!("in {location} = {value}")).collect();
            lines.extend(values.values.iter().map(|(location, value)| format!("{location} = {value}")));
            if lines.len() > STATE_LINES {
                let more = lines.len() - STATE_LINES;
                lines.truncate(STATE_LINES);
                lines.push(format!("… and {more} more"));
            }
            lines
        };
        rows.push(("state 0".to_string(), begun(ABSTRACT), begun(CONCRETE)));
        let (mut made, mut there) = (1, 1);
        let lines = |steps: &[FoundStep]| steps.iter().flat_map(step).collect::<Vec<String>>();
        for (index, segment) in refutation.segments.iter().enumerate() {
            let label = match &refutation.ended {
                Ended::Waits(turn) if *turn == index => format!("{}:{} again and again", segment.m, segment.n),
                _ => format!("{}:{}", segment.m, segment.n),
            };
            let left = match segment.m {
                0 => vec!["no step".to_string()],
                m => lines(&runs[ABSTRACT][made..(made + m).min(runs[ABSTRACT].len())]),
            };
            rows.push((label, left, lines(&runs[CONCRETE][there..(there + segment.n).min(runs[CONCRETE].len())])));
            (made, there) = (made + segment.m, there + segment.n);
        }
        if there < runs[CONCRETE].len() {
            let left = match refutation.ended {
                Ended::Fault => Vec::new(),
                _ => vec!["nothing matches".to_string()],
            };
            rows.push((format!("?:{}", runs[CONCRETE].len() - there), left, lines(&runs[CONCRETE][there..])));
        }
        let count = |text: &str| text.chars().count();
        let widest = rows.iter().flat_map(|(_, left, _)| left).map(|line| count(line)).max().unwrap_or(0);
        let width = widest.clamp(count("abstract"), WIDTH);
        let labels = rows.iter().map(|(label, ..)| count(label)).max().unwrap_or(0);
        let mut out = vec![format!("  {:labels$}  {:width$}  concrete", "", "abstract")];
        for (label, left, right) in rows {
            for index in 0..left.len().max(right.len()).max(1) {
                let label = if index == 0 { label.as_str() } else { "" };
                let of = |lines: &[String]| lines.get(index).cloned().unwrap_or_default();
                out.push(format!("  {label:labels$}  {:width$}  {}", of(&left), of(&right)));
            }
        }
        out
    }

    /// What is wrong at the end of the runs.
    fn end(&self, refutation: &Refutation) -> Vec<String> {
        let mut lines = Vec::new();
        match &refutation.ended {
            Ended::Fault => {
                let fault = self.steps(CONCRETE, &refutation.runs[CONCRETE]).pop().and_then(|step| step.fault);
                lines.extend(fault.map(|fault| format!("  the concrete machine: {fault}")));
            }
            Ended::Waits(turn) => {
                let from = refutation.segments[..*turn].iter().map(|segment| segment.n).sum::<usize>();
                lines.push(format!("  and again from step {} of the concrete machine, for ever", from + 1));
                lines.push(
                    "  if something outside the models ends this, write `allow waiting;` into the coupling".to_string(),
                );
            }
            Ended::Unmatched { inputs, tried, faults } => {
                for (name, value) in inputs {
                    lines.push(format!("  input {name} is {value}"));
                }
                for candidate in tried {
                    let steps: Vec<String> = self.tried(&candidate.steps).iter().flat_map(step).collect();
                    let what = match candidate.steps.len() {
                        0 if refutation.runs[CONCRETE].steps.is_empty() => "the abstract machine begins".to_string(),
                        0 => "the abstract machine makes no step".to_string(),
                        _ => format!("the abstract machine steps: {}", steps.join(", ")),
                    };
                    lines.push(format!("  if {what}"));
                    if candidate.parts.is_empty() {
                        lines.push("    no diagram allows so many steps".to_string());
                    }
                    lines.extend(candidate.parts.iter().map(|part| format!("    {}", broken(part))));
                }
                if tried.is_empty() {
                    lines.push("  the abstract machine has no step with these inputs".to_string());
                }
                lines.extend(
                    faults.iter().map(|fault| format!("  a step of the abstract machine cannot be made: {fault}")),
                );
            }
        }
        lines
    }

    /// A question that says nothing, as a fault of the coupling.
    pub fn vacuous(&self, vacuous: &Vacuous) -> Diagnostic {
        let message = match vacuous {
            Vacuous::NoInitialPair(_) => {
                "no initial states correspond: the coupling holds of no initial pair".to_string()
            }
            Vacuous::NoStep => "the concrete machine makes no step that changes its state".to_string(),
            Vacuous::Total => "the coupling holds of every two states: nothing is observed".to_string(),
            Vacuous::NoStart(side) => {
                format!("the {} machine has no initial state that its assumptions admit", SIDES[*side])
            }
        };
        let span = syntax::Span { file: self.coupling.file, start: 0, end: 0 };
        Diagnostic::error("vacuous-refinement", span, message)
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
        Trouble::Stopped(_) => None,
    }
}

/// A step as lines.
fn step(step: &FoundStep) -> Vec<String> {
    let mut lines: Vec<String> =
        step.inputs.iter().map(|(location, value)| format!("in {location} = {value}")).collect();
    lines.extend(step.choices.iter().map(|choice| format!("choose {choice}")));
    match &step.fault {
        Some(_) => lines.push("cannot be made".to_string()),
        None if step.changes.is_empty() => lines.push("no change".to_string()),
        None => lines.extend(step.changes.iter().map(|change| {
            let super::FoundChange { location, from, to, .. } = change;
            format!("{location}: {from} -> {to}")
        })),
    }
    lines
}

fn broken(part: &Part) -> String {
    let values: Vec<String> = part.values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let fails = part.trouble.clone().unwrap_or_else(|| "is false".to_string());
    match values.is_empty() {
        true => format!("`{}` {fails}", part.text),
        false => format!("`{}` {fails}: {}", part.text, values.join(", ")),
    }
}
