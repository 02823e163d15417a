//! Values and locations in the peer's way of writing, both ways.
//!
//! In: a value, or a text and the domain it is to be of. Out: the text, or the value. The peer writes strings and
//! characters without quotes, the elements of a set in the order of their texts, an element made by `extend` as
//! `dom!k` with only the first letter made small, a rule as `rule r_x(D1,D2)`, a double as Java does.
//! INVARIANT: equal values have equal texts, once [`normal`] is applied to the peer's.

use machine::{Location, Real, Value};
use model::Basic;
use program::{DomainId, DomainKind, Program};

/// The text of a value.
pub fn show(program: &Program, value: &Value) -> String {
    let all = |items: &[Value]| items.iter().map(|item| show(program, item)).collect::<Vec<_>>();
    match value {
        Value::Undef => "undef".to_string(),
        Value::Boolean(b) => b.to_string(),
        Value::Integer(n) => n.to_string(),
        Value::Real(real) => java_double(real.get()),
        Value::Enum(domain, index) => match &program.domain(*domain).kind {
            DomainKind::Enum { literals } => literals[*index as usize].clone(),
            _ => format!("?{index}"),
        },
        Value::Element(domain, index) => element(program, *domain, *index),
        Value::Char(c) => c.to_string(),
        Value::String(text) => text.to_string(),
        Value::Rule(procedure) => {
            let procedure = program.procedure(*procedure);
            let domains: Vec<_> = procedure.parameters.iter().map(|id| program.domain(*id).name.clone()).collect();
            format!("rule {}({})", procedure.name, domains.join(","))
        }
        Value::Complex(parts) => format!("{}+i{}", java_double(parts.0.get()), java_double(parts.1.get())),
        Value::Tuple(items) => format!("({})", all(items).join(",")),
        Value::Seq(items) => format!("[{}]", all(items).join(",")),
        Value::Set(items) => format!("{{{}}}", sorted(all(items)).join(",")),
        Value::Bag(items) => {
            let texts = items.iter().flat_map(|(item, count)| vec![show(program, item); *count as usize]);
            format!("<{}>", sorted(texts.collect()).join(","))
        }
        Value::Map(items) => {
            let entries = items.iter().map(|(key, value)| format!("{}->{}", show(program, key), show(program, value)));
            format!("{{{}}}", sorted(entries.collect()).join(","))
        }
    }
}

fn sorted(mut texts: Vec<String>) -> Vec<String> {
    texts.sort();
    texts
}

fn element(program: &Program, domain: DomainId, index: u32) -> String {
    let entry = program.domain(domain);
    let named = match &entry.kind {
        DomainKind::Abstract { elements, .. } => elements.as_slice(),
        _ => &[],
    };
    match named.get(index as usize) {
        Some(name) => name.clone(),
        None => format!("{}!{}", first_small(&entry.name), index as usize - named.len() + 1),
    }
}

fn first_small(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map(|first| first.to_lowercase().collect::<String>() + letters.as_str()).unwrap_or_default()
}

/// The text of a location.
pub fn location(program: &Program, location: &Location) -> String {
    let name = &program.function(location.function).name;
    if location.arguments.is_empty() {
        return name.clone();
    }
    let arguments: Vec<String> = location.arguments.iter().map(|argument| show(program, argument)).collect();
    format!("{name}({})", arguments.join(","))
}

/// The location that a text names: the last declared function whose parameters the arguments fit.
pub fn location_of(program: &Program, text: &str) -> Option<Location> {
    let (name, arguments) = match text.split_once('(') {
        Some((name, rest)) => (name, parts(rest.strip_suffix(')')?)),
        None => (text, Vec::new()),
    };
    program.functions.iter().enumerate().rev().find_map(|(index, function)| {
        if function.name != name || function.parameters.len() != arguments.len() {
            return None;
        }
        let values = function.parameters.iter().zip(&arguments).map(|(domain, text)| value(program, *domain, text));
        Some(Location { function: program::FunctionId(index as u32), arguments: values.collect::<Option<_>>()? })
    })
}

