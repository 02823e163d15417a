//! Finds which of several functions or rules with the same name an application means.
//!
//! In: the candidates and the checked arguments. Out: the candidate of the least cost, and what its type variables
//! stand for. Exact domains win, then compatible ones (spec/language.md, 8.1), then those that need a numeric coercion.
//! Of equal functions, the one declared last wins; of equal rules, the first. A list of arguments and one argument of a
//! product domain are the same.

use crate::coerce;
use crate::compat::Bindings;
use crate::domain::DomainKind;
use crate::id::DomainId;
use crate::id::{FunctionId, RuleId};
use crate::model::Model;
use crate::term::{Term, TermKind};

/// How the arguments match the parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// One to one.
    Direct,
    /// One product-valued argument for several parameters.
    TakenApart,
    /// Several arguments for one parameter.
    Packed,
}

/// The candidate chosen.
pub(crate) struct Choice<Id> {
    /// Which.
    pub(crate) id: Id,
    /// The domains of its type variables.
    pub(crate) bindings: Bindings,
    /// How its arguments match the parameters.
    pub(crate) shape: Shape,
}

/// The function that an application means.
pub(crate) fn function(model: &mut Model, candidates: &[FunctionId], arguments: &[Term]) -> Option<Choice<FunctionId>> {
    let mut best: Option<(u32, Choice<FunctionId>)> = None;
    for id in candidates.iter().rev().copied() {
        let parameters = &model.function(id).parameters;
        let mut bindings = Bindings::default();
        let Some((cost, shape)) = function_cost(model, parameters, arguments, &mut bindings) else { continue };
        if best.as_ref().is_none_or(|(least, _)| cost < *least) {
            best = Some((cost, Choice { id, bindings, shape }));
        }
    }
    if best.is_none() && arguments.len() > 1 {
        return packed(model, candidates, arguments);
    }
    best.map(|(_, choice)| choice)
}

fn function_cost(
    model: &Model,
    parameters: &[DomainId],
    arguments: &[Term],
    bindings: &mut Bindings,
) -> Option<(u32, Shape)> {
    if parameters.len() == arguments.len() {
        return Some((all(model, parameters, arguments, bindings)?, Shape::Direct));
    }
    let [argument] = arguments else { return None };
    if parameters.len() < 2 {
        return None;
    }
    if let TermKind::Tuple(parts) = &argument.kind {
        return (parts.len() == parameters.len())
            .then(|| all(model, parameters, parts, bindings))?
            .map(|cost| (cost + 1, Shape::TakenApart));
    }
    match model.domains.kind(model.domains.type_domain(argument.domain)) {
        DomainKind::Prod(parts) => Some((model.domains.fit_all(parts, parameters, bindings)? + 1, Shape::TakenApart)),
        _ => None,
    }
}

fn all(model: &Model, parameters: &[DomainId], arguments: &[Term], bindings: &mut Bindings) -> Option<u32> {
    parameters.iter().zip(arguments).try_fold(0u32, |sum, (formal, argument)| {
        Some(sum.saturating_add(coerce::cost(model, argument, *formal, bindings)?))
    })
}

fn packed(model: &mut Model, candidates: &[FunctionId], arguments: &[Term]) -> Option<Choice<FunctionId>> {
    let parts = arguments.iter().map(|argument| argument.domain).collect();
    let product = model.domains.structured(DomainKind::Prod(parts));
    let mut best: Option<(u32, Choice<FunctionId>)> = None;
    for id in candidates.iter().rev().copied() {
        let [formal] = model.function(id).parameters.as_slice() else { continue };
        let mut bindings = Bindings::default();
        let Some(cost) = model.domains.fit(product, *formal, &mut bindings) else { continue };
        if best.as_ref().is_none_or(|(least, _)| cost < *least) {
            best = Some((cost, Choice { id, bindings, shape: Shape::Packed }));
        }
    }
    best.map(|(_, choice)| choice)
}

/// The rule that a call means.
pub(crate) fn rule(model: &Model, candidates: &[RuleId], arguments: &[Term]) -> Option<RuleId> {
    let mut best: Option<(u32, RuleId)> = None;
    for id in candidates.iter().copied() {
        let rule = model.rule(id);
        let parameters: Vec<DomainId> = rule.parameters.iter().map(|id| rule.variables[id.0 as usize].domain).collect();
        if parameters.len() != arguments.len() {
            continue;
        }
        let Some(cost) = all(model, &parameters, arguments, &mut Bindings::default()) else { continue };
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, id));
        }
    }
    best.map(|(_, id)| id)
}
