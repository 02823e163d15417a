//! Describes a refutation as text for people: both runs side by side, and what is wrong at their end.
//!
//! In: a refutation, the words for both models. Out: lines. Of the first states only what matters is shown, unless all is asked for.
//! INVARIANT: the steps have the words that [`Verdicts`](super::Verdicts) has for runs.

use std::collections::{BTreeMap, BTreeSet};

use refine::{ABSTRACT, CONCRETE, Ended, Part, Refutation, SIDES, Tried};

use super::{FoundStep, Refinements};

/// What to do where the concrete machine goes on for ever.
pub const WAITS: &str = "if something outside the models ends this, say what is true again and again, `fair TERM;`, or take it for granted, \
                         `allow waiting;`";

/// What to do where a segment never ends.
const ENDLESS: &str = "let `segment` hold in one of these states; or, if something outside the models ends this, say what is true again and again, \
                       `fair TERM;`";

/// LIMIT: so many lines of an initial state are shown.
const STATE_LINES: usize = 24;
/// A state of so many locations is shown as a whole.
const SMALL: usize = 8;
/// LIMIT: the left column is as wide at most.
const WIDTH: usize = 56;

impl Refinements<'_> {
    /// Which locations of a side's first state matter: what changes later, what the parts of the coupling read that fail, and what is not
    /// the same in both machines. A small state matters as a whole.
    fn matters<'r>(
        &'r self,
        refutation: &'r Refutation,
        runs: &'r [Vec<FoundStep>; 2],
        side: usize,
    ) -> impl Fn(&str) -> bool + 'r {
        let values = &runs[side][0].values;
        let is_small = self.all || values.len() <= SMALL;
        let other: BTreeMap<&str, &str> =
            runs[1 - side][0].values.iter().map(|(location, value)| (location.as_str(), value.as_str())).collect();
        let mut names: BTreeSet<&str> = BTreeSet::new();
        for step in &runs[side][1..] {
            names.extend(step.changes.iter().map(|change| change.location.as_str()));
        }
        if let Ended::Unmatched { tried, .. } = &refutation.ended {
            let parts = tried.iter().flat_map(|candidate| &candidate.parts);
            let read =
                parts.flat_map(|part| part.values.iter().chain(part.instances.iter().flat_map(|one| &one.values)));
            names.extend(read.filter_map(|(name, _)| name.strip_prefix(SIDES[side])?.strip_prefix('.')));
        }
        for (location, value) in values {
            if other.get(location.as_str()).is_some_and(|there| there != value) {
                names.insert(location);
            }
        }
        move |location: &str| is_small || names.contains(location)
    }

    /// Both runs, diagram by diagram, the initial states first.
    pub fn rows(&self, refutation: &Refutation) -> Vec<Row> {
        let runs = [ABSTRACT, CONCRETE].map(|side| self.steps(side, &refutation.runs[side]));
        let begun = |side: usize| {
            let values = &runs[side][0];
            let matters = self.matters(refutation, &runs, side);
            let inputs = values.inputs.iter().map(|(location, value)| format!("in {location} = {value}"));
            let told: Vec<_> = values.values.iter().filter(|(location, _)| matters(location)).collect();
            let few = if self.all || told.len() <= STATE_LINES { told.len() } else { STATE_LINES };
            let mut lines: Vec<String> = inputs.collect();
            lines.extend(told[..few].iter().map(|(location, value)| format!("{location} = {value}")));
            if few < values.values.len() {
                lines.push(format!("… and {} more (--all)", values.values.len() - few));
            }
            lines
        };
        let lines = |steps: &[FoundStep]| steps.iter().flat_map(step).collect::<Vec<String>>();
        let sides = [begun(ABSTRACT), begun(CONCRETE)];
        let mut rows = vec![Row { label: "state 0".to_string(), sides, steps: [0, 0], is_loose: false }];
        let (mut made, mut there) = (1, 1);
        for (index, segment) in refutation.segments.iter().enumerate() {
            let label = match &refutation.ended {
                Ended::Waits(turn) if *turn == index => format!("{}:{} again and again", segment.m, segment.n),
                _ => format!("{}:{}", segment.m, segment.n),
            };
            let left = match segment.m {
                0 => vec!["no step".to_string()],
                m => lines(&runs[ABSTRACT][made..(made + m).min(runs[ABSTRACT].len())]),
            };
            let right = lines(&runs[CONCRETE][there..(there + segment.n).min(runs[CONCRETE].len())]);
            rows.push(Row { label, sides: [left, right], steps: [segment.m, segment.n], is_loose: false });
            (made, there) = (made + segment.m, there + segment.n);
        }
        let mut rest = |steps: &[FoundStep], again: &str, left: &str| {
            if steps.is_empty() {
                return;
            }
            let left = if left.is_empty() { Vec::new() } else { vec![left.to_string()] };
            let label = format!("?:{}{again}", steps.len());
            rows.push(Row { label, sides: [left, lines(steps)], steps: [0, steps.len()], is_loose: true });
        };
        let behind = &runs[CONCRETE][there..];
        match refutation.ended {
            Ended::Endless(turn) => {
                let (way, circle) = behind.split_at(turn + 1 - there);
                rest(way, "", "the segment goes on");
                rest(circle, " again and again", "it does not end");
            }
            Ended::Fault => rest(behind, "", ""),
            Ended::Waits(_) | Ended::Unmatched { .. } => rest(behind, "", "nothing matches"),
        }
        rows
    }

    /// Both runs side by side.
    pub(super) fn runs(&self, refutation: &Refutation) -> Vec<String> {
        let rows = self.rows(refutation);
        let count = |text: &str| text.chars().count();
        let widest = rows.iter().flat_map(|row| &row.sides[ABSTRACT]).map(|line| count(line)).max().unwrap_or(0);
        let width = widest.clamp(count("abstract"), WIDTH);
        let labels = rows.iter().map(|row| count(&row.label)).max().unwrap_or(0);
        let mut out = vec![format!("  {:labels$}  {:width$}  concrete", "", "abstract")];
        for Row { label, sides: [left, right], .. } in rows {
            for index in 0..left.len().max(right.len()).max(1) {
                let label = if index == 0 { label.as_str() } else { "" };
                let of = |lines: &[String]| lines.get(index).cloned().unwrap_or_default();
                out.push(format!("  {label:labels$}  {:width$}  {}", of(&left), of(&right)));
            }
        }
        out
    }

    /// What is said of the end of the runs.
    pub fn remarks(&self, refutation: &Refutation) -> Vec<String> {
        match &refutation.ended {
            Ended::Fault => {
                let fault = self.steps(CONCRETE, &refutation.runs[CONCRETE]).pop().and_then(|step| step.fault);
                fault.into_iter().map(|fault| format!("the concrete machine: {fault}")).collect()
            }
            Ended::Waits(turn) => {
                let from = refutation.segments[..*turn].iter().map(|segment| segment.n).sum::<usize>();
                vec![again_from(from), WAITS.to_string()]
            }
            Ended::Endless(turn) => vec![again_from(*turn), ENDLESS.to_string()],
            Ended::Unmatched { inputs, .. } => {
                inputs.iter().map(|(name, value)| format!("input {name} is {value}")).collect()
            }
        }
    }

    /// What the abstract machine could have done at the end, and the parts of the coupling that fail then, each as lines.
    pub fn candidates(&self, refutation: &Refutation) -> Vec<(String, Vec<Vec<String>>)> {
        let Ended::Unmatched { tried, .. } = &refutation.ended else { return Vec::new() };
        let does = |candidate: &Tried| {
            let steps: Vec<String> = self.tried(&candidate.steps).iter().flat_map(step).collect();
            match candidate.steps.len() {
                0 if refutation.runs[CONCRETE].steps.is_empty() => "the abstract machine begins".to_string(),
                0 => "the abstract machine makes no step".to_string(),
                _ => format!("the abstract machine steps: {}", steps.join(", ")),
            }
        };
        let fails = |candidate: &Tried| match candidate.parts.is_empty() {
            true => vec![vec!["no diagram has these numbers of steps".to_string()]],
            false => candidate.parts.iter().map(broken).collect(),
        };
        tried.iter().map(|candidate| (does(candidate), fails(candidate))).collect()
    }

    /// What else is said of what the abstract machine could have done.
    pub fn hindrances(&self, refutation: &Refutation) -> Vec<String> {
        let Ended::Unmatched { tried, faults, .. } = &refutation.ended else { return Vec::new() };
        let none = tried.is_empty().then(|| "the abstract machine has no step with these inputs".to_string());
        let faults = faults.iter().map(|fault| format!("a step of the abstract machine cannot be made: {fault}"));
        none.into_iter().chain(faults).collect()
    }

    /// What is wrong at the end of the runs.
    pub(super) fn end(&self, refutation: &Refutation) -> Vec<String> {
        let mut lines = self.remarks(refutation);
        for (does, fails) in self.candidates(refutation) {
            lines.push(format!("if {does}"));
            lines.extend(fails.iter().flatten().map(|line| format!("  {line}")));
        }
        lines.extend(self.hindrances(refutation));
        lines.iter().map(|line| format!("  {line}")).collect()
    }
}

