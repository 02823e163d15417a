//! Values: the elements of the universes.
//!
//! A value is 16 bytes: small values are inline, compound ones are shared and immutable. INVARIANT: the elements of a set
//! are sorted and distinct; the keys of bags and maps are sorted by their tree; there is neither NaN nor negative zero, so
//! that equality is that of the derived order. CIRCLE(values): a value holds collections of values.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use program::{DomainId, ProcedureId};

use crate::weighed::{Items, Weighed, Weight};

/// A double without NaN and without negative zero, totally ordered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Real(f64);

impl Real {
    /// The number, unless it is NaN.
    pub fn new(number: f64) -> Option<Real> {
        // Adding zero turns -0.0 into 0.0.
        (!number.is_nan()).then_some(Real(number + 0.0))
    }

    /// The number.
    pub fn get(self) -> f64 {
        self.0
    }
}

impl Eq for Real {}

impl PartialOrd for Real {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Real {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl Hash for Real {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.to_bits().hash(state);
    }
}

/// A value. The derived order is the canonical one: of output, of state encoding, of search.
///
/// The tag is a whole word, so that a copy is two aligned moves whatever the variant.
#[repr(u64)]
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Value {
    /// The undefined value.
    #[default]
    Undef,
    /// A truth value.
    Boolean(bool),
    /// An Integer or a Natural.
    Integer(i64),
    /// A Real.
    Real(Real),
    /// A literal of an enum domain, by its place.
    Enum(DomainId, u32),
    /// An element of an abstract domain (the base, never a concrete one), by its number from 0.
    Element(DomainId, u32),
    /// A Char.
    Char(char),
    /// A rule.
    Rule(ProcedureId),
    /// A Complex: real and imaginary part.
    Complex(Arc<(Real, Real)>),
    /// A String.
    String(Arc<String>),
    /// A tuple.
    Tuple(Arc<Items>),
    /// A sequence.
    Seq(Arc<Items>),
    /// A set: sorted, distinct.
    Set(Arc<Items>),
    /// A bag: each element with how often it occurs, never 0.
    Bag(Arc<Weighed<BTreeMap<Value, u64>>>),
    /// A map.
    Map(Arc<Weighed<BTreeMap<Value, Value>>>),
}

impl Value {
    /// A string.
    pub fn string(text: impl Into<String>) -> Value {
        Value::String(Arc::new(text.into()))
    }

    /// A tuple.
    pub fn tuple(components: Vec<Value>) -> Value {
        Value::Tuple(Arc::new(Weighed::new(components)))
    }

    /// A sequence.
    pub fn seq(elements: Vec<Value>) -> Value {
        Value::Seq(Arc::new(Weighed::new(elements)))
    }

    /// The set of these elements, which may repeat and come in any order.
    pub fn set(mut elements: Vec<Value>) -> Value {
        elements.sort_unstable();
        elements.dedup();
        Value::sorted(elements)
    }

    /// The set of these elements, which are sorted and distinct.
    pub(crate) fn sorted(elements: Vec<Value>) -> Value {
        debug_assert!(elements.is_sorted_by(|a, b| a < b));
        Value::Set(Arc::new(Weighed::new(elements)))
    }

    /// The bag of these elements.
    pub fn bag(elements: impl IntoIterator<Item = Value>) -> Value {
        let mut counts = BTreeMap::new();
        for element in elements {
            *counts.entry(element).or_insert(0) += 1;
        }
        Value::Bag(Arc::new(Weighed::new(counts)))
    }

    /// The map of these entries; of equal keys the last counts.
    pub fn map(entries: impl IntoIterator<Item = (Value, Value)>) -> Value {
        Value::Map(Arc::new(Weighed::new(entries.into_iter().collect())))
    }

    /// How large it is with all that is shared in it unfolded.
    pub fn weight(&self) -> Weight {
        match self {
            Value::Tuple(items) | Value::Seq(items) | Value::Set(items) => items.weight(),
            Value::Bag(counts) => counts.weight(),
            Value::Map(entries) => entries.weight(),
            Value::String(text) => Weight { leaves: 1 + text.len() as u64 / 16, depth: 0 },
            _ => Weight::SCALAR,
        }
    }

    /// Whether it is complete in its two words, with nothing shared.
    #[inline]
    pub(crate) fn is_scalar(&self) -> bool {
        matches!(
            self,
            Value::Undef
                | Value::Boolean(_)
                | Value::Integer(_)
                | Value::Real(_)
                | Value::Enum(..)
                | Value::Element(..)
                | Value::Char(_)
                | Value::Rule(_)
        )
    }

    /// Is it `undef`?
    #[inline]
    pub fn is_undef(&self) -> bool {
        matches!(self, Value::Undef)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_two_words() {
        assert_eq!(std::mem::size_of::<Value>(), 16);
        assert_eq!(std::mem::size_of::<Result<Value, Box<crate::fault::Fault>>>(), 16);
    }

    #[test]
    fn sets_are_canonical() {
        let set = |numbers: &[i64]| Value::set(numbers.iter().map(|n| Value::Integer(*n)).collect());
        assert_eq!(set(&[3, 1, 2, 1]), set(&[1, 2, 3]));
    }

    #[test]
    fn zero_is_one() {
        assert_eq!(Real::new(-0.0), Real::new(0.0));
        assert_eq!(Real::new(f64::NAN), None);
    }
}
