//! Definitions of functions and domains, in the definitions section.
//!
//! In: typed views. Out: the defining terms, in the model's tables. A static function may depend only on
//! static functions; a derived one depends on the state (spec/language.md, section 5).

use std::collections::BTreeMap;

use syntax::Span;
use syntax::ast;

use super::body::{Body, Bound, error_term};
use crate::coerce::can_coerce;
use crate::declaration::{Definition, FunctionKind, Variable};
use crate::declare;
use crate::domain::{DomainKind, Domains};
use crate::fault;
use crate::id::DomainId;
use crate::id::{FunctionId, VariableId};
use crate::site::{Site, kind_word};
use crate::term::{Term, TermKind};
use crate::uses::Referent;

/// Where each function and domain of the model is defined.
#[derive(Default)]
pub(crate) struct Defined {
    functions: BTreeMap<FunctionId, Span>,
    domains: BTreeMap<DomainId, Span>,
}

/// `function f($x in D) = term`
pub(crate) fn function(mut site: Site<'_>, def: &ast::FunctionDef, defined: &mut Defined) {
    let place = site.span(def);
    let Some((id, definition)) = header_and_body(&mut site, def) else { return };
    let function = site.model.function(id);
    let (kind, name, declared) = (function.kind, function.name.clone(), function.span);
    let name_span = def.name().map_or(place, |token| site.token_span(&token));
    match kind {
        FunctionKind::Static => report_dynamic(&mut site, &name, declared, &definition),
        FunctionKind::Derived => report_static(&mut site, &name, name_span, declared, &definition),
        _ => {
            site.faults.push(fault::function::define_dynamic(name_span, &name, kind_word(kind), declared));
            return;
        }
    }
    if let Some(first) = defined.functions.insert(id, name_span) {
        site.faults.push(fault::function::duplicate_definition(name_span, first, "function", &name));
        return;
    }
    // An element that is defined as itself is treated like one without definition.
    let is_itself = matches!(&definition.body.kind, TermKind::Apply { function, arguments } if *function == id && arguments.is_empty());
    let base = site.model.domains.type_domain(site.model.function(id).codomain);
    if is_itself && matches!(site.model.domains.kind(base), DomainKind::Abstract { .. }) {
        return;
    }
    site.model.functions[id.0 as usize].definition = Some(definition);
}

/// The function that is defined or initialised, and its checked right side.
pub(crate) fn header_and_body(site: &mut Site<'_>, def: &ast::FunctionDef) -> Option<(FunctionId, Definition)> {
    let place = site.span(def);
    let parameters = def.parameters().map(|list| declare::parameters(site, &list)).unwrap_or_default();
    let found = find(site, def, &parameters);
    let product = match found {
        Some(id) => site.model.function(id).parameters.len() != parameters.len(),
        None => false,
    };
    let reborrow = Site { model: &mut *site.model, names: site.names, faults: &mut *site.faults, file: site.file };
    let definition = if let (true, Some(id)) = (product, found) {
        product_body(reborrow, def, id, &parameters[0])
    } else {
        let mut body = Body::new(reborrow, &parameters, Bound::Parameter);
        let term = body.optional_term(def.body(), place);
        finish(body, found, parameters.len(), term)
    };
    Some((found?, definition))
}

/// The body of a definition that has one parameter for the product of all.
fn product_body(site: Site<'_>, def: &ast::FunctionDef, id: FunctionId, parameter: &Variable) -> Definition {
    let place = site.span(def);
    let domains = site.model.function(id).parameters.clone();
    let component = |(index, domain): (usize, &DomainId)| Variable {
        name: format!("$${index}"),
        domain: *domain,
        span: parameter.span,
    };
    let made: Vec<Variable> = domains.iter().enumerate().map(component).collect();
    let mut body = Body::new(site, &made, Bound::Parameter);
    let components = (0..made.len() as u32).map(|i| body.variable_term(VariableId(i), parameter.span)).collect();
    let whole = body.tuple(components, parameter.span);
    let token = def.parameters().and_then(|list| list.parameters().next()).and_then(|parameter| parameter.variable());
    let bindings =
        token.map(|token| vec![(body.bind(&token, parameter.domain, Bound::Parameter), whole)]).unwrap_or_default();
    let term = body.optional_term(def.body(), place);
    let (domain, span) = (term.domain, term.span);
    let mut definition = finish(body, Some(id), made.len(), term);
    let inner = std::mem::replace(&mut definition.body, error_term(span));
    definition.body = Term { kind: TermKind::Let { bindings, body: Box::new(inner) }, domain, span };
    definition
}

