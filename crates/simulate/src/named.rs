//! A named-value file: location → value, by step.
//!
//! In: [`Given`] values as a shell read them from YAML or CSV. Out: a [`Source`], or a [`Problem`] for each name or
//! value that does not fit the model. A value given *from* a step on holds until the file gives another one. A value
//! given for a range of steps holds only there, and wins over the first kind. Of two values for the same range, the
//! later wins.

use std::collections::{BTreeMap, BTreeSet};

use machine::{Location, Value};
use program::{FunctionKind, Program};
use syntax::Span;

use crate::constants::read_input;
use crate::inputs::{Ask, Source};
use crate::read::{Written, read_written};
use crate::weighted::{Misfit, Misplaced, Often, Weighted};

/// The steps for which a value is given; steps count from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Steps {
    /// From this step on, until another value is given.
    From(u64),
    /// In these steps only, both included.
    Range(u64, u64),
}

impl Steps {
    /// `3` (from step 3 on), `3..5` (steps 3 to 5), `3..` (from step 3 on), `always`.
    ///
    /// # Errors
    /// A sentence for the user.
    pub fn read(text: &str) -> Result<Steps, String> {
        let text = text.trim();
        let wrong = || format!("`{text}` names no step: write a number from 1, a range such as 3..5, or `always`");
        let number = |text: &str| text.trim().parse::<u64>().map_err(|_| wrong());
        if text == "always" {
            return Ok(Steps::From(0));
        }
        match text.split_once("..") {
            None => number(text).map(Steps::From),
            Some((from, "")) => number(from).map(Steps::From),
            Some((from, to)) => {
                let (from, to) = (number(from)?, number(to)?);
                if from <= to { Ok(Steps::Range(from, to)) } else { Err(wrong()) }
            }
        }
    }
}

/// One value as a file gives it.
#[derive(Debug, Clone)]
pub struct Given {
    /// For which steps.
    pub steps: Steps,
    /// The location's text and place.
    pub location: (String, Span),
    /// The value and its place.
    pub value: (Written, Span),
}

/// How often the values of a location come, as a file says it.
#[derive(Debug, Clone)]
pub struct Weighing {
    /// The text and place of a location, or of a function.
    pub location: (String, Span),
    /// How often, and where all of it stands.
    pub often: (Often, Span),
    /// The places of the values.
    pub values: Vec<Span>,
}

/// What does not fit the model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Where in the file.
    pub span: Span,
    /// A sentence for the user.
    pub message: String,
    /// It is the value that is wrong, not the location.
    pub value: bool,
}

/// Values by location and step.
#[derive(Debug, Clone, Default)]
pub struct Named {
    from: BTreeMap<Location, BTreeMap<u64, Value>>,
    ranges: BTreeMap<Location, Vec<(u64, u64, Value)>>,
    shared: Vec<Location>,
    /// What is drawn.
    weighted: Weighted,
}

impl Named {
    /// Draws by this seed what the file leaves to chance.
    pub fn seeded(self, seed: u64) -> Named {
        Named { weighted: self.weighted.seeded(seed), ..self }
    }

    /// Whether the file leaves something to chance.
    pub fn draws(&self) -> bool {
        !self.weighted.is_empty()
    }

