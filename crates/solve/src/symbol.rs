//! Symbolic values: terms of a solver instead of the machine's values.
//!
//! A symbolic value is one of these: a known value; a number or an element, as a term with the condition under which it
//! is defined; a tuple of symbolic values; a set of them, each with the condition under which it is in the set.
//! Elements are encoded as numbers: enum literals and elements of abstract domains by their own numbers; strings and
//! other values that can only be compared, by their index in a list.

use machine::{Real, Value};
use program::DomainId;

use crate::session::Constant;
use crate::shared::{Kind, Node, Terms};

/// The kind of a term's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Shape {
    /// Truth values.
    Boolean,
    /// Integers.
    Integer,
    /// Real numbers.
    Real,
    /// Literals of an enum, by number.
    Enum(DomainId),
    /// Elements of an abstract domain, by number.
    Element(DomainId),
    /// Values that are only compared, by their index in [`Codes`].
    Coded,
}

impl Shape {
    /// The kind of its terms.
    pub fn kind(self) -> Kind {
        match self {
            Shape::Boolean => Kind::Boolean,
            Shape::Real => Kind::Real,
            _ => Kind::Integer,
        }
    }

    /// The shape of a value that is not undef.
    pub fn of(value: &Value) -> Shape {
        match value {
            Value::Boolean(_) => Shape::Boolean,
            Value::Integer(_) => Shape::Integer,
            Value::Real(number) if number.get().is_finite() => Shape::Real,
            Value::Enum(domain, _) => Shape::Enum(*domain),
            Value::Element(domain, _) => Shape::Element(*domain),
            _ => Shape::Coded,
        }
    }
}

/// A scalar, as a term.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Open {
    /// The shape of its values.
    pub shape: Shape,
    /// Its value, if it is defined.
    pub value: Node,
    /// The condition under which it is defined.
    pub defined: Node,
}

/// A value, known or symbolic.
#[derive(Debug, Clone, PartialEq)]
pub enum Symbol {
    /// A known value.
    Known(Value),
    /// A scalar that is not known.
    Open(Open),
    /// A tuple.
    Tuple(Vec<Symbol>),
    /// The possible elements of a set, each with the condition that it is in the set. INVARIANT: no two elements that
    /// are in the set are equal.
    Set(Vec<(Node, Symbol)>),
}

impl Symbol {
    /// Undef.
    pub const UNDEF: Symbol = Symbol::Known(Value::Undef);

    /// A truth value.
    pub fn boolean(value: Node) -> Symbol {
        match value {
            Terms::TRUE => Symbol::Known(Value::Boolean(true)),
            Terms::FALSE => Symbol::Known(Value::Boolean(false)),
            value => Symbol::Open(Open { shape: Shape::Boolean, value, defined: Terms::TRUE }),
        }
    }

    /// The value, if it is known.
    pub fn known(&self) -> Option<&Value> {
        match self {
            Symbol::Known(value) => Some(value),
            _ => None,
        }
    }
}

/// The list of values that are only compared.
#[derive(Debug, Default)]
pub struct Codes {
    values: Vec<Value>,
}

impl Codes {
    /// The code of a value.
    pub fn code(&mut self, value: &Value) -> i128 {
        let found = self.values.iter().position(|known| known == value);
        found.unwrap_or_else(|| {
            self.values.push(value.clone());
            self.values.len() - 1
        }) as i128
    }

    /// The values that have codes, in their order.
    pub fn values(&self) -> &[Value] {
        &self.values
    }

    /// The value of a code; for an unused code, a string that does not occur.
    pub fn value(&self, code: i128) -> Value {
        let known = usize::try_from(code).ok().and_then(|code| self.values.get(code));
        known.cloned().unwrap_or_else(|| {
            let fresh = (0..).map(|more| format!("text{code}{}", "_".repeat(more)));
            let mut fresh = fresh.map(Value::string).filter(|value| !self.values.contains(value));
            fresh.next().unwrap_or_default()
        })
    }
}

/// A value as a constant of its shape.
pub fn constant(terms: &mut Terms, codes: &mut Codes, value: &Value) -> Node {
    match value {
        Value::Boolean(truth) => terms.boolean(*truth),
        Value::Integer(number) => terms.integer(i128::from(*number)),
        Value::Real(number) if number.get().is_finite() => terms.real(number.get()),
        Value::Enum(_, index) | Value::Element(_, index) => terms.integer(i128::from(*index)),
        other => {
            let code = codes.code(other);
            terms.integer(code)
        }
    }
}

/// A constant as a value of this shape.
pub fn value_of(codes: &Codes, shape: Shape, constant: Constant) -> Option<Value> {
    Some(match (shape, constant) {
        (Shape::Boolean, Constant::Boolean(truth)) => Value::Boolean(truth),
        (Shape::Integer, Constant::Integer(number)) => Value::Integer(i64::try_from(number).ok()?),
        (Shape::Real, Constant::Real(number)) => Value::Real(Real::new(number)?),
        (Shape::Enum(domain), Constant::Integer(index)) => Value::Enum(domain, u32::try_from(index).ok()?),
        (Shape::Element(domain), Constant::Integer(index)) => Value::Element(domain, u32::try_from(index).ok()?),
        (Shape::Coded, Constant::Integer(code)) => codes.value(code),
        _ => return None,
    })
}
