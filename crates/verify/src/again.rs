//! Repeats a run that was found, as `run` would make it; only then a check is called violated.
//!
//! In: a run, and what is violated at its end. Out: whether a machine without exploration makes the same steps from the
//! same inputs and choices, and ends the same way. This checks the search: if the results differ, the search is at
//! fault, and nothing is known. LIMIT: that no step changes the last state, or satisfies the assumptions there, and that an
//! infinite run violates a formula, is not checked again; the steps that lead there are.

use std::collections::VecDeque;
use std::sync::Arc;

use explore::{ChoiceTaken, Settings, Told};
use machine::{Choice, EngineChoice, Environment, FaultClass, Location, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Program};

use crate::target::Target;
use crate::trace::Trace;

/// The inputs and choices of a step.
#[derive(Debug, Default)]
struct Given<'t> {
    inputs: &'t [(Location, Value)],
    choices: VecDeque<&'t ChoiceTaken>,
}

impl<'t> Given<'t> {
    fn new(told: &'t Told) -> Given<'t> {
        Given { inputs: &told.inputs, choices: told.choices.iter().collect() }
    }
}

impl Environment for Given<'_> {
    fn monitored(&mut self, _: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        let given = self.inputs.iter().find(|(one, _)| one.borrowed() == location);
        given.map(|(_, value)| value.clone()).ok_or_else(|| "an input that was not given".to_string())
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let next = self.choices.iter().position(|taken| taken.span == choice.span);
        let wanted = next.and_then(|next| self.choices.remove(next)).ok_or("a choice that was not made")?;
        let found = (0..choice.candidates()).find(|index| choice.candidate(*index) == wanted.values);
        found.ok_or_else(|| "a candidate that there is not".to_string())
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Err("the clock".to_string())
    }
}

/// Whether the machine makes this run and meets the target at its end; without a target, the run violates by its steps
/// alone.
pub(crate) fn made_again(program: &Arc<Program>, settings: &Settings, trace: &Trace, target: Option<Target>) -> bool {
    let mut machine = Machine::new(Arc::clone(program), settings.limits.clone());
    machine.use_engine(EngineChoice::Interpreted);
    if machine.start(&mut Given::new(&trace.start)).is_err() {
        return false;
    }
    let mut at_turn = None;
    for (number, told) in trace.steps.iter().enumerate() {
        if trace.turn == Some(number) {
            at_turn = Some(state(&machine));
        }
        let last = number + 1 == trace.steps.len();
        let ends = match target {
            Some(target) if last => Some(target),
            _ => None,
        };
        if !step(&mut machine, settings, told, ends) {
            return false;
        }
    }
    if at_turn.is_some_and(|former| former != state(&machine)) {
        return false;
    }
    match target {
        Some(Target::Condition(index)) => {
            let formula = &settings.conditions[index];
            machine.forget_inputs();
            machine.evaluate(formula, &mut Given::default()) != Ok(Value::Boolean(true))
        }
        Some(Target::Fault(_) | Target::StepCondition(_)) => !trace.steps.is_empty(),
        Some(Target::Rest) | None => true,
    }
}

/// Whether a step is made with these inputs and choices, and ends as expected.
fn step(machine: &mut Machine, settings: &Settings, told: &Told, ends: Option<Target>) -> bool {
    let mut given = Given::new(told);
    let outcome = machine.prepare(&mut given);
    let same_inputs = |machine: &Machine| {
        let inputs = machine.inputs();
        told.inputs.iter().all(|(location, value)| {
            let asked = inputs.iter().find(|(other, _)| other == location);
            asked.is_none_or(|(_, other)| other == value)
        })
    };
    let fault = match outcome {
        Ok(()) => {
            let mut violated = false;
            for (index, (formula, assumed)) in settings.step_conditions.iter().enumerate() {
                match machine.evaluate(formula, &mut given) {
                    Ok(Value::Boolean(true)) => {}
                    // Where an assumption has no value it is not known whether a step counts.
                    Ok(_) | Err(_) if *assumed => return false,
                    Err(fault) if !fault.kind.is_of_the_model() => {
                        return is_fault(&fault, ends) && same_inputs(machine);
                    }
                    Ok(_) | Err(_) => violated |= ends == Some(Target::StepCondition(index)),
                }
            }
            if matches!(ends, Some(Target::StepCondition(_))) && !violated {
                return false;
            }
            None
        }
        Err(fault) => {
            let mut assumptions = settings.step_conditions.iter().filter(|(_, assumed)| *assumed);
            if !assumptions.all(|(formula, _)| machine.evaluate(formula, &mut given) == Ok(Value::Boolean(true))) {
                return false;
            }
            Some(fault)
        }
    };
    if !same_inputs(machine) {
        return false;
    }
    match (fault, &told.fault) {
        (None, None) => {
            machine.commit();
            let changes = machine.changes();
            let same = changes.len() == told.changes.len()
                && changes.iter().zip(&told.changes).all(|(a, b)| (&a.location, &a.after) == (&b.location, &b.after));
            same && !matches!(ends, Some(Target::Fault(_)))
        }
        // If its step cannot be made, the run stays where it is, and goes on with other inputs.
        (Some(fault), Some(other)) => {
            machine.discard();
            machine.forget_inputs();
            FaultClass::of(&fault) == FaultClass::of(other) && (ends.is_none() || is_fault(&fault, ends))
        }
        _ => false,
    }
}

fn is_fault(fault: &machine::Fault, ends: Option<Target>) -> bool {
    matches!(ends, Some(Target::Fault(class)) if FaultClass::of(fault) as usize == class)
}

/// The state between steps.
fn state(machine: &Machine) -> Vec<(Location, Value)> {
    let input =
        |location: &Location| machine.program().function(location.function).kind == program::FunctionKind::Monitored;
    machine.locations().into_iter().filter(|(location, _)| !input(location)).collect()
}
