//! The machine's values and locations as the oracle's, and back.

use machine::Real;
use oracle::{Double, Symbol, Value};
use program::{ProcedureId, Program};

/// The machine's value as the oracle's.
pub fn value(program: &Program, from: &machine::Value) -> Value {
    let list = |items: &[machine::Value]| items.iter().map(|item| value(program, item)).collect::<Vec<_>>();
    let double = |real: Real| Double::new(real.get()).expect("no value of the machine is NaN");
    match from {
        machine::Value::Undef => Value::Undef,
        machine::Value::Boolean(truth) => Value::Boolean(*truth),
        machine::Value::Integer(number) => Value::Integer(*number),
        machine::Value::Real(number) => Value::Real(double(*number)),
        machine::Value::Enum(domain, place) => Value::Literal(*domain, *place),
        machine::Value::Element(domain, number) => Value::Element(*domain, *number),
        machine::Value::Char(char) => Value::Char(*char),
        machine::Value::Rule(procedure) => Value::Rule(program.procedure(*procedure).rule.expect("a declared rule")),
        machine::Value::Complex(parts) => Value::Complex(double(parts.0), double(parts.1)),
        machine::Value::String(text) => Value::String(text.to_string()),
        machine::Value::Tuple(items) => Value::Tuple(list(items)),
        machine::Value::Seq(items) => Value::Seq(list(items)),
        machine::Value::Set(items) => {
            assert!(
                items.windows(2).all(|pair| pair[0] < pair[1]),
                "a set's elements are sorted and distinct: {items:?}"
            );
            Value::Set(list(items).into_iter().collect())
        }
        machine::Value::Bag(items) => {
            Value::Bag(items.iter().map(|(item, count)| (value(program, item), *count)).collect())
        }
        machine::Value::Map(items) => {
            Value::Map(items.iter().map(|(key, item)| (value(program, key), value(program, item))).collect())
        }
    }
}

/// The oracle's value as the machine's.
pub fn back(program: &Program, from: &Value) -> machine::Value {
    let list = |items: &mut dyn Iterator<Item = &Value>| items.map(|item| back(program, item)).collect::<Vec<_>>();
    let real = |number: Double| Real::new(number.get()).expect("no value of the oracle is NaN");
    match from {
        Value::Undef => machine::Value::Undef,
        Value::Boolean(truth) => machine::Value::Boolean(*truth),
        Value::Integer(number) => machine::Value::Integer(*number),
        Value::Real(number) => machine::Value::Real(real(*number)),
        Value::Literal(domain, place) => machine::Value::Enum(*domain, *place),
        Value::Element(domain, number) => machine::Value::Element(*domain, *number),
        Value::Char(char) => machine::Value::Char(*char),
        Value::Rule(rule) => {
            let place = program.procedures.iter().position(|procedure| procedure.rule == Some(*rule));
            machine::Value::Rule(ProcedureId(place.expect("a rule of the program") as u32))
        }
        Value::Complex(re, im) => machine::Value::Complex(std::sync::Arc::new((real(*re), real(*im)))),
        Value::String(text) => machine::Value::string(text.as_str()),
        Value::Tuple(items) => machine::Value::tuple(list(&mut items.iter())),
        Value::Seq(items) => machine::Value::seq(list(&mut items.iter())),
        Value::Set(items) => machine::Value::set(list(&mut items.iter())),
        Value::Bag(_) => machine::Value::bag(list(&mut from.elements().unwrap_or_default().iter())),
        Value::Map(items) => {
            machine::Value::map(items.iter().map(|(key, item)| (back(program, key), back(program, item))))
        }
    }
}

/// The machine's location as the oracle's.
pub fn location(program: &Program, from: &machine::Location) -> oracle::Location {
    let arguments = from.arguments.iter().map(|argument| value(program, argument)).collect();
    oracle::Location { symbol: Symbol::Function(from.function), arguments }
}

/// The oracle's location as the machine's; none for the characteristic function of a domain.
pub fn location_back(program: &Program, from: &oracle::Location) -> Option<machine::Location> {
    let Symbol::Function(function) = from.symbol else { return None };
    let arguments = from.arguments.iter().map(|argument| back(program, argument)).collect();
    Some(machine::Location { function, arguments })
}
