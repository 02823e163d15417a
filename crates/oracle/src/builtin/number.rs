//! Numbers: Integer and Natural (64 bits, never wrapping), Real, Complex; order; conversions; ranges.

use super::Outcome;
use crate::fault::Fault;
use crate::value::{Double, Value};

pub(super) fn apply(name: &str, values: &[Value]) -> Option<Outcome> {
    match values {
        [Value::Integer(a)] => integer_unary(name, *a),
        [Value::Integer(a), Value::Integer(b)] => integer_binary(name, *a, *b),
        [Value::Real(a)] => real_unary(name, a.get()),
        [Value::Real(a), Value::Real(b)] => real_binary(name, a.get(), b.get()),
        [Value::Complex(re, im)] => complex_unary(name, re.get(), im.get()),
        [Value::Complex(a, b), Value::Complex(c, d)] => complex_binary(name, (a.get(), b.get()), (c.get(), d.get())),
        [Value::Char(a), Value::Char(b)] => order(name, a.cmp(b)),
        _ => None,
    }
}

fn order(name: &str, ordering: std::cmp::Ordering) -> Option<Outcome> {
    let holds = match name {
        "lt" => ordering.is_lt(),
        "le" => ordering.is_le(),
        "gt" => ordering.is_gt(),
        "ge" => ordering.is_ge(),
        _ => return None,
    };
    Some(Ok(Value::Boolean(holds)))
}

/// An Integer, unless the exact result is beyond 64 bits.
fn integer(exact: i128) -> Outcome {
    i64::try_from(exact).map(Value::Integer).map_err(|_| Fault::Overflow)
}

fn integer_unary(name: &str, a: i64) -> Option<Outcome> {
    let exact = i128::from(a);
    Some(match name {
        "plus" | "ntoi" => Ok(Value::Integer(a)),
        "minus" => integer(-exact),
        "abs" => integer(exact.abs()),
        "itor" | "ntor" => real(a as f64),
        "iton" => natural(a),
        _ => return None,
    })
}

fn natural(a: i64) -> Outcome {
    if a < 0 { Err(Fault::BadOperand(format!("{a} is no Natural"))) } else { Ok(Value::Integer(a)) }
}

fn integer_binary(name: &str, a: i64, b: i64) -> Option<Outcome> {
    let (x, y) = (i128::from(a), i128::from(b));
    Some(match name {
        "plus" => integer(x + y),
        "minus" => integer(x - y),
        "mult" => integer(x * y),
        "max" => integer(x.max(y)),
        "min" => integer(x.min(y)),
        "div" | "idiv" | "mod" if b == 0 => Err(Fault::DivisionByZero),
        "div" => real(a as f64 / b as f64),
        // Both truncate toward zero: a = idiv(a,b)·b + mod(a,b).
        "idiv" => integer(x / y),
        "mod" => integer(x % y),
        "pwr" => power(a, b),
        "range" if y - x > 100_000 => Err(Fault::Limit),
        "range" => Ok(Value::Set((a..=b).map(Value::Integer).collect())),
        _ => return order(name, a.cmp(&b)),
    })
}

/// The product of this many times the base.
fn power(base: i64, exponent: i64) -> Outcome {
    if exponent < 0 {
        return Err(Fault::BadOperand(format!("the exponent {exponent} is negative")));
    }
    match base {
        0 | 1 => return Ok(Value::Integer(if exponent == 0 { 1 } else { base })),
        -1 => return Ok(Value::Integer(if exponent % 2 == 0 { 1 } else { -1 })),
        _ => {}
    }
    let mut product = 1;
    for _ in 0..exponent {
        product *= i128::from(base);
        integer(product)?;
    }
    integer(product)
}

/// A Real, unless the result is not a number.
fn real(number: f64) -> Outcome {
    Double::new(number).map(Value::Real).ok_or(Fault::NotANumber)
}

/// A whole double as an Integer.
fn whole(number: f64) -> Outcome {
    if (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&number) {
        Ok(Value::Integer(number as i64))
    } else {
        Err(Fault::Overflow)
    }
}

fn real_unary(name: &str, a: f64) -> Option<Outcome> {
    Some(match name {
        "plus" => real(a),
        "minus" => real(-a),
        "abs" => real(a.abs()),
        "sqrt" => real(a.sqrt()),
        "floor" => whole(a.floor()),
        // To the nearest, halves up.
        "round" => whole(if a - a.floor() >= 0.5 { a.floor() + 1.0 } else { a.floor() }),
        "rtoi" => whole(a.trunc()),
        "rton" => whole(a.trunc()).and_then(|whole| match whole {
            Value::Integer(whole) => natural(whole),
            _ => Err(Fault::NotANumber),
        }),
        _ => return None,
    })
}

