//! Repeats a run that a solver found; only a run that the machine makes is reported.
//!
//! In: values of the inputs of each step. Out: the run as a trace, if the machine makes it and reaches the target. So
//! the machine's semantics checks the solver, and our encoding.

use std::sync::Arc;

use explore::{Given, Told};
use machine::{EngineChoice, FaultClass, Location, Machine, Value};
use program::Program;
use rustc_hash::FxHashMap;
use solve::session::Constant;
use solve::shared::{VariableId, value_at};

use crate::plan::Plan;
use crate::solver::relation::Relation;
use crate::solver::unrolling::SolverRun;
use crate::target::Target;
use crate::trace::Trace;
use solve::encode::InputKind;
use solve::symbol::{Symbol, value_of};

/// The run as the machine makes it; `None` if the machine does something else.
pub(crate) fn replay(
    program: &Arc<Program>,
    plan: &Plan,
    relation: &Relation,
    found: &SolverRun,
    target: Target,
) -> Option<Trace> {
    let start = &relation.starts[found.start];
    let mut machine = Machine::new(Arc::clone(program), plan.settings.limits.clone());
    machine.use_engine(EngineChoice::Interpreted);
    machine.start(&mut Given::new(&start.told)).ok()?;
    let mut trace = Trace { start: start.told.clone(), values: start.values.clone(), ..Trace::default() };
    let last = found.steps.len() - 1;
    for (step, mut given) in decided(relation, found)?.into_iter().enumerate() {
        if step == last && matches!(target, Target::Condition(_)) {
            break;
        }
        let mut told = Told::default();
        let prepared = machine.prepare(&mut given);
        let mut failed = false;
        let outcome = prepared.and_then(|()| {
            for (index, (formula, assumed)) in plan.settings.step_conditions.iter().enumerate() {
                let holds = match machine.evaluate(formula, &mut given) {
                    Err(fault) if *assumed || !fault.kind.is_of_the_model() => return Err(fault),
                    truth => truth == Ok(Value::Boolean(true)),
                };
                failed |= !holds && target == Target::StepCondition(index);
            }
            Ok(())
        });
        told.inputs = machine.inputs();
        match outcome {
            Ok(()) => {
                machine.commit();
                told.changes = machine.changes();
            }
            Err(fault) => told.fault = Some(Box::new(fault)),
        }
        told.choices = std::mem::take(&mut given.taken);
        let reached = match (target, &told.fault) {
            (Target::Fault(class), Some(fault)) => FaultClass::of(fault) as usize == class,
            (Target::StepCondition(_), None) => failed,
            (Target::Rest, None) => told.changes.is_empty(),
            _ => false,
        };
        if step == last && !reached || step < last && told.fault.is_some() {
            return None;
        }
        if target != Target::Rest || step < last {
            trace.steps.push(told);
        }
        machine.forget_inputs();
    }
    if let Target::Condition(index) = target {
        let truth = machine.evaluate(&plan.settings.conditions[index], &mut Given::default());
        if truth == Ok(Value::Boolean(true)) {
            return None;
        }
    }
    Some(trace)
}

/// The inputs and choices of each step.
fn decided(relation: &Relation, found: &SolverRun) -> Option<Vec<Given>> {
    let inputs = relation.input_variables();
    let place: FxHashMap<VariableId, usize> = inputs.iter().copied().zip(0..).collect();
    let begin =
        relation.terms.values(&|id| (Some(id) == relation.start).then_some(Constant::Integer(found.start as i128)));
    let mut state: FxHashMap<VariableId, Option<Constant>> =
        relation.state.iter().copied().zip(relation.initial.iter().map(|node| value_at(&begin, *node))).collect();
    let mut all = Vec::new();
    for step in &found.steps {
        let values = relation.terms.values(&|id| match place.get(&id) {
            Some(index) => step[*index],
            None => state.get(&id).copied().flatten(),
        });
        let truth = |node| value_at(&values, node) == Some(Constant::Boolean(true));
        let mut given = Given::default();
        for (input, value) in relation.inputs.iter().zip(step) {
            if let (InputKind::Location(function, arguments, shape), Some(value)) = (&input.kind, value) {
                let location = Location { function: *function, arguments: arguments.clone() };
                given.inputs.insert(location, value_of(&relation.codes, *shape, *value)?);
            }
        }
        for choice in relation.choices.iter().filter(|choice| truth(choice.made)) {
            for draw in &choice.draws {
                given.numbers.push_back(shown(relation, &values, draw)?);
            }
            let taken = choice.candidates.iter().find(|(taken, _)| truth(*taken));
            if let Some((_, symbols)) = taken {
                let values: Option<Vec<Value>> =
                    symbols.iter().map(|symbol| shown(relation, &values, symbol)).collect();
                given.choices.push_back(values?);
            }
        }
        all.push(given);
        state = relation.state.iter().copied().zip(relation.next.iter().map(|node| value_at(&values, *node))).collect();
    }
    Some(all)
}

/// The value of a symbol, given the solver's values.
fn shown(relation: &Relation, values: &[Option<Constant>], symbol: &Symbol) -> Option<Value> {
    match symbol {
        Symbol::Known(value) => Some(value.clone()),
        Symbol::Open(open) => match value_at(values, open.defined)? {
            Constant::Boolean(true) => value_of(&relation.codes, open.shape, value_at(values, open.value)?),
            _ => Some(Value::Undef),
        },
        Symbol::Tuple(parts) => {
            let parts: Option<Vec<Value>> = parts.iter().map(|part| shown(relation, values, part)).collect();
            parts.map(Value::tuple)
        }
        Symbol::Set(elements) => {
            let mut present = Vec::new();
            for (here, element) in elements {
                if value_at(values, *here)? == Constant::Boolean(true) {
                    present.push(shown(relation, values, element)?);
                }
            }
            Some(Value::set(present))
        }
    }
}
