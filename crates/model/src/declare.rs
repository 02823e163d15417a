//! Declarations: adds the signature of a file and the headings of its rules to the model's tables.
//!
//! In: a unit and the names that its imports bring. Out: the names that the file sees, its own included; faults for
//! what is declared twice, or over what does not exist. INVARIANT: this module does not look at bodies. Every declared
//! rule and function has its parameters when the first body is checked, so the order of declarations does not matter.

use std::collections::BTreeMap;
use std::sync::Arc;

use syntax::ast::{self, AstNode};
use syntax::{FileId, Span, SyntaxKind, SyntaxToken};

use crate::declaration::{Function, FunctionKind, Rule, Variable};
use crate::domain::{DomainKind, Domains};
use crate::fault::{self, Faults};
use crate::id::DomainId;
use crate::id::{RuleId, VariableId};
use crate::imports::Unit;
use crate::model::Model;
use crate::names::Names;
use crate::rule::{RuleKind, RuleNode};
use crate::site::{Site, predefined};
use crate::uses::Referent;

/// Adds the declarations of a unit; returns its names, and its rules in the order of the text, the main rule last.
pub(crate) fn declare(
    unit: &Unit,
    names: Names,
    model: &mut Model,
    faults: &mut Faults,
) -> (Names, Vec<(ast::RuleDecl, RuleId)>) {
    let mut declare =
        Declare { file: unit.file, library: unit.library, names, model, faults, literals: BTreeMap::new() };
    if let Some(signature) = unit.tree.signature() {
        let domains: Vec<_> = signature.domains().collect();
        let declared: Vec<_> = domains.iter().map(|domain| declare.domain(domain)).collect();
        for (domain, id) in domains.iter().zip(declared) {
            declare.domain_body(domain, id);
        }
        for function in signature.functions() {
            declare.function(&function);
        }
    }
    let rules = unit.tree.definitions().into_iter().flat_map(|definitions| definitions.rules());
    let main = unit.tree.main_rule().and_then(|main| main.rule());
    let rules = rules.chain(main).filter_map(|rule| declare.rule(&rule).map(|id| (rule, id))).collect();
    (declare.names, rules)
}

struct Declare<'a> {
    file: FileId,
    library: bool,
    names: Names,
    model: &'a mut Model,
    faults: &'a mut Faults,
    /// Where each enum literal of this file is declared.
    literals: BTreeMap<String, Span>,
}

