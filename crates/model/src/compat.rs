//! Compatibility of domains, as a cost.
//!
//! In: the domain of a term (actual) and the expected domain (formal). Out: `None` if a value of the one is never a value
//! of the other; otherwise the distance between them. 0 means that they are the same. Below [`COERCING`] they are
//! compatible in the sense of AsmetaL (spec/language.md, 8.1: concrete and type domain in either direction, `undef`, type
//! variables). From [`COERCING`] on, they need a numeric coercion Natural ⊂ Integer ⊂ Real ⊂ Complex.
//!
//! INVARIANT: only reads the table; binds a type variable only to the domain of some term.

use crate::domain::{Basic, DomainKind, Domains};
use crate::id::DomainId;

/// The least cost of a numeric coercion.
pub(crate) const COERCING: u32 = 10_000;
/// The least cost of using a value as a member of a subset; only the run can tell whether it is one.
pub(crate) const NARROWING: u32 = 100;
const TO_BASE: u32 = 10;
const VARIABLE: u32 = 20;
const UNKNOWN: u32 = 60;
const TO_CONCRETE: u32 = NARROWING;
const SIBLING: u32 = 200;
const PER_COMPONENT: u32 = 1;

/// The domains of a signature's type variables in one application.
#[derive(Debug, Default, Clone)]
pub(crate) struct Bindings(Vec<(DomainId, DomainId)>);

impl Bindings {
    /// The domain of a type variable.
    pub(crate) fn get(&self, variable: DomainId) -> Option<DomainId> {
        self.0.iter().find(|(bound, _)| *bound == variable).map(|(_, domain)| *domain)
    }

    fn set(&mut self, variable: DomainId, domain: DomainId) {
        match self.0.iter_mut().find(|(bound, _)| *bound == variable) {
            Some(entry) => entry.1 = domain,
            None => self.0.push((variable, domain)),
        }
    }
}

impl Domains {
    /// Whether a term of domain `actual` is allowed where `formal` is expected; a type variable may be any domain.
    pub(crate) fn fits(&self, actual: DomainId, formal: DomainId) -> Option<u32> {
        self.fit(actual, formal, &mut Bindings::default())
    }

    /// As [`Domains::fits`], but in either direction and without numeric coercions: `compat` of spec/language.md, 8.1.
    pub(crate) fn compatible(&self, a: DomainId, b: DomainId) -> bool {
        [self.fits(a, b), self.fits(b, a)].into_iter().flatten().any(|cost| cost < COERCING)
    }

    /// The cost of an actual domain for a formal one; binds the type variables of the formal one.
    pub(crate) fn fit(&self, actual: DomainId, formal: DomainId, bindings: &mut Bindings) -> Option<u32> {
        use DomainKind::*;
        if actual == Domains::ERROR || formal == Domains::ERROR {
            return Some(0);
        }
        if formal == Domains::ANY {
            return Some(UNKNOWN);
        }
        if let Any = self.kind(formal) {
            return self.fit_variable(actual, formal, bindings);
        }
        if actual == formal {
            return Some(0);
        }
        match (self.kind(actual), self.kind(formal)) {
            (Any | Basic(crate::domain::Basic::Undef), _) | (_, Basic(crate::domain::Basic::Undef)) => Some(UNKNOWN),
            (Concrete { base: a, .. }, Concrete { base: f, .. }) if a == f => Some(SIBLING),
            (Concrete { base, .. }, _) if *base == formal => Some(TO_BASE),
            (_, Concrete { base, .. }) if *base == actual => Some(TO_CONCRETE),
            (Concrete { base, .. }, _) => Some(self.fit(*base, formal, bindings)? + TO_BASE),
            (_, Concrete { base, .. }) => Some(self.fit(actual, *base, bindings)? + TO_CONCRETE),
            (Basic(a), Basic(f)) => widening(*a, *f),
            (Prod(a), Prod(f)) | (Rule(a), Rule(f)) => self.fit_all(a, f, bindings),
            (Seq(a), Seq(f)) | (Powerset(a), Powerset(f)) | (Bag(a), Bag(f)) => self.fit_part(*a, *f, bindings),
            (Map(a, b), Map(f, g)) => Some(self.fit_part(*a, *f, bindings)? + self.fit_part(*b, *g, bindings)?),
            _ => None,
        }
    }

    fn fit_part(&self, actual: DomainId, formal: DomainId, bindings: &mut Bindings) -> Option<u32> {
        // Deep structures cost no more than many components.
        Some(self.fit(actual, formal, bindings)?.saturating_add(PER_COMPONENT).min(100 * COERCING))
    }

    /// As [`Domains::fit`], component by component.
    pub(crate) fn fit_all(&self, actual: &[DomainId], formal: &[DomainId], bindings: &mut Bindings) -> Option<u32> {
        if actual.len() != formal.len() {
            return None;
        }
        actual.iter().zip(formal).try_fold(0u32, |sum, (actual, formal)| {
            Some(sum.saturating_add(self.fit_part(*actual, *formal, bindings)?))
        })
    }

    fn fit_variable(&self, actual: DomainId, variable: DomainId, bindings: &mut Bindings) -> Option<u32> {
        let Some(bound) = bindings.get(variable) else {
            bindings.set(variable, actual);
            return Some(VARIABLE);
        };
        if bound == actual || actual == variable {
            return Some(0);
        }
        let cost = match (self.fits(actual, bound), self.fits(bound, actual)) {
            (None, None) => return None,
            (Some(forward), Some(backward)) if forward <= backward && bound != Domains::UNDEF => forward,
            (Some(forward), None) => forward,
            (_, Some(backward)) => {
                bindings.set(variable, actual);
                backward
            }
        };
        Some(if cost >= COERCING { cost } else { cost.min(TO_BASE) })
    }

