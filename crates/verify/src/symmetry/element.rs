//! Elements that may be interchangeable, and why a domain's elements are not.

use machine::Value;
use program::{DomainId, DomainKind, FunctionId, Program};
use syntax::Span;

/// Why the elements of a domain are not interchangeable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Distinct {
    /// The model names an element here.
    Named(Span),
    /// An operation here distinguishes elements, or reveals an order of them.
    Told(Span),
    /// Only some of them are tried for an input.
    Bounded(FunctionId),
    /// Elements of a domain are created here, in an order.
    Extended(Span),
    /// A fault occurred here, and which one may depend on the order of elements.
    Ordered(Span),
    /// They belong to different subsets of the domain.
    Subsets,
    /// There are too many, or packed states do not allow to permute them.
    Packed,
}

/// How many elements of a domain may be interchangeable.
pub fn count(program: &Program, domain: DomainId) -> usize {
    match &program.domain(domain).kind {
        // If the domain grows, it is reported as extended.
        DomainKind::Abstract { elements, .. } => elements.len(),
        DomainKind::Enum { literals } => literals.len(),
        _ => 0,
    }
}

/// An element, by index.
pub fn element(program: &Program, domain: DomainId, index: u32) -> Value {
    match program.domain(domain).kind {
        DomainKind::Enum { .. } => Value::Enum(domain, index),
        _ => Value::Element(domain, index),
    }
}
