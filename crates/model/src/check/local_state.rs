//! Variables that a rule updates.
//!
//! AsmetaL lets an update write to a variable. A parameter of a macro rule then stands for the caller's location. Any
//! other variable is local state: a local function that starts with the value bound and lives as long as the scope of
//! the variable (Börger & Stärk 2003, section 4.1.2). In: rules as written. Out: which variables those are, and
//! [`RuleKind::Local`] around the rules they are visible in.

use std::collections::BTreeSet;

use syntax::ast::{self, AstNode};
use syntax::{Span, SyntaxKind};

use super::body::{Body, Bound};
use crate::id::{FunctionId, VariableId};
use crate::rule::{RuleKind, RuleNode, Target};
use crate::term::Term;

/// Parameters that their macro rules update: the rule's name and the parameter's place.
///
/// By name, so that it is known before any rule is checked. It may hold too much where names are overloaded, never too
/// little.
pub(crate) type UpdatedParameters = BTreeSet<(String, usize)>;

/// What a rule writes to where that may be a variable: read once, since its tree is large.
#[derive(Debug, Default)]
pub(crate) struct Writes {
    /// Variables that updates and turbo returns write to.
    variables: Vec<String>,
    /// Variables that are given to macro rules: the rule's name, the parameter's place, the variable.
    given: Vec<(String, usize, String)>,
}

impl Writes {
    /// Those of a rule.
    pub(crate) fn of(rule: &ast::Rule) -> Writes {
        let mut writes = Writes::default();
        let name = |term: Option<ast::Term>| match term {
            Some(ast::Term::Variable(variable)) => variable.token().map(|token| token.text().to_string()),
            _ => None,
        };
        for node in rule.syntax().descendants() {
            let target = match node.kind() {
                SyntaxKind::UPDATE_RULE => ast::UpdateRule::cast(node).and_then(|update| update.target()),
                SyntaxKind::RETURN_RULE => ast::ReturnRule::cast(node).and_then(|update| update.target()),
                SyntaxKind::MACRO_CALL_RULE => {
                    let Some(call) = ast::MacroCallRule::cast(node) else { continue };
                    let Some(rule) = call.name() else { continue };
                    for (place, argument) in call.arguments().into_iter().flat_map(|list| list.terms()).enumerate() {
                        writes.given.extend(name(Some(argument)).map(|name| (rule.text().to_string(), place, name)));
                    }
                    continue;
                }
                _ => continue,
            };
            writes.variables.extend(name(target));
        }
        writes
    }

    /// The variables that the rule updates, itself or through macro rules that update these parameters.
    pub(crate) fn updated(&self, parameters: &UpdatedParameters) -> BTreeSet<String> {
        let through = |(rule, place, _): &&(String, usize, String)| parameters.contains(&(rule.clone(), *place));
        let given = self.given.iter().filter(through).map(|(_, _, variable)| variable);
        self.variables.iter().chain(given).cloned().collect()
    }
}

/// Adds the parameters that the rules of a file update, themselves or through the rules that they call.
pub(crate) fn add_updated_parameters<'r>(
    rules: impl Iterator<Item = (&'r ast::RuleDecl, &'r Writes)> + Clone,
    known: &mut UpdatedParameters,
) {
    loop {
        let before = known.len();
        for (rule, writes) in rules.clone() {
            let updated = writes.updated(known);
            if updated.is_empty() {
                continue;
            }
            let Some(name) = rule.name() else { continue };
            let parameters = rule.parameters().into_iter().flat_map(|list| list.parameters());
            for (place, parameter) in parameters.enumerate() {
                if parameter.variable().is_some_and(|token| updated.contains(token.text())) {
                    known.insert((name.text().to_string(), place));
                }
            }
        }
        if known.len() == before {
            return;
        }
    }
}

/// What stands around the body of a `let`, from the outside in.
enum Wrapper {
    Let(Vec<(VariableId, Term)>),
    Local(FunctionId, RuleNode),
}

impl Body<'_> {
    /// A `let`, whose variables may be local state.
    pub(crate) fn let_rule(&mut self, rule: &ast::LetRule, span: Span) -> RuleKind {
        let mark = self.mark();
        let mut wrappers: Vec<Wrapper> = Vec::new();
        for binding in rule.bindings() {
            let place = self.site.span(&binding);
            let term = self.optional_term(binding.term(), place);
            let Some(token) = binding.variable() else { continue };
            if self.updated.contains(token.text()) {
                let name_span = self.site.token_span(&token);
                let function = self.bind_local(token.text().to_string(), term.domain, name_span, Bound::Let);
                wrappers.push(Wrapper::Local(function, first_value(function, term, name_span)));
                continue;
            }
            let bound = (self.bind(&token, term.domain, Bound::Let), term);
            match wrappers.last_mut() {
                Some(Wrapper::Let(bindings)) => bindings.push(bound),
                _ => wrappers.push(Wrapper::Let(vec![bound])),
            }
        }
        let body = self.optional_rule(rule.body(), span);
        self.release(mark);
        let wrap = |body: RuleNode, wrapper| {
            let body = Box::new(body);
            let kind = match wrapper {
                Wrapper::Let(bindings) => RuleKind::Let { bindings, body },
                Wrapper::Local(function, first) => RuleKind::Local { locals: vec![(function, first)], body },
            };
            RuleNode { kind, span }
        };
        wrappers.into_iter().rev().fold(body, wrap).kind
    }

    /// A rule in which some of these variables may be local state, starting with the values they are bound to.
    pub(crate) fn with_local_state(
        &mut self,
        variables: &[VariableId],
        rule: Option<ast::Rule>,
        span: Span,
    ) -> RuleNode {
        let mark = self.mark();
        let mut locals = Vec::new();
        for id in variables {
            let variable = self.variable(*id).clone();
            if self.updated.contains(&variable.name) {
                let bound = self.bound[id.0 as usize];
                let function = self.bind_local(variable.name, variable.domain, variable.span, bound);
                let value = self.variable_term(*id, variable.span);
                locals.push((function, first_value(function, value, variable.span)));
            }
        }
        let body = self.optional_rule(rule, span);
        self.release(mark);
        match locals.is_empty() {
            true => body,
            false => RuleNode { span: body.span, kind: RuleKind::Local { locals, body: Box::new(body) } },
        }
    }
}

fn first_value(function: FunctionId, value: Term, span: Span) -> RuleNode {
    let target = Target::Location { function, arguments: Vec::new(), span };
    RuleNode { kind: RuleKind::Update { target, value }, span }
}
