//! Updates and turbo returns: finds what they write to, and checks whether the value fits.
//!
//! In: the written target and value. Out: a [`Target`] with the value coerced to its codomain. A rule may write to
//! controlled, shared, out and local functions, a macro rule also to its location parameters; the environment
//! (a scenario's `set`) to monitored and shared ones.

use syntax::Span;
use syntax::ast;

use super::body::{Body, Bound};
use crate::coerce::can_coerce;
use crate::compat::COERCING;
use crate::declaration::FunctionKind;
use crate::domain::Domains;
use crate::fault;
use crate::id::DomainId;
use crate::id::{FunctionId, VariableId};
use crate::rule::{RuleKind, Target};
use crate::site::kind_word;
use crate::term::{Term, TermKind};

/// A target, the domain it takes, and how to name it in a fault.
struct Place {
    target: Target,
    domain: DomainId,
    name: String,
    declared: Span,
}

impl Body<'_> {
    /// `target := value`
    pub(crate) fn update(&mut self, rule: &ast::UpdateRule, span: Span) -> RuleKind {
        match self.update_of(rule.target(), rule.value(), span) {
            Some((target, value)) => RuleKind::Update { target, value },
            None => RuleKind::Error,
        }
    }

    /// The parts of an update; none after a fault.
    pub(crate) fn update_of(
        &mut self,
        target: Option<ast::Term>,
        value: Option<ast::Term>,
        span: Span,
    ) -> Option<(Target, Term)> {
        let place = target.and_then(|target| self.target(&target, false));
        let value = self.optional_term(value, span);
        let place = place?;
        if !can_coerce(self.site.model, &value, place.domain) {
            let mismatch = self.site.mismatch(place.domain, value.domain);
            self.site.faults.push(fault::rule::update_domain(value.span, &place.name, &mismatch, place.declared));
            return None;
        }
        let value = self.coerce(value, place.domain);
        Some((place.target, value))
    }

    /// `target <- r_x(…)`
    pub(crate) fn return_rule(&mut self, rule: &ast::ReturnRule, span: Span) -> RuleKind {
        let place = rule.target().and_then(|target| self.target(&target, true));
        let call = rule.call().and_then(|call| {
            let span = self.site.span(&call);
            self.call(call.name(), call.arguments(), true, span)
        });
        let (Some(place), Some(call)) = (place, call) else { return RuleKind::Error };
        let called = self.site.model.rule(call.rule);
        match called.result {
            None => {
                let (name, declared) = (called.name.clone(), called.span);
                self.site.faults.push(fault::rule::without_result(span, &name, declared));
            }
            Some(result) => {
                let fits = self.site.model.domains.fits(result, place.domain);
                let same_form = fits.is_some_and(|cost| cost < COERCING)
                    || result == Domains::NATURAL
                        && self.site.model.domains.type_domain(place.domain) == Domains::INTEGER;
                if !same_form {
                    let mismatch = self.site.mismatch(place.domain, result);
                    self.site.faults.push(fault::rule::update_domain(span, &place.name, &mismatch, place.declared));
                }
            }
        }
        RuleKind::Return { target: place.target, call }
    }

    /// The location that a term names; `returned` if it gets the result of a turbo rule.
    fn target(&mut self, target: &ast::Term, returned: bool) -> Option<Place> {
        if let ast::Term::Variable(variable) = target {
            return self.variable_place(variable);
        }
        let term = match target {
            ast::Term::Function(_) => self.term(target),
            _ => {
                let span = self.site.span(target);
                self.site.faults.push(fault::rule::not_a_location(
                    span,
                    "this is no location, so it cannot be updated",
                    None,
                ));
                return None;
            }
        };
        let span = term.span;
        let Some((function, arguments)) = application(term) else {
            let message = "this is no location, so it cannot be updated";
            let known = self.site.faults.has_at(span);
            if !known {
                self.site.faults.push(fault::rule::not_a_location(span, message, None));
            }
            return None;
        };
        self.may_update(function, target, returned).then(|| self.function_place(function, arguments, span))
    }

    fn variable_place(&mut self, variable: &ast::VariableTerm) -> Option<Place> {
        let token = variable.token()?;
        let term = self.resolve_variable(&token);
        let name = token.text().to_string();
        match term.kind {
            TermKind::Apply { function, .. } => {
                let declared = self.site.model.function(function).span;
                self.report_copy(&name, function, term.span, declared);
                let target = Target::Location { function, arguments: Vec::new(), span: term.span };
                Some(Place { target, domain: term.domain, name, declared })
            }
            TermKind::Variable(id) if self.bound[id.0 as usize] == Bound::MacroParameter => {
                let declared = self.variable(id).span;
                Some(Place { target: Target::Parameter(id, term.span), domain: term.domain, name, declared })
            }
            TermKind::Variable(_) => {
                let message = format!("`{name}` is a value, not a location, so it cannot be updated");
                self.site.faults.push(fault::rule::not_a_location(term.span, &message, None));
                None
            }
            _ => None,
        }
    }

    /// Warns where an update of a variable likely means an update of what the variable was taken from.
    fn report_copy(&mut self, name: &str, function: FunctionId, span: Span, declared: Span) {
        let (what, help) = match self.bound_of_local(function) {
            Some(Bound::Range) => ("ranges over values here", "update a function of the variable: `f($x) := …`"),
            Some(Bound::Extend) => ("a fresh element", "update a function of the variable: `f($x) := …`"),
            Some(Bound::Parameter) => (
                "a parameter called by value",
                "to change what the caller gave, make the rule a macro rule, called with `[]`",
            ),
            _ => return,
        };
        self.site.faults.push(fault::rule::update_of_variable(span, name, declared, what, help));
    }

    fn may_update(&mut self, id: FunctionId, target: &ast::Term, returned: bool) -> bool {
        let function = self.site.model.function(id);
        let (kind, name, declared) = (function.kind, function.name.clone(), function.span);
        if returned && kind == FunctionKind::Monitored && !self.in_scenario {
            // The peer accepts it, and forgets the value at the end of the step.
            let span = self.site.span(target);
            self.site.faults.push(fault::rule::return_lost(span, &name, declared));
            return true;
        }
        if self.in_scenario && kind == FunctionKind::Monitored {
            return true;
        }
        let (reason, help) = match (kind, self.as_environment) {
            (FunctionKind::Shared, _) => return true,
            (FunctionKind::Monitored, true) => return true,
            (FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Local, false) => return true,
            (FunctionKind::Monitored, false) => (
                "only the environment writes it",
                format!("declare `{name}` shared if the machine writes it too, or controlled"),
            ),
            (FunctionKind::Derived, _) => {
                ("its definition gives its value", format!("update the functions that `{name}` is derived from"))
            }
            (FunctionKind::Static, _) => ("it never changes", format!("declare `{name}` controlled")),
            (_, true) => ("only the machine writes it", "run an update instead: `exec … := …;`".to_string()),
        };
        let span = self.site.span(target);
        let fault = fault::rule::update_not_allowed(span, &name, kind_word(kind), reason, declared, help);
        self.site.faults.push(fault);
        false
    }

    fn function_place(&self, id: FunctionId, arguments: Vec<Term>, span: Span) -> Place {
        let function = self.site.model.function(id);
        let is_result = function.library && function.name == "result";
        let domain = match self.result {
            Some(result) if is_result => result,
            _ => function.codomain,
        };
        let target = Target::Location { function: id, arguments, span };
        Place { target, domain, name: function.name.clone(), declared: function.span }
    }
}

/// The function and the arguments of an application; a product taken apart by a `let` is put in where it is used.
fn application(term: Term) -> Option<(FunctionId, Vec<Term>)> {
    match term.kind {
        TermKind::Apply { function, arguments } => Some((function, arguments)),
        TermKind::Let { bindings, body } => {
            let [(variable, tuple)] = bindings.as_slice() else { return None };
            let TermKind::Apply { function, arguments } = body.kind else { return None };
            let arguments = arguments.into_iter().map(|argument| substitute(argument, *variable, tuple)).collect();
            Some((function, arguments))
        }
        _ => None,
    }
}

fn substitute(mut term: Term, variable: VariableId, tuple: &Term) -> Term {
    match &mut term.kind {
        TermKind::Variable(id) if *id == variable => return tuple.clone(),
        TermKind::Coerce(inner) | TermKind::Project { tuple: inner, .. } => {
            let taken = std::mem::replace(inner.as_mut(), crate::check::body::error_term(tuple.span));
            **inner = substitute(taken, variable, tuple);
        }
        _ => {}
    }
    term
}
