//! The environment of a replayed step: inputs and clock as recorded, choices by a plan.
//!
//! In: one recorded step and a plan (which candidate each choice of the step takes, the first ones as far as the plan
//! goes). Out: what the machine asks for, and notes of what it asked beyond the record. INVARIANT: of a location that
//! the record has several times the first value counts, of a twin's the last. An input that the record lacks is a choice among a few values
//! of its domain.

use std::collections::BTreeMap;

use machine::{Choice, Draw, Environment, LocationRef, Machine, Real, TimeUnit, Value};
use program::{DomainId, DomainKind, FunctionKind, Program};
use syntax::Span;

use super::defect::locations::is_twin;
use super::names::painted;
use super::text;
use super::trace::Step;

/// A choice as it was made: which candidate of how many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Made {
    /// The candidate taken.
    pub index: usize,
    /// How many there were.
    pub of: usize,
}

/// What was chosen at each choose rule before. The peer takes the first candidate of its hash table, so of the same
/// candidates it takes the same again.
#[derive(Debug, Default)]
pub struct Habits {
    /// By the rule and all its candidates.
    exact: BTreeMap<(Span, Vec<Value>), usize>,
    /// By the rule alone: the candidate's values.
    last: BTreeMap<Span, Vec<Value>>,
}

/// A choice with all that a habit is made of.
#[derive(Debug)]
pub struct Chosen {
    span: Span,
    values: Vec<Value>,
    candidate: Vec<Value>,
    index: usize,
}

impl Habits {
    /// Takes on the choices of a step that agreed.
    pub fn learn(&mut self, chosen: Vec<Chosen>) {
        for Chosen { span, values, candidate, index } in chosen {
            self.last.insert(span, candidate);
            self.exact.insert((span, values), index);
        }
    }

    fn index(&self, choice: &Choice<'_>) -> usize {
        if let Some(index) = self.exact.get(&(choice.span, choice.values.to_vec())) {
            return *index;
        }
        let last = self.last.get(&choice.span);
        last.and_then(|last| (0..choice.candidates()).find(|index| choice.candidate(*index) == last)).unwrap_or(0)
    }
}

/// A few values of each domain that inputs have.
pub type Samples = BTreeMap<DomainId, Vec<Value>>;

/// LIMIT: how many values of a domain are tried for an input that the record lacks.
const SAMPLES: usize = 8;

/// A few values of each domain that inputs have.
pub fn samples(machine: &mut Machine) -> Samples {
    let program = machine.program().clone();
    let inputs = program.functions.iter().filter(|f| matches!(f.kind, FunctionKind::Monitored | FunctionKind::Shared));
    let mut samples = Samples::new();
    for function in inputs {
        let domain = function.codomain;
        samples.entry(domain).or_insert_with(|| some_values(machine, &program, domain));
    }
    samples
}

fn some_values(machine: &mut Machine, program: &Program, domain: DomainId) -> Vec<Value> {
    let mut values = match &program.domain(domain).kind {
        DomainKind::Basic(model::Basic::Boolean) => vec![Value::Boolean(false), Value::Boolean(true)],
        DomainKind::Basic(model::Basic::Integer | model::Basic::Natural) => vec![Value::Integer(0)],
        DomainKind::Enum { literals } => (0..literals.len() as u32).map(|index| Value::Enum(domain, index)).collect(),
        _ => machine.elements(domain).unwrap_or_default(),
    };
    values.truncate(SAMPLES);
    if values.is_empty() { vec![Value::Undef] } else { values }
}

/// The environment of one step.
#[derive(Debug)]
pub struct RecordedInputs<'a> {
    values: BTreeMap<&'a str, &'a str>,
    /// The last values of the locations that the record has several times.
    last: BTreeMap<&'a str, &'a str>,
    samples: &'a Samples,
    /// The numbers that the state after the step has: one drawn is among them, if anything came of it.
    numbers: Vec<Value>,
    /// Our elements by their names in the record.
    renaming: &'a BTreeMap<String, String>,
    /// Inputs beyond the record are no choices.
    strict: bool,
    plan: Vec<Made>,
    /// What choices beyond the plan go by; none for the first candidate.
    habits: Option<&'a Habits>,
    /// The choices made.
    pub made: Vec<Made>,
    /// The same with all that a habit is made of.
    pub chosen: Vec<Chosen>,
    /// Locations asked for that the record does not have, or whose value cannot be read.
    pub beyond: Vec<String>,
}