/// A diagram of both runs, or the initial states, or what belongs to no diagram.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// `m:n`, or what the row is.
    pub label: String,
    /// What each machine does, as lines.
    pub sides: [Vec<String>; 2],
    /// How many steps each makes.
    pub steps: [usize; 2],
    /// Nothing corresponds to it.
    pub is_loose: bool,
}

fn again_from(step: usize) -> String {
    format!("and again from step {} of the concrete machine, for ever", step + 1)
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

/// A part of the coupling that does not hold, as lines.
fn broken(part: &Part) -> Vec<String> {
    let listed = |values: &[(String, String)]| {
        let values: Vec<String> = values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        values.join(", ")
    };
    let fails = part.trouble.clone().unwrap_or_else(|| "is false".to_string());
    let more = match part.more {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    let mut lines = vec![match part.values.is_empty() {
        true => format!("`{}` {fails}", part.text),
        false => format!("`{}` {fails}: {}{more}", part.text, listed(&part.values)),
    }];
    for instance in &part.instances {
        let fails = instance.trouble.iter().map(|trouble| format!(" (it {trouble})")).collect::<String>();
        let values = listed(&instance.values);
        let values = if values.is_empty() { values } else { format!(": {values}") };
        lines.push(format!("  for {}{fails}{values}", listed(&instance.bound)));
    }
    if part.more > 0 && part.values.is_empty() {
        lines.push(format!("  and for {} more", part.more));
    }
    lines
}
