//! Which bounds leave out values that an input may have, and which values inputs of both machines have.
//!
//! In: a program and what it is explored with. Out: the inputs that are limited: their domains and the assumptions leave them more values
//! than the bounds. Bounds that are assumed limit nothing: the verdict is about these values.

use std::collections::BTreeMap;
use std::sync::Arc;

use explore::input_values;
use machine::{Machine, Value};
use program::{FunctionId, Program};

use crate::coupling::Coupling;
use crate::options::{Extent, Options};
use crate::{ABSTRACT, CONCRETE};

/// All values of an input that its domain and the assumptions leave; none if they are not finitely many that can be listed.
pub(crate) fn all_values(program: &Arc<Program>, extent: &Extent, function: FunctionId) -> Option<Vec<Value>> {
    let assumed = extent.bounds.iter().filter(|(function, _)| extent.assumed.contains_key(function));
    let assumed = assumed.map(|(function, values)| (*function, values.clone())).collect();
    if let Some(values) = input_values(program, &assumed, &extent.undefined).remove(&function) {
        // Undef among the values of an infinite domain makes none that can be listed.
        return (!values.is_empty()).then_some(values);
    }
    let domain = program.function(function).codomain;
    if !program.constant_domains()[domain.0 as usize] || !program.is_listable(domain) {
        return None;
    }
    Machine::new(Arc::clone(program), extent.limits.clone()).elements(domain).ok()
}

/// Bounds that leave out values of an input.
#[derive(Debug)]
pub(crate) struct Limit {
    tried: Vec<Value>,
    /// All that the domain and the assumptions leave, if they can be listed.
    all: Option<Vec<Value>>,
}

impl Limit {
    /// Whether a value may be one that was left out.
    pub fn leaves_out(&self, value: &Value) -> bool {
        !self.tried.contains(value) && self.all.as_ref().is_none_or(|all| all.contains(value))
    }
}

/// The inputs of which bounds leave out values that the domain and the assumptions leave.
pub(crate) fn limited(program: &Arc<Program>, extent: &Extent) -> BTreeMap<FunctionId, Limit> {
    let mut given = input_values(program, &extent.bounds, &extent.undefined);
    let bounds = extent.bounds.keys().filter(|function| !extent.assumed.contains_key(function));
    let limit = |function: &FunctionId| {
        let limit = Limit { tried: given.remove(function)?, all: all_values(program, extent, *function) };
        let whole = limit.all.as_ref().is_some_and(|all| all.iter().all(|value| limit.tried.contains(value)));
        (!whole).then_some((*function, limit))
    };
    bounds.filter_map(limit).collect()
}

/// Options in which an input of the abstract machine that has no values to try has those of the concrete machine's input that it is: both
/// stand in one environment.
pub(crate) fn with_shared_inputs(coupling: &Coupling, options: &Options) -> Options {
    let mut options = options.clone();
    let [extent, concrete] = &mut options.extents;
    let (one, other) = (&coupling.programs[ABSTRACT], &coupling.programs[CONCRETE]);
    let has = input_values(one, &extent.bounds, &extent.undefined);
    let given = input_values(other, &concrete.bounds, &concrete.undefined);
    let bridges = &coupling.joint.bridges;
    let mut all: Vec<_> = coupling.shared[CONCRETE].iter().collect();
    all.sort_unstable();
    for (there, inputs) in all {
        let Some(values) = given.get(there).filter(|values| !values.is_empty()) else { continue };
        for input in inputs.iter().copied().map(FunctionId) {
            if has.contains_key(&input) || one.is_listable(one.function(input).codomain) {
                continue;
            }
            let taken = values.iter().map(|value| bridges[ABSTRACT].back(&bridges[CONCRETE].over(value)?));
            let Some(taken) = taken.collect::<Option<Vec<Value>>>() else { continue };
            extent.bounds.insert(input, taken);
            if !concrete.bounds.contains_key(there) || concrete.assumed.contains_key(there) {
                extent.assumed.insert(input, Default::default());
            }
        }
    }
    options
}
