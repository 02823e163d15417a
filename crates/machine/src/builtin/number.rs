//! Integer, Natural, Real, Complex: arithmetic, order, conversions. 64-bit integers never wrap.

use std::sync::Arc;

use program::Builtin;

use super::{Result, Trouble};
use crate::value::{Real, Value};

pub(super) fn apply(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    integer(builtin, operands)
        .or_else(|| real(builtin, operands))
        .or_else(|| complex(builtin, operands))
        .or_else(|| order(builtin, operands))
        .or_else(|| conversion(builtin, operands))
}

fn int(value: &Value) -> Result<i64> {
    if let Value::Integer(n) = value { Ok(*n) } else { Err(Trouble::Undefined) }
}

fn float(value: &Value) -> Result<f64> {
    match value {
        Value::Real(r) => Ok(r.get()),
        Value::Integer(n) => Ok(*n as f64),
        _ => Err(Trouble::Undefined),
    }
}

/// A Real, or the trouble of a result that is none.
fn number(result: f64, operation: impl FnOnce() -> String) -> Result {
    Real::new(result).map(Value::Real).ok_or_else(|| Trouble::NotANumber(operation()))
}

fn integer(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    let binary = |symbol: &str, checked: fn(i64, i64) -> Option<i64>| -> Result {
        let (a, b) = (int(&operands[0])?, int(&operands[1])?);
        checked(a, b).map(Value::Integer).ok_or_else(|| Trouble::Overflow(format!("{a} {symbol} {b}")))
    };
    let division = |symbol: &str, checked: fn(i64, i64) -> Option<i64>| -> Result {
        if int(&operands[1])? == 0 && int(&operands[0]).is_ok() {
            return Err(Trouble::Zero);
        }
        binary(symbol, checked)
    };
    let unary = |symbol: &str, checked: fn(i64) -> Option<i64>| -> Result {
        let a = int(&operands[0])?;
        checked(a).map(Value::Integer).ok_or_else(|| Trouble::Overflow(format!("{symbol}({a})")))
    };
    Some(match builtin {
        Builtin::IntNeg => unary("-", i64::checked_neg),
        Builtin::IntAbs => unary("abs", i64::checked_abs),
        Builtin::IntAdd => binary("+", i64::checked_add),
        Builtin::IntSub => binary("-", i64::checked_sub),
        Builtin::IntMul => binary("*", i64::checked_mul),
        Builtin::IntMin => binary("min", |a, b| Some(a.min(b))),
        Builtin::IntMax => binary("max", |a, b| Some(a.max(b))),
        // Both truncate toward zero, so that a = idiv(a,b)*b + mod(a,b).
        Builtin::IntQuotient => division("idiv", i64::checked_div),
        Builtin::IntMod => division("mod", |a, b| Some(a.wrapping_rem(b))),
        Builtin::IntPower => power(operands),
        Builtin::IntDiv => (|| {
            let (a, b) = (int(&operands[0])?, int(&operands[1])?);
            if b == 0 { Err(Trouble::Zero) } else { number(a as f64 / b as f64, || format!("{a} / {b}")) }
        })(),
        _ => return None,
    })
}

fn power(operands: &[Value]) -> Result {
    let (base, exponent) = (int(&operands[0])?, int(&operands[1])?);
    let Ok(exponent) = u32::try_from(exponent) else {
        return Err(Trouble::Bad(format!("the exponent {exponent} of an integer power is outside 0..2^32")));
    };
    base.checked_pow(exponent).map(Value::Integer).ok_or_else(|| Trouble::Overflow(format!("{base} ^ {exponent}")))
}

fn real(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    let binary = |symbol: &str, compute: fn(f64, f64) -> f64| -> Result {
        let (a, b) = (float(&operands[0])?, float(&operands[1])?);
        number(compute(a, b), || format!("{a:?} {symbol} {b:?}"))
    };
    let unary = |name: &str, compute: fn(f64) -> f64| -> Result {
        let a = float(&operands[0])?;
        number(compute(a), || format!("{name}({a:?})"))
    };
    Some(match builtin {
        Builtin::RealNeg => unary("-", |a| -a),
        Builtin::RealAbs => unary("abs", f64::abs),
        Builtin::Sqrt => unary("sqrt", f64::sqrt),
        Builtin::RealAdd => binary("+", |a, b| a + b),
        Builtin::RealSub => binary("-", |a, b| a - b),
        Builtin::RealMul => binary("*", |a, b| a * b),
        Builtin::RealMin => binary("min", f64::min),
        Builtin::RealMax => binary("max", f64::max),
        Builtin::RealPower => binary("^", f64::powf),
        Builtin::RealDiv => match float(&operands[1]) {
            Ok(0.0) if !operands[0].is_undef() => Err(Trouble::Zero),
            _ => binary("/", |a, b| a / b),
        },
        Builtin::Floor => whole("floor", operands, f64::floor),
        Builtin::Round => whole("round", operands, |x| x.floor() + f64::from(x - x.floor() >= 0.5)),
        _ => return None,
    })
}

