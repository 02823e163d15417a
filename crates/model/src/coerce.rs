//! Converts a term to the domain that is expected in its place.
//!
//! In: a term and the expected domain. Out: whether the term is allowed there, and the converted term. A number that
//! changes its form gets a [`TermKind::Coerce`]; constants become literals of the expected domain. Both are pushed into
//! branches, elements and components, so the coercion is applied to the number itself. INVARIANT: a term without numbers
//! does not change, except for the domain of an empty collection.

use crate::check::body::Body;
use crate::collection::CollectionKind;
use crate::compat::{Bindings, COERCING};
use crate::constant;
use crate::domain::{Basic, DomainKind, Domains};
use crate::id::DomainId;
use crate::model::Model;
use crate::term::{Binder, Literal, Term, TermKind};

/// The cost of using a constant Integer as a Natural.
const CONSTANT: u32 = COERCING / 2;

/// The cost of a term for a formal domain: as [`Domains::fit`], but also uses what is known of the term itself.
pub(crate) fn cost(model: &Model, term: &Term, formal: DomainId, bindings: &mut Bindings) -> Option<u32> {
    let domains = &model.domains;
    let before = bindings.clone();
    let by_domain = domains.fit(term.domain, formal, bindings);
    if by_domain.is_some_and(|cost| cost < COERCING) {
        return by_domain;
    }
    let target = match domains.kind(formal) {
        DomainKind::Any => before.get(formal).unwrap_or(Domains::ANY),
        _ => formal,
    };
    if can_push(model, term, target) {
        *bindings = before;
        return Some(CONSTANT);
    }
    by_domain.filter(|_| can_coerce(model, term, target))
}

/// Whether the term is allowed where `target` is expected.
pub(crate) fn can_coerce(model: &Model, term: &Term, target: DomainId) -> bool {
    match model.domains.fits(term.domain, target) {
        Some(cost) if cost < COERCING => true,
        Some(_) => convertible(&model.domains, term.domain, target) || can_push(model, term, target),
        None => can_push(model, term, target),
    }
}

/// Whether any value of the one domain can be converted to the other, whatever the term is.
fn convertible(domains: &Domains, from: DomainId, to: DomainId) -> bool {
    match (domains.kind(domains.type_domain(from)), domains.kind(domains.type_domain(to))) {
        (DomainKind::Map(..), DomainKind::Map(..)) => !changes_form(domains, from, to),
        (DomainKind::Prod(a), DomainKind::Prod(b)) => a.iter().zip(b).all(|(a, b)| convertible(domains, *a, *b)),
        (DomainKind::Seq(a), DomainKind::Seq(b))
        | (DomainKind::Powerset(a), DomainKind::Powerset(b))
        | (DomainKind::Bag(a), DomainKind::Bag(b)) => convertible(domains, *a, *b),
        _ => true,
    }
}

/// Whether the coercion changes the value itself: some number in it becomes a Real or a Complex.
fn changes_form(domains: &Domains, from: DomainId, to: DomainId) -> bool {
    let (from, to) = (domains.type_domain(from), domains.type_domain(to));
    if from == to {
        return false;
    }
    match (domains.kind(from), domains.kind(to)) {
        (DomainKind::Basic(a), DomainKind::Basic(b)) => a < &Basic::Char && matches!(b, Basic::Real | Basic::Complex),
        (DomainKind::Prod(a), DomainKind::Prod(b)) => a.iter().zip(b).any(|(a, b)| changes_form(domains, *a, *b)),
        (DomainKind::Seq(a), DomainKind::Seq(b))
        | (DomainKind::Powerset(a), DomainKind::Powerset(b))
        | (DomainKind::Bag(a), DomainKind::Bag(b)) => changes_form(domains, *a, *b),
        (DomainKind::Map(a, b), DomainKind::Map(c, d)) => {
            changes_form(domains, *a, *c) || changes_form(domains, *b, *d)
        }
        _ => false,
    }
}

