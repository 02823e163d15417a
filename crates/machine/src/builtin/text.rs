//! Strings and characters. Positions count characters (Unicode scalar values) from 0.

use std::sync::Arc;

use program::Builtin;

use super::{Result, Trouble};
use crate::value::{Real, Value};

pub(super) fn apply(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    let text = |index: usize| -> Result<&str> {
        if let Value::String(text) = &operands[index] { Ok(text.as_str()) } else { Err(Trouble::Undefined) }
    };
    Some(match builtin {
        Builtin::StringSize => text(0).map(|t| Value::Integer(t.chars().count() as i64)),
        Builtin::StringConcat => text(0).and_then(|a| Ok(Value::string(format!("{a}{}", text(1)?)))),
        Builtin::ToUpper => text(0).map(|t| Value::string(t.to_uppercase())),
        Builtin::ToLower => text(0).map(|t| Value::string(t.to_lowercase())),
        Builtin::StringContains => text(0).and_then(|a| Ok(Value::Boolean(a.contains(text(1)?)))),
        Builtin::SubString => text(0).and_then(|t| sub_string(t, &operands[1], &operands[2])),
        Builtin::Split => text(0).and_then(|a| Ok(split(a, text(1)?))),
        Builtin::ToInteger | Builtin::ToNatural => text(0).and_then(|t| {
            let parsed = t.trim().trim_end_matches('n').parse::<i64>().ok();
            let allowed = parsed.filter(|n| builtin == Builtin::ToInteger || *n >= 0);
            allowed.map(Value::Integer).ok_or_else(|| Trouble::Bad(format!("{t:?} is not written as such a number")))
        }),
        Builtin::ToReal => text(0).and_then(|t| {
            let parsed = t.trim().parse::<f64>().ok().filter(|x| x.is_finite()).and_then(Real::new);
            parsed.map(Value::Real).ok_or_else(|| Trouble::Bad(format!("{t:?} is not written as a Real")))
        }),
        Builtin::ToChar => text(0).and_then(|t| {
            let first = t.chars().next();
            first.map(Value::Char).ok_or_else(|| Trouble::Bad("the empty string has no first character".into()))
        }),
        Builtin::ToComplex => text(0).and_then(to_complex),
        _ => return None,
    })
}

fn sub_string(text: &str, from: &Value, to: &Value) -> Result {
    let (Value::Integer(from), Value::Integer(to)) = (from, to) else { return Err(Trouble::Undefined) };
    let length = text.chars().count() as i64;
    if *from < 0 || from > to || *to > length {
        return Err(Trouble::Bad(format!("characters {from} to {to} are outside a string of length {length}")));
    }
    Ok(Value::string(text.chars().skip(*from as usize).take((to - from) as usize).collect::<String>()))
}

fn split(text: &str, separator: &str) -> Value {
    if separator.is_empty() {
        return Value::seq(text.chars().map(|c| Value::string(c.to_string())).collect());
    }
    Value::seq(text.split(separator).map(Value::string).collect())
}

/// `a`, `ib`, `a+ib`, `a-ib`.
fn to_complex(text: &str) -> Result {
    let bad = || Trouble::Bad(format!("{text:?} is not written as a Complex"));
    let compact: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let (re, im) = match compact.find('i') {
        None => (compact.as_str(), None),
        Some(at) => {
            let (before, behind) = (&compact[..at], &compact[at + 1..]);
            let negative = before.ends_with('-');
            let re = before.strip_suffix(['+', '-']).unwrap_or(before);
            (re, Some((negative, behind)))
        }
    };
    let parse = |t: &str, default: f64| if t.is_empty() { Ok(default) } else { t.parse::<f64>().map_err(|_| bad()) };
    let real = parse(re, 0.0)?;
    let imaginary = match im {
        None => 0.0,
        Some((negative, digits)) => parse(digits, 1.0)? * if negative { -1.0 } else { 1.0 },
    };
    let parts = Real::new(real).zip(Real::new(imaginary)).ok_or_else(bad)?;
    Ok(Value::Complex(Arc::new(parts)))
}
