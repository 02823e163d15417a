//! Describes a run as text for people: inputs, choices, changes.
//!
//! In: records as they come, with the state after each if it is to be shown. Out: lines. INVARIANT: they depend on the
//! records alone, so a replay prints the same.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt::{self, Write};

use machine::{Location, Show, Value};
use program::Program;
use simulate::{ChoiceMade, End, Record, StepRecord, Violation};
use syntax::Span;

use super::plural;

/// How much of the state is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// The whole state after every step
    All,
    /// The initial state, then what changed
    Changed,
    /// Only how the run ended
    None,
}

/// Describes records.
#[derive(Debug)]
pub struct Narrator<'a> {
    detail: Detail,
    is_colored: bool,
    program: &'a Program,
    /// The variables that each choose rule binds, by its place.
    binders: BTreeMap<Span, Vec<String>>,
    until: Option<String>,
    /// The range of steps, not shown yet, in which nothing was read and nothing changed.
    quiet: Cell<Option<(u64, u64)>>,
}

/// A state: each location with its value.
type State = [(Location, Value)];

const BOLD: &str = "\x1b[1m";
const DIM: &str = "\x1b[2m";
const CYAN: &str = "\x1b[36m";
const GREEN: &str = "\x1b[32m";
const RED: &str = "\x1b[31m";
const RESET: &str = "\x1b[0m";

impl<'a> Narrator<'a> {
    /// A narrator at the beginning of a run. `until` is the condition that may end the run; set `is_colored` for
    /// terminals.
    pub fn new(program: &'a Program, detail: Detail, until: Option<String>, is_colored: bool) -> Narrator<'a> {
        let binders = crate::choice_variables(program);
        Narrator { detail, is_colored, program, binders, until, quiet: Cell::new(None) }
    }

    /// Whether [`record`](Narrator::record) needs the state.
    pub fn wants_state(&self) -> bool {
        self.detail == Detail::All
    }
}

impl Narrator<'_> {
    /// A record as lines; empty if it will be shown together with those that follow. `steps` have been made; `state` is
    /// the state after it.
    pub fn record(&self, record: &Record, steps: u64, state: Option<&State>) -> String {
        let mut out = String::new();
        let _ = self.write(&mut out, record, steps, state.unwrap_or_default());
        out
    }

    fn write(&self, out: &mut String, record: &Record, steps: u64, state: &State) -> fmt::Result {
        if self.detail == Detail::None && !matches!(record, Record::End(_)) {
            return Ok(());
        }
        if let Record::Step(step) = record
            && self.detail == Detail::Changed
            && is_quiet(step)
        {
            let first = self.quiet.get().map_or(step.step, |(first, _)| first);
            self.quiet.set(Some((first, step.step)));
            return Ok(());
        }
        self.tell_quiet(out)?;
        match record {
            Record::Initial { inputs, choices, values, violations, .. } => {
                writeln!(out, "{}", self.paint(BOLD, "state 0"))?;
                self.values(out, "in", CYAN, inputs)?;
                self.choices(out, choices)?;
                self.values(out, "", "", values)?;
                self.violations(out, violations)
            }
            Record::Step(step) => {
                writeln!(out, "{}", self.paint(BOLD, &format!("step {}", step.step)))?;
                self.taken(out, step)?;
                self.changes(out, step, state)?;
                self.violations(out, &step.violations)
            }
            Record::Attempt(step) => {
                writeln!(out, "{}", self.paint(BOLD, &format!("step {}, not made", step.step)))?;
                self.taken(out, step)?;
                self.violations(out, &step.violations)
            }
            Record::Back { step } => writeln!(out, "{}", self.paint(DIM, &format!("back to before step {step}"))),
            Record::End(end) => {
                let made = plural(steps as usize, "step");
                writeln!(out, "{} {}", self.paint(BOLD, &format!("end after {made}:")), self.reason(end, steps))
            }
        }
    }

    /// A state, shown between two steps.
    pub fn state(&self, state: &State) -> String {
        let line = |(location, value): &(Location, Value)| {
            format!("{} = {}", location.show(self.program), value.show(self.program))
        };
        listed(state.iter().map(line))
    }

    /// What a step changed, shown after it.
    pub fn updates(&self, step: &StepRecord) -> String {
        listed(step.changes.iter().map(|change| {
            let (before, after) = (change.before.show(self.program), change.after.show(self.program));
            format!("{}: {before} -> {after}", change.location.show(self.program))
        }))
    }