    /// Reads what a file gives, and what it leaves to chance, against a program.
    ///
    /// # Errors
    /// All that does not fit, in the order of the file.
    pub fn new(program: &Program, given: &[Given], weighings: &[Weighing]) -> Result<Named, Vec<Problem>> {
        let mut named = Named::default();
        let mut problems = Vec::new();
        // Columns of a table repeat a location on every row: each text is read once.
        let mut locations: BTreeMap<&str, Result<Location, String>> = BTreeMap::new();
        let mut met = BTreeSet::new();
        for Given { steps, location: (text, place), value: (written, value_place) } in given {
            let location = locations.entry(text).or_insert_with(|| read_input(program, text));
            let location = match location {
                Ok(location) => location.clone(),
                Err(message) => {
                    let message = std::mem::take(message);
                    if !message.is_empty() {
                        problems.push(Problem { span: *place, message, value: false });
                    }
                    continue;
                }
            };
            let function = program.function(location.function);
            if !met.insert((location.clone(), *steps)) {
                let message = format!("`{text}` is given twice for the same steps");
                problems.push(Problem { span: *value_place, message, value: true });
            }
            match read_written(program, function.codomain, written) {
                Err(message) => problems.push(Problem { span: *value_place, message, value: true }),
                Ok(value) => named.add(location, *steps, value, function.kind == FunctionKind::Shared),
            }
        }
        let mut weighed = BTreeSet::new();
        for Weighing { location: (location, place), often: (often, whole), values } in weighings {
            if !weighed.insert(location.trim()) {
                let message = format!("how often `{location}` comes is given twice");
                problems.push(Problem { span: *whole, message, value: true });
            }
            if let Err(Misfit { message, place: about }) = named.weighted.set(program, location, often) {
                let (span, value) = match about {
                    Misplaced::Location => (*place, false),
                    Misplaced::All => (*whole, true),
                    Misplaced::Value(index) => (values.get(index).copied().unwrap_or(*whole), true),
                };
                problems.push(Problem { span, message, value });
            }
        }
        problems.sort_by_key(|problem| problem.span.start);
        if problems.is_empty() { Ok(named) } else { Err(problems) }
    }

    fn add(&mut self, location: Location, steps: Steps, value: Value, shared: bool) {
        if shared && !self.shared.contains(&location) {
            self.shared.push(location.clone());
        }
        match steps {
            Steps::From(step) => {
                self.from.entry(location).or_default().insert(step, value);
            }
            Steps::Range(from, to) => self.ranges.entry(location).or_default().push((from, to, value)),
        }
    }

    /// The value of a location in a step, if the file gives one.
    pub fn value(&self, location: &Location, step: u64) -> Option<&Value> {
        let ranged = self.ranges.get(location).into_iter().flatten().rev();
        let mut inside = ranged.filter(|(from, to, _)| (*from..=*to).contains(&step));
        if let Some((_, _, value)) = inside.next() {
            return Some(value);
        }
        // The initial state (step 0) sees what is given for the first step.
        let upto = step.max(1);
        self.from.get(location)?.range(..=upto).next_back().map(|(_, value)| value)
    }

    /// The value that the file begins to give in exactly this step.
    fn begins(&self, location: &Location, step: u64) -> Option<&Value> {
        let ranged = self.ranges.get(location).into_iter().flatten().rev();
        let mut inside = ranged.filter(|(from, to, _)| (*from..=*to).contains(&step));
        if let Some((_, _, value)) = inside.next() {
            return Some(value);
        }
        let exact = self.from.get(location)?.get(&step);
        if step == 1 { exact.or_else(|| self.from.get(location)?.get(&0)) } else { exact }
    }
}

impl Source for Named {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        match self.value(&ask.location.to_location(), ask.step) {
            Some(value) => Ok(Some(value.clone())),
            None => self.weighted.input(ask),
        }
    }

    /// A shared location is written when the file says so; in between, the machine may change it.
    fn has_writes(&self) -> bool {
        true
    }

    fn writes(&mut self, step: u64) -> Vec<(Location, Value)> {
        let given = self.shared.iter().filter_map(|at| self.begins(at, step).map(|value| (at.clone(), value.clone())));
        given.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_read() {
        assert_eq!(Steps::read("3"), Ok(Steps::From(3)));
        assert_eq!(Steps::read(" 3..5 "), Ok(Steps::Range(3, 5)));
        assert_eq!(Steps::read("3.."), Ok(Steps::From(3)));
        assert_eq!(Steps::read("always"), Ok(Steps::From(0)));
        assert!(Steps::read("5..3").is_err());
        assert!(Steps::read("first").is_err());
    }

    #[test]
    fn values_hold_until_the_next() {
        let at = Location { function: program::FunctionId(0), arguments: Vec::new() };
        let mut named = Named::default();
        let number = Value::Integer;
        named.add(at.clone(), Steps::From(2), number(20), false);
        named.add(at.clone(), Steps::From(5), number(50), false);
        named.add(at.clone(), Steps::Range(3, 3), number(33), false);
        let seen: Vec<_> = (1..=6).map(|step| named.value(&at, step).cloned()).collect();
        let expected = [None, Some(20), Some(33), Some(20), Some(50), Some(50)];
        assert_eq!(seen, expected.map(|n| n.map(number)));
    }
}
