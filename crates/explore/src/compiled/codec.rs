//! From the code of a field to its value and back, without a search where the values are consecutive.
//!
//! In: how the encoding lists the values of a function. Out: the same codes. INVARIANT: both ways agree with
//! [`Encoding::code`] and [`Encoding::value`] on every value and code.

use std::sync::Arc;

use machine::Value;
use program::DomainId;

use crate::packed::codes::Codes;
use crate::packed::collection::Collection;
use crate::packed::encoding::Encoding;
use crate::packed::interner::View;
use crate::packed::words::Field;

/// How the values of one field become codes. `undefined` is the code of undef, if it has one.
#[derive(Debug)]
pub(crate) enum Codec {
    /// Integers from `low` on.
    Integers { low: i64, count: u32, undefined: Option<u32> },
    /// False, then true.
    Booleans { undefined: Option<u32> },
    /// The literals of an enum domain, from the first on.
    Literals { domain: DomainId, count: u32, undefined: Option<u32> },
    /// In the order of this list.
    Listed { values: Arc<Vec<Value>>, undefined: Option<u32> },
    /// Sequences or sets, by their elements.
    InPlace(Collection),
    /// The number that an interner gives.
    Interned,
    /// That of the few values that a location has taken.
    Few { location: u32, bits: u8 },
}

impl Codec {
    /// That of a field.
    pub fn of(encoding: &Encoding, field: Field) -> Codec {
        if field.few {
            return Codec::Few { location: field.location, bits: field.bits };
        }
        let (values, undefined) = match &encoding.codes[field.function.0 as usize] {
            Some(Codes::Listed { values, undefined }) => (values, undefined),
            Some(Codes::InPlace(collection)) => return Codec::InPlace(collection.clone()),
            Some(Codes::Interned) | None => return Codec::Interned,
        };
        let count = values.len() as u32;
        let undefined = undefined.then_some(count);
        let consecutive = |matches: &dyn Fn(i64, &Value) -> bool| {
            !values.is_empty() && values.iter().enumerate().all(|(index, value)| matches(index as i64, value))
        };
        match values.first() {
            Some(Value::Integer(low)) if consecutive(&|index, value| *value == Value::Integer(low + index)) => {
                Codec::Integers { low: *low, count, undefined }
            }
            Some(Value::Boolean(false)) if values[..] == [Value::Boolean(false), Value::Boolean(true)] => {
                Codec::Booleans { undefined }
            }
            Some(Value::Enum(domain, 0))
                if consecutive(&|index, value| *value == Value::Enum(*domain, index as u32)) =>
            {
                Codec::Literals { domain: *domain, count, undefined }
            }
            _ => Codec::Listed { values: Arc::clone(values), undefined },
        }
    }

    /// The value of a code.
    #[inline]
    pub fn value(&self, code: u64, view: &mut View) -> Value {
        match self {
            Codec::Integers { low, count, .. } if code < u64::from(*count) => Value::Integer(low + code as i64),
            Codec::Booleans { .. } if code < 2 => Value::Boolean(code == 1),
            Codec::Literals { domain, count, .. } if code < u64::from(*count) => Value::Enum(*domain, code as u32),
            Codec::Integers { .. } | Codec::Booleans { .. } | Codec::Literals { .. } => Value::Undef,
            Codec::Listed { values, .. } => values.get(code as usize).cloned().unwrap_or(Value::Undef),
            Codec::InPlace(collection) => collection.value(code),
            Codec::Interned => view.value(code as u32).clone(),
            Codec::Few { location, .. } => view.few_value(*location, code).clone(),
        }
    }

    /// The code of a value; none where the field has none for it.
    #[inline]
    pub fn code(&self, value: &Value, view: &mut View) -> Option<u64> {
        match (self, value) {
            (Codec::Interned, _) => Some(u64::from(view.number(value))),
            (Codec::InPlace(collection), _) => collection.code(value).ok(),
            (Codec::Few { location, bits }, _) => view.few_code(*location, *bits, value),
            (
                Codec::Integers { undefined, .. }
                | Codec::Booleans { undefined }
                | Codec::Literals { undefined, .. }
                | Codec::Listed { undefined, .. },
                Value::Undef,
            ) => undefined.map(u64::from),
            (Codec::Integers { low, count, .. }, Value::Integer(number)) => {
                let code = u64::try_from(number.wrapping_sub(*low)).ok()?;
                (code < u64::from(*count)).then_some(code)
            }
            (Codec::Booleans { .. }, Value::Boolean(truth)) => Some(u64::from(*truth)),
            (Codec::Literals { domain, count, .. }, Value::Enum(of, literal)) => {
                (of == domain && literal < count).then_some(u64::from(*literal))
            }
            (Codec::Listed { values, .. }, _) => Some(values.binary_search(value).ok()? as u64),
            (Codec::Integers { .. } | Codec::Booleans { .. } | Codec::Literals { .. }, _) => None,
        }
    }
}