/// Takes the term to the function's codomain.
fn finish(mut body: Body<'_>, function: Option<FunctionId>, parameters: usize, mut term: Term) -> Definition {
    if let Some(id) = function {
        let function = body.site.model.function(id);
        let (codomain, declared) = (function.codomain, function.span);
        if can_coerce(body.site.model, &term, codomain) {
            term = body.coerce(term, codomain);
        } else {
            let name = body.site.model.function(id).name.clone();
            let mismatch = body.site.mismatch(codomain, term.domain);
            body.site.faults.push(fault::function::definition_domain(term.span, &name, &mismatch, declared));
        }
    }
    let parameters = (0..parameters as u32).map(VariableId).collect();
    Definition { variables: body.variables, parameters, body: term }
}

/// The declared function with exactly these parameter domains.
fn find(site: &mut Site<'_>, def: &ast::FunctionDef, parameters: &[Variable]) -> Option<FunctionId> {
    let token = def.name()?;
    let candidates = site.names.functions(token.text());
    let span = site.token_span(&token);
    if candidates.is_empty() {
        site.unknown_function(token.text(), token.text(), span, &[]);
        return None;
    }
    let domains: Vec<DomainId> = parameters.iter().map(|parameter| parameter.domain).collect();
    if domains.contains(&Domains::ERROR) {
        return None;
    }
    let exact = |domains: &[DomainId]| {
        candidates.iter().rev().copied().find(|id| site.model.function(*id).parameters == domains)
    };
    let product = match domains.as_slice() {
        [one] => site.model.domains.parameters_of(*one),
        _ => domains.clone(),
    };
    if let Some(id) = exact(&domains).or_else(|| exact(&product)) {
        site.note(span, Referent::Function(id));
        return Some(id);
    }
    let unclear = |id: &FunctionId| site.model.function(*id).parameters.contains(&Domains::ERROR);
    if site.names.incomplete || candidates.iter().any(unclear) {
        return None;
    }
    let declared: Vec<(Span, String)> =
        candidates.iter().rev().take(3).map(|id| (site.model.function(*id).span, site.signature(*id))).collect();
    let domain = if domains.is_empty() { String::new() } else { site.product(&domains) };
    let help = "name the parameter domains exactly as they are declared".to_string();
    site.faults.push(fault::function::no_declaration(span, token.text(), &domain, &declared, help));
    None
}

/// A part of a definition that changes from state to state, and what it is.
fn dynamic_part(site: &Site<'_>, definition: &Definition) -> Option<(Span, String, &'static str)> {
    let mut found = None;
    definition.body.walk(&mut |term| {
        if found.is_some() {
            return;
        }
        found = match &term.kind {
            TermKind::Apply { function, .. } => {
                let function = site.model.function(*function);
                (function.kind != FunctionKind::Static).then(|| {
                    let what = match function.kind {
                        FunctionKind::Derived => "the derived function",
                        FunctionKind::Monitored => "the monitored function",
                        FunctionKind::Shared => "the shared function",
                        FunctionKind::Out => "the out function",
                        _ => "the controlled function",
                    };
                    (term.span, function.name.clone(), what)
                })
            }
            TermKind::Domain(domain) if is_dynamic(site, *domain) => {
                Some((term.span, site.display(*domain), "the dynamic domain"))
            }
            _ => None,
        };
    });
    found
}