impl Declare<'_> {
    fn site(&mut self) -> Site<'_> {
        Site { model: self.model, names: &self.names, faults: self.faults, file: self.file }
    }

    fn resolve(&mut self, domain: Option<ast::Domain>) -> DomainId {
        domain.map_or(Domains::ERROR, |domain| self.site().resolve_domain(&domain))
    }

    /// Declares the name of a domain.
    fn domain(&mut self, decl: &ast::DomainDecl) -> Option<DomainId> {
        let token = decl.name()?;
        let (name, span) = (token.text().to_string(), Span::new(self.file, token.text_range()));
        let kind = match decl {
            ast::DomainDecl::Structured(_) => return None,
            ast::DomainDecl::Basic(_) => return self.basic(&name, span),
            ast::DomainDecl::Any(_) if name == "Any" => return self.define(name, Domains::ANY, span),
            ast::DomainDecl::Any(_) => DomainKind::Any,
            ast::DomainDecl::Abstract(_)
                if matches!(name.as_str(), "Agent" | "Reserve") && self.names.domain(&name).is_none() =>
            {
                return self.define(name.clone(), predefined(&name)?, span);
            }
            ast::DomainDecl::Abstract(_) => DomainKind::Abstract { dynamic: decl.is_dynamic() },
            ast::DomainDecl::Enum(_) => DomainKind::Enum { literals: Vec::new() },
            ast::DomainDecl::Concrete(_) => {
                DomainKind::Concrete { base: Domains::ERROR, dynamic: decl.is_dynamic(), definition: None }
            }
        };
        if token.kind() == SyntaxKind::ENUM_ID {
            self.faults.push(fault::name::domain_in_capitals(span, &name));
        }
        if let (DomainKind::Any, Some(known)) = (&kind, self.names.domain(&name))
            && matches!(self.model.domains.kind(known), DomainKind::Any)
        {
            return Some(known);
        }
        let id = self.model.domains.declare(name.clone(), kind, span);
        self.define(name, id, span)
    }

    fn basic(&mut self, name: &str, span: Span) -> Option<DomainId> {
        let basic = predefined(name).filter(|id| matches!(self.model.domains.kind(*id), DomainKind::Basic(_)));
        match basic {
            Some(id) if self.names.domain(name) == Some(id) => Some(id),
            Some(id) => self.define(name.to_string(), id, span),
            None => {
                self.faults.push(fault::domain::not_basic(span, name));
                self.define(name.to_string(), Domains::ERROR, span)
            }
        }
    }

    fn define(&mut self, name: String, id: DomainId, span: Span) -> Option<DomainId> {
        if id != Domains::ERROR {
            self.model.uses.declare(span, Referent::Domain(id));
        }
        match self.names.domains.get(name.as_str()) {
            // A type variable of an imported library is not an obstacle to a domain of that name.
            Some(first) if *first != Domains::ANY && !matches!(self.model.domains.kind(*first), DomainKind::Any) => {
                let first = self.model.domains.get(*first).span;
                self.faults.push(fault::name::duplicate_domain(span, first, &name));
                Some(id)
            }
            _ => {
                self.names.domains.insert(name.into(), id);
                Some(id)
            }
        }
    }

    /// What a domain is made of.
    fn domain_body(&mut self, decl: &ast::DomainDecl, id: Option<DomainId>) {
        match (decl, id) {
            (ast::DomainDecl::Structured(structured), _) => {
                self.resolve(structured.domain());
            }
            (ast::DomainDecl::Enum(decl), Some(id)) => self.literals(decl, id),
            (ast::DomainDecl::Concrete(decl), Some(id)) => self.base(decl, id),
            _ => {}
        }
    }

    fn literals(&mut self, decl: &ast::EnumDomainDecl, id: DomainId) {
        for token in decl.literals().filter_map(|literal| literal.name()) {
            let (name, span) = (token.text().to_string(), Span::new(self.file, token.text_range()));
            if let Some((domain, _)) = self.names.literal(&name) {
                let first = self.literals.get(&name).copied().or(self.model.domains.get(domain).span);
                let domain = self.model.domains.display(domain);
                self.faults.push(fault::name::duplicate_literal(span, first, &name, &domain));
                continue;
            }
            if let DomainKind::Enum { literals } = &mut self.model.domains.get_mut(id).kind {
                literals.push(name.clone());
                let place = literals.len() as u32 - 1;
                self.names.literals.insert(name.as_str().into(), (id, place));
                self.model.uses.declare(span, Referent::Literal(id, place));
                self.literals.insert(name, span);
            }
        }
    }

    fn base(&mut self, decl: &ast::ConcreteDomainDecl, id: DomainId) {
        let Some(written) = decl.base() else { return };
        let found = self.resolve(Some(written.clone()));
        if let DomainKind::Concrete { base: under, .. } = self.model.domains.kind(found) {
            let display = |id| self.model.domains.display(id);
            let (name, base, under) = (display(id), display(found), display(*under));
            let span = Span::new(self.file, written.range());
            let place = self.model.domains.get(found).span;
            self.faults.push(fault::domain::concrete_over_concrete(span, &name, &base, &under, place));
            return;
        }
        if let DomainKind::Concrete { base, .. } = &mut self.model.domains.get_mut(id).kind {
            *base = found;
        }
    }

    fn function(&mut self, decl: &ast::FunctionDecl) {
        let parameters = match decl.domain() {
            Some(domain) => {
                let domain = self.resolve(Some(domain));
                self.model.domains.parameters_of(domain)
            }
            None => Vec::new(),
        };
        let codomain = self.resolve(decl.codomain());
        let (Some(token), Some(kind)) = (decl.name(), decl.kind()) else { return };
        let kind = match kind {
            SyntaxKind::STATIC_KW => FunctionKind::Static,
            SyntaxKind::DERIVED_KW => FunctionKind::Derived,
            SyntaxKind::MONITORED_KW => FunctionKind::Monitored,
            SyntaxKind::SHARED_KW => FunctionKind::Shared,
            SyntaxKind::OUT_KW => FunctionKind::Out,
            _ => FunctionKind::Controlled,
        };
        let span = Span::new(self.file, token.text_range());
        let name = token.text().to_string();
        let library = self.library;
        let function = Function { name, kind, parameters, codomain, definition: None, library, span };
        let same = |id: &&crate::id::FunctionId| self.model.function(**id).parameters == function.parameters;
        if let Some(first) = self.names.functions(&function.name).iter().find(same).copied() {
            let place = self.model.function(first).span;
            let signature = self.site().signature(first);
            self.faults.push(fault::name::duplicate_function(span, place, &signature));
            return;
        }
        let id = self.model.add_function(function);
        self.model.uses.declare(span, Referent::Function(id));
        Arc::make_mut(self.names.functions.entry(token.text().into()).or_default()).push(id);
    }

    fn rule(&mut self, decl: &ast::RuleDecl) -> Option<RuleId> {
        let token = decl.name()?;
        let span = Span::new(self.file, token.text_range());
        let variables = match decl.parameters() {
            Some(list) => parameters(&mut self.site(), &list),
            None => Vec::new(),
        };
        let result = decl.result().map(|domain| self.resolve(Some(domain)));
        let id = RuleId(self.model.rules.len() as u32);
        let parameters = (0..variables.len() as u32).map(VariableId).collect();
        self.model.rules.push(Rule {
            name: token.text().to_string(),
            turbo: decl.is_turbo(),
            variables,
            parameters,
            result,
            body: RuleNode { kind: RuleKind::Error, span },
            span,
        });
        self.model.uses.declare(span, Referent::Rule(id));
        self.own_rule(&token, id, span);
        Some(id)
    }

    fn own_rule(&mut self, token: &SyntaxToken, id: RuleId, span: Span) {
        let domains = |rule: &Rule| -> Vec<DomainId> { rule.variables.iter().map(|v| v.domain).collect() };
        let mine = domains(self.model.rule(id));
        let same = |other: &&RuleId| {
            let other = self.model.rule(**other);
            other.span.file == self.file && domains(other) == mine
        };
        let known = Arc::make_mut(self.names.rules.entry(token.text().into()).or_default());
        if let Some(first) = known.iter().find(same).copied() {
            let place = self.model.rule(first).span;
            let signature = self.site().rule_signature(first);
            self.faults.push(fault::name::duplicate_rule(span, place, &signature));
            return;
        }
        known.push(id);
    }
}

/// The variables of a parameter list, in order.
pub(crate) fn parameters(site: &mut Site<'_>, list: &ast::ParameterList) -> Vec<Variable> {
    let mut variables: Vec<Variable> = Vec::new();
    for parameter in list.parameters() {
        let domain = match parameter.domain() {
            Some(domain) => site.resolve_domain(&domain),
            None => Domains::ERROR,
        };
        let Some(token) = parameter.variable() else { continue };
        let span = site.token_span(&token);
        if let Some(first) = variables.iter().find(|variable| variable.name == token.text()) {
            site.faults.push(fault::name::duplicate_parameter(span, first.span, token.text()));
        }
        site.model.uses.declare(span, Referent::Variable(span, domain));
        variables.push(Variable { name: token.text().to_string(), domain, span });
    }
    variables
}