/// A Real made whole, as an Integer.
fn whole(name: &str, operands: &[Value], compute: fn(f64) -> f64) -> Result {
    let x = float(&operands[0])?;
    let result = compute(x);
    // 2^63 is exact as a double; every double below it converts.
    if (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&result) {
        Ok(Value::Integer(result as i64))
    } else {
        Err(Trouble::Overflow(format!("{name}({x:?})")))
    }
}

fn complex(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    let parts = |value: &Value| -> Result<(f64, f64)> {
        match value {
            Value::Complex(parts) => Ok((parts.0.get(), parts.1.get())),
            other => Ok((float(other)?, 0.0)),
        }
    };
    let make = |re: f64, im: f64| -> Result {
        match (Real::new(re), Real::new(im)) {
            (Some(re), Some(im)) => Ok(Value::Complex(Arc::new((re, im)))),
            _ => Err(Trouble::NotANumber("the complex operation".into())),
        }
    };
    type Pair = (f64, f64);
    let binary = |compute: fn(Pair, Pair) -> Pair| -> Result {
        let (re, im) = compute(parts(&operands[0])?, parts(&operands[1])?);
        make(re, im)
    };
    Some(match builtin {
        Builtin::Re => parts(&operands[0]).and_then(|(re, _)| number(re, String::new)),
        Builtin::Im => parts(&operands[0]).and_then(|(_, im)| number(im, String::new)),
        Builtin::Norm => parts(&operands[0]).and_then(|(re, im)| make(re.hypot(im), 0.0)),
        Builtin::IsZero => parts(&operands[0]).map(|(re, im)| Value::Boolean(re == 0.0 && im == 0.0)),
        Builtin::ComplexNeg => parts(&operands[0]).and_then(|(re, im)| make(-re, -im)),
        Builtin::ComplexAdd => binary(|a, b| (a.0 + b.0, a.1 + b.1)),
        Builtin::ComplexSub => binary(|a, b| (a.0 - b.0, a.1 - b.1)),
        Builtin::ComplexMul => binary(|a, b| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)),
        Builtin::ComplexDiv => (|| {
            let (a, b) = (parts(&operands[0])?, parts(&operands[1])?);
            let scale = b.0 * b.0 + b.1 * b.1;
            if scale == 0.0 {
                return Err(Trouble::Zero);
            }
            make((a.0 * b.0 + a.1 * b.1) / scale, (a.1 * b.0 - a.0 * b.1) / scale)
        })(),
        _ => return None,
    })
}

fn order(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    use std::cmp::Ordering::{Equal, Greater, Less};
    let accepted: &[std::cmp::Ordering] = match builtin {
        Builtin::Lt => &[Less],
        Builtin::Le => &[Less, Equal],
        Builtin::Gt => &[Greater],
        Builtin::Ge => &[Greater, Equal],
        _ => return None,
    };
    let ordering = match (&operands[0], &operands[1]) {
        (Value::Integer(a), Value::Integer(b)) => Some(a.cmp(b)),
        (Value::Real(a), Value::Real(b)) => Some(a.cmp(b)),
        (Value::Char(a), Value::Char(b)) => Some(a.cmp(b)),
        (a, b) => float(a).ok().zip(float(b).ok()).and_then(|(a, b)| a.partial_cmp(&b)),
    };
    Some(ordering.map(|ordering| Value::Boolean(accepted.contains(&ordering))).ok_or(Trouble::Undefined))
}

fn conversion(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    let natural = |value: &Value| -> Result {
        match int(value)? {
            n if n < 0 => Err(Trouble::Bad(format!("{n} is negative, so it is no Natural"))),
            n => Ok(Value::Integer(n)),
        }
    };
    Some(match builtin {
        Builtin::RealToInt => whole("rtoi", operands, f64::trunc),
        Builtin::RealToNat => whole("rton", operands, f64::trunc).and_then(|value| natural(&value)),
        Builtin::IntToReal | Builtin::NatToReal => float(&operands[0]).and_then(|x| number(x, String::new)),
        Builtin::IntToNat => natural(&operands[0]),
        Builtin::NatToInt => int(&operands[0]).map(Value::Integer),
        _ => return None,
    })
}