fn real_binary(name: &str, a: f64, b: f64) -> Option<Outcome> {
    Some(match name {
        "plus" => real(a + b),
        "minus" => real(a - b),
        "mult" => real(a * b),
        "div" if b == 0.0 => Err(Fault::DivisionByZero),
        "div" => real(a / b),
        "pwr" => real(a.powf(b)),
        "max" => real(if a < b { b } else { a }),
        "min" => real(if b < a { b } else { a }),
        _ => return order(name, a.partial_cmp(&b).expect("no NaN among the values")),
    })
}

fn complex(re: f64, im: f64) -> Outcome {
    match (Double::new(re), Double::new(im)) {
        (Some(re), Some(im)) => Ok(Value::Complex(re, im)),
        _ => Err(Fault::NotANumber),
    }
}

fn complex_unary(name: &str, re: f64, im: f64) -> Option<Outcome> {
    Some(match name {
        "re" => real(re),
        "im" => real(im),
        "minus" => complex(-re, -im),
        "norm" => complex(re.hypot(im), 0.0),
        "iszero" => Ok(Value::Boolean(re == 0.0 && im == 0.0)),
        _ => return None,
    })
}

fn complex_binary(name: &str, (a, b): (f64, f64), (c, d): (f64, f64)) -> Option<Outcome> {
    let scale = c * c + d * d;
    Some(match name {
        "plus" => complex(a + c, b + d),
        "minus" => complex(a - c, b - d),
        "mult" => complex(a * c - b * d, a * d + b * c),
        "div" if scale == 0.0 => Err(Fault::DivisionByZero),
        "div" => complex((a * c + b * d) / scale, (b * c - a * d) / scale),
        _ => return None,
    })
}

/// A value as an element of Real or Complex, into which its domain is embedded; undef stays undef.
pub(crate) fn coerce(value: Value, to_complex: bool) -> Value {
    let double = |number: i64| Double::new(number as f64).expect("an integer is a number");
    let zero = Double::new(0.0).expect("a number");
    match value {
        Value::Integer(number) if to_complex => Value::Complex(double(number), zero),
        Value::Real(number) if to_complex => Value::Complex(number, zero),
        Value::Integer(number) => Value::Real(double(number)),
        other => other,
    }
}

/// `low`, `low + step`, … up to and including `high`.
pub(crate) fn range(low: &Value, high: &Value, step: Option<&Value>, bound: usize) -> Result<Vec<Value>, Fault> {
    if low.is_undef() || high.is_undef() || step.is_some_and(Value::is_undef) {
        return Err(Fault::UndefinedOperand("range".to_string()));
    }
    let mut elements = Vec::new();
    match (low, high, step.unwrap_or(&Value::Integer(1))) {
        (Value::Integer(low), Value::Integer(high), Value::Integer(step)) => {
            let (mut next, high, step) = (i128::from(*low), i128::from(*high), i128::from(*step));
            positive(step > 0)?;
            while next <= high {
                elements.push(integer(next)?);
                next += step;
                bounded(&elements, bound)?;
            }
        }
        (Value::Real(low), Value::Real(high), step) => {
            let step = match step {
                Value::Real(step) => step.get(),
                Value::Integer(step) => *step as f64,
                _ => return Err(Fault::BadOperand("range".to_string())),
            };
            positive(step > 0.0)?;
            // As exact decimals: tenths added up to 0.3 are the double 0.3.
            let places = decimals(low.get()).max(decimals(high.get())).max(decimals(step));
            let (mut next, high, step) = (scaled(low.get(), places), scaled(high.get(), places), scaled(step, places));
            while next <= high {
                elements.push(real(format!("{next}e-{places}").parse().expect("a decimal number"))?);
                next += step;
                bounded(&elements, bound)?;
            }
        }
        _ => return Err(Fault::BadOperand("range".to_string())),
    }
    Ok(elements)
}

fn positive(holds: bool) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(Fault::BadOperand("the step of a range is not positive".to_string())) }
}

fn bounded(elements: &[Value], bound: usize) -> Result<(), Fault> {
    if elements.len() > bound { Err(Fault::Limit) } else { Ok(()) }
}

/// The number of decimals in the number's shortest notation.
fn decimals(number: f64) -> usize {
    number.to_string().split_once('.').map_or(0, |(_, decimals)| decimals.len())
}

/// number · 10^places, which is whole.
fn scaled(number: f64, places: usize) -> i128 {
    format!("{number:.places$}").replace('.', "").parse().expect("a decimal number")
}
