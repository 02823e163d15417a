//! What must still be checked when a value is written to a function: see [`crate::contain`].
//!
//! In: a domain. Out: a [`Membership`], which says what must still be checked. The checker of models has already made sure
//! that the value has the domain's type.

use program::{DomainId, DomainKind, Program};

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
    /// Whatever `Executor::contains` says.
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
        // The members of tuples and collections are not checked.
        _ => Membership::Any,
    }
}

fn consecutive(elements: &[Value]) -> Option<Membership> {
    let (Value::Integer(low), Value::Integer(high)) = (elements.first()?, elements.last()?) else { return None };
    let all = i128::from(*high) - i128::from(*low) + 1 == elements.len() as i128;
    all.then_some(Membership::Between(*low, *high))
}
