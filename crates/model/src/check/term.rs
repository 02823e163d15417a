//! Terms: finds the domain of every part of a written term (spec/language.md, section 6).
//!
//! In: a typed view of a term. Out: a [`Term`]. After a reported fault its domain is [`Domains::ERROR`], which is
//! compatible with every other, so one mistake gives one fault. INVARIANT: safe on any tree, however deep.

use syntax::ast;
use syntax::{Span, SyntaxKind, SyntaxToken};

use super::body::{Body, Bound, error_term};
use crate::coerce::can_coerce;
use crate::domain::{DomainKind, Domains};
use crate::fault;
use crate::id::DomainId;
use crate::id::VariableId;
use crate::term::{Literal, Quantifier, Term, TermKind};
use crate::uses::Referent;

impl Body<'_> {
    /// A term that may be missing after a syntax fault at `place`.
    pub(crate) fn optional_term(&mut self, term: Option<ast::Term>, place: Span) -> Term {
        match term {
            Some(term) => self.term(&term),
            None => error_term(place),
        }
    }

    /// Checks a term.
    pub(crate) fn term(&mut self, term: &ast::Term) -> Term {
        stacker::maybe_grow(128 * 1024, 2 * 1024 * 1024, || self.term_here(term))
    }

    fn term_here(&mut self, term: &ast::Term) -> Term {
        let span = self.site.span(term);
        match term {
            ast::Term::Literal(literal) => self.literal(literal, span),
            ast::Term::Enum(literal) => self.enum_literal(literal, span),
            ast::Term::Variable(variable) => match variable.token() {
                Some(token) => self.resolve_variable(&token),
                None => error_term(span),
            },
            ast::Term::Function(function) => self.function_term(function, span),
            ast::Term::Domain(domain) => self.domain_term(domain, span),
            ast::Term::Unary(unary) => self.unary(unary, span),
            ast::Term::Binary(binary) => self.binary(binary, span),
            ast::Term::Paren(paren) => self.optional_term(paren.term(), span),
            ast::Term::Tuple(tuple) => {
                let components = tuple.components().map(|component| self.term(&component)).collect();
                self.tuple(components, span)
            }
            ast::Term::Quantified(quantified) => self.quantified(quantified, span),
            ast::Term::If(term) => self.if_term(term, span),
            ast::Term::Switch(term) => self.switch_term(term, span),
            ast::Term::Let(term) => self.let_term(term, span),
            ast::Term::Collection(collection) => self.collection(collection, span),
            ast::Term::Range(range) => self.range(range, span),
            ast::Term::Map(map) => self.map(map, span),
            ast::Term::Comprehension(comprehension) => self.comprehension(comprehension, span),
            ast::Term::Rule(rule) => self.rule_term(rule, span),
        }
    }

    fn enum_literal(&mut self, literal: &ast::EnumTerm, span: Span) -> Term {
        let Some(token) = literal.token() else { return error_term(span) };
        let name = token.text();
        if let Some((domain, place)) = self.site.names.literal(name) {
            self.site.note(span, Referent::Literal(domain, place));
            return Term { kind: TermKind::Literal(Literal::Enum(domain, place)), domain, span };
        }
        if let Some(domain) = self.site.names.domain(name) {
            self.site.note(span, Referent::Domain(domain));
            return self.domain_as_set(domain, span);
        }
        self.site.unknown_literal(name, span);
        error_term(span)
    }

    fn domain_term(&mut self, term: &ast::DomainTerm, span: Span) -> Term {
        let Some(domain) = term.domain() else { return error_term(span) };
        if let ast::Domain::Named(named) = &domain
            && let Some(name) = named.name()
            && self.site.names.domain(name.text()).is_none()
            && let Some((domain, place)) = self.site.names.literal(name.text())
        {
            // A literal of the wrong shape; that was reported at its declaration.
            self.site.note(span, Referent::Literal(domain, place));
            return Term { kind: TermKind::Literal(Literal::Enum(domain, place)), domain, span };
        }
        let domain = self.site.resolve_domain(&domain);
        self.domain_as_set(domain, span)
    }

    fn domain_as_set(&mut self, domain: DomainId, span: Span) -> Term {
        if domain == Domains::ERROR {
            return error_term(span);
        }
        let set = self.site.model.domains.powerset(domain);
        Term { kind: TermKind::Domain(domain), domain: set, span }
    }

    /// Several terms as one.
    pub(crate) fn tuple(&mut self, components: Vec<Term>, span: Span) -> Term {
        let parts: Vec<DomainId> = components.iter().map(|component| component.domain).collect();
        if parts.len() < 2 {
            return components.into_iter().next().unwrap_or_else(|| error_term(span));
        }
        let domain = match parts.contains(&Domains::ERROR) {
            true => Domains::ERROR,
            false => self.site.model.domains.structured(DomainKind::Prod(parts)),
        };
        Term { kind: TermKind::Tuple(components), domain, span }
    }

    fn unary(&mut self, term: &ast::UnaryTerm, span: Span) -> Term {
        let Some(operator) = term.operator() else { return error_term(span) };
        if let (SyntaxKind::MINUS, Some(least)) = (operator.kind(), least_integer(term.operand())) {
            return Term { kind: TermKind::Literal(Literal::Integer(least)), domain: Domains::INTEGER, span };
        }
        let operand = self.optional_term(term.operand(), span);
        let name = match operator.kind() {
            SyntaxKind::MINUS => "minus",
            SyntaxKind::PLUS => "plus",
            _ => "not",
        };
        if name == "minus"
            && let TermKind::Literal(literal) = &operand.kind
        {
            let negated = match literal {
                Literal::Integer(value) => Some((Literal::Integer(-value), Domains::INTEGER)),
                Literal::Real(value) => Some((Literal::Real(-value), Domains::REAL)),
                _ => None,
            };
            if let Some((literal, domain)) = negated {
                return Term { kind: TermKind::Literal(literal), domain, span };
            }
        }
        self.operator(&operator, name, vec![operand], span)
    }

    fn binary(&mut self, term: &ast::BinaryTerm, span: Span) -> Term {
        let Some(operator) = term.operator() else { return error_term(span) };
        let left = self.optional_term(term.left(), span);
        let right = self.optional_term(term.right(), span);
        match operator.kind() {
            SyntaxKind::IN_KW => self.operator(&operator, "contains", vec![right, left], span),
            SyntaxKind::NOTIN_KW => {
                let contains = self.operator(&operator, "contains", vec![right, left], span);
                self.operator(&operator, "not", vec![contains], span)
            }
            _ => match function_of(&operator) {
                Some(name) => self.operator(&operator, name, vec![left, right], span),
                None => error_term(span),
            },
        }
    }

    /// A condition: checked to be Boolean.
    pub(crate) fn condition(&mut self, term: Option<ast::Term>, place: Span, what: &str) -> Term {
        let condition = self.optional_term(term, place);
        self.boolean(condition, what)
    }

    fn boolean(&mut self, condition: Term, what: &str) -> Term {
        if !can_coerce(self.site.model, &condition, Domains::BOOLEAN) {
            let found = self.site.display(condition.domain);
            self.site.faults.push(fault::term::guard_not_boolean(condition.span, what, &found));
        }
        condition
    }

    fn quantified(&mut self, term: &ast::QuantifiedTerm, span: Span) -> Term {
        let quantifier = match (term.quantifier(), term.is_unique()) {
            (Some(SyntaxKind::FORALL_KW), _) => Quantifier::Forall,
            (_, true) => Quantifier::ExistsUnique,
            _ => Quantifier::Exists,
        };
        let mark = self.mark();
        let binders = self.binders(term.binders());
        let condition =
            term.condition().map(|c| Box::new(self.condition(Some(c), span, "the condition behind `with`")));
        self.release(mark);
        Term { kind: TermKind::Quantified { quantifier, binders, condition }, domain: Domains::BOOLEAN, span }
    }

    fn if_term(&mut self, term: &ast::IfTerm, span: Span) -> Term {
        let mut branches = Vec::new();
        for branch in term.branches() {
            let place = self.site.span(&branch);
            let guard = self.condition(branch.guard(), place, "the guard of `if`");
            branches.push((guard, self.optional_term(branch.term(), place)));
        }
        let mut otherwise = term.otherwise().map(|term| Box::new(self.term(&term)));
        let results = branches.iter_mut().map(|(_, term)| term).chain(otherwise.as_deref_mut());
        let domain = self.unify(results.collect());
        Term { kind: TermKind::If { branches, otherwise }, domain, span }
    }

    fn switch_term(&mut self, term: &ast::SwitchTerm, span: Span) -> Term {
        let subject = self.optional_term(term.subject(), span);
        let mut cases = Vec::new();
        for case in term.cases() {
            let place = self.site.span(&case);
            let value = self.case_value(&subject, case.value(), place);
            cases.push((value, self.optional_term(case.term(), place)));
        }
        let mut otherwise = term.otherwise().map(|term| Box::new(self.term(&term)));
        let results = cases.iter_mut().map(|(_, term)| term).chain(otherwise.as_deref_mut());
        let domain = self.unify(results.collect());
        Term { kind: TermKind::Switch { subject: Box::new(subject), cases, otherwise }, domain, span }
    }

    /// The value of a case; a number is taken to the subject's domain.
    pub(crate) fn case_value(&mut self, subject: &Term, value: Option<ast::Term>, place: Span) -> Term {
        let value = self.optional_term(value, place);
        if can_coerce(self.site.model, &value, subject.domain) {
            return self.coerce(value, subject.domain);
        }
        if self.site.model.domains.fits(subject.domain, value.domain).is_none() {
            let (found, expected) = (self.site.display(value.domain), self.site.display(subject.domain));
            self.site.faults.push(fault::term::case_never_matches(value.span, &found, subject.span, &expected));
        }
        value
    }

    /// Brings the results of all branches to one domain.
    fn unify(&mut self, mut results: Vec<&mut Term>) -> DomainId {
        let Some((first, first_span)) = results.first().map(|term| (term.domain, term.span)) else {
            return Domains::ERROR;
        };
        let mut domain = first;
        for result in &results[1..] {
            match self.site.model.domains.join(domain, result.domain) {
                Some(join) => domain = join,
                None => {
                    let (found, expected) = (self.site.display(result.domain), self.site.display(domain));
                    self.site.faults.push(fault::term::branch_domains(result.span, &found, first_span, &expected));
                    return Domains::ERROR;
                }
            }
        }
        for result in &mut results {
            let term = std::mem::replace(*result, error_term(first_span));
            **result = self.coerce(term, domain);
        }
        domain
    }

    fn let_term(&mut self, term: &ast::LetTerm, span: Span) -> Term {
        let mark = self.mark();
        let bindings = self.bindings(term.bindings());
        let body = Box::new(self.optional_term(term.body(), span));
        self.release(mark);
        let domain = body.domain;
        Term { kind: TermKind::Let { bindings, body }, domain, span }
    }

    /// The bindings of a `let`; their variables stay in scope.
    pub(crate) fn bindings(&mut self, bindings: impl Iterator<Item = ast::Binding>) -> Vec<(VariableId, Term)> {
        let mut bound = Vec::new();
        for binding in bindings {
            let place = self.site.span(&binding);
            let term = self.optional_term(binding.term(), place);
            if let Some(token) = binding.variable() {
                bound.push((self.bind(&token, term.domain, Bound::Let), term));
            }
        }
        bound
    }

    fn rule_term(&mut self, term: &ast::RuleTerm, span: Span) -> Term {
        let Some(token) = term.name() else { return error_term(span) };
        let domains: Vec<DomainId> = term.domains().map(|domain| self.site.resolve_domain(&domain)).collect();
        match self.rule_by_domains(&token, &domains, span) {
            Some(rule) => {
                let parameters = self.site.model.rule(rule).variables[..self.site.model.rule(rule).parameters.len()]
                    .iter()
                    .map(|variable| variable.domain)
                    .collect();
                let domain = self.site.model.domains.structured(DomainKind::Rule(parameters));
                Term { kind: TermKind::Rule(rule), domain, span }
            }
            None => error_term(span),
        }
    }
}

/// The least integer: its digits alone are beyond the greatest one.
fn least_integer(operand: Option<ast::Term>) -> Option<i64> {
    let Some(ast::Term::Literal(literal)) = operand else { return None };
    let token = literal.token().filter(|token| token.kind() == SyntaxKind::INTEGER)?;
    (token.text().parse::<u64>().ok()? == i64::MIN.unsigned_abs()).then_some(i64::MIN)
}

/// The library function of a binary operator.
fn function_of(operator: &SyntaxToken) -> Option<&'static str> {
    Some(match operator.kind() {
        SyntaxKind::EQ => "eq",
        SyntaxKind::NEQ => "neq",
        SyntaxKind::LT => "lt",
        SyntaxKind::LE => "le",
        SyntaxKind::GT => "gt",
        SyntaxKind::GE => "ge",
        SyntaxKind::PLUS => "plus",
        SyntaxKind::MINUS => "minus",
        SyntaxKind::STAR => "mult",
        SyntaxKind::SLASH => "div",
        SyntaxKind::CARET => "pwr",
        _ => match operator.text() {
            "and" => "and",
            "or" => "or",
            "xor" => "xor",
            "implies" => "implies",
            "iff" => "iff",
            "mod" => "mod",
            _ => return None,
        },
    })
}