    /// The domain that contains the values of both, if there is one.
    pub(crate) fn join(&mut self, a: DomainId, b: DomainId) -> Option<DomainId> {
        if a == b || b == Domains::ERROR {
            return Some(a);
        }
        if a == Domains::ERROR {
            return Some(b);
        }
        let (type_a, type_b) = (self.type_domain(a), self.type_domain(b));
        if type_a == type_b {
            return Some(type_a);
        }
        match (self.fits(a, b), self.fits(b, a)) {
            (Some(forward), Some(backward)) => Some(if forward <= backward { b } else { a }),
            (Some(_), None) => Some(b),
            (None, Some(_)) => Some(a),
            (None, None) => self.join_parts(type_a, type_b),
        }
    }

    fn join_parts(&mut self, a: DomainId, b: DomainId) -> Option<DomainId> {
        let kind = match (self.kind(a).clone(), self.kind(b).clone()) {
            (DomainKind::Prod(a), DomainKind::Prod(b)) if a.len() == b.len() => {
                DomainKind::Prod(a.into_iter().zip(b).map(|(a, b)| self.join(a, b)).collect::<Option<_>>()?)
            }
            (DomainKind::Seq(a), DomainKind::Seq(b)) => DomainKind::Seq(self.join(a, b)?),
            (DomainKind::Powerset(a), DomainKind::Powerset(b)) => DomainKind::Powerset(self.join(a, b)?),
            (DomainKind::Bag(a), DomainKind::Bag(b)) => DomainKind::Bag(self.join(a, b)?),
            (DomainKind::Map(a, b), DomainKind::Map(c, d)) => DomainKind::Map(self.join(a, c)?, self.join(b, d)?),
            _ => return None,
        };
        Some(self.structured(kind))
    }

    /// The domain with its type variables replaced by their domains; an unbound one becomes `Any`.
    pub(crate) fn instantiate(&mut self, domain: DomainId, bindings: &Bindings) -> DomainId {
        if matches!(self.kind(domain), DomainKind::Enum { .. } | DomainKind::Concrete { .. }) {
            return domain;
        }
        let kind = match self.kind(domain).clone() {
            DomainKind::Any => return bindings.get(domain).unwrap_or(Domains::ANY),
            DomainKind::Prod(parts) => DomainKind::Prod(self.instantiate_all(&parts, bindings)),
            DomainKind::Rule(parts) if !parts.is_empty() => DomainKind::Rule(self.instantiate_all(&parts, bindings)),
            DomainKind::Seq(of) => DomainKind::Seq(self.instantiate(of, bindings)),
            DomainKind::Powerset(of) => DomainKind::Powerset(self.instantiate(of, bindings)),
            DomainKind::Bag(of) => DomainKind::Bag(self.instantiate(of, bindings)),
            DomainKind::Map(key, value) => {
                DomainKind::Map(self.instantiate(key, bindings), self.instantiate(value, bindings))
            }
            _ => return domain,
        };
        self.structured(kind)
    }

    fn instantiate_all(&mut self, parts: &[DomainId], bindings: &Bindings) -> Vec<DomainId> {
        parts.iter().map(|part| self.instantiate(*part, bindings)).collect()
    }

    /// A basic domain of numbers, or a concrete one over it.
    pub(crate) fn numeric(&self, domain: DomainId) -> Option<Basic> {
        match self.kind(self.type_domain(domain)) {
            DomainKind::Basic(basic @ (Basic::Complex | Basic::Real | Basic::Integer | Basic::Natural)) => Some(*basic),
            _ => None,
        }
    }
}

/// The cost of using a number of one basic domain as one of another.
fn widening(actual: Basic, formal: Basic) -> Option<u32> {
    let rank = |basic| match basic {
        Basic::Natural => Some(0),
        Basic::Integer => Some(1),
        Basic::Real => Some(2),
        Basic::Complex => Some(3),
        _ => None,
    };
    let (from, to) = (rank(actual)?, rank(formal)?);
    (to > from).then(|| COERCING * (1 << (to - from)) / 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undef_and_numbers_and_structures() {
        let mut domains = Domains::new();
        let integers = domains.powerset(Domains::INTEGER);
        let reals = domains.powerset(Domains::REAL);
        let empty = domains.powerset(Domains::UNDEF);
        assert_eq!(domains.fits(integers, integers), Some(0));
        assert!(domains.fits(empty, integers).is_some_and(|cost| cost < COERCING));
        assert!(domains.fits(integers, reals).is_some_and(|cost| cost >= COERCING));
        assert_eq!(domains.fits(reals, integers), None);
        assert_eq!(domains.join(integers, reals), Some(reals));
        assert_eq!(domains.join(empty, reals), Some(reals));
        assert_eq!(domains.fits(Domains::BOOLEAN, Domains::INTEGER), None);
        assert!(!domains.compatible(Domains::NATURAL, Domains::INTEGER));
    }

    #[test]
    fn a_type_variable_takes_the_wider_of_its_domains() {
        let mut domains = Domains::new();
        let file = syntax::FileId(0);
        let span = syntax::Span { file, start: 0, end: 0 };
        let variable = domains.declare("D", DomainKind::Any, span);
        let of_variable = domains.powerset(variable);
        let empty = domains.powerset(Domains::UNDEF);
        let mut bindings = Bindings::default();
        assert!(domains.fit(empty, of_variable, &mut bindings).is_some());
        assert!(domains.fit(Domains::INTEGER, variable, &mut bindings).is_some());
        assert_eq!(domains.instantiate(of_variable, &bindings), domains.powerset(Domains::INTEGER));
    }
}
