//! Text → value, for inputs that are not model text: input files, `--set`, the prompt, traces.
//!
//! In: a domain and text as [`machine::Show`] would print it, or as people write it in YAML (an Integer where a
//! Real is meant, a string without quotes). Out: the value, or a sentence that says what was expected.
//! INVARIANT: what `Show` prints of a value of a domain reads back as that value.

use machine::{Location, Real, Value, element_name};
use program::{DomainId, DomainKind, FunctionKind, Program};

mod scan;

use scan::Scan;

/// A value as a data file has it: a scalar's text, a list, or a mapping.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Written {
    /// Any text that [`read_value`] reads.
    Text(String),
    /// A sequence, set, bag or tuple.
    List(Vec<Written>),
    /// A map.
    Entries(Vec<(Written, Written)>),
}

/// Reads a value of a domain.
///
/// # Errors
/// A sentence for the user: the text is not a value of the domain.
pub fn read_value(program: &Program, domain: DomainId, text: &str) -> Result<Value, String> {
    let trimmed = text.trim();
    if let Some(value) = read_bare(program, domain, trimmed) {
        return Ok(value);
    }
    let mut scan = Scan::new(program, trimmed);
    let read = scan.value(domain).and_then(|value| scan.end().map(|()| value));
    read.map_err(|()| expectation(program, domain, trimmed))
}

/// Reads a value of a domain from a data file's tree.
///
/// # Errors
/// A sentence for the user.
pub fn read_written(program: &Program, domain: DomainId, written: &Written) -> Result<Value, String> {
    let domain = type_domain(program, domain);
    let all = |of: DomainId, items: &[Written]| {
        items.iter().map(|item| read_written(program, of, item)).collect::<Result<Vec<_>, _>>()
    };
    match (written, &program.domain(domain).kind) {
        (Written::Text(text), _) => read_value(program, domain, text),
        (Written::List(items), DomainKind::Seq(of)) => Ok(Value::seq(all(*of, items)?)),
        (Written::List(items), DomainKind::Powerset(of)) => Ok(Value::set(all(*of, items)?)),
        (Written::List(items), DomainKind::Bag(of)) => Ok(Value::bag(all(*of, items)?)),
        (Written::List(items), DomainKind::Prod(parts)) if parts.len() == items.len() => {
            let read = items.iter().zip(parts).map(|(item, part)| read_written(program, *part, item));
            Ok(Value::tuple(read.collect::<Result<_, _>>()?))
        }
        (Written::Entries(entries), DomainKind::Map(key, of)) => {
            let read =
                entries.iter().map(|(k, v)| Ok((read_written(program, *key, k)?, read_written(program, *of, v)?)));
            Ok(Value::map(read.collect::<Result<Vec<_>, String>>()?))
        }
        _ => Err(expectation(program, domain, "this")),
    }
}

/// Reads a location of a dynamic function: `passed`, `temperature(ROOM1)`.
///
/// # Errors
/// A sentence for the user: no such function, or arguments outside its parameter domains.
pub fn read_location(program: &Program, text: &str) -> Result<Location, String> {
    let text = text.trim();
    let name = text.split('(').next().unwrap_or_default().trim();
    let mut problem = unknown(program, name);
    for (index, function) in program.functions.iter().enumerate().rev() {
        let dynamic = !matches!(function.kind, FunctionKind::Static | FunctionKind::Derived);
        if function.shown() != name {
            continue;
        }
        if !dynamic {
            problem = format!("`{name}` is not a location: its value is defined and cannot be given");
            continue;
        }
        let mut scan = Scan::new(program, text);
        let read = scan.arguments(&function.parameters);
        if let Ok(arguments) = read.and_then(|arguments| scan.end().map(|()| arguments)) {
            return Ok(Location { function: program::FunctionId(index as u32), arguments });
        }
        problem = if function.parameters.is_empty() {
            format!("`{text}` is not a location: `{name}` takes no arguments")
        } else {
            let domains: Vec<_> = function.parameters.iter().map(|d| program.domain(*d).name.as_str()).collect();
            format!("`{text}` is not a location: `{name}` takes arguments of {}", domains.join(", "))
        };
    }
    Err(problem)
}

