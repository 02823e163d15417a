//! The members of a model's class: which functions and domains have members, what is logged, how parameters are
//! declared.
//!
//! In: what the bodies reached. Out: facts for the code that prints the class. Its only texts are names and types.

use program::{DomainId, FunctionId};

use crate::model::generator::Generator;
use crate::model::plan::{DomainPlan, FunctionPlan, Role};
use crate::model::reach::Need;
use crate::model::storage::Updates;

/// The functions with these roles that the code reaches.
pub(crate) fn functions<'p>(generator: &'p Generator<'_>, roles: &[Role]) -> Vec<(FunctionId, &'p FunctionPlan)> {
    let all = generator.plan.functions.iter().enumerate();
    all.map(|(index, plan)| (FunctionId(index as u32), plan))
        .filter(|(id, plan)| roles.contains(&plan.role) && generator.reach.functions.contains(id))
        .collect()
}

/// A function's parameters, with types that admit undef where an argument may be undef, and their names.
pub(crate) fn parameters(generator: &Generator<'_>, id: FunctionId) -> (String, String) {
    let mut declared = Vec::new();
    let mut names = Vec::new();
    for (place, domain) in generator.program.function(id).parameters.iter().enumerate() {
        let ty = generator.parameter_type(*domain);
        let name = argument_name(place);
        let defined = generator.assumed.inside[id.0 as usize][place];
        declared.push(format!("{} {name}", generator.parameter(ty, defined)));
        names.push(name);
    }
    (declared.join(", "), names.join(", "))
}

/// The name of the argument at this index.
pub(crate) fn argument_name(place: usize) -> String {
    if place == 0 { "argument".to_string() } else { format!("argument_{}", place + 1) }
}

/// Whether answers of the environment are remembered by step number.
pub(crate) fn counts_steps(generator: &Generator<'_>) -> bool {
    generator.reach.needs(Need::Clock) || !functions(generator, &[Role::Input]).is_empty()
}

/// The functions whose updates of the running step are kept in a `Next`.
pub(crate) fn stepped<'p>(generator: &'p Generator<'_>) -> Vec<&'p FunctionPlan> {
    let all = functions(generator, &[Role::State, Role::Local]).into_iter();
    all.filter(|(id, _)| generator.storage(*id).updates == Updates::Step).map(|(_, function)| function).collect()
}

/// The members that have a log of the running step.
pub(crate) fn logs(generator: &Generator<'_>) -> Vec<String> {
    let mut all = Vec::new();
    for (id, function) in functions(generator, &[Role::State, Role::Local, Role::Shared]) {
        if generator.storage(id).updates == Updates::Log {
            let dot = if function.role == Role::Shared { ".locations" } else { "" };
            all.push(format!("{}{dot}", function.member));
        }
    }
    all.extend(carriers(generator).into_iter().filter_map(|(_, domain)| domain.carrier.clone()));
    all
}

/// The growing domains that the code ranges over, asks or extends.
pub(crate) fn carriers<'p>(generator: &'p Generator<'_>) -> Vec<(usize, &'p DomainPlan)> {
    let all = generator.plan.domains.iter().enumerate();
    all.filter(|(index, plan)| plan.carrier.is_some() && generator.reach.carriers.contains(&DomainId(*index as u32)))
        .collect()
}
