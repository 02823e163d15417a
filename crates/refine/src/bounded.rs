//! When it matters for a proof that inputs had only some of their values.
//!
//! In: a product that was searched, the bounds that it was searched with. Out: the bounds for which a proof is not sure. A bound leaves
//! something out only if a step or an initial state looked at the input, and if the input is [`crate::limited`]. INVARIANT: where nothing is
//! returned, a search without these bounds gives the same proof. What bounds leave out of the abstract machine's answers is unclear in
//! the game itself ([`crate::product`]).

use std::collections::BTreeSet;

use machine::Value;
use program::FunctionId;

use crate::limited::all_values;
use crate::options::Extent;
use crate::product::Product;
use crate::report::Why;
use crate::{ABSTRACT, CONCRETE};

/// The input of the concrete machine that an input of the abstract one is; none if this is free, or a term.
fn counterpart(product: &Product<'_>, input: FunctionId) -> Option<FunctionId> {
    let shared = &product.judge.coupling.shared[CONCRETE];
    shared.iter().filter(|(_, named)| named.contains(&input.0)).map(|(there, _)| *there).min()
}

/// Whether all values of an input of the concrete machine are among those that an input of the abstract one had.
fn within(product: &Product<'_>, values: Option<&Vec<Value>>, abstract_values: &[Value]) -> bool {
    let bridges = &product.judge.coupling.joint.bridges;
    let over = |side: usize, values: &[Value]| -> Option<BTreeSet<Value>> {
        values.iter().map(|value| bridges[side].over(value)).collect()
    };
    let all = values.and_then(|values| over(CONCRETE, values));
    let had = over(ABSTRACT, abstract_values);
    all.zip(had).is_some_and(|(all, had)| all.is_subset(&had))
}

/// The bounds without which there might have been more to answer.
pub(crate) fn of_proof(product: &Product<'_>, extents: &[Extent; 2]) -> Vec<Why> {
    let of_concrete = product.sides[CONCRETE].limited_and_read();
    // An input that the concrete machine ignores takes the values that the abstract machine was searched with.
    let matters = |input: &FunctionId| match counterpart(product, *input) {
        None => false,
        // It is told already.
        Some(there) if of_concrete.contains(&there) => false,
        Some(there) => {
            let all = all_values(&product.sides[CONCRETE].program, &extents[CONCRETE], there);
            !within(product, all.as_ref(), &extents[ABSTRACT].bounds[input])
        }
    };
    let of_abstract = product.sides[ABSTRACT].limited_and_read().into_iter().filter(matters);
    let all = of_abstract.map(|input| Why::Bounded(ABSTRACT, input));
    all.chain(of_concrete.iter().map(|input| Why::Bounded(CONCRETE, *input))).collect()
}
