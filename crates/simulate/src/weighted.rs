//! Random inputs by weight: `--weight 'emergency=true:1,false:99'`, `--weight emergency=1%`, or `random:` in a file of inputs.
//!
//! In: for a function, or for one of its locations, values and how often each should come. Weights are compared with each other, and values
//! without one never come. Shares are parts of a hundred, and what they leave is shared evenly by the other values. A draw depends on seed,
//! step and location alone, like those of [`RandomSource`](crate::RandomSource).

use std::sync::Arc;

use machine::{Limits, LocationRef, Machine, Show, Value};
use program::{FunctionId, FunctionKind, Program};

use crate::constants::{read_input, split};
use crate::delayed::{Delay, Waitings};
use crate::draw::{Bounds, draw};
use crate::inputs::{Ask, Source};
use crate::read::{Written, read_written};
use crate::splitmix::{SplitMix, location_key_of};

/// The weight of all values together, where shares are given in percent with up to three decimals.
const WHOLE: u64 = 100_000;

/// LIMIT: so often a value is drawn anew that has a share of its own.
const TRIES: usize = 1_000;

/// How often values come, as it is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Often {
    /// The share of `true`: `1%`.
    True(String),
    /// Values, each with its weight or its share.
    Each(Vec<(Written, String)>),
    /// It becomes true after a number of steps: `after 0..16`.
    After(String),
}

/// What is wrong with weights, as a sentence for the user.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Misfit {
    /// The sentence.
    pub message: String,
    /// What it is about.
    pub place: Misplaced,
}

/// What a [`Misfit`] is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Misplaced {
    /// The location.
    Location,
    /// All values together.
    All,
    /// The value with this index, or how often it comes.
    Value(usize),
}

fn misfit(place: Misplaced, message: impl Into<String>) -> Misfit {
    Misfit { message: message.into(), place }
}

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

/// A share as it is written.
fn shown(share: u64) -> String {
    let (whole, part) = (share / 1_000, share % 1_000);
    match part {
        0 => format!("{whole} %"),
        _ => format!("{whole}.{} %", format!("{part:03}").trim_end_matches('0')),
    }
}

/// How often a value comes.
enum Amount {
    Weight(u64),
    Share(u64),
}

fn amount(text: &str) -> Result<Amount, String> {
    let text = text.trim();
    match text.strip_suffix('%') {
        Some(number) => share(number.trim()).map(Amount::Share).ok_or_else(|| {
            format!("`{text}` is no share: write a number from 0 to 100 with up to three decimals, as in 0.1%")
        }),
        None => match text.parse::<u32>() {
            Ok(weight) => Ok(Amount::Weight(u64::from(weight))),
            Err(_) => Err(format!("`{text}` is no weight: write a whole number, or a share such as 5%")),
        },
    }
}

/// Values and their weights.
#[derive(Debug, Clone, Default)]
pub struct Weighted {
    seed: u64,
    rules: Vec<Rule>,
    waitings: Waitings,
}

#[derive(Debug, Clone)]
struct Rule {
    function: FunctionId,
    /// None: all locations of the function.
    arguments: Option<Vec<Value>>,
    values: Vec<(Value, u64)>,
    /// It is true after so many steps, and has no weights.
    delay: Option<Delay>,
    /// The weight of all values together; what is left of it is for those without one.
    total: u64,
}

impl Weighted {
    /// Draws by a seed; no weights yet.
    pub fn new(seed: u64) -> Self {
        Weighted { seed, ..Weighted::default() }
    }

    /// The same weights, drawn by another seed.
    pub fn seeded(self, seed: u64) -> Self {
        Weighted { seed, ..self }
    }

    /// Whether there are no weights.
    pub fn is_empty(&self) -> bool {
        self.rules.is_empty()
    }

    /// Adds `location=value:weight,value:weight`; a function's name alone stands for all its locations. Weights may be shares instead:
    /// `mode=FAULT:1%` lets the other values share the rest, and `location=1%` is the share of `true`.
    ///
    /// # Errors
    /// A sentence for the user: no such input or value, no weight, or none above 0.
    pub fn add(&mut self, program: &Program, text: &str) -> Result<(), String> {
        let form =
            || format!("`{text}` is not of the form location=value:weight,value:weight, such as stop=true:1,false:99");
        let (location, values) = split(text).ok_or_else(form)?;
        let pair = |part: &str| {
            let (value, weight) = part.rsplit_once(':').ok_or_else(form)?;
            Ok((Written::Text(value.trim().to_string()), weight.trim().to_string()))
        };
        let parts = parts(values);
        let often = match &parts[..] {
            _ if Delay::read(values).is_some() => Often::After(values.to_string()),
            [share] if share.trim().ends_with('%') && !share.contains(':') => Often::True(share.trim().to_string()),
            parts => Often::Each(parts.iter().map(|part| pair(part)).collect::<Result<_, String>>()?),
        };
        self.set(program, location.trim(), &often).map_err(|misfit| misfit.message)
    }

