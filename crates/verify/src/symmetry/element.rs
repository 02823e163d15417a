//! Elements that may be interchangeable, and why those of a domain are not.

use machine::Value;
use program::{DomainId, DomainKind, FunctionId, Program};
use syntax::Span;

/// Why the elements of a domain are not interchangeable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Distinct {
    /// An element is named here.
    Named(Span),
    /// An operation here tells elements apart, or shows an order of them.
    Told(Span),
    /// An input is tried with some of them.
    Bounded(FunctionId),
    /// Elements of some domain are made here, in an order.
    Extended(Span),
    /// A fault was met among them here, which may depend on their order.
    Ordered(Span),
    /// Each is in other subsets of the domain.
    Subsets,
    /// There are too many, or states are packed so that they cannot be permuted.
    Packed,
}

/// How many elements a domain may have that nothing tells apart.
pub fn count(program: &Program, domain: DomainId) -> usize {
    match &program.domain(domain).kind {
        // If it grows it is found to be extended.
        DomainKind::Abstract { elements, .. } => elements.len(),
        DomainKind::Enum { literals } => literals.len(),
        _ => 0,
    }
}

/// One of them.
pub fn element(program: &Program, domain: DomainId, index: u32) -> Value {
    match program.domain(domain).kind {
        DomainKind::Enum { .. } => Value::Enum(domain, index),
        _ => Value::Element(domain, index),
    }
}
