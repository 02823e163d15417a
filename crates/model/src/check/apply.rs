//! Applications of functions and operators: finds the overload that is meant, or says why there is none.
//!
//! In: a name and arguments. Out: [`TermKind::Apply`] with one argument for each parameter, or a fault that says what
//! the candidates would take. Projections (`first`, `second`, …) of products become [`TermKind::Project`].

use syntax::{Span, SyntaxToken, ast};

use super::body::{Body, error_term};
use crate::coerce::can_coerce;
use crate::domain::{DomainKind, Domains};
use crate::fault;
use crate::id::DomainId;
use crate::id::FunctionId;
use crate::overload::{self, Choice, Shape};
use crate::term::{Term, TermKind};
use crate::uses::Referent;

const PROJECTIONS: [&str; 9] = ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth"];

/// How an application was written, for its faults.
pub(crate) struct Written<'a> {
    /// The function's name.
    pub(crate) name: &'a str,
    /// The name or operator as it is written.
    pub(crate) shown: &'a str,
    /// Where that stands.
    pub(crate) name_span: Span,
    /// The whole application.
    pub(crate) span: Span,
}

impl Body<'_> {
    /// `f`, `f(a,b)`, `self.f(a)`
    pub(crate) fn function_term(&mut self, term: &ast::FunctionTerm, span: Span) -> Term {
        let mut arguments = Vec::new();
        if let Some(agent) = term.agent() {
            let place = self.site.token_span(&agent);
            let written = Written { name: agent.text(), shown: agent.text(), name_span: place, span: place };
            arguments.push(self.application(&written, Vec::new()));
        }
        arguments
            .extend(term.arguments().into_iter().flat_map(|list| list.terms()).map(|argument| self.term(&argument)));
        let Some(name) = term.name() else { return error_term(span) };
        let name_span = self.site.token_span(&name);
        self.application(&Written { name: name.text(), shown: name.text(), name_span, span }, arguments)
    }

    /// An operator as the application of its library function.
    pub(crate) fn operator(&mut self, token: &SyntaxToken, name: &str, arguments: Vec<Term>, span: Span) -> Term {
        let name_span = self.site.token_span(token);
        self.application(&Written { name, shown: token.text(), name_span, span }, arguments)
    }

    /// A function applied to checked arguments.
    pub(crate) fn application(&mut self, written: &Written<'_>, arguments: Vec<Term>) -> Term {
        let names = self.site.names;
        let local: Vec<FunctionId>;
        let candidates = match self.locals.iter().any(|(name, _)| name == written.name) {
            true => {
                let locals = self.locals.iter().filter(|(name, _)| name == written.name).map(|(_, id)| *id);
                local = names.functions(written.name).iter().copied().chain(locals).collect();
                local.as_slice()
            }
            false => names.functions(written.name),
        };
        if candidates.is_empty() {
            let visible: Vec<String> = self.visible().into_iter().map(str::to_string).collect();
            let visible: Vec<&str> = visible.iter().map(String::as_str).collect();
            self.site.unknown_function(written.name, written.shown, written.name_span, &visible);
            return error_term(written.span);
        }
        // Arguments that do not fit leave no doubt about the function if there is only one.
        if let [only] = candidates {
            self.site.note(written.name_span, Referent::Function(*only));
        }
        if arguments.iter().any(|argument| argument.domain == Domains::ERROR) {
            return self.guess(candidates, arguments, written.span);
        }
        match overload::function(self.site.model, candidates, &arguments) {
            Some(choice) => self.apply(choice, arguments, written),
            None => {
                self.report(candidates, &arguments, written);
                error_term(written.span)
            }
        }
    }

    /// An application to arguments that already hold a reported fault.
    fn guess(&mut self, candidates: &[FunctionId], arguments: Vec<Term>, span: Span) -> Term {
        let fitting: Vec<DomainId> = candidates
            .iter()
            .map(|id| self.site.model.function(*id))
            .filter(|function| function.parameters.len() == arguments.len())
            .map(|function| function.codomain)
            .collect();
        let domain = match fitting.as_slice() {
            [first, rest @ ..] if rest.iter().all(|other| other == first) => *first,
            _ => Domains::ERROR,
        };
        let polymorphic = self.site.model.domains.instantiate(domain, &Default::default()) != domain;
        Term { kind: TermKind::Error, domain: if polymorphic { Domains::ERROR } else { domain }, span }
    }

    fn apply(&mut self, choice: Choice<FunctionId>, mut arguments: Vec<Term>, written: &Written<'_>) -> Term {
        let Choice { id, bindings, shape } = choice;
        let span = written.span;
        self.site.note(written.name_span, Referent::Function(id));
        if let Some(projection) = self.projection(id, &mut arguments, span) {
            return projection;
        }
        let mut unpacked = None;
        match shape {
            Shape::Direct => {}
            Shape::Packed => arguments = vec![self.tuple(arguments, span)],
            Shape::TakenApart => {
                let whole = arguments.remove(0);
                let (variable, components) = self.take_apart(&whole);
                unpacked = variable.map(|variable| (variable, whole));
                arguments = components;
            }
        }
        let parameters = self.site.model.function(id).parameters.clone();
        let of_agent = arguments.iter().any(|argument| self.mentions_self(argument));
        let arguments: Vec<Term> = arguments
            .into_iter()
            .zip(&parameters)
            .map(|(argument, formal)| {
                if !of_agent {
                    self.report_narrower(id, *formal, &argument);
                }
                let formal = self.site.model.domains.instantiate(*formal, &bindings);
                self.coerce(argument, formal)
            })
            .collect();
        let codomain = self.site.model.function(id).codomain;
        let domain = self.site.model.domains.instantiate(codomain, &bindings);
        let application = Term { kind: TermKind::Apply { function: id, arguments }, domain, span };
        match unpacked {
            Some(binding) => {
                Term { kind: TermKind::Let { bindings: vec![binding], body: Box::new(application) }, domain, span }
            }
            None => application,
        }
    }

    /// `first(t)` and its like on products.
    fn projection(&mut self, id: FunctionId, arguments: &mut Vec<Term>, span: Span) -> Option<Term> {
        let function = self.site.model.function(id);
        if !function.library || function.parameters.len() < 2 {
            return None;
        }
        let index = PROJECTIONS.iter().position(|name| *name == function.name)?;
        let tuple = match arguments.len() {
            1 => arguments.remove(0),
            _ => self.tuple(std::mem::take(arguments), span),
        };
        let type_domain = self.site.model.domains.type_domain(tuple.domain);
        let domain = *self.site.model.domains.parameters_of(type_domain).get(index)?;
        Some(Term { kind: TermKind::Project { tuple: Box::new(tuple), index: index as u32 }, domain, span })
    }

    /// A function over a subset of an abstract domain needs an argument of that subset. (If `self` is an argument
    /// nothing is reported: whose program this is decides whether the agent is of the right kind.)
    fn report_narrower(&mut self, id: FunctionId, formal: DomainId, argument: &Term) {
        let domains = &self.site.model.domains;
        let DomainKind::Concrete { base, .. } = domains.kind(formal) else { return };
        let abstract_base = matches!(domains.kind(*base), DomainKind::Abstract { .. });
        if !abstract_base || argument.domain != *base {
            return;
        }
        let (expected, found) = (self.site.display(formal), self.site.display(*base));
        let function = self.site.model.function(id);
        let fault = fault::term::narrower_domain(argument.span, &function.name, &expected, &found, function.span);
        self.site.faults.push(fault);
    }

    fn mentions_self(&self, term: &Term) -> bool {
        match &term.kind {
            TermKind::Apply { function, arguments } => {
                let function = self.site.model.function(*function);
                (function.library && function.name == "self") || arguments.iter().any(|term| self.mentions_self(term))
            }
            _ => false,
        }
    }

    /// Says why no candidate takes these arguments.
    fn report(&mut self, candidates: &[FunctionId], arguments: &[Term], written: &Written<'_>) {
        let model = &*self.site.model;
        let fitting: Vec<FunctionId> =
            candidates.iter().copied().filter(|id| model.function(*id).parameters.len() == arguments.len()).collect();
        let fault = match fitting.as_slice() {
            [] => self.wrong_count(candidates, arguments, written),
            [id] if written.shown == written.name => self.wrong_argument(*id, arguments, written),
            _ => self.no_overload(&fitting, arguments, written),
        };
        self.site.faults.push(fault);
    }

    fn wrong_count(&self, candidates: &[FunctionId], arguments: &[Term], written: &Written<'_>) -> syntax::Diagnostic {
        let mut counts: Vec<usize> =
            candidates.iter().map(|id| self.site.model.function(*id).parameters.len()).collect();
        counts.sort_unstable();
        counts.dedup();
        let expected = match counts.as_slice() {
            [0] => "no arguments".to_string(),
            [one] => fault::count(*one, "argument"),
            [front @ .., last] => {
                let front: Vec<String> = front.iter().map(usize::to_string).collect();
                format!("{} or {}", front.join(", "), fault::count(*last, "argument"))
            }
            [] => "no arguments".to_string(),
        };
        let found = arguments.len();
        fault::term::argument_count(written.name_span, written.shown, &expected, found, &self.signatures(candidates))
    }

    fn wrong_argument(&self, id: FunctionId, arguments: &[Term], written: &Written<'_>) -> syntax::Diagnostic {
        let function = self.site.model.function(id);
        let pairs = || arguments.iter().zip(&function.parameters);
        let wrong = pairs().find(|(argument, formal)| !can_coerce(self.site.model, argument, **formal));
        let Some((argument, formal)) = wrong.or_else(|| pairs().next_back()) else {
            return self.no_overload(&[id], arguments, written);
        };
        let mismatch = self.site.mismatch(*formal, argument.domain);
        let signature = self.site.signature(id);
        fault::term::argument_domain(argument.span, written.shown, &mismatch, function.span, &signature)
    }

    fn no_overload(&self, candidates: &[FunctionId], arguments: &[Term], written: &Written<'_>) -> syntax::Diagnostic {
        let domains: Vec<String> = arguments.iter().map(|argument| self.site.display(argument.domain)).collect();
        let message = format!("no `{}` takes {}", written.shown, fault::list(&domains));
        let operands: Vec<(Span, String)> = arguments.iter().map(|argument| argument.span).zip(domains).collect();
        let domains_of = |id: &FunctionId| -> String {
            let parameters = &self.site.model.function(*id).parameters;
            let parts: Vec<String> = parameters.iter().map(|domain| self.site.display(*domain)).collect();
            if parts.len() == 1 { parts.concat() } else { format!("({})", parts.join(", ")) }
        };
        let mut takes: Vec<String> = candidates.iter().map(domains_of).collect();
        takes.dedup();
        let shown = takes.len().min(6);
        let more = if takes.len() > shown { format!(" and {} more", takes.len() - shown) } else { String::new() };
        let help = format!("`{}` takes {}{more}", written.shown, takes[..shown].join(", "));
        fault::term::no_overload(written.name_span, message, &operands, help)
    }

    fn signatures(&self, candidates: &[FunctionId]) -> Vec<(Span, String)> {
        let own = candidates.iter().filter(|id| !self.site.model.function(**id).library);
        own.take(3).map(|id| (self.site.model.function(*id).span, self.site.signature(*id))).collect()
    }
}
