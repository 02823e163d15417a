//! The C++ types of domains and of generated expressions.
//!
//! Scalars are typed: truth values, numbers, characters, literals of enum domains, elements of abstract ones. All other
//! values, including strings and collections, have the dynamic type `Value`.

use model::Basic;
use program::{DomainId, DomainKind, Program};

/// The type of an expression, apart from whether it may be undef.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Type {
    /// `undef` itself, of any domain.
    Undef,
    Boolean,
    /// Integer and Natural.
    Integer,
    Real,
    Char,
    Enum(DomainId),
    /// An element of an abstract domain, namely the base domain.
    Element(DomainId),
    /// A sequence over a small domain of literals or elements.
    List(DomainId),
    /// Everything else.
    Value,
}

/// The type of a domain's values.
pub(crate) fn type_of(program: &Program, domain: DomainId) -> Type {
    let base = program.base_domain(domain);
    match &program.domain(base).kind {
        DomainKind::Basic(Basic::Boolean) => Type::Boolean,
        DomainKind::Basic(Basic::Integer | Basic::Natural) => Type::Integer,
        DomainKind::Basic(Basic::Real) => Type::Real,
        DomainKind::Basic(Basic::Char) => Type::Char,
        DomainKind::Basic(Basic::Undef) => Type::Undef,
        DomainKind::Enum { .. } => Type::Enum(base),
        DomainKind::Abstract { .. } => Type::Element(base),
        _ => Type::Value,
    }
}

/// LIMIT: a list has one byte per item, and one of its values stands for undef.
const MOST_IN_LISTS: usize = 255;

/// The type of a function's or term's value: that of its domain, with lists.
pub(crate) fn result_type(program: &Program, domain: DomainId) -> Type {
    let DomainKind::Seq(of) = &program.domain(domain).kind else { return type_of(program, domain) };
    match ordinals(program, *of) {
        Some(1..=MOST_IN_LISTS) => Type::List(program.base_domain(*of)),
        _ => Type::Value,
    }
}

/// The number of values of an enum domain, or of an abstract one that does not grow.
pub(crate) fn ordinals(program: &Program, domain: DomainId) -> Option<usize> {
    match &program.domain(program.base_domain(domain)).kind {
        DomainKind::Enum { literals } => Some(literals.len()),
        DomainKind::Abstract { elements, dynamic: false } => Some(elements.len()),
        _ => None,
    }
}

/// The type of a list's items.
pub(crate) fn item_type(program: &Program, domain: DomainId) -> Type {
    type_of(program, domain)
}
