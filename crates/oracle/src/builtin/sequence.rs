//! Sequences and products. Positions count from 0; a position outside is a fault.

use super::Outcome;
use crate::fault::Fault;
use crate::value::Value;

pub(super) fn apply(name: &str, values: &[Value]) -> Option<Outcome> {
    if let Some(component) = component(name, values) {
        return Some(Ok(component));
    }
    let outside = || Fault::BadOperand(format!("{name}: the position is outside"));
    let position = |value: &Value, below: usize| match value {
        Value::Integer(index) => usize::try_from(*index).ok().filter(|index| *index < below).ok_or_else(outside),
        _ => Err(outside()),
    };
    let index_of = |items: &[Value], wanted: &Value| {
        Value::Integer(items.iter().position(|item| item == wanted).map_or(-1, |index| index as i64))
    };
    Some(match (name, values) {
        ("length" | "size", [Value::Seq(items)]) => Ok(Value::Integer(items.len() as i64)),
        ("isEmpty", [Value::Seq(items)]) => Ok(Value::Boolean(items.is_empty())),
        ("contains", [Value::Seq(items), wanted]) => Ok(Value::Boolean(items.contains(wanted))),
        ("count", [Value::Seq(items), wanted]) => {
            Ok(Value::Integer(items.iter().filter(|item| *item == wanted).count() as i64))
        }
        ("at", [Value::Seq(items) | Value::Tuple(items), index]) => {
            position(index, items.len()).map(|index| items[index].clone())
        }
        ("indexOf", [Value::Seq(items) | Value::Tuple(items), wanted]) => Ok(index_of(items, wanted)),
        ("first", [Value::Seq(items)]) => items.first().cloned().ok_or_else(outside),
        ("last", [Value::Seq(items)]) => items.last().cloned().ok_or_else(outside),
        ("tail", [Value::Seq(items)]) => {
            items.split_first().map(|(_, tail)| Value::Seq(tail.to_vec())).ok_or_else(outside)
        }
        ("union", [Value::Seq(left), Value::Seq(right)]) => Ok(Value::Seq([left.as_slice(), right].concat())),
        ("append", [Value::Seq(items), last]) => {
            Ok(Value::Seq([items.as_slice(), std::slice::from_ref(last)].concat()))
        }
        ("prepend", [first, Value::Seq(items)]) => Ok(Value::Seq([std::slice::from_ref(first), items].concat())),
        ("insertAt", [Value::Seq(items), index, new]) => position(index, items.len() + 1).map(|index| {
            let (before, behind) = items.split_at(index);
            Value::Seq([before, std::slice::from_ref(new), behind].concat())
        }),
        ("replaceAt", [Value::Seq(items), index, new]) => position(index, items.len()).map(|index| {
            let mut changed = items.clone();
            changed[index] = new.clone();
            Value::Seq(changed)
        }),
        ("subSequence", [Value::Seq(items), from, to]) => position(from, items.len() + 1)
            .and_then(|from| Ok((from, position(to, items.len() + 1)?)))
            .and_then(|(from, to)| if from <= to { Ok(Value::Seq(items[from..to].to_vec())) } else { Err(outside()) }),
        ("excluding", [Value::Seq(items), unwanted]) => {
            let first = items.iter().position(|item| item == unwanted);
            let kept = items.iter().enumerate().filter(|(index, _)| Some(*index) != first);
            Ok(Value::Seq(kept.map(|(_, item)| item.clone()).collect()))
        }
        _ => return None,
    })
}

/// `first`, `second`, … of the components of a product, which are the arguments.
fn component(name: &str, values: &[Value]) -> Option<Value> {
    const NAMES: [&str; 9] = ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth"];
    let index = NAMES.iter().position(|known| *known == name)?;
    if values.len() < 2 { None } else { values.get(index).cloned() }
}
