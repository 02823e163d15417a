//! Derives a report specification from a model that has none of its own.
//!
//! In: the program, and the chart beside it, if there is one. Out: the text of a specification, like one written by hand: a lane for
//! each location that takes values of an enumeration, Booleans or named elements, a curve for each that takes numbers, and the chart's
//! machines. What cannot be listed, or is too much to look at, is left out; the note says so.

use std::fmt::Write;
use std::sync::Arc;

use chart::{Chart, subjects};
use machine::{Limits, Machine, Show, Value};
use model::Basic;
use program::{DomainId, DomainKind, Function, FunctionKind, Program};
use report::Tone;

/// LIMIT: lanes of one function; a function with more locations is left out.
const LOCATIONS: usize = 16;
/// LIMIT: lanes in all.
const LANES: usize = 40;
/// LIMIT: curves in all.
const CURVES: usize = 12;

/// How the values of a function are shown.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shown {
    Lane,
    Curve,
}

/// The specification of a model's run; `chart` is the chart beside it, and its file's name.
pub fn model_specification(program: &Arc<Program>, chart: Option<(&Chart, &str)>) -> String {
    let mut machine = Machine::new(Arc::clone(program), Limits::default());
    let (mut lanes, mut curves) = (Vec::new(), Vec::new());
    // Functions that are left out: there is no picture of such values, or there would be too many.
    let (mut unlike, mut left) = (Vec::new(), Vec::new());
    let mut enums: Vec<DomainId> = Vec::new();
    for function in program.functions.iter().filter(|function| is_state(function)) {
        let Some(shown) = shown(program, function.codomain) else {
            unlike.push(function.name.as_str());
            continue;
        };
        let (group, most) = match shown {
            Shown::Lane => (&mut lanes, LANES),
            Shown::Curve => (&mut curves, CURVES),
        };
        match locations(&mut machine, function) {
            Some(found) if group.len() + found.len() <= most => {
                group.extend(found);
                enums.extend(enumeration(program, function.codomain).filter(|domain| !enums.contains(domain)));
            }
            _ => left.push(function.name.as_str()),
        }
    }
    let mut out = String::new();
    let mut note = "The functions of the model that take few values, and its integers.".to_string();
    for (names, why) in
        [(&left, "there would be too many lanes or curves"), (&unlike, "neither a lane nor a curve shows such values")]
    {
        if !names.is_empty() {
            let _ = write!(note, " Left out, since {why}: {}.", names.join(", "));
        }
    }
    let _ = writeln!(out, "note: {}", quoted(&note));
    out.push_str("activities:\n  \"false\": [\"false\", idle]\n  \"true\": [\"true\", work]\n");
    // A literal has the same colour whenever it is first seen in a run: by its place among all of them.
    let literals = enums.iter().filter_map(|domain| literals(program, *domain)).flatten();
    for (place, literal) in literals.enumerate() {
        let words = literal.to_lowercase().replace('_', " ");
        let _ = writeln!(out, "  {}: [{}, {}]", quoted(literal), quoted(&words), Tone::by_order(place).name());
    }
    if !lanes.is_empty() {
        out.push_str("tasks:\n  each:\n");
        for lane in &lanes {
            let _ = writeln!(out, "    {}: {{ name: {} }}", quoted(lane), quoted(lane));
        }
        out.push_str("  terms:\n    activity: \"{}\"\n");
    }
    if !curves.is_empty() {
        out.push_str("series:\n");
        for curve in &curves {
            let _ = writeln!(out, "  {}: {{ value: {} }}", quoted(curve), quoted(curve));
        }
    }
    if let Some((chart, file)) = chart {
        // What a machine with a parameter stands for is said by nobody.
        let mut machines = subjects(chart).map(|subject| subject.machine()).peekable();
        let some = machines.peek().is_some();
        if some && machines.all(|machine| machine.is_some_and(|machine| machine.parameters.is_empty())) {
            let _ = writeln!(out, "charts: {{ {}: {{}} }}", quoted(file));
        }
    }
    out
}

/// Its values are part of the state, and the model writes them.
fn is_state(function: &Function) -> bool {
    // What the model's own file does not see has no name in a specification.
    function.seen
        && !function.library
        && matches!(function.kind, FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Shared)
}

fn shown(program: &Program, domain: DomainId) -> Option<Shown> {
    match &program.domain(domain).kind {
        DomainKind::Basic(Basic::Boolean) | DomainKind::Enum { .. } => Some(Shown::Lane),
        DomainKind::Basic(Basic::Integer | Basic::Natural) => Some(Shown::Curve),
        DomainKind::Abstract { elements, .. } => (!elements.is_empty()).then_some(Shown::Lane),
        DomainKind::Concrete { base, .. } => shown(program, *base),
        DomainKind::Error
        | DomainKind::Any
        | DomainKind::Basic(Basic::Complex | Basic::Real | Basic::Char | Basic::String | Basic::Undef)
        | DomainKind::Prod(_)
        | DomainKind::Seq(_)
        | DomainKind::Powerset(_)
        | DomainKind::Bag(_)
        | DomainKind::Map(..)
        | DomainKind::Rule(_) => None,
    }
}

/// The enumeration that a domain is, or that it is a part of.
fn enumeration(program: &Program, domain: DomainId) -> Option<DomainId> {
    match &program.domain(domain).kind {
        DomainKind::Enum { .. } => Some(domain),
        DomainKind::Concrete { base, .. } => enumeration(program, *base),
        _ => None,
    }
}

fn literals(program: &Program, domain: DomainId) -> Option<&[String]> {
    match &program.domain(domain).kind {
        DomainKind::Enum { literals } => Some(literals),
        _ => None,
    }
}

/// The terms of a function's locations, if they can be listed and are few.
fn locations(machine: &mut Machine, function: &Function) -> Option<Vec<String>> {
    let program = Arc::clone(machine.program());
    let mut found: Vec<Vec<String>> = vec![Vec::new()];
    for parameter in &function.parameters {
        if !program.is_listable(*parameter) || program.waits_for_start(*parameter) {
            return None;
        }
        let elements: Vec<Value> = machine.elements(*parameter).ok()?;
        if elements.len() * found.len() > LOCATIONS {
            return None;
        }
        let with = |arguments: &Vec<String>, element: &Value| {
            let shown = element.show(&program).to_string();
            arguments.iter().cloned().chain([shown]).collect::<Vec<String>>()
        };
        found = found.iter().flat_map(|some| elements.iter().map(|element| with(some, element))).collect();
    }
    let term = |arguments: Vec<String>| match arguments.is_empty() {
        true => function.name.clone(),
        false => format!("{}({})", function.name, arguments.join(", ")),
    };
    Some(found.into_iter().map(term).collect())
}

/// A text as a YAML scalar, quoted as in JSON.
pub(super) fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
