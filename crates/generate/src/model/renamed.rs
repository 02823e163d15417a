//! Finds names of a model that differ in C++, since the language, a macro of its headers or the class already uses
//! them.
//!
//! In: the plan. Out: pairs of names, and comments about them. It chooses no names (`plan` and `names` do).

use program::DomainKind;

use crate::model::generator::Generator;
use crate::model::members::functions;
use crate::model::plan::Role;

/// The names that users of the class find changed, as `(the model's, the class's)`: functions, then enum and abstract
/// domains with their literals.
pub(crate) fn renamed(generator: &Generator<'_>) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for (id, function) in functions(generator, &[Role::State, Role::Input, Role::Shared]) {
        found.push((generator.program.function(id).name.clone(), function.name.clone()));
    }
    for (domain, plan) in generator.program.domains.iter().zip(&generator.plan.domains) {
        if let DomainKind::Enum { .. } | DomainKind::Abstract { .. } = &domain.kind {
            found.push((domain.name.clone(), plan.stem().to_string()));
        }
        if let DomainKind::Enum { literals } = &domain.kind {
            found.extend(literals.iter().cloned().zip(plan.literals.iter().cloned()));
        }
    }
    found.retain(|(model, cpp)| model != cpp);
    found
}

/// The addition to a function's comment.
pub(crate) fn called(model: &str, cpp: &str) -> String {
    if model == cpp {
        String::new()
    } else {
        format!(". Called `{cpp}` here: C++ or this class has `{model}` already.")
    }
}

/// The comment on an enum's literals, if some have other names.
pub(crate) fn literals_called(model: &[String], cpp: &[String]) -> Option<String> {
    let pairs = model.iter().zip(cpp).filter(|(model, cpp)| model != cpp);
    let others: Vec<String> = pairs.map(|(model, cpp)| format!("`{model}` is `{cpp}`")).collect();
    let told = format!("/// Names that C++ or its headers have already: {}.", others.join(", "));
    (!others.is_empty()).then_some(told)
}
