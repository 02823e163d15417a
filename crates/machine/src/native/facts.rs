//! What compiled code relies on of the machine that runs it.
//!
//! In: a program and a started core. Out: [`Facts`], by which it is told whether code fits another machine of the program.

use std::sync::Arc;

use program::{Certain, FunctionId, FunctionKind, Program};

use crate::execute::Core;
use crate::layout::Layout;
use crate::membership::Membership;
use crate::memo::Shelf;
use crate::native::settled::settled_functions;
use crate::value::Value;
use crate::weighed::Items;

/// What code relies on of the machine that runs it.
#[derive(Debug, PartialEq)]
pub(super) struct Facts {
    pub layouts: Vec<Layout>,
    pub codomains: Vec<Membership>,
    pub contents: Vec<Option<Arc<Items>>>,
    /// By function: read without asking anybody.
    pub plain: Vec<bool>,
    /// By function: some initial values are still to be evaluated.
    pub lazy: Vec<bool>,
    /// By function: what is certain of its values before the first step.
    pub before: Vec<Certain>,
    /// A procedure may be run from outside that is not the main rule.
    pub entered: bool,
    /// Initial values may yet be evaluated in another state than the present one.
    pub late: bool,
    pub shelves: Vec<Option<Shelf>>,
    /// By function: the values at its numbered locations, where they stay as they are.
    pub settled: Vec<Option<Arc<Items>>>,
}

impl Facts {
    /// Those of a started machine.
    pub fn of(program: &Program, core: &Core) -> Facts {
        let lazy: Vec<bool> = (0..program.functions.len()).map(|index| is_lazy(core, index)).collect();
        Facts {
            layouts: core.store.layouts.to_vec(),
            settled: settled_functions(program, core, &lazy),
            codomains: core.codomains.clone(),
            contents: core.contents.clone(),
            plain: core.plain.clone(),
            lazy,
            before: before_steps(program, core),
            entered: core.entered,
            late: core.origin.is_some(),
            shelves: core.memo.shelves().to_vec(),
        }
    }
}

/// By function, what is certain of its values before the first step.
fn before_steps(program: &Program, core: &Core) -> Vec<Certain> {
    (0..program.functions.len() as u32).map(|index| before(program, core, FunctionId(index))).collect()
}

fn before(program: &Program, core: &Core, function: FunctionId) -> Certain {
    let index = function.0 as usize;
    let known = matches!(program.function(function).kind, FunctionKind::Controlled | FunctionKind::Out)
        && !core.unset
        && core.plain[index]
        && core.initials[index].is_some()
        && Some(function) != program.self_function;
    if !known {
        return Certain::NOTHING;
    }
    let places = core.store.indices_of(function).into_iter().map(|place| place as usize);
    // A location that has no value yet gets its initial value as soon as it is looked at.
    let there = places.filter(|place| core.store.given[*place] != 0 || !core.store.values[*place].is_undef());
    let values: Vec<&Value> = there.map(|place| &core.store.values[place]).collect();
    let same = !core.elsewhere.varies(function);
    let certain = of_values(&values, bounds_of(&core.codomains[index]));
    Certain {
        defined: certain.defined && !core.elsewhere.may_be_undef(function),
        solid: certain.solid && same,
        bounds: certain.bounds.filter(|_| same),
    }
}

/// What is certain of these values, which are to lie within these bounds.
pub(super) fn of_values(values: &[&Value], bounds: Option<(i64, i64)>) -> Certain {
    Certain {
        defined: !values.iter().any(|value| value.is_undef()),
        solid: values.iter().all(|value| is_solid(value)),
        bounds: bounds.filter(|(low, high)| {
            values.iter().all(|value| match value {
                Value::Integer(n) => (low..=high).contains(&n),
                Value::Undef => true,
                _ => false,
            })
        }),
    }
}

/// Whether no element of a value is undef.
pub(crate) fn is_solid(value: &Value) -> bool {
    match value {
        Value::Tuple(items) | Value::Seq(items) | Value::Set(items) => !items.iter().any(Value::is_undef),
        Value::Bag(counts) => !counts.keys().any(Value::is_undef),
        Value::Map(entries) => !entries.iter().any(|(key, value)| key.is_undef() || value.is_undef()),
        Value::Undef
        | Value::Boolean(_)
        | Value::Integer(_)
        | Value::Real(_)
        | Value::Enum(..)
        | Value::Element(..)
        | Value::Char(_)
        | Value::Rule(_)
        | Value::Complex(_)
        | Value::String(_) => true,
    }
}

pub(super) fn bounds_of(membership: &Membership) -> Option<(i64, i64)> {
    match membership {
        Membership::Natural => Some((0, i64::MAX)),
        Membership::Between(low, high) => Some((*low, *high)),
        Membership::Any | Membership::Domain(_) => None,
    }
}

/// Whether some location of a function that has a number may yet get an initial value.
fn is_lazy(core: &Core, function: usize) -> bool {
    core.initials[function].is_some()
        && match &core.store.layouts[function] {
            Layout::Single(index) => core.store.given[*index as usize] == 0,
            Layout::Dense { base, len, .. } => core.store.given[*base as usize..(*base + *len) as usize].contains(&0),
            Layout::None | Layout::Sparse => true,
        }
}
