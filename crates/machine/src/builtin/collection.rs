//! Sets, bags and maps.

use std::collections::BTreeMap;
use std::sync::Arc;

use program::Builtin;

use super::{Result, Trouble, number};
use crate::value::Value;
use crate::weighed::Weighed;

pub(super) fn apply(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    set(builtin, operands).or_else(|| bag(builtin, operands)).or_else(|| map(builtin, operands))
}

fn elements(value: &Value) -> Result<&[Value]> {
    if let Value::Set(items) = value { Ok(items) } else { Err(Trouble::Undefined) }
}

fn difference(a: &[Value], b: &[Value]) -> Vec<Value> {
    a.iter().filter(|v| b.binary_search(v).is_err()).cloned().collect()
}

fn set(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    let one = |compute: fn(&[Value]) -> Value| elements(&operands[0]).map(compute);
    let two = |compute: fn(&[Value], &[Value]) -> Value| -> Result {
        Ok(compute(elements(&operands[0])?, elements(&operands[1])?))
    };
    let member = || elements(&operands[0]).map(|s| s.binary_search(&operands[1]).is_ok());
    Some(match builtin {
        Builtin::SetSize => one(|s| Value::Integer(s.len() as i64)),
        Builtin::SetIsEmpty => one(|s| Value::Boolean(s.is_empty())),
        Builtin::SetNotEmpty => one(|s| Value::Boolean(!s.is_empty())),
        Builtin::SetContains => member().map(Value::Boolean),
        Builtin::SetNotIn => member().map(|is_member| Value::Boolean(!is_member)),
        Builtin::AllIn => two(|a, b| Value::Boolean(a.iter().all(|v| b.binary_search(v).is_ok()))),
        Builtin::NotAllIn => two(|a, b| Value::Boolean(!a.iter().all(|v| b.binary_search(v).is_ok()))),
        Builtin::SetUnion => two(|a, b| Value::set([a, b].concat())),
        Builtin::SetIntersection => {
            two(|a, b| Value::sorted(a.iter().filter(|v| b.binary_search(v).is_ok()).cloned().collect()))
        }
        Builtin::SetDifference => two(|a, b| Value::sorted(difference(a, b))),
        Builtin::SymmetricDifference => two(|a, b| Value::set([difference(a, b), difference(b, a)].concat())),
        Builtin::SetIncluding => elements(&operands[0]).map(|s| match s.binary_search(&operands[1]) {
            Ok(_) => operands[0].clone(),
            Err(place) => Value::sorted([&s[..place], &operands[1..2], &s[place..]].concat()),
        }),
        Builtin::SetExcluding => {
            elements(&operands[0]).map(|s| Value::sorted(s.iter().filter(|v| **v != operands[1]).cloned().collect()))
        }
        Builtin::SetSum | Builtin::SeqSum | Builtin::BagSum => members(&operands[0]).and_then(|items| sum(&items)),
        Builtin::AsSequence => members(&operands[0]).map(Value::seq),
        Builtin::AsBag => members(&operands[0]).map(Value::bag),
        Builtin::AsSet => members(&operands[0]).map(Value::set),
        Builtin::NaturalRange => match (&operands[0], &operands[1]) {
            (Value::Integer(low), Value::Integer(high)) if high.saturating_sub(*low) > 100_000_000 => {
                Err(Trouble::Bad(format!("the range from {low} to {high} is too large")))
            }
            (Value::Integer(low), Value::Integer(high)) => {
                Ok(Value::sorted((*low..=*high).map(Value::Integer).collect()))
            }
            _ => Err(Trouble::Undefined),
        },
        _ => return None,
    })
}

/// Has the collection no members?
pub(super) fn is_empty(value: &Value) -> bool {
    match value {
        Value::Set(items) | Value::Seq(items) => items.is_empty(),
        Value::Bag(counts) => counts.is_empty(),
        _ => false,
    }
}

/// The members of any collection, in its order.
fn members(value: &Value) -> Result<Vec<Value>> {
    match value {
        Value::Set(items) | Value::Seq(items) => Ok(items.to_vec()),
        Value::Bag(counts) => {
            Ok(counts.iter().flat_map(|(v, n)| std::iter::repeat_n(v.clone(), *n as usize)).collect())
        }
        _ => Err(Trouble::Undefined),
    }
}

