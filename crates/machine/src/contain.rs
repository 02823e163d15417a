//! Checks whether a value is in a domain. Every update is checked.
//!
//! In: a value, and a domain or the function to which it is written. Out: whether the domain contains the value in the
//! current state, including the elements that the running step makes.

use program::{DomainId, DomainKind, FunctionId};

use crate::execute::Executor;
use crate::membership::Membership;
use crate::value::Value;

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
                    // Fresh elements have rising numbers; most questions are about the newest.
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
