//! Writes runs as Avalla: sets the inputs and picks the choices of each step of a trace.
//!
//! In: what a step was given. Out: lines of a scenario. What no scenario can express becomes a comment: a choice of a term, and elements
//! that a run has made, which have no name.
//! Counterexamples and generated tests are written with it.

use std::fmt::Write;

use explore::ChoiceTaken;
use machine::{Location, Show, Value};
use program::{Program, Rule, RuleId};

/// What is said in a scenario of what it cannot do.
pub(crate) const UNSAID: &str = "which no scenario can say";

/// Whether a scenario leaves out a part of its run.
pub fn leaves_out(scenario: &str) -> bool {
    scenario.lines().any(|line| line.starts_with("//") && line.ends_with(UNSAID))
}

/// Sets the inputs whose values changed since the last `set`.
pub(crate) fn set(
    text: &mut String,
    program: &Program,
    given: &mut Vec<(Location, Value)>,
    inputs: &[(Location, Value)],
) {
    for (location, value) in inputs {
        match given.iter_mut().find(|(former, _)| former == location) {
            Some((_, former)) if former == value => continue,
            Some((_, former)) => former.clone_from(value),
            None => given.push((location.clone(), value.clone())),
        }
        let (place, shown) = (location.show(program), value.show(program));
        let _ = match is_said(program, location, value) {
            true => writeln!(text, "set {place} := {shown};"),
            false => writeln!(text, "// {place} is {shown} here, {UNSAID}"),
        };
    }
}

/// Picks what was chosen.
pub(crate) fn pick(text: &mut String, program: &Program, choice: &ChoiceTaken) {
    for procedure in &program.procedures {
        let mut open: Vec<RuleId> = vec![procedure.body];
        while let Some(id) = open.pop() {
            program.each_child_of_rule(id, &mut |child| open.push(child));
            let Rule::Choose { binders, .. } = program.rule(id) else { continue };
            if program.rule_span(id) != choice.span {
                continue;
            }
            for (binder, value) in program.binder_list(*binders).iter().zip(&choice.values) {
                let variable = &procedure.names[binder.slot.0 as usize];
                let (rule, shown) = (&procedure.name, value.show(program));
                let _ = match is_written(program, value) {
                    true => writeln!(text, "pick {variable} in {rule} := {shown};"),
                    false => writeln!(text, "// {rule} chooses {shown} for {variable} here, {UNSAID}"),
                };
            }
            return;
        }
    }
    let values: Vec<String> = choice.values.iter().map(|value| value.show(program).to_string()).collect();
    let _ = writeln!(text, "// a term chooses {} here, {UNSAID}", values.join(", "));
}

/// Whether a scenario can say that a location has a value: it sees the function, and a term has each value.
pub(crate) fn is_said(program: &Program, location: &Location, value: &Value) -> bool {
    program.function(location.function).seen
        && location.arguments.iter().chain([value]).all(|value| is_written(program, value))
}

/// Whether a value can be written as a term: it contains no unnamed element, none with a name that an export list hides, and no rule.
pub(crate) fn is_written(program: &Program, value: &Value) -> bool {
    match value {
        Value::Element(domain, index) => match &program.domain(*domain).kind {
            program::DomainKind::Abstract { elements, .. } => {
                program.domain(*domain).seen && (*index as usize) < elements.len()
            }
            _ => false,
        },
        Value::Enum(domain, _) => program.domain(*domain).seen,
        Value::Rule(_) => false,
        Value::Tuple(items) => items.iter().all(|item| is_written(program, item)),
        Value::Seq(items) | Value::Set(items) => items.iter().all(|item| is_written(program, item)),
        Value::Bag(items) => items.keys().all(|item| is_written(program, item)),
        Value::Map(entries) => {
            entries.iter().all(|(key, value)| is_written(program, key) && is_written(program, value))
        }
        _ => true,
    }
}