/// The sum of numbers of one kind; 0 of none.
fn sum(items: &[Value]) -> Result {
    let mut total = match items.first() {
        None => return Ok(Value::Integer(0)),
        Some(first) => first.clone(),
    };
    for item in &items[1..] {
        let add = match (&total, item) {
            (Value::Integer(_), Value::Integer(_)) => Builtin::IntAdd,
            (Value::Complex(_), _) | (_, Value::Complex(_)) => Builtin::ComplexAdd,
            _ => Builtin::RealAdd,
        };
        total = number::apply(add, &[total, item.clone()]).unwrap_or(Err(Trouble::Undefined))?;
    }
    match total {
        Value::Integer(_) | Value::Real(_) | Value::Complex(_) => Ok(total),
        _ => Err(Trouble::Undefined),
    }
}

type Counts = BTreeMap<Value, u64>;

/// A collection as a bag.
fn counts(value: &Value) -> Result<Counts> {
    match value {
        Value::Bag(counts) => Ok((***counts).clone()),
        Value::Set(items) => Ok(items.iter().map(|v| (v.clone(), 1)).collect()),
        _ => Err(Trouble::Undefined),
    }
}

fn bag(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    let combine = |both: fn(u64, u64) -> u64| -> Result<Counts> {
        let (a, b) = (counts(&operands[0])?, counts(&operands[1])?);
        let mut all = a.clone();
        all.extend(b.iter().map(|(v, n)| (v.clone(), *n)));
        let count = |of: &Counts, v: &Value| of.get(v).copied().unwrap_or(0);
        let combined = all.into_keys().map(|v| (both(count(&a, &v), count(&b, &v)), v));
        Ok(combined.filter(|(n, _)| *n > 0).map(|(n, v)| (v, n)).collect())
    };
    let adjusted = |adjust: fn(u64) -> u64| -> Result {
        let mut changed = counts(&operands[0])?;
        let count = adjust(changed.remove(&operands[1]).unwrap_or(0));
        if count > 0 {
            changed.insert(operands[1].clone(), count);
        }
        Ok(Value::Bag(Arc::new(Weighed::new(changed))))
    };
    let as_bag = |counts: Counts| Value::Bag(Arc::new(Weighed::new(counts)));
    Some(match builtin {
        Builtin::BagUnion | Builtin::SetBagUnion | Builtin::BagSetUnion => {
            combine(|a, b| a.saturating_add(b)).map(as_bag)
        }
        Builtin::BagIntersection => combine(u64::min).map(as_bag),
        // A set counts each element once; the result is of the first operand's kind.
        Builtin::BagSetIntersection => combine(u64::min).map(as_bag),
        Builtin::SetBagIntersection => combine(u64::min).map(|counts| Value::sorted(counts.into_keys().collect())),
        Builtin::BagContains => counts(&operands[0]).map(|b| Value::Boolean(b.contains_key(&operands[1]))),
        Builtin::BagCount => counts(&operands[0])
            .map(|b| Value::Integer(i64::try_from(b.get(&operands[1]).copied().unwrap_or(0)).unwrap_or(i64::MAX))),
        Builtin::BagSize => counts(&operands[0]).map(|b| {
            Value::Integer(b.values().fold(0i64, |sum, n| sum.saturating_add(i64::try_from(*n).unwrap_or(i64::MAX))))
        }),
        Builtin::BagIncluding => adjusted(|n| n.saturating_add(1)),
        Builtin::BagExcluding => adjusted(|n| n.saturating_sub(1)),
        _ => return None,
    })
}

fn map(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    let entries = |index: usize| -> Result<&BTreeMap<Value, Value>> {
        if let Value::Map(entries) = &operands[index] { Ok(entries) } else { Err(Trouble::Undefined) }
    };
    let changed = |entries: BTreeMap<Value, Value>| Value::Map(Arc::new(Weighed::new(entries)));
    Some(match builtin {
        Builtin::MapAt => entries(0).map(|m| m.get(&operands[1]).cloned().unwrap_or_default()),
        Builtin::MapSize => entries(0).map(|m| Value::Integer(m.len() as i64)),
        Builtin::MapKeys => entries(0).map(|m| Value::sorted(m.keys().cloned().collect())),
        Builtin::MapValues => entries(0).map(|m| Value::set(m.values().cloned().collect())),
        Builtin::MapAssign => entries(0).map(|m| {
            let mut next = m.clone();
            next.insert(operands[1].clone(), operands[2].clone());
            changed(next)
        }),
        // The second map's entries win.
        Builtin::MapMerge => entries(0).and_then(|a| {
            let mut next = a.clone();
            next.extend(entries(1)?.iter().map(|(k, v)| (k.clone(), v.clone())));
            Ok(changed(next))
        }),
        _ => return None,
    })
}
