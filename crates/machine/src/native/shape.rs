//! How a value lies in a register: the kinds of scalar, and what is known of one while translating.
//!
//! In: a domain of the program. Out: a [`Kind`], if its values fit a register. INVARIANT: a [`Scalar`] without a
//! flag is never undef; one with a range lies in it.

use cranelift_codegen::ir::{self, Type, types};
use model::Basic;
use program::{CollectionKind, DomainId, DomainKind, Program};

use crate::value::Value;

/// A kind of value that fits a register.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Boolean,
    Integer,
    Real,
    /// By its place among the literals.
    Enum(DomainId),
    /// By its number.
    Element(DomainId),
    Char,
    Rule,
}

impl Kind {
    /// The kind of a domain's values; none if they are compound or of several kinds.
    pub fn of(program: &Program, domain: DomainId) -> Option<Kind> {
        Some(match &program.domain(domain).kind {
            DomainKind::Basic(Basic::Boolean) => Kind::Boolean,
            DomainKind::Basic(Basic::Integer | Basic::Natural) => Kind::Integer,
            DomainKind::Basic(Basic::Real) => Kind::Real,
            DomainKind::Basic(Basic::Char) => Kind::Char,
            DomainKind::Enum { .. } => Kind::Enum(domain),
            DomainKind::Abstract { .. } => Kind::Element(domain),
            DomainKind::Concrete { base, .. } => return Kind::of(program, *base),
            DomainKind::Rule(_) => Kind::Rule,
            _ => return None,
        })
    }

    /// The tag of [`crate::Value`]: the place of the variant in its declaration (a test holds it to that).
    pub fn tag(self) -> i64 {
        match self {
            Kind::Boolean => 1,
            Kind::Integer => 2,
            Kind::Real => 3,
            Kind::Enum(_) => 4,
            Kind::Element(_) => 5,
            Kind::Char => 6,
            Kind::Rule => 7,
        }
    }

    /// Which bits of the second word of a value are written.
    pub fn mask(self) -> u64 {
        match self {
            Kind::Boolean => 0xff,
            Kind::Char | Kind::Rule => 0xffff_ffff,
            Kind::Integer | Kind::Real | Kind::Enum(_) | Kind::Element(_) => u64::MAX,
        }
    }

    /// The value of a number: an integer, or the place of a literal, an element, a truth value.
    pub fn value(self, number: i64) -> Value {
        match self {
            Kind::Boolean => Value::Boolean(number != 0),
            Kind::Enum(domain) => Value::Enum(domain, number as u32),
            Kind::Element(domain) => Value::Element(domain, number as u32),
            _ => Value::Integer(number),
        }
    }

    /// The number by which a register has a value of this kind; none of other values, and 0 of a real.
    pub fn number_of(self, value: &Value) -> Option<i64> {
        match (self, value) {
            (Kind::Boolean, Value::Boolean(truth)) => Some(i64::from(*truth)),
            (Kind::Integer, Value::Integer(number)) => Some(*number),
            (Kind::Real, Value::Real(_)) => Some(0),
            (Kind::Enum(domain), Value::Enum(of, number)) | (Kind::Element(domain), Value::Element(of, number)) => {
                (domain == *of).then_some(i64::from(*number))
            }
            (Kind::Char, Value::Char(c)) => Some(i64::from(u32::from(*c))),
            (Kind::Rule, Value::Rule(procedure)) => Some(i64::from(procedure.0)),
            _ => None,
        }
    }

    /// The type of its register.
    pub fn register(self) -> Type {
        match self {
            Kind::Boolean => types::I8,
            Kind::Real => types::F64,
            _ => types::I64,
        }
    }
}

/// A value in a register.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scalar {
    pub kind: Kind,
    pub value: ir::Value,
    /// Not zero where the value is defined; none if it always is.
    pub flag: Option<ir::Value>,
    /// Bounds of an integer, or of the number of an element or literal; both included.
    pub range: Option<(i64, i64)>,
}

