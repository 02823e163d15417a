//! Tells the pair of states from which an obligation fails.
//!
//! In: the values that a solver gave to the variables, the steps of the diagram, the answers that were tried. Out: a [`Stuck`]. Nothing of
//! it is relied on: the pair may be one that no runs reach.

use std::collections::BTreeMap;

use machine::{Location, Show, Value};
use solve::session::Constant;
use solve::shared::{Node, VariableId, value_at};
use solve::symbol::value_of;

use super::proof::{Attempt, Stuck};
use super::replay::Scene;
use crate::coupling::Coupling;
use crate::formulas::answers::Offered;
use crate::formulas::ask::Model;
use crate::formulas::diagrams::{Answer, Step};
use crate::formulas::symbolic::{Store, Symbolic, input_location};
use crate::formulas::values::{least, values};
use crate::why::Differs;
use crate::{ABSTRACT, CONCRETE};

/// LIMIT: so many of the best candidates are told.
const TRIED: usize = 3;

/// Tells a pair of states, the steps from there, and the answers to the last of them.
pub(super) fn tell(
    store: &mut Store,
    coupling: &Coupling,
    machines: [&Symbolic; 2],
    model: &Model,
    steps: &[Step],
    answers: &[Answer],
    fault: Option<String>,
) -> Stuck {
    let here = machines.map(|machine| machine.here(&mut store.terms));
    let values = values(store, model);
    let shown = |side: usize, values: Vec<(Location, Value)>| -> Differs {
        let program = &coupling.programs[side];
        let one = |(location, value): (Location, Value)| {
            (location.show(program).to_string(), value.show(program).to_string())
        };
        values.into_iter().map(one).collect()
    };
    let states = [ABSTRACT, CONCRETE].map(|side| shown(side, values.state(machines[side], &here[side], Some(model))));
    let mut made = Vec::new();
    for step in steps {
        let mut inputs = Vec::new();
        for (input, own) in &step.inputs {
            if let (Some((function, arguments, shape)), true) = (input_location(input), model.contains_key(own)) {
                let location = Location { function, arguments: arguments.to_vec() };
                let constant = model[own];
                inputs.extend(value_of(values.codes, shape, constant).map(|value| (location, value)));
            }
        }
        let (before, after) =
            (values.state(machines[CONCRETE], &step.from, None), values.state(machines[CONCRETE], &step.to, None));
        let changes = match values.truth(step.goes) {
            true => after.into_iter().filter(|one| !before.contains(one)).collect(),
            false => Vec::new(),
        };
        made.push((shown(CONCRETE, inputs), shown(CONCRETE, changes)));
    }
    let mut tried: Vec<Attempt> = Vec::new();
    for answer in answers {
        if !values.truth(answer.made) || values.truth(answer.holds) {
            continue;
        }
        let failing: Vec<String> = (0..answer.parts.len())
            .filter(|part| !values.truth(answer.parts[*part]))
            .map(|part| coupling.conjunct(part))
            .collect();
        let stands = answer.m == 0 && failing.is_empty();
        let attempt = Attempt { m: answer.m, parts: failing, stands };
        if !tried.contains(&attempt) {
            tried.push(attempt);
        }
    }
    tried.sort_by_key(|attempt| (attempt.parts.len(), attempt.m == 0));
    tried.truncate(TRIED);
    Stuck { states, steps: made, fault, tried, faults: Default::default() }
}

/// The state that a concrete step begins in, with its inputs; none if it has values that no machine has.
pub(super) fn before(store: &Store, machine: &Symbolic, model: &Model, step: &Step) -> Option<Scene> {
    let values = values(store, model);
    let state = values.state(machine, &step.from, None);
    let mut inputs = BTreeMap::new();
    for (input, own) in &step.inputs {
        let Some((function, arguments, shape)) = input_location(input) else { continue };
        let constant = model.get(own).copied().unwrap_or_else(|| least(&store.terms, *own));
        let location = Location { function, arguments: arguments.to_vec() };
        inputs.insert(location, vec![value_of(values.codes, shape, constant)?]);
    }
    (state.len() == machine.places.len()).then_some(Scene { state, inputs })
}

/// The abstract state that a diagram begins in, with the values that inputs have in it.
pub(super) fn behind(store: &mut Store, machine: &Symbolic, model: &Model, offered: &Offered) -> Option<Scene> {
    let here = machine.here(&mut store.terms);
    let used = machine.used_inputs(&store.terms);
    let values = values(store, model);
    let state = values.state(machine, &here, None);
    let mut inputs = BTreeMap::new();
    for input in used {
        let (Some((function, arguments, shape)), Some(id)) = (input_location(&input), store.variable(input.variable))
        else {
            continue;
        };
        // What is not offered the machine takes as it likes.
        let Some(all) = offered.get(&id) else { continue };
        let valid = all.iter().filter(|(_, valid)| values.truth(*valid));
        let all: Option<Vec<Value>> = valid.map(|(value, _)| values.value(shape, *value)).collect();
        inputs.insert(Location { function, arguments: arguments.to_vec() }, all?);
    }
    (state.len() == machine.places.len()).then_some(Scene { state, inputs })
}

/// The first fault or stray that holds.
pub(super) fn which<'w, T>(store: &Store, model: &Model, of: impl Iterator<Item = (Node, &'w T)>) -> Option<&'w T> {
    let value = |id: VariableId| model.get(&id).copied();
    let values = store.terms.values(&value);
    let mut all: Vec<(Node, &T)> = of.collect();
    let found = all.iter().position(|(node, _)| value_at(&values, *node) == Some(Constant::Boolean(true)));
    found.map(|index| all.swap_remove(index).1)
}