/// Whether the expected domain can be pushed into the parts of the term.
fn can_push(model: &Model, term: &Term, target: DomainId) -> bool {
    let domains = &model.domains;
    let into =
        |term: &Term, target: DomainId| stacker::maybe_grow(64 * 1024, 1024 * 1024, || can_coerce(model, term, target));
    if domains.numeric(target) == Some(Basic::Natural) && constant::integer(model, term).is_some_and(|value| value >= 0)
    {
        return true;
    }
    let element = |collection| match domains.kind(domains.type_domain(collection)) {
        DomainKind::Seq(of) | DomainKind::Powerset(of) | DomainKind::Bag(of) => Some(*of),
        _ => None,
    };
    let same_collection = domains.compatible(rough(domains, term.domain), rough(domains, target));
    match (&term.kind, domains.kind(domains.type_domain(target))) {
        (TermKind::Tuple(parts), DomainKind::Prod(targets)) => {
            parts.len() == targets.len() && parts.iter().zip(targets).all(|(part, target)| into(part, *target))
        }
        (TermKind::Collection { elements, kind: CollectionKind::Map }, DomainKind::Map(key, value)) => {
            elements.iter().all(|entry| match &entry.kind {
                TermKind::Tuple(pair) => into(&pair[0], *key) && into(&pair[1], *value),
                _ => false,
            })
        }
        (TermKind::Collection { elements, .. }, _) if same_collection => {
            element(target).is_some_and(|of| elements.iter().all(|element| into(element, of)))
        }
        (TermKind::Range { low, high, step, .. }, _) if same_collection => element(target)
            .is_some_and(|of| into(low, of) && into(high, of) && step.as_ref().is_none_or(|step| into(step, of))),
        (TermKind::Comprehension { body, kind, .. }, _) if same_collection && *kind != CollectionKind::Map => {
            element(target).is_some_and(|of| into(body, of))
        }
        (TermKind::If { branches, otherwise }, _) => {
            branches.iter().all(|(_, term)| into(term, target))
                && otherwise.as_ref().is_none_or(|term| into(term, target))
        }
        (TermKind::Switch { cases, otherwise, .. }, _) => {
            cases.iter().all(|(_, term)| into(term, target)) && otherwise.as_ref().is_none_or(|term| into(term, target))
        }
        (TermKind::Let { body, .. }, _) => into(body, target),
        _ => false,
    }
}

/// The kind of collection that a domain is, whatever it holds; a basic domain stands for each kind.
fn rough(domains: &Domains, domain: DomainId) -> DomainId {
    match domains.kind(domains.type_domain(domain)) {
        DomainKind::Powerset(_) => Domains::INTEGER,
        DomainKind::Seq(_) => Domains::BOOLEAN,
        DomainKind::Bag(_) => Domains::STRING,
        _ => Domains::CHAR,
    }
}

