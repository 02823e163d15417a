//! Initial states: first values of dynamic functions and domains, and the programs of agents.
//!
//! In: the init sections of a file. Out: [`Init`]s with checked terms. Only those of the root file count, but those of
//! imported files are checked too.

use syntax::ast;

use super::body::{Body, Bound};
use super::definition;
use crate::declaration::FunctionKind;
use crate::domain::Domains;
use crate::fault;
use crate::id::DomainId;
use crate::model::{AgentProgram, Init, InitialFunction};
use crate::site::{Site, kind_word};

/// Checks all initial states of a file; returns them and the index of the default one.
pub(crate) fn inits(site: &mut Site<'_>, tree: &ast::SourceFile) -> (Vec<Init>, Option<usize>) {
    let mut inits: Vec<Init> = Vec::new();
    let mut default = None;
    for written in tree.inits() {
        let checked = init(site, &written);
        if written.is_default() {
            match default {
                None => default = Some(inits.len()),
                Some(first) => {
                    let first: &Init = &inits[first];
                    site.faults.push(fault::function::duplicate_default_init(checked.span, first.span));
                }
            }
        }
        inits.push(checked);
    }
    if let (None, Some(first)) = (default, inits.first()) {
        site.faults.push(fault::function::missing_default_init(first.span, &first.name));
    }
    (inits, default)
}

fn init(site: &mut Site<'_>, written: &ast::Init) -> Init {
    let span = match written.name() {
        Some(token) => site.token_span(&token),
        None => site.span(written),
    };
    let name = written.name().map(|token| token.text().to_string()).unwrap_or_default();
    let mut init = Init { name, domains: Vec::new(), functions: Vec::new(), agents: Vec::new(), span };
    for def in written.domain_defs() {
        init.domains.extend(definition::contents(site, &def, true).map(|(id, _, term)| (id, term)));
    }
    for def in written.function_defs() {
        init.functions.extend(function(site, &def, &init));
    }
    for agent in written.agents() {
        init.agents.extend(program(site, &agent));
    }
    init
}

fn function(site: &mut Site<'_>, def: &ast::FunctionDef, init: &Init) -> Option<InitialFunction> {
    let span = site.span(def);
    let (id, definition) = definition::header_and_body(site, def)?;
    let name_span = def.name().map_or(span, |token| site.token_span(&token));
    let function = site.model.function(id);
    let (kind, name, declared) = (function.kind, function.name.clone(), function.span);
    if matches!(kind, FunctionKind::Static | FunctionKind::Derived) {
        site.faults.push(fault::function::init_static(name_span, &name, kind_word(kind), declared));
        return None;
    }
    if let Some(first) = init.functions.iter().find(|other| other.function == id) {
        site.faults.push(fault::function::duplicate_definition(name_span, first.span, "initial value of", &name));
        return None;
    }
    Some(InitialFunction { function: id, definition, span })
}

fn program(site: &mut Site<'_>, written: &ast::AgentInit) -> Option<AgentProgram> {
    let span = site.span(written);
    let token = written.domain()?;
    let domain = site.resolve_domain_name(&token);
    if domain != Domains::ERROR && !is_agents(site, domain) {
        let message = format!("`{}` is not a domain of agents", token.text());
        let help = "name `Agent`, or a domain declared as a subset of it: `domain D subsetof Agent`";
        let place = site.token_span(&token);
        site.faults.push(fault::function::agent_program(place, message, help));
        return None;
    }
    let Some(ast::Rule::MacroCall(call)) = written.program() else {
        return None; // the parser has reported what stands there instead
    };
    let place = site.span(&call);
    let has_arguments = call.arguments().is_some_and(|list| list.terms().next().is_some());
    let reborrow = Site { model: &mut *site.model, names: site.names, faults: &mut *site.faults, file: site.file };
    let call = Body::new(reborrow, &[], Bound::Parameter).call(call.name(), call.arguments(), false, place)?;
    if has_arguments {
        let message = "the program of an agent takes no arguments".to_string();
        site.faults.push(fault::function::agent_program(
            place,
            message,
            "call a rule without parameters; it knows its agent as `self`",
        ));
        return None;
    }
    (domain != Domains::ERROR).then_some(AgentProgram { domain, rule: call.rule, span })
}

fn is_agents(site: &Site<'_>, domain: DomainId) -> bool {
    site.model.domains.type_domain(domain) == Domains::AGENT
}
