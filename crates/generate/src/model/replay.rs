//! Writes runs as texts that generated code replays, and states as texts to compare: the model's side of
//! `machine/replay.hpp`.
//!
//! In: what a step read from the environment, and states of the machine. Out: the same words as the generated driver's,
//! so that two texts are equal if and only if the runs are. SYNC(replay)

use machine::{Location, TimeUnit, Value};
use program::{DomainKind, FunctionKind, Program, Rule, RuleId, Term};
use syntax::Span;

/// What a step reads from the environment.
#[derive(Debug, Default)]
pub struct Answers {
    /// Monitored and shared locations.
    pub inputs: Vec<(Location, Value)>,
    /// Choices: the choose rule, the candidate's number, the values of its variables.
    pub choices: Vec<(Span, usize, Vec<Value>)>,
    /// Readings of the clock.
    pub times: Vec<(TimeUnit, i64)>,
}

/// The answers, and the word that makes the step.
pub fn script(program: &Program, answers: &Answers) -> String {
    let mut out = String::new();
    for (location, value) in &answers.inputs {
        let name = &program.function(location.function).name;
        out.push_str(&format!("in {name} {} {}\n", arguments(location), encode(value)));
    }
    for (span, index, values) in &answers.choices {
        for (place, value) in values.iter().enumerate() {
            if is_drawn(program, *span, place) {
                out.push_str(&format!("number {}\n", encode(value)));
            }
        }
        out.push_str(&format!("choose {index}\n"));
    }
    for (unit, time) in &answers.times {
        out.push_str(&format!("time {} {time}\n", *unit as usize));
    }
    out.push_str("step\n");
    out
}

/// Whether the variable at this index is a drawn number, not an element of a range.
fn is_drawn(program: &Program, choose: Span, place: usize) -> bool {
    let rule = (0..program.rules.len()).map(|index| RuleId(index as u32)).find(|id| program.rule_span(*id) == choose);
    let Some(Rule::Choose { binders, .. }) = rule.map(|id| program.rule(id)) else { return false };
    let Some(binder) = program.binder_list(*binders).get(place) else { return false };
    match program.term(binder.range) {
        Term::Domain(domain) => {
            use model::Basic::{Integer, Natural, Real};
            matches!(program.domain(*domain).kind, DomainKind::Basic(Integer | Natural | Real))
        }
        _ => false,
    }
}

/// The locations of controlled, out and shared functions that have a value, one per line, sorted; those with an undef
/// argument begin with `? `. The last line is `.` with the names of functions that have initial values. For such a
/// function, whether a location with an undef argument already has its initial value cannot be told, so generated code
/// may have more of these locations.
pub fn state(program: &Program, locations: &[(Location, Value)]) -> String {
    let mut lines: Vec<String> = locations
        .iter()
        .filter(|(location, value)| {
            let function = program.function(location.function);
            let kind = matches!(function.kind, FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Shared);
            kind && Some(location.function) != program.self_function && !value.is_undef()
        })
        .map(|(location, value)| {
            let name = &program.function(location.function).name;
            let mark = if location.arguments.iter().any(Value::is_undef) { "? " } else { "" };
            format!("{mark}{name} {} {}\n", arguments(location), encode(value))
        })
        .collect();
    lines.sort();
    let mut late: Vec<&str> = program
        .initials
        .iter()
        .map(|initial| program.function(initial.function))
        .filter(|function| !function.parameters.is_empty())
        .map(|function| function.name.as_str())
        .collect();
    late.sort_unstable();
    late.dedup();
    lines.push(format!("{}\n", [&["."], late.as_slice()].concat().join(" ")));
    lines.concat()
}

fn arguments(location: &Location) -> String {
    encode(&Value::tuple(location.arguments.clone()))
}

/// A value as an exact text, without spaces outside of strings.
pub fn encode(value: &Value) -> String {
    let list = |open: char, items: &[Value], close: char| {
        let items: Vec<String> = items.iter().map(encode).collect();
        format!("{open}{}{close}", items.join(","))
    };
    let bits = |number: machine::Real| format!("{:016x}", number.get().to_bits());
    match value {
        Value::Undef => "u".to_string(),
        Value::Boolean(truth) => format!("b{}", u8::from(*truth)),
        Value::Integer(number) => format!("i{number}"),
        Value::Real(number) => format!("r{}", bits(*number)),
        Value::Enum(domain, index) => format!("e{}:{index}", domain.0),
        Value::Element(domain, number) => format!("o{}:{number}", domain.0),
        Value::Char(letter) => format!("c{}", *letter as u32),
        Value::Rule(procedure) => format!("p{}", procedure.0),
        Value::Complex(parts) => format!("z{}{}", bits(parts.0), bits(parts.1)),
        Value::String(text) => format!("s{}:{text}", text.len()),
        Value::Tuple(items) => list('(', items, ')'),
        Value::Seq(items) => list('[', items, ']'),
        Value::Set(items) => list('{', items, '}'),
        Value::Bag(counts) => {
            let items: Vec<String> = counts.iter().map(|(item, count)| format!("{}*{count}", encode(item))).collect();
            format!("<{}>", items.join(","))
        }
        // A key may itself be a map, so the empty map needs its own text.
        Value::Map(entries) if entries.is_empty() => "|-|".to_string(),
        Value::Map(entries) => {
            let items: Vec<String> =
                entries.iter().map(|(key, value)| format!("{}>{}", encode(key), encode(value))).collect();
            format!("|{}|", items.join(","))
        }
    }
}
