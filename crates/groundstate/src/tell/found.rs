//! Describes runs that a search found, as text for people.
//!
//! In: a [`Trace`]. Out: its steps in words, or lines. INVARIANT: both have the same words.

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use explore::{ChoiceTaken, Told};
use machine::{Location, Show, Value};
use syntax::Span;
use verify::Trace;
use verify::listing::ListedStep;

use super::Verdicts;

/// A step in words. The first of a run is the initial state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundStep {
    /// The initial state: locations and values.
    pub values: Vec<(String, String)>,
    /// What it read: locations and values.
    pub inputs: Vec<(String, String)>,
    /// What it chose.
    pub choices: Vec<String>,
    /// What it changed.
    pub changes: Vec<FoundChange>,
    /// Why it could not be made.
    pub fault: Option<String>,
}

/// A location whose value changed, in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundChange {
    /// The location.
    pub location: String,
    /// Its value before.
    pub from: String,
    /// Its value after.
    pub to: String,
    /// The place of the update.
    pub by: String,
}

impl Verdicts<'_> {
    /// The initial state and the steps of a run.
    pub fn steps(&self, trace: &Trace) -> Vec<FoundStep> {
        let binders = crate::choice_variables(self.program);
        let steps = trace.steps.iter().map(|told| self.step(told, &[], &binders));
        std::iter::once(self.step(&trace.start, &trace.values, &binders)).chain(steps).collect()
    }

    /// What the first way of a listed step read and chose.
    pub fn way(&self, step: &ListedStep) -> FoundStep {
        let told = Told { inputs: step.inputs.clone(), choices: step.choices.clone(), ..Told::default() };
        self.step(&told, &[], &crate::choice_variables(self.program))
    }

    fn step(&self, told: &Told, values: &[(Location, Value)], binders: &BTreeMap<Span, Vec<String>>) -> FoundStep {
        let pairs = |values: &[(Location, Value)]| -> Vec<(String, String)> {
            let show = |(location, value): &(Location, Value)| {
                (location.show(self.program).to_string(), value.show(self.program).to_string())
            };
            values.iter().map(show).collect()
        };
        let changes = told.changes.iter().map(|change| FoundChange {
            location: change.location.show(self.program).to_string(),
            from: change.before.show(self.program).to_string(),
            to: change.after.show(self.program).to_string(),
            by: self.place(change.span),
        });
        FoundStep {
            values: pairs(values),
            inputs: pairs(&told.inputs),
            choices: told.choices.iter().map(|choice| self.choice(choice, binders)).collect(),
            changes: changes.collect(),
            fault: told.fault.as_ref().map(|fault| fault.show(self.program).to_string()),
        }
    }

    /// A run as lines, step by step. An initial state that equals that of the previous run is not repeated.
    pub fn run(&self, trace: &Trace) -> String {
        let mut out = String::new();
        let _ = self.write_run(&mut out, trace);
        out
    }

    fn write_run(&self, out: &mut String, trace: &Trace) -> fmt::Result {
        let mut steps = self.steps(trace).into_iter();
        let start = steps.next().unwrap_or_else(|| unreachable!("a run has an initial state"));
        let inputs = start.inputs.iter().map(|(location, value)| format!("in {location} = {value}"));
        let values = start.values.iter().map(|(location, value)| format!("{location} = {value}"));
        let state: Vec<String> = inputs.chain(values).collect();
        if state.len() > 1 && *self.initial.borrow() == state {
            writeln!(out, "  state 0, as above")?;
        } else {
            writeln!(out, "  state 0")?;
            state.iter().try_for_each(|line| writeln!(out, "    {line}"))?;
            self.initial.replace(state);
        }
        for (index, step) in steps.enumerate() {
            let made = if step.fault.is_some() { ", not made" } else { "" };
            writeln!(out, "  step {}{made}", index + 1)?;
            for (location, value) in &step.inputs {
                writeln!(out, "    in {location} = {value}")?;
            }
            for choice in &step.choices {
                writeln!(out, "    choose {choice}")?;
            }
            for FoundChange { location, from, to, by } in &step.changes {
                writeln!(out, "    {location}: {from} -> {to}  ({by})")?;
            }
            if step.fault.is_none() && step.changes.is_empty() {
                writeln!(out, "    no change")?;
            }
        }
        if let Some(turn) = trace.turn {
            writeln!(out, "  and again from step {}, for ever", turn + 1)?;
        }
        if trace.ends {
            writeln!(out, "  no step satisfies the assumptions: the run ends here")?;
        }
        Ok(())
    }

    fn choice(&self, choice: &ChoiceTaken, binders: &BTreeMap<Span, Vec<String>>) -> String {
        let values: Vec<String> = choice.values.iter().map(|value| value.show(self.program).to_string()).collect();
        match binders.get(&choice.span) {
            Some(names) if names.len() == values.len() => {
                let pairs: Vec<String> =
                    names.iter().zip(&values).map(|(name, value)| format!("{name} = {value}")).collect();
                pairs.join(", ")
            }
            _ => values.join(", "),
        }
    }
}