impl<'a> RecordedInputs<'a> {
    /// What a step has.
    pub fn new(
        step: &'a Step,
        plan: Vec<Made>,
        habits: Option<&'a Habits>,
        strict: bool,
        samples: &'a Samples,
        renaming: &'a BTreeMap<String, String>,
    ) -> Self {
        let (mut values, mut last) = (BTreeMap::new(), BTreeMap::new());
        for (location, value) in step.inputs.iter().chain(&step.times) {
            if values.insert(location.as_str(), value.as_str()).is_some() {
                last.insert(location.as_str(), value.as_str());
            }
        }
        for (location, value) in step.inputs.iter().chain(&step.times).rev() {
            values.insert(location.as_str(), value.as_str());
        }
        let (made, chosen, beyond) = (Vec::new(), Vec::new(), Vec::new());
        let numbers = numbers(step);
        RecordedInputs { values, last, samples, numbers, renaming, strict, plan, habits, made, chosen, beyond }
    }

    fn take(&mut self, of: usize, habit: usize) -> usize {
        let index = self.plan.get(self.made.len()).map_or(habit, |planned| planned.index.min(of - 1));
        self.made.push(Made { index, of });
        index
    }
}

impl Environment for RecordedInputs<'_> {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        let theirs = |element: &str| self.renaming.get(element).cloned().unwrap_or_else(|| element.to_string());
        let name = painted(&text::location(program, &location.to_location()), &theirs);
        let ours = |element: &str| {
            let found = self.renaming.iter().find(|(_, theirs)| theirs.as_str() == element);
            found.map_or_else(|| element.to_string(), |(ours, _)| ours.clone())
        };
        let again = self.last.get(name.as_str()).filter(|_| is_twin(program, location.function));
        let recorded = again.or_else(|| self.values.get(name.as_str())).map(|value| painted(value, &ours));
        if let Some(value) = recorded.and_then(|value| text::value(program, codomain, &value)) {
            return Ok(value);
        }
        self.beyond.push(name);
        let samples = self.samples.get(&codomain).map_or(&[][..], Vec::as_slice);
        let index = if self.strict || samples.len() < 2 { 0 } else { self.take(samples.len(), 0) };
        Ok(samples.get(index).cloned().unwrap_or_default())
    }

    fn number(&mut self, _program: &Program, draw: &Draw) -> Result<Value, String> {
        let admitted: Vec<Value> = self.numbers.iter().filter(|number| draw.admits(number)).cloned().collect();
        if admitted.is_empty() {
            return Ok(draw.number(0));
        }
        let index = self.take(admitted.len(), 0);
        Ok(admitted[index].clone())
    }

    fn choose(&mut self, _program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let habit = self.habits.map_or(0, |habits| habits.index(choice));
        let index = self.take(choice.candidates(), habit);
        let (values, candidate) = (choice.values.to_vec(), choice.candidate(index).to_vec());
        self.chosen.push(Chosen { span: choice.span, values, candidate, index });
        Ok(index)
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        let name = match unit {
            TimeUnit::Nanoseconds => "currTimeNanosecs",
            TimeUnit::Milliseconds => "currTimeMillisecs",
            TimeUnit::Seconds => "currTimeSecs",
        };
        if let Some(value) = self.values.get(name).and_then(|value| value.parse().ok()) {
            return Ok(value);
        }
        // A reading that the record lacks is among the numbers of the next state, if anything came of it.
        let whole = |number: &Value| matches!(number, Value::Integer(_));
        let numbers: Vec<Value> = self.numbers.iter().rev().filter(|number| whole(number)).cloned().collect();
        if self.strict || numbers.is_empty() {
            self.beyond.push(name.to_string());
            return Ok(0);
        }
        let index = self.take(numbers.len(), 0);
        match numbers[index] {
            Value::Integer(time) => Ok(time),
            _ => Ok(0),
        }
    }
}

fn numbers(step: &Step) -> Vec<Value> {
    let texts = step.after.iter().flatten().map(|(_, value)| value.as_str());
    let mut numbers: Vec<Value> = texts
        .filter_map(|text| {
            let real = || text.parse().ok().filter(|_| text.contains('.')).and_then(Real::new).map(Value::Real);
            text.parse().ok().map(Value::Integer).or_else(real)
        })
        .collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// The plan after this one in the order of a count, the last choice fastest; none after the last.
pub fn next_plan(made: &[Made]) -> Option<Vec<Made>> {
    let last = made.iter().rposition(|choice| choice.index + 1 < choice.of)?;
    let mut plan = made[..=last].to_vec();
    plan[last].index += 1;
    Some(plan)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plans_count_through_all_choices() {
        let mut plan = vec![Made { index: 0, of: 2 }, Made { index: 0, of: 3 }];
        let mut count = 1;
        while let Some(mut next) = next_plan(&plan) {
            next.resize(2, Made { index: 0, of: 3 });
            plan = next;
            count += 1;
        }
        assert_eq!(count, 6);
    }
}
