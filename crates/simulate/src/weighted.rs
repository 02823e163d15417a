//! Random inputs by weight: `--weight 'emergency=true:1,false:99'`, or `--weight emergency=1%`.
//!
//! In: for a function, or for one of its locations, values and how often each should come compared with the others.
//! Values that are not named never come. A draw depends on seed, step and location alone, like those of
//! [`RandomSource`](crate::RandomSource).

use machine::{LocationRef, Value};
use program::{FunctionId, FunctionKind, Program};

use crate::constants::{read_input, split};
use crate::inputs::{Ask, Source};
use crate::read::read_value;
use crate::splitmix::{SplitMix, location_key_of};

/// The weight of all values together, where one has a share in percent with up to three decimals.
const WHOLE: u64 = 100_000;

/// A share of [`WHOLE`] in percent.
fn share(text: &str) -> Option<u64> {
    let (whole, part) = text.split_once('.').unwrap_or((text, "0"));
    let is_number = |digits: &str| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    if !is_number(whole) || !is_number(part) || part.len() > 3 {
        return None;
    }
    let share = whole.parse::<u64>().ok()?.checked_mul(1_000)? + format!("{part:0<3}").parse::<u64>().ok()?;
    (share <= WHOLE).then_some(share)
}

/// Values and their weights.
#[derive(Debug, Clone)]
pub struct Weighted {
    seed: u64,
    rules: Vec<Rule>,
}

#[derive(Debug, Clone)]
struct Rule {
    function: FunctionId,
    /// None: all locations of the function.
    arguments: Option<Vec<Value>>,
    values: Vec<(Value, u64)>,
    total: u64,
}

impl Weighted {
    /// Draws by a seed; no weights yet.
    pub fn new(seed: u64) -> Self {
        Weighted { seed, rules: Vec::new() }
    }

    /// Adds `location=value:weight,value:weight`; a function's name alone stands for all its locations. A Boolean may have a share
    /// instead: `location=1%` is true in one of a hundred draws.
    ///
    /// # Errors
    /// A sentence for the user: no such input or value, no weight, or none above 0.
    pub fn add(&mut self, program: &Program, text: &str) -> Result<(), String> {
        let form =
            || format!("`{text}` is not of the form location=value:weight,value:weight, such as stop=true:1,false:99");
        let (location, values) = split(text).ok_or_else(form)?;
        let location = location.trim();
        let takes = |kind| matches!(kind, FunctionKind::Monitored | FunctionKind::Shared);
        let named = program.functions.iter().position(|f| f.name == location && takes(f.kind) && !f.library);
        let (function, arguments) = match named {
            Some(index) => (FunctionId(index as u32), None),
            None => {
                let location = read_input(program, location)?;
                (location.function, Some(location.arguments))
            }
        };
        let codomain = program.function(function).codomain;
        let mut rule = Rule { function, arguments, values: Vec::new(), total: 0 };
        if let Some(number) = values.trim().strip_suffix('%') {
            let is_true = share(number.trim()).ok_or_else(|| {
                format!(
                    "`{}` is no share: write a number from 0 to 100 with up to three decimals, as in 0.1%",
                    values.trim()
                )
            })?;
            for (value, weight) in [("true", is_true), ("false", WHOLE - is_true)] {
                let read = read_value(program, codomain, value).ok();
                let value = read.filter(|value| matches!(value, Value::Boolean(_))).ok_or_else(|| {
                    format!("`{location}` is not Boolean: give each value a weight, as in {location}=value:1,value:99")
                })?;
                rule.values.push((value, weight));
            }
            rule.total = WHOLE;
        }
        let listed = if rule.values.is_empty() { parts(values) } else { Vec::new() };
        for part in listed {
            let (value, weight) = part.rsplit_once(':').ok_or_else(form)?;
            let weight: u32 =
                weight.trim().parse().map_err(|_| format!("`{}` is no weight: write a whole number", weight.trim()))?;
            rule.values.push((read_value(program, codomain, value.trim())?, u64::from(weight)));
            rule.total += u64::from(weight);
        }
        if rule.total == 0 {
            return Err("one weight at least is to be above 0".to_string());
        }
        // One location's own weights come before those of its function.
        let at = if rule.arguments.is_some() { 0 } else { self.rules.len() };
        self.rules.insert(at, rule);
        Ok(())
    }

    fn rule(&self, location: LocationRef<'_>) -> Option<&Rule> {
        self.rules.iter().find(|rule| {
            let all = || rule.arguments.as_deref().is_none_or(|arguments| arguments == location.arguments);
            rule.function == location.function && all()
        })
    }
}

/// At the commas outside of brackets and quotes.
fn parts(text: &str) -> Vec<&str> {
    let (mut depth, mut quoted, mut from) = (0, false, 0);
    let mut parts = Vec::new();
    for (at, c) in text.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '(' | '[' | '{' | '<' if !quoted => depth += 1,
            ')' | ']' | '}' | '>' if !quoted => depth -= 1,
            ',' if !quoted && depth == 0 => {
                parts.push(&text[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[from..]);
    parts
}

impl Source for Weighted {
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String> {
        let Some(rule) = self.rule(ask.location) else { return Ok(None) };
        let name = &ask.program.function(ask.location.function).name;
        let key = location_key_of(name, ask.program, ask.location.arguments);
        let mut at = SplitMix::stream(self.seed, ask.step, key).below(rule.total);
        for (value, weight) in &rule.values {
            match at.checked_sub(*weight) {
                Some(rest) => at = rest,
                None => return Ok(Some(value.clone())),
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::{parts, share};

    #[test]
    fn shares_of_a_hundred() {
        let all = ["1", "0", "100", "0.1", "12.345", "100.001", "1.2345", "-1", "", ".5", "5.", "1e1", "101"];
        let expect = [Some(1_000), Some(0), Some(100_000), Some(100), Some(12_345)];
        for (at, text) in all.iter().enumerate() {
            assert_eq!(share(text), expect.get(at).copied().flatten(), "{text}");
        }
    }

    #[test]
    fn values_may_have_commas() {
        assert_eq!(parts("true:1,false:99"), ["true:1", "false:99"]);
        assert_eq!(parts("(1,2):1,\"a,b\":3,[4,5]:6"), ["(1,2):1", "\"a,b\":3", "[4,5]:6"]);
    }
}