    /// Shows consecutive steps in which nothing happened as one.
    fn tell_quiet(&self, out: &mut String) -> fmt::Result {
        let Some((first, last)) = self.quiet.take() else { return Ok(()) };
        let steps = if first == last { format!("step {first}") } else { format!("steps {first} to {last}") };
        writeln!(out, "{}\n  {}", self.paint(BOLD, &steps), self.paint(DIM, "no change"))
    }

    /// What a step read from the environment.
    fn taken(&self, out: &mut String, step: &StepRecord) -> fmt::Result {
        self.values(out, "in", CYAN, &step.inputs)?;
        self.values(out, "in", CYAN, &step.writes)?;
        self.choices(out, &step.choices)
    }

    fn choices(&self, out: &mut String, choices: &[ChoiceMade]) -> fmt::Result {
        for choice in choices {
            writeln!(out, "  {} {}", self.paint(CYAN, "choose"), self.choice(choice))?;
        }
        Ok(())
    }

    fn choice(&self, choice: &ChoiceMade) -> String {
        let values: Vec<String> =
            choice.values.iter().map(|value| value.show(self.program).briefly().to_string()).collect();
        let shown = match self.binders.get(&choice.span) {
            Some(names) if names.len() == values.len() => {
                let pairs: Vec<String> =
                    names.iter().zip(&values).map(|(name, value)| format!("{name} = {value}")).collect();
                pairs.join(", ")
            }
            _ => values.join(", "),
        };
        format!("{shown} ({} of {})", choice.index + 1, choice.of)
    }

    fn changes(&self, out: &mut String, step: &StepRecord, state: &State) -> fmt::Result {
        if self.detail == Detail::All {
            let changed: Vec<&Location> = step.changes.iter().map(|change| &change.location).collect();
            for (location, value) in state {
                let color = if changed.contains(&location) { GREEN } else { "" };
                self.value(out, "", color, location, value)?;
            }
            return Ok(());
        }
        for change in &step.changes {
            let (before, after) =
                (change.before.show(self.program).briefly(), change.after.show(self.program).briefly());
            let location = change.location.show(self.program);
            writeln!(
                out,
                "  {location}: {before} {} {}",
                self.paint(DIM, "->"),
                self.paint(GREEN, &after.to_string())
            )?;
        }
        if step.changes.is_empty() {
            // If the state changed without a changed location, a domain grew.
            let what = if step.changed { "new elements only" } else { "no change" };
            writeln!(out, "  {}", self.paint(DIM, what))?;
        }
        Ok(())
    }

    fn values(&self, out: &mut String, word: &str, color: &str, values: &[(Location, Value)]) -> fmt::Result {
        values.iter().try_for_each(|(location, value)| self.value(out, word, color, location, value))
    }

    fn value(&self, out: &mut String, word: &str, color: &str, at: &Location, value: &Value) -> fmt::Result {
        let line = format!("{} = {}", at.show(self.program), value.show(self.program).briefly());
        match word {
            "" => writeln!(out, "  {}", self.paint(color, &line)),
            word => writeln!(out, "  {} {line}", self.paint(color, word)),
        }
    }

    fn violations(&self, out: &mut String, violations: &[Violation]) -> fmt::Result {
        let word = self.paint(RED, "violated");
        violations.iter().try_for_each(|violation| writeln!(out, "  {word} {}", violation.name))
    }

    fn reason(&self, end: &End, steps: u64) -> String {
        let until = self.until.as_deref().unwrap_or("the condition");
        match end {
            End::Steps if self.until.is_some() => format!("`{until}` did not hold within them"),
            End::Steps => "as many as asked for".to_string(),
            End::Empty => "the update set is empty".to_string(),
            End::Trivial => "nothing changes any more".to_string(),
            End::Until => format!("`{until}` holds"),
            End::Violation => self.paint(RED, "an invariant does not hold"),
            End::Fault(_) => self.paint(RED, &format!("step {} cannot be made", steps + 1)),
            End::Interrupted => "interrupted".to_string(),
            End::Quit => "stopped at the prompt".to_string(),
        }
    }

    fn paint(&self, color: &str, text: &str) -> String {
        if self.is_colored && !color.is_empty() { format!("{color}{text}{RESET}") } else { text.to_string() }
    }
}

fn is_quiet(step: &StepRecord) -> bool {
    let outside = step.inputs.is_empty() && step.writes.is_empty() && step.choices.is_empty();
    outside && !step.changed && step.violations.is_empty()
}

fn listed(lines: impl Iterator<Item = String>) -> String {
    let text: String = lines.map(|line| format!("  {line}\n")).collect();
    if text.is_empty() { "  nothing\n".to_string() } else { text }
}
