//! A counterexample as a run of the whole system: machines that were left out of the search get inputs, too.
//!
//! In: the trace of a part, and the ground model of the whole chart. Out: a trace of the ground model. What the part was given, the whole is
//! given; each other input keeps a value that is drawn once. INVARIANT: the run was made to its end; what was left out changes no times, so
//! that any inputs will do with which its machines make their steps.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;

use explore::{ChoiceTaken, Told};
use machine::{Choice, Limits, Location, Show, Value};
use program::Program;
use simulate::{Ask, Bounds, Choices, Chooser, End, Inputs, Invariants, Options, RandomSource, Record, Run, Source};
use verify::Trace;

use crate::picked::Picked;
use crate::simulate::read_value;

/// LIMIT: as often are other inputs tried, if a machine that was left out cannot make a step.
const SEEDS: u64 = 16;

/// The run of the whole; none if no inputs were found with which it is made to its end.
pub(crate) fn whole_run(whole: &Arc<Program>, limits: &Limits, part: &Program, trace: &Trace) -> Option<Trace> {
    let said = |told: &Told| -> Vec<(String, String)> {
        told.inputs.iter().map(|(at, value)| (at.show(part).to_string(), value.show(part).to_string())).collect()
    };
    let given: Vec<_> = std::iter::once(&trace.start).chain(&trace.steps).map(said).collect();
    let picked: Vec<_> =
        std::iter::once(&trace.start).chain(&trace.steps).map(|told| Picked::of(part, &told.choices)).collect();
    (0..SEEDS).find_map(|seed| {
        let kept = Kept { random: RandomSource::new(seed, Bounds::default()), values: Vec::new() };
        let step = Rc::new(Cell::new(0));
        let given = Given { steps: given.clone(), step: Rc::clone(&step) };
        let chosen = Chosen { steps: picked.clone(), step };
        made(whole, limits, Inputs::new().with(given).with(kept).choosing(Choices::asked(chosen)), trace)
    })
}

fn made(whole: &Arc<Program>, limits: &Limits, inputs: Inputs, trace: &Trace) -> Option<Trace> {
    let steps = trace.steps.len();
    let options = Options { steps: Some(steps as u64), invariants: Invariants::Ignore, ..Options::default() };
    let mut run = Run::new(Arc::clone(whole), limits.clone(), inputs, options);
    let mut made = Trace { turn: trace.turn, ends: trace.ends, branch: trace.branch, ..Trace::default() };
    let told = |inputs, choices: Vec<simulate::ChoiceMade>| {
        let choices = choices.into_iter().map(|choice| ChoiceTaken { span: choice.span, values: choice.values });
        Told { inputs, choices: choices.collect(), ..Told::default() }
    };
    while let Some(record) = run.advance() {
        match record {
            Record::Initial { inputs, choices, values, .. } => {
                (made.start, made.values) = (told(inputs, choices), values);
            }
            Record::Step(step) => made.steps.push(told(step.inputs, step.choices)),
            Record::Attempt(step) => made.steps.push(told(step.inputs, step.choices)),
            Record::End(End::Fault(fault)) => made.steps.last_mut()?.fault = Some(fault),
            Record::Back { .. } | Record::End(_) => {}
        }
    }
    let fails = |trace: &Trace| trace.steps.last().is_some_and(|step| step.fault.is_some());
    (made.steps.len() == steps && fails(&made) == fails(trace)).then_some(made)
}

/// What the part was given, by the names of its inputs: the programs of both number their functions differently.
struct Given {
    steps: Vec<Vec<(String, String)>>,
    /// The step being made, for [`Chosen`].
    step: Rc<Cell<u64>>,
}

impl Source for Given {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        let name = ask.location.show(ask.program).to_string();
        let found = self.steps.get(ask.step as usize).and_then(|step| step.iter().find(|(input, _)| *input == name));
        found.map(|(_, text)| read_value(ask.program, ask.codomain, text)).transpose()
    }

    fn has_writes(&self) -> bool {
        true
    }

    /// Nothing is written: this is asked when a step begins.
    fn writes(&mut self, step: u64) -> Vec<(Location, Value)> {
        self.step.set(step);
        Vec::new()
    }
}

/// What the part chose; the first candidate where it chose nothing.
struct Chosen {
    steps: Vec<Picked>,
    step: Rc<Cell<u64>>,
}

impl Chooser for Chosen {
    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let picked = self.steps.get_mut(self.step.get() as usize);
        Ok(picked.and_then(|picked| picked.take(program, choice)).unwrap_or(0))
    }
}

/// Values that are drawn once.
struct Kept {
    random: RandomSource,
    values: Vec<(Location, Value)>,
}

impl Source for Kept {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        if let Some((_, value)) = self.values.iter().find(|(location, _)| location.borrowed() == ask.location) {
            return Ok(Some(value.clone()));
        }
        let drawn = self.random.input(ask)?;
        self.values.extend(drawn.clone().map(|value| (ask.location.to_location(), value)));
        Ok(drawn)
    }
}