/// A double as Java's `Double.toString` writes it, without the sign of a negative zero.
pub fn java_double(number: f64) -> String {
    if number == 0.0 {
        return "0.0".to_string();
    }
    if number.is_infinite() {
        return if number > 0.0 { "Infinity" } else { "-Infinity" }.to_string();
    }
    if (1e-3..1e7).contains(&number.abs()) {
        return format!("{number:?}");
    }
    let text = format!("{number:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let point = if digits.contains('.') { "" } else { ".0" };
    format!("{digits}{point}E{exponent}")
}

/// A text of the peer in the form that is compared: no negative zero.
pub fn normal(text: &str) -> String {
    text.split_inclusive([',', '(', '[', '{', '>', ')', ']', '}'])
        .map(|part| match part.strip_prefix("-0.0") {
            Some(rest) if rest.is_empty() || !rest.starts_with(|c: char| c.is_ascii_digit() || c == 'E') => {
                format!("0.0{rest}")
            }
            _ => part.to_string(),
        })
        .collect()
}

/// The value that a text means as an element of a domain.
pub fn value(program: &Program, domain: DomainId, text: &str) -> Option<Value> {
    if text == "undef" {
        return Some(Value::Undef);
    }
    let items = |of: DomainId, open: char, close: char| -> Option<Vec<Value>> {
        parts(text.strip_prefix(open)?.strip_suffix(close)?).into_iter().map(|part| value(program, of, part)).collect()
    };
    match &program.domain(domain).kind {
        DomainKind::Basic(basic) => basic_value(*basic, text),
        DomainKind::Enum { literals } => {
            let index = literals.iter().position(|literal| literal == text)?;
            Some(Value::Enum(domain, index as u32))
        }
        DomainKind::Abstract { elements, .. } => {
            if let Some(index) = elements.iter().position(|name| name == text) {
                return Some(Value::Element(domain, index as u32));
            }
            let (_, number) = text.rsplit_once('!')?;
            Some(Value::Element(domain, number.parse::<u32>().ok()?.checked_sub(1)? + elements.len() as u32))
        }
        DomainKind::Concrete { base, .. } => value(program, *base, text),
        DomainKind::Prod(domains) => {
            let texts = parts(text.strip_prefix('(')?.strip_suffix(')')?);
            if texts.len() != domains.len() {
                return None;
            }
            domains
                .iter()
                .zip(texts)
                .map(|(domain, text)| value(program, *domain, text))
                .collect::<Option<_>>()
                .map(Value::tuple)
        }
        DomainKind::Seq(of) => items(*of, '[', ']').map(Value::seq),
        DomainKind::Powerset(of) => items(*of, '{', '}').map(Value::set),
        DomainKind::Bag(of) => items(*of, '<', '>').map(Value::bag),
        _ => None,
    }
}

fn basic_value(basic: Basic, text: &str) -> Option<Value> {
    match basic {
        Basic::Boolean => text.parse().ok().map(Value::Boolean),
        Basic::Integer | Basic::Natural => text.parse().ok().map(Value::Integer),
        Basic::Real => text.parse().ok().and_then(Real::new).map(Value::Real),
        Basic::String => Some(Value::string(text)),
        Basic::Char => text.chars().next().map(Value::Char),
        Basic::Complex | Basic::Undef => None,
    }
}

/// The parts between the commas that stand in no brackets.
pub fn parts(text: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let (mut depth, mut start) = (0, 0);
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    if !text.is_empty() {
        parts.push(&text[start..]);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_are_written_as_java_does() {
        let check = |number: f64, expect: &str| assert_eq!(java_double(number), expect);
        check(1.0, "1.0");
        check(-0.0, "0.0");
        check(1e12, "1.0E12");
        check(1.25e-7, "1.25E-7");
        check(9_999_999.5, "9999999.5");
    }

    #[test]
    fn negative_zeros_are_normalised() {
        assert_eq!(normal("(-0.0,-0.05,{-0.0})"), "(0.0,-0.05,{0.0})");
        assert_eq!(normal("-0.0"), "0.0");
        assert_eq!(normal("-0.0E5"), "-0.0E5");
    }

    #[test]
    fn nested_commas_do_not_part() {
        assert_eq!(parts("a,(b,c),[d,{e,f}]"), ["a", "(b,c)", "[d,{e,f}]"]);
        assert!(parts("").is_empty());
    }
}
