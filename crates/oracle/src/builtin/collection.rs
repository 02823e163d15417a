//! Sets, bags and maps.

use std::collections::{BTreeMap, BTreeSet};

use model::{DomainId, Domains, Model};

use super::Outcome;
use crate::fault::Fault;
use crate::value::{Double, Value};

pub(super) fn apply(model: &Model, name: &str, domain: DomainId, values: &[Value]) -> Option<Outcome> {
    if let ("sum", [collection]) = (name, values) {
        return Some(sum(model, domain, &collection.elements()?));
    }
    let value =
        set(name, values).or_else(|| bag(name, values)).or_else(|| mixed(name, values)).or_else(|| map(name, values));
    value.map(Ok)
}

fn set(name: &str, values: &[Value]) -> Option<Value> {
    use Value::{Boolean, Integer, Set};
    Some(match (name, values) {
        ("size", [Set(a)]) => Integer(a.len() as i64),
        ("isEmpty", [Set(a)]) => Boolean(a.is_empty()),
        ("notEmpty", [Set(a)]) => Boolean(!a.is_empty()),
        ("contains", [Set(a), x]) => Boolean(a.contains(x)),
        ("notin", [Set(a), x]) => Boolean(!a.contains(x)),
        ("allin", [Set(a), Set(b)]) => Boolean(a.is_subset(b)),
        ("notallin", [Set(a), Set(b)]) => Boolean(!a.is_subset(b)),
        ("union", [Set(a), Set(b)]) => Set(a | b),
        ("intersection", [Set(a), Set(b)]) => Set(a & b),
        ("difference", [Set(a), Set(b)]) => Set(a - b),
        ("symmetricDifference", [Set(a), Set(b)]) => Set(a ^ b),
        ("including", [Set(a), x]) => Set(a | &[x.clone()].into()),
        ("excluding", [Set(a), x]) => Set(a - &[x.clone()].into()),
        ("asSequence", [a]) => Value::Seq(a.elements()?),
        ("asBag", [a]) => Value::bag(a.elements()?),
        ("asSet", [a]) => Set(a.elements()?.into_iter().collect()),
        _ => return None,
    })
}

type Counts = BTreeMap<Value, u64>;

/// The bag whose counts come from the counts of two bags.
fn together(a: &Counts, b: &Counts, how: fn(u64, u64) -> u64) -> Counts {
    let count = |of: &Counts, element: &Value| of.get(element).copied().unwrap_or(0);
    let counts = a.keys().chain(b.keys()).map(|element| (element.clone(), how(count(a, element), count(b, element))));
    counts.filter(|(_, count)| *count > 0).collect()
}

fn bag(name: &str, values: &[Value]) -> Option<Value> {
    use Value::{Bag, Boolean, Integer};
    let one = |element: &Value| Counts::from([(element.clone(), 1)]);
    Some(match (name, values) {
        ("size", [Bag(a)]) => Integer(a.values().sum::<u64>() as i64),
        ("contains", [Bag(a), x]) => Boolean(a.contains_key(x)),
        ("count", [Bag(a), x]) => Integer(a.get(x).copied().unwrap_or(0) as i64),
        ("union", [Bag(a), Bag(b)]) => Bag(together(a, b, |m, n| m + n)),
        ("intersection", [Bag(a), Bag(b)]) => Bag(together(a, b, u64::min)),
        ("including", [Bag(a), x]) => Bag(together(a, &one(x), |m, n| m + n)),
        // One occurrence goes.
        ("excluding", [Bag(a), x]) => Bag(together(a, &one(x), u64::saturating_sub)),
        _ => return None,
    })
}

/// A set and a bag: the set counts each element once. Their common part is of the first one's kind.
fn mixed(name: &str, values: &[Value]) -> Option<Value> {
    let as_bag = |set: &BTreeSet<Value>| set.iter().map(|element| (element.clone(), 1)).collect::<Counts>();
    Some(match (name, values) {
        ("union", [Value::Set(set), Value::Bag(bag)] | [Value::Bag(bag), Value::Set(set)]) => {
            Value::Bag(together(&as_bag(set), bag, |m, n| m + n))
        }
        ("intersection", [Value::Set(set), Value::Bag(bag)]) => {
            Value::Set(set.iter().filter(|element| bag.contains_key(element)).cloned().collect())
        }
        ("intersection", [Value::Bag(bag), Value::Set(set)]) => Value::Bag(together(bag, &as_bag(set), u64::min)),
        _ => return None,
    })
}

fn map(name: &str, values: &[Value]) -> Option<Value> {
    use Value::Map;
    let merged = |a: &BTreeMap<Value, Value>, b: BTreeMap<Value, Value>| Map(a.clone().into_iter().chain(b).collect());
    Some(match (name, values) {
        ("size", [Map(entries)]) => Value::Integer(entries.len() as i64),
        ("keys", [Map(entries)]) => Value::Set(entries.keys().cloned().collect()),
        ("values", [Map(entries)]) => Value::Set(entries.values().cloned().collect()),
        ("at", [Map(entries), key]) => entries.get(key).cloned().unwrap_or(Value::Undef),
        ("assign", [Map(entries), key, value]) => merged(entries, [(key.clone(), value.clone())].into()),
        ("merge", [Map(a), Map(b)]) => merged(a, b.clone()),
        _ => return None,
    })
}

/// The sum of numbers, from the least on; without numbers, the zero of the domain.
fn sum(model: &Model, domain: DomainId, elements: &[Value]) -> Outcome {
    let zero = Double::new(0.0).expect("a number");
    let mut total = match model.domains.type_domain(domain) {
        Domains::REAL => Value::Real(zero),
        Domains::COMPLEX => Value::Complex(zero, zero),
        _ => Value::Integer(0),
    };
    for element in elements {
        let number = matches!(element, Value::Integer(_) | Value::Real(_) | Value::Complex(..));
        total = match super::number::apply("plus", &[total, element.clone()]) {
            Some(sum) if number => sum?,
            _ => return Err(Fault::BadOperand("sum of what are not numbers".to_string())),
        };
    }
    Ok(total)
}
