//! Verifies of the abstract machine the properties that come along to the concrete one, so that they hold there without an *if*.
//!
//! In: the abstract model, what a proof of refinement says of its properties, options. Out: by index of the property, its outcome. Only
//! properties that come along are looked at. INVARIANT: a property holds by the same search, and under the same assumptions of the
//! model, as `verify` would say.

use std::collections::BTreeMap;
use std::sync::Arc;

use program::{Program, PropertyKind};
use refine::Preserved;
use verify::{NoStart, Options, Outcome, Progress, Subject};

/// Verifies the properties of a program that come along.
///
/// # Errors
/// There is no initial state.
pub fn verify_preserved(
    program: &Arc<Program>,
    properties: &[Preserved],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<BTreeMap<usize, Outcome>, NoStart> {
    let asked: Vec<usize> =
        properties.iter().filter(|property| property.form.is_ok()).map(|property| property.property).collect();
    if asked.is_empty() {
        return Ok(BTreeMap::new());
    }
    let mut asked_alone = (**program).clone();
    // By place in the smaller program, which property it is.
    let mut places = Vec::new();
    let mut kept = Vec::new();
    for (index, property) in program.properties.iter().enumerate() {
        let claimed = matches!(property.kind, PropertyKind::Invariant | PropertyKind::Ctl | PropertyKind::Ltl);
        if !claimed || asked.contains(&index) {
            places.push(index);
            kept.push(property.clone());
        }
    }
    asked_alone.properties = kept;
    let report = verify::verify(&Arc::new(asked_alone), options, watch)?;
    let outcomes = report.verdicts.into_iter().filter_map(|verdict| match verdict.subject {
        Subject::Property(place) => Some((places[place], verdict.outcome)),
        _ => None,
    });
    Ok(outcomes.collect())
}
