//! Sequences and tuples. Positions count from 0; outside of them is a fault.

use program::Builtin;

use super::{Result, Trouble};
use crate::value::Value;

pub(super) fn apply(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    let items = |index: usize| -> Result<&[Value]> {
        if let Value::Seq(items) = &operands[index] { Ok(items) } else { Err(Trouble::Undefined) }
    };
    Some(match builtin {
        Builtin::SeqLength => items(0).map(|s| Value::Integer(s.len() as i64)),
        Builtin::SeqIsEmpty => items(0).map(|s| Value::Boolean(s.is_empty())),
        Builtin::SeqContains => items(0).map(|s| Value::Boolean(s.contains(&operands[1]))),
        Builtin::SeqCount => items(0).map(|s| Value::Integer(s.iter().filter(|v| **v == operands[1]).count() as i64)),
        Builtin::SeqConcat => items(0).and_then(|a| Ok(Value::seq([a, items(1)?].concat()))),
        Builtin::Append => items(0).map(|s| Value::seq([s, &operands[1..2]].concat())),
        Builtin::Prepend => items(1).map(|s| Value::seq([&operands[0..1], s].concat())),
        Builtin::First => items(0).and_then(|s| s.first().cloned().ok_or_else(empty)),
        Builtin::Last => items(0).and_then(|s| s.last().cloned().ok_or_else(empty)),
        Builtin::Tail => items(0).and_then(|s| s.get(1..).map(|t| Value::seq(t.to_vec())).ok_or_else(empty)),
        Builtin::SeqAt => items(0).and_then(|s| at(s, &operands[1]).cloned()),
        Builtin::SeqIndexOf => items(0).map(|s| index_of(s, &operands[1])),
        Builtin::InsertAt => items(0).and_then(|s| {
            let position = position(&operands[1], s.len() + 1, s.len())?;
            let mut longer = s.to_vec();
            longer.insert(position, operands[2].clone());
            Ok(Value::seq(longer))
        }),
        Builtin::ReplaceAt => items(0).and_then(|s| {
            let position = position(&operands[1], s.len(), s.len())?;
            let mut changed = s.to_vec();
            changed[position] = operands[2].clone();
            Ok(Value::seq(changed))
        }),
        Builtin::SubSequence => items(0).and_then(|s| sub_sequence(s, &operands[1], &operands[2])),
        Builtin::SeqExcluding => items(0).map(|s| {
            let mut rest = s.to_vec();
            if let Some(position) = rest.iter().position(|v| *v == operands[1]) {
                rest.remove(position);
            }
            Value::seq(rest)
        }),
        Builtin::Component(index) => match &operands[0] {
            Value::Tuple(parts) => parts.get(index as usize).cloned().ok_or_else(|| {
                Trouble::Bad(format!("a tuple of {} components has no component {}", parts.len(), index + 1))
            }),
            _ => Err(Trouble::Undefined),
        },
        Builtin::TupleAt => match &operands[0] {
            Value::Tuple(parts) => at(parts, &operands[1]).cloned(),
            _ => Err(Trouble::Undefined),
        },
        Builtin::TupleIndexOf => match &operands[0] {
            Value::Tuple(parts) => Ok(index_of(parts, &operands[1])),
            _ => Err(Trouble::Undefined),
        },
        _ => return None,
    })
}

fn empty() -> Trouble {
    Trouble::Bad("an empty sequence has no first or last element".into())
}

fn at<'v>(items: &'v [Value], index: &Value) -> Result<&'v Value> {
    position(index, items.len(), items.len()).map(|position| &items[position])
}

fn index_of(items: &[Value], element: &Value) -> Value {
    Value::Integer(items.iter().position(|v| v == element).map_or(-1, |i| i as i64))
}

/// A position below `bound`.
fn position(index: &Value, bound: usize, length: usize) -> Result<usize> {
    let Value::Integer(index) = index else { return Err(Trouble::Undefined) };
    usize::try_from(*index)
        .ok()
        .filter(|position| *position < bound)
        .ok_or_else(|| Trouble::Bad(format!("index {index} is outside a sequence of length {length}")))
}

fn sub_sequence(items: &[Value], from: &Value, to: &Value) -> Result {
    let (Value::Integer(from), Value::Integer(to)) = (from, to) else { return Err(Trouble::Undefined) };
    let range = usize::try_from(*from).ok().zip(usize::try_from(*to).ok()).and_then(|(from, to)| items.get(from..to));
    range.map(|part| Value::seq(part.to_vec())).ok_or_else(|| {
        Trouble::Bad(format!("elements {from} to {to} are outside a sequence of length {}", items.len()))
    })
}
