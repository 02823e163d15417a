//! Values, as plain trees: the elements of the superuniverse (Börger & Stärk 2003, definition 2.4.1).
//!
//! The derived order is the canonical order of the language (spec/language.md): undef, truth values, integers,
//! reals, enum literals, elements, chars, rules, complex numbers, strings, tuples, sequences, sets, bags, maps;
//! compound values lexicographically. INVARIANT: no real is NaN or negative zero, no count of a bag is 0.
//!
//! Nothing here is shared with the machine: the two must agree because both are right.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use model::{DomainId, RuleId};

/// A double, totally ordered.
#[derive(Debug, Clone, Copy)]
pub struct Double(f64);

impl Double {
    /// The number; none for NaN.
    pub fn new(number: f64) -> Option<Double> {
        if number.is_nan() {
            None
        } else if number == 0.0 {
            Some(Double(0.0))
        } else {
            Some(Double(number))
        }
    }

    /// The number.
    pub fn get(self) -> f64 {
        self.0
    }
}

impl Ord for Double {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.partial_cmp(&other.0).expect("no NaN among the values")
    }
}

impl PartialOrd for Double {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Double {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Double {}

/// A value.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names are those of the language")]
pub enum Value {
    Undef,
    Boolean(bool),
    Integer(i64),
    Real(Double),
    /// Literal of an enum domain, by its place.
    Literal(DomainId, u32),
    /// Element of an abstract domain, in order of creation.
    Element(DomainId, u32),
    Char(char),
    Rule(RuleId),
    Complex(Double, Double),
    String(String),
    Tuple(Vec<Value>),
    Seq(Vec<Value>),
    Set(BTreeSet<Value>),
    /// How often each element occurs.
    Bag(BTreeMap<Value, u64>),
    Map(BTreeMap<Value, Value>),
}

impl Value {
    /// Is it `undef`?
    pub fn is_undef(&self) -> bool {
        *self == Value::Undef
    }

    /// A bag.
    pub fn bag(elements: impl IntoIterator<Item = Value>) -> Value {
        let mut counts = BTreeMap::new();
        for element in elements {
            *counts.entry(element).or_insert(0) += 1;
        }
        Value::Bag(counts)
    }

    /// The elements of a set, sequence or bag in canonical order, as they are ranged over; none for other values.
    pub fn elements(&self) -> Option<Vec<Value>> {
        match self {
            Value::Set(elements) => Some(elements.iter().cloned().collect()),
            Value::Seq(elements) => Some(elements.clone()),
            Value::Bag(counts) => {
                let each = counts.iter().flat_map(|(element, count)| (0..*count).map(move |_| element.clone()));
                Some(each.collect())
            }
            _ => None,
        }
    }
}
