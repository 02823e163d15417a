//! Describes a refutation as text for people: both runs side by side, and what is wrong at their end.
//!
//! In: a refutation, the words for both models. Out: lines. Of the first states only what matters is shown, unless all is asked for.
//! INVARIANT: the steps have the words that [`Verdicts`](super::Verdicts) has for runs.

use std::collections::{BTreeMap, BTreeSet};

use refine::{ABSTRACT, CONCRETE, Ended, Part, Refutation, SIDES};

use super::{FoundStep, Refinements};

/// What to do where the concrete machine goes on for ever.
pub const WAITS: &str = "if something outside the models ends this, say what is true again and again, `fair TERM;`, or take it for granted, \
                         `allow waiting;`";

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

    /// Both runs side by side.
    pub(super) fn runs(&self, refutation: &Refutation) -> Vec<String> {
        let runs = [ABSTRACT, CONCRETE].map(|side| self.steps(side, &refutation.runs[side]));
        let mut rows: Vec<(String, Vec<String>, Vec<String>)> = Vec::new();
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
    pub(super) fn end(&self, refutation: &Refutation) -> Vec<String> {
        let mut lines = Vec::new();
        match &refutation.ended {
            Ended::Fault => {
                let fault = self.steps(CONCRETE, &refutation.runs[CONCRETE]).pop().and_then(|step| step.fault);
                lines.extend(fault.map(|fault| format!("  the concrete machine: {fault}")));
            }
            Ended::Waits(turn) => {
                let from = refutation.segments[..*turn].iter().map(|segment| segment.n).sum::<usize>();
                lines.push(format!("  and again from step {} of the concrete machine, for ever", from + 1));
                lines.push(format!("  {WAITS}"));
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
                    let parts = candidate.parts.iter().flat_map(broken);
                    lines.extend(parts.map(|line| format!("    {line}")));
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
