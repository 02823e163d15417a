//! Formulas that are decided by themselves, since the inputs that they read are a part of their states.
//!
//! In: a program with its temporal properties. Out: programs with some of them each. INVARIANT: a formula is decided over the inputs that
//! it and the assumed fairness read, whatever the other formulas of the program read.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use program::{FunctionId, FunctionKind, Program, Property, PropertyKind};

/// Formulas that read the same inputs.
pub(super) struct Group {
    /// The program, of whose formulas only these are left.
    pub program: Arc<Program>,
    /// By property of that program, its place in the whole program.
    pub places: Vec<usize>,
    /// Whether they, or the assumed fairness, read any input.
    pub reads_inputs: bool,
}

/// The formulas of a program, those that read no inputs first.
pub(super) fn groups(program: &Arc<Program>) -> Vec<Group> {
    let fair = program.properties.iter().filter(|property| is_fairness(property.kind));
    let fair: BTreeSet<FunctionId> = fair.flat_map(|property| inputs(program, property)).collect();
    let mut by_inputs: BTreeMap<BTreeSet<FunctionId>, BTreeSet<usize>> = BTreeMap::new();
    for (index, property) in program.properties.iter().enumerate().filter(|(_, property)| is_formula(property.kind)) {
        let read = &inputs(program, property) | &fair;
        by_inputs.entry(read).or_default().insert(index);
    }
    let is_alone = by_inputs.len() == 1;
    let group = |(read, formulas): (BTreeSet<FunctionId>, BTreeSet<usize>)| {
        let kept = |index: &usize| !is_formula(program.properties[*index].kind) || formulas.contains(index);
        let places: Vec<usize> = (0..program.properties.len()).filter(kept).collect();
        let mut part = Arc::clone(program);
        if !is_alone {
            let properties = places.iter().map(|index| program.properties[*index].clone()).collect();
            Arc::make_mut(&mut part).properties = properties;
        }
        Group { program: part, places, reads_inputs: !read.is_empty() }
    };
    by_inputs.into_iter().map(group).collect()
}

fn is_formula(kind: PropertyKind) -> bool {
    matches!(kind, PropertyKind::Ctl | PropertyKind::Ltl)
}

fn is_fairness(kind: PropertyKind) -> bool {
    matches!(kind, PropertyKind::Justice | PropertyKind::Compassion)
}

/// What a property reads that the environment gives.
fn inputs(program: &Program, property: &Property) -> BTreeSet<FunctionId> {
    let formulas = [Some(&property.formula), property.conclusion.as_ref()];
    let read = formulas.into_iter().flatten().flat_map(|formula| program.reads_and_more(formula).0);
    let is_given = |function: &FunctionId| {
        matches!(program.function(*function).kind, FunctionKind::Monitored | FunctionKind::Shared)
    };
    read.filter(is_given).collect()
}