impl Body<'_> {
    /// The term converted to the domain `target`, which must be possible ([`can_coerce`]).
    pub(crate) fn coerce(&mut self, mut term: Term, target: DomainId) -> Term {
        let domains = &self.site.model.domains;
        let fit = domains.fits(term.domain, target);
        if fit.is_some_and(|cost| cost < COERCING) {
            let empty = matches!(&term.kind, TermKind::Collection { elements, .. } if elements.is_empty());
            if empty && target != Domains::ANY && target != Domains::ERROR {
                term.domain = domains.type_domain(target);
            }
            return term;
        }
        if can_push(self.site.model, &term, target) {
            return stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.push(term, target));
        }
        self.convert(term, target)
    }

    fn push(&mut self, mut term: Term, target: DomainId) -> Term {
        let target = self.site.model.domains.type_domain(target);
        let element = self.site.model.domains.element(target);
        term.domain = target;
        match &mut term.kind {
            TermKind::Tuple(parts) => {
                let targets = self.site.model.domains.parameters_of(target);
                for (part, target) in parts.iter_mut().zip(targets) {
                    self.coerce_in_place(part, target);
                }
            }
            TermKind::Collection { elements, .. } => {
                for part in elements {
                    self.coerce_in_place(part, element.unwrap_or(Domains::ERROR));
                }
            }
            TermKind::Range { low, high, step, .. } => {
                for part in [Some(low), Some(high), step.as_mut()].into_iter().flatten() {
                    self.coerce_in_place(part, element.unwrap_or(Domains::ERROR));
                }
            }
            TermKind::Comprehension { body, .. } => self.coerce_in_place(body, element.unwrap_or(Domains::ERROR)),
            TermKind::If { branches, otherwise } => {
                branches.iter_mut().for_each(|(_, part)| self.coerce_in_place(part, target));
                otherwise.iter_mut().for_each(|part| self.coerce_in_place(part, target));
            }
            TermKind::Switch { cases, otherwise, .. } => {
                cases.iter_mut().for_each(|(_, part)| self.coerce_in_place(part, target));
                otherwise.iter_mut().for_each(|part| self.coerce_in_place(part, target));
            }
            TermKind::Let { body, .. } => self.coerce_in_place(body, target),
            _ => {} // a constant taken for a Natural: its domain says so
        }
        term
    }

    fn coerce_in_place(&mut self, term: &mut Term, target: DomainId) {
        let span = term.span;
        let taken = std::mem::replace(term, crate::check::body::error_term(span));
        *term = self.coerce(taken, target);
    }

    /// Converts the value of a term to `target`, whatever the term is.
    fn convert(&mut self, term: Term, target: DomainId) -> Term {
        let domains = &self.site.model.domains;
        let (span, target) = (term.span, domains.type_domain(target));
        if !changes_form(domains, term.domain, target) {
            return term;
        }
        let kind = match (term.kind, domains.kind(target).clone()) {
            (TermKind::Literal(Literal::Integer(value)), DomainKind::Basic(Basic::Real)) => {
                TermKind::Literal(Literal::Real(value as f64))
            }
            (TermKind::Literal(Literal::Integer(value)), DomainKind::Basic(_)) => {
                TermKind::Literal(Literal::Complex(value as f64, 0.0))
            }
            (TermKind::Literal(Literal::Real(value)), DomainKind::Basic(_)) => {
                TermKind::Literal(Literal::Complex(value, 0.0))
            }
            (kind, DomainKind::Basic(_)) => TermKind::Coerce(Box::new(Term { kind, ..term })),
            (kind, DomainKind::Seq(of)) => self.convert_elements(Term { kind, ..term }, CollectionKind::Seq, of),
            (kind, DomainKind::Powerset(of)) => self.convert_elements(Term { kind, ..term }, CollectionKind::Set, of),
            (kind, DomainKind::Bag(of)) => self.convert_elements(Term { kind, ..term }, CollectionKind::Bag, of),
            (kind, DomainKind::Prod(parts)) => self.convert_components(Term { kind, ..term }, &parts),
            (kind, _) => kind,
        };
        Term { kind, domain: target, span }
    }

    fn convert_elements(&mut self, collection: Term, kind: CollectionKind, of: DomainId) -> TermKind {
        let span = collection.span;
        let element = self.site.model.domains.element(collection.domain).unwrap_or(Domains::ERROR);
        let variable = self.made_variable(element, span);
        let body = self.variable_term(variable, span);
        let body = Box::new(self.coerce(body, of));
        TermKind::Comprehension { kind, binders: vec![Binder { variable, range: collection }], condition: None, body }
    }

    fn convert_components(&mut self, tuple: Term, parts: &[DomainId]) -> TermKind {
        let (span, domain) = (tuple.span, tuple.domain);
        let (variable, components) = self.take_apart(&tuple);
        let components: Vec<Term> =
            components.into_iter().zip(parts).map(|(component, part)| self.coerce(component, *part)).collect();
        let target = self.site.model.domains.structured(DomainKind::Prod(parts.to_vec()));
        let body = Term { kind: TermKind::Tuple(components), domain: target, span };
        match variable {
            Some(variable) => {
                let bindings = vec![(variable, Term { domain, ..tuple })];
                TermKind::Let { bindings, body: Box::new(body) }
            }
            None => body.kind,
        }
    }

    /// The components of a product-valued term, and the variable that they are projections of, to be bound to the
    /// term by a `let` around their use; none where the term may stand several times as it is.
    pub(crate) fn take_apart(&mut self, tuple: &Term) -> (Option<crate::id::VariableId>, Vec<Term>) {
        let type_domain = self.site.model.domains.type_domain(tuple.domain);
        let parts = self.site.model.domains.parameters_of(type_domain);
        if let TermKind::Tuple(components) = &tuple.kind {
            return (None, components.clone());
        }
        let plain = matches!(tuple.kind, TermKind::Variable(_));
        let variable = (!plain).then(|| self.made_variable(tuple.domain, tuple.span));
        let whole = match variable {
            Some(variable) => self.variable_term(variable, tuple.span),
            None => tuple.clone(),
        };
        let project = |(index, part): (usize, &DomainId)| Term {
            kind: TermKind::Project { tuple: Box::new(whole.clone()), index: index as u32 },
            domain: *part,
            span: tuple.span,
        };
        (variable, parts.iter().enumerate().map(project).collect())
    }
}