fn is_dynamic(site: &Site<'_>, domain: DomainId) -> bool {
    match site.model.domains.kind(domain) {
        DomainKind::Abstract { dynamic } | DomainKind::Concrete { dynamic, .. } => *dynamic,
        DomainKind::Prod(parts) => parts.iter().any(|part| is_dynamic(site, *part)),
        DomainKind::Powerset(of) | DomainKind::Seq(of) | DomainKind::Bag(of) => is_dynamic(site, *of),
        DomainKind::Map(key, value) => is_dynamic(site, *key) || is_dynamic(site, *value),
        _ => false,
    }
}

fn report_dynamic(site: &mut Site<'_>, name: &str, declared: Span, definition: &Definition) {
    if let Some((span, mentioned, what)) = dynamic_part(site, definition) {
        site.faults.push(fault::function::dynamic_in_static(span, name, &mentioned, what, declared));
    }
}

fn report_static(site: &mut Site<'_>, name: &str, span: Span, declared: Span, definition: &Definition) {
    let ranges_over_dynamic = definition.variables.iter().any(|variable| is_dynamic(site, variable.domain));
    let mut faulty = false;
    definition.body.walk(&mut |term| faulty |= matches!(term.kind, TermKind::Error));
    if !faulty && !ranges_over_dynamic && dynamic_part(site, definition).is_none() {
        site.faults.push(fault::function::static_derived(span, name, declared));
    }
}

/// `domain D = term`
pub(crate) fn domain(mut site: Site<'_>, def: &ast::DomainDef, defined: &mut Defined) {
    let Some((id, name_span, term)) = contents(&mut site, def, false) else { return };
    if let Some(first) = defined.domains.insert(id, name_span) {
        let name = site.display(id);
        site.faults.push(fault::function::duplicate_definition(name_span, first, "domain", &name));
        return;
    }
    if let DomainKind::Concrete { definition, .. } = &mut site.model.domains.get_mut(id).kind {
        *definition = Some(term);
    }
}

/// The domain that is defined, and its checked contents; with `init` these are the initial contents of a dynamic
/// domain.
pub(crate) fn contents(site: &mut Site<'_>, def: &ast::DomainDef, init: bool) -> Option<(DomainId, Span, Term)> {
    let place = site.span(def);
    let token = def.name()?;
    let name_span = site.token_span(&token);
    let id = site.resolve_domain_name(&token);
    let reborrow = Site { model: &mut *site.model, names: site.names, faults: &mut *site.faults, file: site.file };
    let mut body = Body::new(reborrow, &[], Bound::Parameter);
    let term = body.optional_term(def.body(), place);
    let name = token.text();
    let (kind, help) = match body.site.model.domains.kind(id) {
        DomainKind::Error => return None,
        DomainKind::Concrete { base, dynamic, .. } if *dynamic == init => {
            let base = *base;
            let set = body.site.model.domains.powerset(base);
            let sequence = body.site.model.domains.structured(DomainKind::Seq(base));
            if !can_coerce(body.site.model, &term, set) && !can_coerce(body.site.model, &term, sequence) {
                let (base, found) = (body.site.display(base), body.site.display(term.domain));
                body.site.faults.push(fault::domain::contents(term.span, name, &base, &found));
                return None;
            }
            let target = if can_coerce(body.site.model, &term, set) { set } else { sequence };
            let term = body.coerce(term, target);
            return Some((id, name_span, term));
        }
        DomainKind::Concrete { dynamic: true, .. } => {
            ("a dynamic subset", "give its first contents in an init section")
        }
        DomainKind::Concrete { .. } => {
            ("a static subset", "define it in the definitions section, or declare it `dynamic domain`")
        }
        DomainKind::Enum { .. } => {
            ("an enum domain", "its literals are its contents; change them where it is declared")
        }
        DomainKind::Abstract { .. } => {
            ("an abstract domain", "declare its static elements in the signature: `static e1: …`")
        }
        _ => ("not a subset", "declare a subset first: `domain D subsetof …`"),
    };
    body.site.faults.push(fault::domain::not_definable(name_span, name, kind, help));
    None
}
