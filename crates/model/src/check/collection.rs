//! Collections: literals, ranges, maps, comprehensions, and the binders that range over them.
//!
//! In: typed views. Out: terms whose elements all have the collection's domain. A binder may range over a domain and
//! any set, sequence or bag, whatever collection is made.

use syntax::Span;
use syntax::ast::{self, Bracket};

use super::body::{Body, Bound, error_term};
use crate::collection::CollectionKind;
use crate::constant;
use crate::domain::{Basic, DomainKind, Domains};
use crate::fault;
use crate::id::DomainId;
use crate::term::{Binder, Term, TermKind};

fn kind_of(bracket: Bracket) -> CollectionKind {
    match bracket {
        Bracket::Set => CollectionKind::Set,
        Bracket::Seq => CollectionKind::Seq,
        Bracket::Bag => CollectionKind::Bag,
    }
}

impl Body<'_> {
    /// `{a, b}`, `[a, b]`, `<a, b>`
    pub(crate) fn collection(&mut self, term: &ast::CollectionTerm, span: Span) -> Term {
        let kind = kind_of(term.bracket());
        let mut elements: Vec<Term> = term.elements().map(|element| self.term(&element)).collect();
        let of = self.common_domain(&mut elements);
        if kind == CollectionKind::Set {
            self.report_duplicates(&elements, "element");
        }
        let domain = self.collection_of(kind, of);
        Term { kind: TermKind::Collection { kind, elements }, domain, span }
    }

    fn collection_of(&mut self, kind: CollectionKind, of: Option<DomainId>) -> DomainId {
        match of {
            Some(Domains::ERROR) | None => Domains::ERROR,
            Some(of) => self.site.model.domains.collection(kind, of),
        }
    }

    /// Brings all elements to one domain; without elements it is Undef.
    fn common_domain(&mut self, elements: &mut [Term]) -> Option<DomainId> {
        let mut domain = Domains::UNDEF;
        for index in 0..elements.len() {
            let element = &elements[index];
            match self.site.model.domains.join(domain, element.domain) {
                Some(join) => domain = join,
                None => {
                    let (found, expected) = (self.site.display(element.domain), self.site.display(domain));
                    let first = elements[0].span;
                    self.site.faults.push(fault::term::element_domains(element.span, &found, first, &expected));
                    return None;
                }
            }
        }
        for element in elements {
            let term = std::mem::replace(element, error_term(element.span));
            *element = self.coerce(term, domain);
        }
        Some(domain)
    }

    fn report_duplicates(&mut self, elements: &[Term], what: &str) {
        let mut seen: std::collections::BTreeMap<String, Span> = std::collections::BTreeMap::new();
        for element in elements {
            let TermKind::Literal(literal) = &element.kind else { continue };
            if let Some(first) = seen.insert(format!("{literal:?}"), element.span) {
                self.site.faults.push(fault::term::duplicate_element(element.span, first, what));
            }
        }
    }

    /// `{low : high, step}` in any of the three brackets
    pub(crate) fn range(&mut self, term: &ast::RangeTerm, span: Span) -> Term {
        let kind = kind_of(term.bracket());
        let mut bounds = vec![self.optional_term(term.low(), span), self.optional_term(term.high(), span)];
        bounds.extend(term.step().map(|step| self.term(&step)));
        let mut of = Domains::NATURAL;
        for bound in &bounds {
            let numeric = match self.site.model.domains.numeric(bound.domain) {
                Some(Basic::Natural) => Domains::NATURAL,
                Some(Basic::Integer) => Domains::INTEGER,
                Some(Basic::Real) => Domains::REAL,
                _ if bound.domain == Domains::ERROR => return error_term(span),
                _ => {
                    let found = self.site.display(bound.domain);
                    self.site.faults.push(fault::term::range_bounds(bound.span, &found));
                    return error_term(span);
                }
            };
            of = self.site.model.domains.join(of, numeric).unwrap_or(of);
        }
        let mut bounds = bounds.into_iter().map(|bound| self.coerce(bound, of)).collect::<Vec<_>>().into_iter();
        let (Some(low), Some(high)) = (bounds.next(), bounds.next()) else { return error_term(span) };
        let step = bounds.next();
        self.report_empty_range(&low, &high, step.as_ref(), span);
        let domain = self.site.model.domains.collection(kind, of);
        let kind = TermKind::Range { kind, low: Box::new(low), high: Box::new(high), step: step.map(Box::new) };
        Term { kind, domain, span }
    }

    fn report_empty_range(&mut self, low: &Term, high: &Term, step: Option<&Term>, span: Span) {
        let value = |term: &Term| constant::number(self.site.model, term);
        let fault = match (value(low), value(high), step.and_then(value)) {
            (_, _, Some(step)) if step <= 0.0 => {
                fault::term::empty_range(span, "the step leads nowhere", "give a step greater than 0")
            }
            (Some(low), Some(high), _) if low > high => fault::term::empty_range(
                span,
                "the lower bound is above the upper one",
                "swap the bounds: `{low : high}`",
            ),
            _ => return,
        };
        self.site.faults.push(fault);
    }

    /// `{a -> b, c -> d}`
    pub(crate) fn map(&mut self, term: &ast::MapTerm, span: Span) -> Term {
        let (mut keys, mut values, mut places) = (Vec::new(), Vec::new(), Vec::new());
        for entry in term.entries() {
            let place = self.site.span(&entry);
            keys.push(self.optional_term(entry.key(), place));
            values.push(self.optional_term(entry.value(), place));
            places.push(place);
        }
        let (key, value) = (self.common_domain(&mut keys), self.common_domain(&mut values));
        self.report_duplicates(&keys, "key");
        let domain = match (key, value) {
            (Some(key), Some(value)) if key != Domains::ERROR && value != Domains::ERROR => {
                self.site.model.domains.structured(DomainKind::Map(key, value))
            }
            _ => Domains::ERROR,
        };
        let pairs = keys.into_iter().zip(values).zip(places);
        let elements = pairs.map(|((key, value), place)| self.tuple(vec![key, value], place)).collect();
        Term { kind: TermKind::Collection { kind: CollectionKind::Map, elements }, domain, span }
    }

    /// `{$x in D | c : t}` in any of the three brackets, or of a map
    pub(crate) fn comprehension(&mut self, term: &ast::ComprehensionTerm, span: Span) -> Term {
        let mark = self.mark();
        let binders = self.binders(term.binders());
        let condition = term
            .condition()
            .map(|condition| Box::new(self.condition(Some(condition), span, "the condition behind `|`")));
        let (kind, body) = match term.entry() {
            Some(entry) => {
                let place = self.site.span(&entry);
                let pair = vec![self.optional_term(entry.key(), place), self.optional_term(entry.value(), place)];
                (CollectionKind::Map, self.tuple(pair, place))
            }
            None => (kind_of(term.bracket()), self.optional_term(term.body(), span)),
        };
        self.release(mark);
        let domain = self.collection_of(kind, Some(body.domain));
        Term { kind: TermKind::Comprehension { kind, binders, condition, body: Box::new(body) }, domain, span }
    }

    /// `$x in D, $y in E`; the variables stay in scope, and a later range may use an earlier variable.
    pub(crate) fn binders(&mut self, binders: impl Iterator<Item = ast::Binder>) -> Vec<Binder> {
        let mut bound = Vec::new();
        for binder in binders {
            let place = self.site.span(&binder);
            let range = self.optional_term(binder.range_term(), place);
            let element = self.element_of(&range);
            if let Some(token) = binder.variable() {
                bound.push(Binder { variable: self.bind(&token, element, Bound::Range), range });
            }
        }
        bound
    }

    fn element_of(&mut self, range: &Term) -> DomainId {
        let map = matches!(
            self.site.model.domains.kind(self.site.model.domains.type_domain(range.domain)),
            DomainKind::Map(..)
        );
        match self.site.model.domains.element(range.domain) {
            Some(element) if !map => element,
            _ => {
                let found = self.site.display(range.domain);
                self.site.faults.push(fault::term::not_a_collection(range.span, &found));
                Domains::ERROR
            }
        }
    }
}
