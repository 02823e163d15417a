//! The body of one declaration: a rule, a definition, a property or a fragment, with its variables.
//!
//! In: a [`Site`] and the parameters. Out: terms and rules, with all variables of the declaration in one list.
//! INVARIANT: scoping is lexical; a name means its innermost binding, and re-binding a name makes a new variable.

use std::collections::BTreeSet;

use syntax::{Span, SyntaxToken};

use crate::declaration::{Function, FunctionKind, Variable};
use crate::domain::Domains;
use crate::fault;
use crate::id::DomainId;
use crate::id::{FunctionId, VariableId};
use crate::site::Site;
use crate::suggest::did_you_mean;
use crate::term::{Term, TermKind};
use crate::uses::Referent;

/// What binds a variable. This decides whether it may be updated, and how that is explained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bound {
    /// A parameter of a macro rule, called by name.
    MacroParameter,
    /// Any other parameter.
    Parameter,
    /// `let`
    Let,
    /// `forall`, `choose`, a quantifier or a comprehension.
    Range,
    /// `extend`
    Extend,
}

/// The body of one declaration.
pub(crate) struct Body<'a> {
    /// The file and the model.
    pub(crate) site: Site<'a>,
    /// All variables of the declaration.
    pub(crate) variables: Vec<Variable>,
    /// What binds each of them.
    pub(crate) bound: Vec<Bound>,
    /// The names bound here, the innermost last.
    scope: Vec<(String, Meaning)>,
    /// The variables that some update in this declaration writes to.
    pub(crate) updated: BTreeSet<String>,
    /// The local functions that replace variables, and what bound the variables.
    local_variables: Vec<(FunctionId, Bound)>,
    /// The local functions declared here, the innermost last.
    pub(crate) locals: Vec<(String, FunctionId)>,
    /// The domain of the result, in a turbo rule that declares one.
    pub(crate) result: Option<DomainId>,
    /// The environment's functions may be updated too (a scenario sets them).
    pub(crate) as_environment: bool,
    /// In a rule of a scenario, which acts both for the machine and for the environment.
    pub(crate) in_scenario: bool,
}

/// What a variable's name means.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Meaning {
    /// A logical variable: a value.
    Variable(VariableId),
    /// A variable that is updated in its scope: a local function without arguments.
    Local(FunctionId),
}

/// How far the scope reached before a binding.
pub(crate) struct Mark(usize);

impl<'a> Body<'a> {
    /// A body with these parameters in scope.
    pub(crate) fn new(site: Site<'a>, parameters: &[Variable], bound: Bound) -> Self {
        let scope = parameters
            .iter()
            .enumerate()
            .map(|(i, v)| (v.name.clone(), Meaning::Variable(VariableId(i as u32))))
            .collect();
        Body {
            site,
            variables: parameters.to_vec(),
            bound: vec![bound; parameters.len()],
            scope,
            updated: BTreeSet::new(),
            local_variables: Vec::new(),
            locals: Vec::new(),
            result: None,
            as_environment: false,
            in_scenario: false,
        }
    }

    /// The place of a node of the file.
    pub(crate) fn place(&self, node: &impl syntax::ast::AstNode) -> Span {
        self.site.span(node)
    }

    /// The present end of the scope.
    pub(crate) fn mark(&self) -> Mark {
        Mark(self.scope.len())
    }

    /// Ends the scope of everything bound since.
    pub(crate) fn release(&mut self, mark: Mark) {
        self.scope.truncate(mark.0);
    }

    /// Binds a variable from here on.
    pub(crate) fn bind(&mut self, token: &SyntaxToken, domain: DomainId, bound: Bound) -> VariableId {
        let span = self.site.token_span(token);
        self.site.model.uses.declare(span, Referent::Variable(span, domain));
        let id = self.add_variable(token.text().to_string(), domain, span, bound);
        self.scope.push((token.text().to_string(), Meaning::Variable(id)));
        id
    }

