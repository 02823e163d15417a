//! Elements of abstract domains, and those that have names.

use model::{DomainId, DomainKind, FunctionId, FunctionKind, Model};

use crate::value::Value;

/// Is it a domain of unnamed elements?
pub(crate) fn is_abstract(model: &Model, domain: DomainId) -> bool {
    matches!(model.domains.kind(domain), DomainKind::Abstract { .. })
}

/// The elements named by static functions: the function, the domain it is declared with, and the element. The elements
/// of an abstract domain are numbered in the order of these declarations.
pub(crate) fn named_elements(model: &Model) -> impl Iterator<Item = (FunctionId, DomainId, Value)> {
    let mut counts = std::collections::BTreeMap::new();
    model.functions().filter_map(move |(id, function)| {
        let base = model.domains.type_domain(function.codomain);
        let names_element = function.kind == FunctionKind::Static
            && function.definition.is_none()
            && function.parameters.is_empty()
            && is_abstract(model, base);
        names_element.then(|| {
            let next = counts.entry(base).or_insert(0u32);
            *next += 1;
            (id, function.codomain, Value::Element(base, *next - 1))
        })
    })
}