impl Scalar {
    /// A value that is never undef.
    pub fn defined(kind: Kind, value: ir::Value) -> Scalar {
        Scalar { kind, value, flag: None, range: None }
    }

    /// The same, within bounds.
    pub fn within(self, low: i64, high: i64) -> Scalar {
        Scalar { range: Some((low, high)), ..self }
    }

    /// The bounds, those of the register where nothing is known.
    pub fn bounds(&self) -> (i64, i64) {
        self.range.unwrap_or((i64::MIN, i64::MAX))
    }

    /// Its one possible value.
    pub fn constant(&self) -> Option<i64> {
        self.range.filter(|(low, high)| low == high).map(|(low, _)| low)
    }
}

/// What a term was translated to.
#[derive(Debug, Clone, Copy)]
pub(super) enum Operand {
    /// The value undef.
    Undef,
    Scalar(Scalar),
    /// A pointer to a [`crate::Value`] that stays where it is until the statement ends.
    Boxed(ir::Value),
    /// The number of a location of the store, whose address changes when the store grows.
    Stored(ir::Value),
    /// A pointer to a kept value of a definition, which stays there as long as the state.
    Shelved(ir::Value),
    /// A collection that has not been made.
    Items(Items),
}

/// A set or a sequence as its items, all of which are scalars: where they stand one after the other until the rule ends.
/// INVARIANT: those of a set are sorted and distinct.
#[derive(Debug, Clone, Copy)]
pub(super) struct Items {
    pub start: ir::Value,
    pub count: ir::Value,
    pub kind: CollectionKind,
}

/// What a variable is bound to.
#[derive(Debug, Clone, Copy)]
pub(super) enum Bound {
    Scalar(Scalar),
    Boxed(ir::Value),
    Items(Items),
    Undef,
}

impl From<Bound> for Operand {
    fn from(bound: Bound) -> Operand {
        match bound {
            Bound::Scalar(scalar) => Operand::Scalar(scalar),
            Bound::Boxed(pointer) => Operand::Boxed(pointer),
            Bound::Items(items) => Operand::Items(items),
            Bound::Undef => Operand::Undef,
        }
    }
}

/// The bounds of values that are consecutive numbers of one kind: integers, or elements of one domain.
pub(super) fn consecutive(values: &[Value]) -> Option<(i64, i64)> {
    let number = |value: &Value| match value {
        Value::Integer(n) => Some(*n),
        Value::Element(_, n) | Value::Enum(_, n) => Some(i64::from(*n)),
        _ => None,
    };
    let (low, high) = (number(values.first()?)?, number(values.last()?)?);
    let gapless = i128::from(high) - i128::from(low) + 1 == values.len() as i128;
    gapless.then_some((low, high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::Real;

    /// The first word of a value, its tag.
    #[allow(unsafe_code)]
    fn words(value: &Value) -> [u64; 2] {
        // SAFETY: a value is two words, both written for the variants below save padding, which is not looked at.
        unsafe { *std::ptr::from_ref(value).cast::<[u64; 2]>() }
    }

    #[test]
    fn tags_are_those_of_values() {
        let domain = DomainId(7);
        let cases = [
            (Kind::Boolean, Value::Boolean(true), 1),
            (Kind::Integer, Value::Integer(-3), -3i64 as u64),
            (Kind::Real, Value::Real(Real::new(1.5).expect("a number")), 1.5f64.to_bits()),
            (Kind::Enum(domain), Value::Enum(domain, 9), 7 | 9 << 32),
            (Kind::Element(domain), Value::Element(domain, 9), 7 | 9 << 32),
            (Kind::Char, Value::Char('x'), u64::from('x')),
            (Kind::Rule, Value::Rule(program::ProcedureId(5)), 5),
        ];
        for (kind, value, payload) in cases {
            let [tag, word] = words(&value);
            assert_eq!(tag, kind.tag() as u64, "{value:?}");
            assert_eq!(word & kind.mask(), payload, "{value:?}");
        }
        assert_eq!(words(&Value::Undef)[0], 0);
    }
}
