//! Strings and chars, and values as text. Positions count characters from 0.

use model::{Domains, Model};

use super::Outcome;
use crate::fault::Fault;
use crate::print::show;
use crate::value::{Double, Value};

pub(super) fn apply(model: &Model, name: &str, values: &[Value]) -> Option<Outcome> {
    let string = |text: String| Some(Ok(Value::String(text)));
    let bad = || Fault::BadOperand(format!("{name} of {values:?}"));
    match (name, values) {
        // Printing is not the machine's task; the value is 1.
        ("print", _) => Some(Ok(Value::Integer(1))),
        ("toString", [Value::String(text)]) => string(text.clone()),
        ("toString", [Value::Char(char)]) => string(char.to_string()),
        ("toString", [value]) => string(show(model, value)),
        ("id", [agent @ Value::Element(..)]) => string(show(model, agent)),
        ("getAgent", [Value::String(name)]) => {
            let mut named = crate::element::named_elements(model);
            let found = named.find(|(function, domain, _)| {
                model.function(*function).name == *name && model.domains.type_domain(*domain) == Domains::AGENT
            });
            Some(Ok(found.map_or(Value::Undef, |(_, _, element)| element)))
        }
        ("getAgent", [Value::Undef]) => Some(Ok(Value::Undef)),
        ("size", [Value::String(text)]) => Some(Ok(Value::Integer(text.chars().count() as i64))),
        ("plus" | "concat", [Value::String(a), Value::String(b)]) => string(format!("{a}{b}")),
        ("toUpper", [Value::String(text)]) => string(text.to_uppercase()),
        ("toLower", [Value::String(text)]) => string(text.to_lowercase()),
        ("contains", [Value::String(a), Value::String(b)]) => Some(Ok(Value::Boolean(a.contains(b.as_str())))),
        ("subString", [Value::String(text), Value::Integer(from), Value::Integer(to)]) => {
            let chars: Vec<char> = text.chars().collect();
            let part = usize::try_from(*from).ok().zip(usize::try_from(*to).ok());
            let part = part.and_then(|(from, to)| chars.get(from..to));
            Some(part.map(|part| Value::String(part.iter().collect())).ok_or_else(bad))
        }
        ("split", [Value::String(text), Value::String(separator)]) if separator.is_empty() => {
            Some(Ok(Value::Seq(text.chars().map(|char| Value::String(char.to_string())).collect())))
        }
        ("split", [Value::String(text), Value::String(separator)]) => {
            Some(Ok(Value::Seq(text.split(separator.as_str()).map(|part| Value::String(part.to_string())).collect())))
        }
        ("toChar", [Value::String(text)]) => Some(text.chars().next().map(Value::Char).ok_or_else(bad)),
        ("toInteger" | "toNatural", [Value::String(text)]) => {
            let digits = text.trim();
            let number = digits.strip_suffix('n').unwrap_or(digits).parse().ok();
            let allowed = number.filter(|number: &i64| name == "toInteger" || *number >= 0);
            Some(allowed.map(Value::Integer).ok_or_else(bad))
        }
        ("toReal", [Value::String(text)]) => {
            let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite()).and_then(Double::new);
            Some(number.map(Value::Real).ok_or_else(bad))
        }
        _ => None,
    }
}
