//! When it matters that inputs had only some of their values.
//!
//! In: a product that was searched, the bounds that it was searched with. Out: the bounds for which a verdict is not sure. A bound leaves
//! something out only if a step or an initial state looked at the input, and if the input is [`crate::limited`]. INVARIANT: where nothing is
//! returned, a search without these bounds gives the same verdict.

use std::collections::BTreeSet;

use explore::input_values;
use machine::Value;
use program::FunctionId;

use crate::limited::all_values;
use crate::options::Extent;
use crate::product::Product;
use crate::report::Why;
use crate::{ABSTRACT, CONCRETE};

/// How an input of the abstract machine gets its value.
enum Source {
    /// It takes what it likes.
    Free,
    /// It is an input of the concrete machine.
    Input(FunctionId),
    /// It is a term over the concrete machine, which has its value in every step.
    Term,
}

fn source(product: &Product<'_>, input: FunctionId) -> Source {
    let shared = &product.judge.coupling.shared;
    if !shared[ABSTRACT].contains_key(&input) {
        return Source::Free;
    }
    let mut there: Vec<FunctionId> =
        shared[CONCRETE].iter().filter(|(_, named)| named.contains(&input.0)).map(|(there, _)| *there).collect();
    there.sort_unstable();
    there.first().map_or(Source::Term, |there| Source::Input(*there))
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

/// The bounds without which the abstract machine might have had an answer.
pub(crate) fn of_refutation(product: &Product<'_>, extents: &[Extent; 2]) -> Vec<Why> {
    let matters = |input: &FunctionId| match source(product, *input) {
        Source::Free | Source::Term => true,
        // What the concrete machine's input may be, bounds included.
        Source::Input(there) => {
            let program = &product.sides[CONCRETE].program;
            let given = input_values(program, &extents[CONCRETE].bounds, &extents[CONCRETE].undefined).remove(&there);
            let all = given.or_else(|| all_values(program, &extents[CONCRETE], there));
            !within(product, all.as_ref(), &extents[ABSTRACT].bounds[input])
        }
    };
    let looked = product.sides[ABSTRACT].limited_and_read();
    looked.into_iter().filter(matters).map(|input| Why::Bounded(ABSTRACT, input)).collect()
}

/// The bounds without which there might have been more to answer.
pub(crate) fn of_proof(product: &Product<'_>, extents: &[Extent; 2]) -> Vec<Why> {
    let of_concrete = product.sides[CONCRETE].limited_and_read();
    // An input that the concrete machine ignores takes the values that the abstract machine was searched with.
    let matters = |input: &FunctionId| match source(product, *input) {
        Source::Free | Source::Term => false,
        // It is told already.
        Source::Input(there) if of_concrete.contains(&there) => false,
        Source::Input(there) => {
            let all = all_values(&product.sides[CONCRETE].program, &extents[CONCRETE], there);
            !within(product, all.as_ref(), &extents[ABSTRACT].bounds[input])
        }
    };
    let of_abstract = product.sides[ABSTRACT].limited_and_read().into_iter().filter(matters);
    let all = of_abstract.map(|input| Why::Bounded(ABSTRACT, input));
    all.chain(of_concrete.iter().map(|input| Why::Bounded(CONCRETE, *input))).collect()
}
