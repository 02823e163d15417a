//! Which functions keep their values, so that compiled code may read them as constants.
//!
//! In: a program and a started core. Out: by function the values at its numbered locations, where no step changes them. INVARIANT:
//! the code is run only while the locations have these values. Whoever changes one from outside has the machine look again
//! ([`crate::machine::Machine::has_code`]); a search says beforehand what differs between its initial states
//! ([`crate::inside::Elsewhere`]).

use std::sync::Arc;

use program::{FunctionId, FunctionKind, Program};

use crate::execute::Core;
use crate::value::Value;
use crate::weighed::Items;

/// By function, the values at its numbered locations, in their order; none where they may change.
pub(super) fn settled_functions(program: &Program, core: &Core, lazy: &[bool]) -> Vec<Option<Arc<Items>>> {
    let updated = program.updated_functions();
    (0..program.functions.len())
        .map(|index| {
            let function = FunctionId(index as u32);
            let kind = program.function(function).kind;
            let kept = matches!(kind, FunctionKind::Controlled | FunctionKind::Out)
                && core.plain[index]
                && !lazy[index]
                && !core.elsewhere.varies(function)
                && !updated.contains(&function)
                && Some(function) != program.self_function;
            kept.then(|| values_of(core, function)).flatten().map(|values| Arc::new(Items::new(values.to_vec())))
        })
        .collect()
}

/// Of which functions, that were settled, the locations have other values now.
pub(super) fn unsettled(settled: &[Option<Arc<Items>>], core: &Core) -> Vec<FunctionId> {
    let functions = (0..).map(FunctionId).zip(settled);
    let changed = functions.filter(|(function, values)| {
        values.as_ref().is_some_and(|values| values_of(core, *function) != Some(&values[..]))
    });
    changed.map(|(function, _)| function).collect()
}

fn values_of(core: &Core, function: FunctionId) -> Option<&[Value]> {
    let dense = core.store.dense(function)?;
    Some(&core.store.values[dense.start as usize..dense.end as usize])
}