    /// Adds how often the values of a location come, or those of all locations of a function.
    ///
    /// # Errors
    /// What does not fit the program, or what is wrong with the weights.
    pub fn set(&mut self, program: &Program, location: &str, often: &Often) -> Result<(), Misfit> {
        let takes = |kind| matches!(kind, FunctionKind::Monitored | FunctionKind::Shared);
        let named = program.functions.iter().position(|f| f.name == location && takes(f.kind) && !f.library);
        let (function, arguments) = match named {
            Some(index) => (FunctionId(index as u32), None),
            None => {
                let location = read_input(program, location).map_err(|told| misfit(Misplaced::Location, told))?;
                (location.function, Some(location.arguments))
            }
        };
        let is_boolean = || {
            let truth = Written::Text("true".to_string());
            matches!(read_written(program, program.function(function).codomain, &truth), Ok(Value::Boolean(_)))
        };
        let boolean;
        let mut delay = None;
        let each = match often {
            Often::Each(each) => each,
            Often::After(text) => {
                if !is_boolean() {
                    let message = format!(
                        "`{location}` is not Boolean: only what is true or false comes after a number of steps"
                    );
                    return Err(misfit(Misplaced::All, message));
                }
                let read = Delay::read(text).unwrap_or_else(|| Err(format!("`{text}` does not begin with `after`")));
                delay = Some(read.map_err(|told| misfit(Misplaced::All, told))?);
                &[][..]
            }
            Often::True(share) => {
                if !is_boolean() {
                    return Err(misfit(
                        Misplaced::All,
                        format!(
                            "`{location}` is not Boolean: give each value a weight, as in {location}=value:1,value:99"
                        ),
                    ));
                }
                boolean = [(Written::Text("true".to_string()), share.clone())];
                &boolean[..]
            }
        };
        let (values, total) = match delay {
            Some(_) => (Vec::new(), 0),
            None => weights(program, function, location, each)?,
        };
        let rule = Rule { function, arguments, values, delay, total };
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

type Weights = (Vec<(Value, u64)>, u64);

/// The weights of values, and the weight of all together.
fn weights(
    program: &Program,
    function: FunctionId,
    location: &str,
    each: &[(Written, String)],
) -> Result<Weights, Misfit> {
    let domain = program.function(function).codomain;
    let is_constant = program.constant_domains()[domain.0 as usize];
    let mut machine = is_constant.then(|| Machine::new(Arc::new(program.clone()), Limits::default()));
    let mut values: Vec<(Value, u64)> = Vec::new();
    let (mut weight, mut share) = (None, None);
    for (index, (value, often)) in each.iter().enumerate() {
        let here = |told: String| misfit(Misplaced::Value(index), told);
        let value = read_written(program, domain, value).map_err(here)?;
        if machine.as_mut().is_some_and(|machine| !machine.contains(domain, &value)) {
            return Err(here(format!("{} is not in {}", value.show(program), program.domain(domain).name)));
        }
        if values.iter().any(|(known, _)| *known == value) {
            return Err(here(format!("{} stands here twice", value.show(program))));
        }
        let (sum, part) = match amount(often).map_err(here)? {
            Amount::Weight(part) => (&mut weight, part),
            Amount::Share(part) => (&mut share, part),
        };
        *sum = Some(sum.unwrap_or(0) + part);
        values.push((value, part));
    }
    let all = |told: String| misfit(Misplaced::All, told);
    match (weight, share) {
        (Some(_), Some(_)) => Err(all("some are weights and some are shares: write all with %, or none".to_string())),
        (None, Some(share)) if share > WHOLE => {
            Err(all(format!("the shares of `{location}` are {} together, which is more than 100 %", shown(share))))
        }
        (None, Some(share)) => {
            let elements: Option<Vec<Value>> =
                machine.as_mut().filter(|_| share < WHOLE).and_then(|machine| machine.elements(domain).ok());
            let is_named = |element: &Value| values.iter().any(|(value, _)| value == element);
            match elements.is_some_and(|elements| elements.iter().all(is_named)) {
                true => Err(all(format!(
                    "the shares of `{location}` are {} together, and there is no other value for the rest",
                    shown(share)
                ))),
                false => Ok((values, WHOLE)),
            }
        }
        (None | Some(0), None) => Err(all("one weight at least is to be above 0".to_string())),
        (Some(weight), None) => Ok((values, weight)),
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
        if let Some(delay) = &rule.delay {
            // A rule is no part of the waitings.
            let delay = delay.clone();
            return Ok(Some(Value::Boolean(self.waitings.is_over(&delay, self.seed, ask.step, key))));
        }
        let mut stream = SplitMix::stream(self.seed, ask.step, key);
        let mut at = stream.below(rule.total);
        for (value, weight) in &rule.values {
            match at.checked_sub(*weight) {
                Some(rest) => at = rest,
                None => return Ok(Some(value.clone())),
            }
        }
        let has_share = |drawn: &Value| rule.values.iter().any(|(value, _)| value == drawn);
        for _ in 0..TRIES {
            let drawn = draw(ask.program, ask.carriers, &Bounds::default(), ask.codomain, &mut stream)?;
            if !has_share(&drawn) {
                return Ok(Some(drawn));
            }
        }
        Err(format!("{} has no other value than those with a share", ask.location.show(ask.program)))
    }
}

#[cfg(test)]
mod tests {
    use super::{parts, share, shown};

    #[test]
    fn shares_of_a_hundred() {
        let all = ["1", "0", "100", "0.1", "12.345", "100.001", "1.2345", "-1", "", ".5", "5.", "1e1", "101"];
        let expect = [Some(1_000), Some(0), Some(100_000), Some(100), Some(12_345)];
        for (at, text) in all.iter().enumerate() {
            assert_eq!(share(text), expect.get(at).copied().flatten(), "{text}");
        }
        assert_eq!([1_000, 12_345, 110_000, 500].map(shown), ["1 %", "12.345 %", "110 %", "0.5 %"]);
    }

    #[test]
    fn values_may_have_commas() {
        assert_eq!(parts("true:1,false:99"), ["true:1", "false:99"]);
        assert_eq!(parts("(1,2):1,\"a,b\":3,[4,5]:6"), ["(1,2):1", "\"a,b\":3", "[4,5]:6"]);
    }
}