fn unknown(program: &Program, name: &str) -> String {
    let close = program
        .functions
        .iter()
        .filter(|f| matches!(f.kind, FunctionKind::Monitored | FunctionKind::Shared) && !f.library)
        .map(|f| (strsim::levenshtein(name, &f.name), f.name.as_str()))
        .filter(|(distance, _)| *distance <= 2)
        .min();
    match close {
        Some((_, close)) => format!("the model has no function `{name}`; is `{close}` meant?"),
        None => format!("the model has no function `{name}`"),
    }
}

/// Strings and chars may lack quotes if they are the whole text.
fn read_bare(program: &Program, domain: DomainId, text: &str) -> Option<Value> {
    use model::Basic;
    match program.domain(type_domain(program, domain)).kind {
        DomainKind::Basic(Basic::String) if !text.starts_with('"') && text != "undef" => Some(Value::string(text)),
        DomainKind::Basic(Basic::Char) => {
            let mut chars = text.chars();
            match (chars.next(), chars.next()) {
                (Some(c), None) => Some(Value::Char(c)),
                _ => None,
            }
        }
        _ => None,
    }
}

pub(crate) fn type_domain(program: &Program, domain: DomainId) -> DomainId {
    match program.domain(domain).kind {
        DomainKind::Concrete { base, .. } => base,
        _ => domain,
    }
}

fn expectation(program: &Program, domain: DomainId, text: &str) -> String {
    let name = &program.domain(domain).name;
    let shown = if text.chars().count() > 40 {
        format!("{}…", text.chars().take(40).collect::<String>())
    } else {
        text.to_string()
    };
    match expected(program, domain) {
        Some(expected) => format!("`{shown}` is not a value of {name}: {expected} is expected"),
        None => format!("`{shown}` is not a value of {name}"),
    }
}

/// What a value of the domain looks like, for messages and prompts.
pub fn expected(program: &Program, domain: DomainId) -> Option<String> {
    use model::Basic;
    let list = |names: &[String]| match names {
        [] => None,
        [one] => Some(one.clone()),
        _ if names.len() > 12 => Some(format!("{}, … or {}", names[..10].join(", "), names[names.len() - 1])),
        [first @ .., last] => Some(format!("{} or {last}", first.join(", "))),
    };
    let simple = |text: &str| Some(text.to_string());
    match &program.domain(type_domain(program, domain)).kind {
        DomainKind::Enum { literals } => list(literals),
        DomainKind::Abstract { elements, .. } => list(elements),
        DomainKind::Basic(basic) => match basic {
            Basic::Boolean => simple("true or false"),
            Basic::Integer => simple("a whole number"),
            Basic::Natural => simple("a whole number from 0"),
            Basic::Real => simple("a number"),
            Basic::Complex => simple("a complex number such as 1.0+i2.0"),
            Basic::Char => simple("one character, such as 'a',"),
            Basic::String => simple("a text"),
            Basic::Undef => simple("undef"),
        },
        DomainKind::Prod(_) => simple("a tuple such as (1,2)"),
        DomainKind::Seq(_) => simple("a sequence such as [1,2]"),
        DomainKind::Powerset(_) => simple("a set such as {1,2}"),
        DomainKind::Bag(_) => simple("a bag such as <1,1,2>"),
        DomainKind::Map(..) => simple("a map such as {1->2}"),
        DomainKind::Rule(_) => simple("a rule such as <<r_x>>"),
        _ => None,
    }
}

/// The number of a named element of an abstract domain, or of one made by `extend`.
fn element(program: &Program, domain: DomainId, name: &str) -> Option<Value> {
    let DomainKind::Abstract { elements, .. } = &program.domain(domain).kind else { return None };
    if let Some(index) = elements.iter().position(|element| element == name) {
        return Some(Value::Element(domain, index as u32));
    }
    let number: u32 = name.rsplit_once('!')?.1.parse().ok()?;
    let index = number.checked_sub(1)?.checked_add(elements.len() as u32)?;
    (element_name(program, domain, index) == name).then_some(Value::Element(domain, index))
}

fn real(number: f64) -> Option<Value> {
    Real::new(number).map(Value::Real)
}
