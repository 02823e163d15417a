//! The standard library as functions on values (spec/standard-library.md): the static part of every state.
//!
//! In: a library function and the values of its arguments; those that must not be undef are not undef. Out: a value, or
//! a fault if the function has none. A name may stand for several functions; the kinds of the values select one.

mod collection;
mod number;
mod sequence;
mod text;

use model::{DomainId, Function, Model};

use crate::fault::Fault;
use crate::value::Value;

pub(crate) use number::{coerce, range};

/// What a library function gives.
pub(crate) type Outcome = Result<Value, Fault>;

/// The value of a library function; `domain` is that of the term.
pub(crate) fn apply(model: &Model, function: &Function, domain: DomainId, values: &[Value]) -> Outcome {
    let name = function.name.as_str();
    if matches!(name, "eq" | "neq" | "equality" | "isDef" | "isUndef" | "not" | "xor" | "iff") {
        return Ok(logical(name, values));
    }
    let found = text::apply(model, name, values)
        .or_else(|| number::apply(name, values))
        .or_else(|| sequence::apply(name, values))
        .or_else(|| collection::apply(model, name, domain, values));
    found.unwrap_or_else(|| Err(Fault::BadOperand(format!("{name} of {values:?}"))))
}

fn logical(name: &str, values: &[Value]) -> Value {
    use Value::Boolean;
    match (name, values) {
        ("eq" | "equality", [a, b]) => Boolean(a == b),
        ("neq", [a, b]) => Boolean(a != b),
        ("isDef", [a]) => Boolean(*a != Value::Undef),
        ("isUndef", [a]) => Boolean(*a == Value::Undef),
        ("not", [Boolean(a)]) => Boolean(!a),
        ("xor", [Boolean(a), Boolean(b)]) => Boolean(a != b),
        ("iff", [Boolean(a), Boolean(b)]) => Boolean(a == b),
        _ => Value::Undef,
    }
}

/// The value of a connective that its left operand alone decides.
pub(crate) fn decided_by_left(name: &str, left: &Value) -> Option<Value> {
    match (name, left) {
        ("and", Value::Boolean(false)) => Some(Value::Boolean(false)),
        ("or" | "implies", Value::Boolean(left)) if *left == (name == "or") => Some(Value::Boolean(true)),
        _ => None,
    }
}

/// Kleene's strong three-valued `and`, `or` and `implies`.
pub(crate) fn connective(name: &str, left: &Value, right: &Value) -> Value {
    use Value::{Boolean, Undef};
    let negated = match left {
        Boolean(truth) => Boolean(!truth),
        _ => Undef,
    };
    match name {
        "and" => match (left, right) {
            (Boolean(false), _) | (_, Boolean(false)) => Boolean(false),
            (Boolean(true), Boolean(true)) => Boolean(true),
            _ => Undef,
        },
        "or" => match (left, right) {
            (Boolean(true), _) | (_, Boolean(true)) => Boolean(true),
            (Boolean(false), Boolean(false)) => Boolean(false),
            _ => Undef,
        },
        // φ ⇒ ψ is ¬φ ∨ ψ.
        _ => connective("or", &negated, right),
    }
}
