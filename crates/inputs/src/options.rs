//! Options about inputs: ranges, times, fixed and weighted values, and which inputs a program asks for.
//!
//! In: texts as they are typed, and the program. Out: what `simulate` takes, or a sentence that says what to write instead.

use std::str::FromStr;

use program::{FunctionKind, Program, Term};
use simulate::{Constants, Weighted};

use crate::Refused;

fn range<T: FromStr + PartialOrd + Copy>(text: &str) -> Option<(T, T)> {
    let (low, high) = text.split_once("..")?;
    let (low, high) = (low.trim().parse().ok()?, high.trim().parse().ok()?);
    (low <= high).then_some((low, high))
}

/// A range of whole numbers, such as `-10..10`.
///
/// # Errors
/// It is none; a sentence for the user.
pub fn integers(text: &str) -> Result<(i64, i64), String> {
    range(text).ok_or_else(|| "write the lowest and the highest whole number, such as -10..10".to_string())
}

/// A range of numbers, such as `-1.5..1.5`.
///
/// # Errors
/// It is none; a sentence for the user.
pub fn reals(text: &str) -> Result<(f64, f64), String> {
    let finite = |(low, high): &(f64, f64)| low.abs() < 1e15 && high.abs() < 1e15;
    range(text).filter(finite).ok_or_else(|| "write the lowest and the highest number, such as -1.5..1.5".to_string())
}

/// The time that passes in a step, such as `10ms`.
///
/// # Errors
/// It is not a time; a sentence for the user, who may also write `system`.
pub fn step_ns(text: &str) -> Result<u64, String> {
    let digits = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let unit_ns: u64 = match unit {
        "ns" => 1,
        "us" => 1_000,
        "ms" => 1_000_000,
        "s" => 1_000_000_000,
        _ => return Err("write a time such as 100us, 10ms or 1s, or `system`".to_string()),
    };
    let number: u64 = number.parse().map_err(|_| "the time starts with a whole number".to_string())?;
    number.checked_mul(unit_ns).ok_or_else(|| "the time is too long".to_string())
}

/// Values that hold in every step, each as `LOCATION=VALUE`.
///
/// # Errors
/// The first that does not fit the program.
pub fn constants(program: &Program, texts: &[String]) -> Result<Constants, Refused> {
    let mut constants = Constants::default();
    for text in texts {
        constants.set(program, text).map_err(|reason| Refused::new(text, reason))?;
    }
    Ok(constants)
}

/// How often random values come, each as `LOCATION=VALUE:N,…`.
///
/// # Errors
/// The first that does not fit the program.
pub fn weighted(program: &Program, seed: u64, texts: &[String]) -> Result<Weighted, Refused> {
    let mut weighted = Weighted::new(seed);
    for text in texts {
        weighted.add(program, text).map_err(|reason| Refused::new(text, reason))?;
    }
    Ok(weighted)
}

/// The monitored functions that the program reads.
pub fn asked(program: &Program) -> Vec<String> {
    let mut read = vec![false; program.functions.len()];
    for term in &program.terms {
        if let Term::Read { function, .. } = term {
            read[function.0 as usize] = true;
        }
    }
    let functions = program.functions.iter().zip(read);
    functions
        .filter(|(function, read)| *read && function.kind == FunctionKind::Monitored && !function.library)
        .map(|(function, _)| function.name.clone())
        .collect()
}

/// A sentence that says that a program takes inputs although there is no source of them; none if it takes no inputs.
pub fn without_source(program: &Program) -> Option<String> {
    let asked = asked(program);
    let names = match asked.len() {
        0 => return None,
        1..=3 => asked.join(", "),
        all => format!("{}, {} and {} more", asked[0], asked[1], all - 2),
    };
    Some(format!("the model takes inputs ({names}), but nothing says where from"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges() {
        assert_eq!(integers("-10.. 10"), Ok((-10, 10)));
        assert!(integers("10..-10").is_err() && integers("1").is_err());
        assert_eq!(reals("-1.5..1.5"), Ok((-1.5, 1.5)));
        assert!(reals("0..1e300").is_err() && reals("NaN..1").is_err());
    }

    #[test]
    fn times() {
        assert_eq!(step_ns("100us"), Ok(100_000));
        assert!(step_ns("100").is_err() && step_ns("ms").is_err() && step_ns("99999999999999999999s").is_err());
    }
}
