//! Is a value in a domain? The check made when an update is.
//!
//! In: a domain. Out: a [`Membership`], which says what remains to be checked given that the value has the
//! domain's type (the model's checker has seen to that).

use program::{DomainId, DomainKind, FunctionId, Program};

use crate::execute::Executor;
use crate::value::Value;

/// What has to be checked of a value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Membership {
    /// Nothing: every value of the type is in it.
    Any,
    /// A Natural is not negative.
    Natural,
    /// A concrete domain of consecutive integers, both included.
    Between(i64, i64),
    /// Whatever [`Executor::contains`] says.
    Domain(DomainId),
}

/// What values of a domain have to be checked for.
pub(crate) fn membership(
    program: &Program,
    domain: DomainId,
    contents: &dyn Fn(DomainId) -> Option<Vec<Value>>,
) -> Membership {
    match &program.domain(domain).kind {
        DomainKind::Basic(model::Basic::Natural) => Membership::Natural,
        DomainKind::Concrete { dynamic: false, .. } => match contents(domain) {
            Some(elements) => consecutive(&elements).unwrap_or(Membership::Domain(domain)),
            None => Membership::Domain(domain),
        },
        DomainKind::Concrete { .. } => Membership::Domain(domain),
        // What is inside of tuples and collections is not looked at.
        _ => Membership::Any,
    }
}

fn consecutive(elements: &[Value]) -> Option<Membership> {
    let (Value::Integer(low), Value::Integer(high)) = (elements.first()?, elements.last()?) else { return None };
    let all = i128::from(*high) - i128::from(*low) + 1 == elements.len() as i128;
    all.then_some(Membership::Between(*low, *high))
}

impl Executor<'_> {
    /// Whether a value may be written to a function.
    #[inline]
    pub fn is_member(&mut self, function: FunctionId, value: &Value) -> bool {
        match (&self.core.codomains[function.0 as usize], value) {
            (Membership::Any, _) | (_, Value::Undef) => true,
            (Membership::Natural, Value::Integer(n)) => *n >= 0,
            (Membership::Between(low, high), Value::Integer(n)) => low <= n && n <= high,
            (Membership::Natural | Membership::Between(..), _) => false,
            (Membership::Domain(domain), _) => {
                let domain = *domain;
                self.contains(domain, value)
            }
        }
    }

    /// Whether a value is in a domain in the current state; undef is in every one.
    pub fn contains(&mut self, domain: DomainId, value: &Value) -> bool {
        use model::Basic;
        let program = self.program;
        match (&program.domain(domain).kind, value) {
            (_, Value::Undef) | (DomainKind::Any | DomainKind::Error, _) => true,
            (DomainKind::Basic(basic), value) => match (basic, value) {
                (Basic::Natural, Value::Integer(n)) => *n >= 0,
                (Basic::Integer, Value::Integer(_))
                | (Basic::Real, Value::Real(_))
                | (Basic::Complex, Value::Complex(_))
                | (Basic::Char, Value::Char(_))
                | (Basic::String, Value::String(_))
                | (Basic::Boolean, Value::Boolean(_)) => true,
                _ => false,
            },
            (DomainKind::Enum { .. }, Value::Enum(other, _)) => *other == domain,
            (DomainKind::Abstract { .. }, Value::Element(other, _)) => *other == domain,
            (DomainKind::Concrete { dynamic, .. }, value) => {
                if *dynamic {
                    if self.core.exploring {
                        self.note_carriers();
                    }
                    let carrier = &self.core.store.carriers[domain.0 as usize];
                    // Fresh elements have rising numbers; what is asked for is most often the newest.
                    let created = || self.core.updates.created().iter().rev().any(|(d, v)| *d == domain && v == value);
                    return carrier.elements.binary_search(value).is_ok()
                        || carrier.intermediate.binary_search(value).is_ok()
                        || created();
                }
                match &self.core.contents[domain.0 as usize] {
                    Some(elements) => elements.binary_search(value).is_ok(),
                    None => false,
                }
            }
            (DomainKind::Prod(parts), Value::Tuple(items)) => {
                parts.len() == items.len()
                    && parts.iter().zip(items.iter()).all(|(part, item)| self.contains(*part, item))
            }
            (DomainKind::Seq(of), Value::Seq(items)) | (DomainKind::Powerset(of), Value::Set(items)) => {
                items.iter().all(|item| self.contains(*of, item))
            }
            (DomainKind::Bag(of), Value::Bag(items)) => items.keys().all(|item| self.contains(*of, item)),
            (DomainKind::Map(key, of), Value::Map(items)) => {
                items.iter().all(|(k, v)| self.contains(*key, k) && self.contains(*of, v))
            }
            (DomainKind::Rule(parts), Value::Rule(procedure)) => {
                program.procedure(*procedure).parameters.len() == parts.len()
            }
            _ => false,
        }
    }
}