    /// Binds a name to a local function from here on, in the place of a variable bound by `bound`.
    pub(crate) fn bind_local(&mut self, name: String, codomain: DomainId, span: Span, bound: Bound) -> FunctionId {
        let id = self.site.model.add_function(Function {
            name: name.clone(),
            kind: FunctionKind::Local,
            parameters: Vec::new(),
            codomain,
            definition: None,
            library: false,
            span,
        });
        self.site.model.uses.declare(span, Referent::Variable(span, codomain));
        self.local_variables.push((id, bound));
        self.scope.push((name, Meaning::Local(id)));
        id
    }

    /// What bound the variable that a local function replaces.
    pub(crate) fn bound_of_local(&self, function: FunctionId) -> Option<Bound> {
        self.local_variables.iter().find(|(id, _)| *id == function).map(|(_, bound)| *bound)
    }

    /// A variable that no text names.
    pub(crate) fn made_variable(&mut self, domain: DomainId, span: Span) -> VariableId {
        let name = format!("$${}", self.variables.len());
        self.add_variable(name, domain, span, Bound::Let)
    }

    fn add_variable(&mut self, name: String, domain: DomainId, span: Span, bound: Bound) -> VariableId {
        self.variables.push(Variable { name, domain, span });
        self.bound.push(bound);
        VariableId(self.variables.len() as u32 - 1)
    }

    /// What a variable's name means here.
    pub(crate) fn lookup(&self, name: &str) -> Option<Meaning> {
        self.scope.iter().rev().find(|(bound, _)| bound == name).map(|(_, id)| *id)
    }

    /// The variable of that id.
    pub(crate) fn variable(&self, id: VariableId) -> &Variable {
        &self.variables[id.0 as usize]
    }

    /// The names in scope.
    pub(crate) fn visible(&self) -> Vec<&str> {
        self.scope.iter().map(|(name, _)| name.as_str()).collect()
    }

    /// A variable as a term.
    pub(crate) fn variable_term(&self, id: VariableId, span: Span) -> Term {
        Term { kind: TermKind::Variable(id), domain: self.variable(id).domain, span }
    }

    /// The term that a written variable means.
    pub(crate) fn resolve_variable(&mut self, token: &SyntaxToken) -> Term {
        let span = self.site.token_span(token);
        let name = token.text();
        match self.lookup(name) {
            Some(Meaning::Variable(id)) => {
                let variable = self.variable(id);
                let referent = Referent::Variable(variable.span, variable.domain);
                self.site.note(span, referent);
                return self.variable_term(id, span);
            }
            Some(Meaning::Local(function)) => {
                let local = self.site.model.function(function);
                let (domain, bound) = (local.codomain, local.span);
                self.site.note(span, Referent::Variable(bound, domain));
                return Term { kind: TermKind::Apply { function, arguments: Vec::new() }, domain, span };
            }
            None => {}
        }
        let plain = name.trim_start_matches('$');
        let bound = self.variables.iter().position(|variable| variable.name == name);
        let elsewhere = bound.map(|index| self.variables[index].span);
        let help = if self.site.names.functions.contains_key(plain) {
            format!("did you mean the function `{plain}`?")
        } else if elsewhere.is_some() {
            "put this inside that scope, or bind the variable again around it".to_string()
        } else {
            did_you_mean(name, self.visible(), || {
                format!("bind it: as a parameter, or by `let`, `forall`, `choose`, as in `forall {name} in …`")
            })
        };
        self.site.faults.push(fault::name::unknown_variable(span, name, elsewhere, help));
        match bound {
            Some(index) => {
                let kind = TermKind::Unbound(VariableId(index as u32));
                Term { kind, domain: self.variables[index].domain, span }
            }
            None => error_term(span),
        }
    }
}

/// Stands where a reported fault left no term.
pub(crate) fn error_term(span: Span) -> Term {
    Term { kind: TermKind::Error, domain: Domains::ERROR, span }
}
