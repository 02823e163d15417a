//! Writes a generated test: inputs and choices before each step, checks of what changed after it.

use std::fmt::Write;

use machine::{Change, Location, Show, Value};
use program::{FunctionKind, Program};

use crate::avalla::{is_said, pick, set};
use crate::test_generation::cover::Candidate;
use crate::test_generation::{Generated, Subject};

/// The first line of a scenario that reaches so many goals.
pub(super) fn headline(goals: usize) -> String {
    format!("// reaches {}", crate::tell::plural(goals, "goal"))
}

/// The scenario of a walk.
pub(super) fn scenario(subject: &Subject<'_>, number: usize, walk: &Candidate, goals: usize) -> Generated {
    let trace = walk.trace();
    let program: &Program = subject.program;
    let name = format!("{}_{number}", program.name);
    let mut text = format!("{}\nscenario {name}\nload \"{}\"\n", headline(goals), subject.path);
    let mut given: Vec<(Location, Value)> = Vec::new();
    let mut state = trace.values.clone();
    set(&mut text, program, &mut given, &trace.start.inputs);
    for (index, step) in trace.steps.iter().enumerate() {
        let _ = write!(text, "\n// step {}\n", index + 1);
        set(&mut text, program, &mut given, &step.inputs);
        step.choices.iter().for_each(|choice| pick(&mut text, program, choice));
        text.push_str("step\n");
        for Change { location, after, .. } in &step.changes {
            check(&mut text, program, location, after);
            match state.iter_mut().find(|(known, _)| known == location) {
                Some((_, value)) => value.clone_from(after),
                None => state.push((location.clone(), after.clone())),
            }
        }
        // That nothing changes is worth checking, too.
        if step.changes.is_empty() {
            state.iter().for_each(|(location, value)| check(&mut text, program, location, value));
        }
    }
    Generated { name, text, steps: trace.steps.len(), meets: walk.all() }
}

/// Checks the present value of a location, if a term can express it.
fn check(text: &mut String, program: &Program, location: &Location, value: &Value) {
    let function = program.function(location.function);
    if !is_said(program, location, value)
        || function.library
        || !matches!(function.kind, FunctionKind::Controlled | FunctionKind::Out)
    {
        return;
    }
    let location = location.show(program);
    let _ = match value {
        Value::Undef => writeln!(text, "check isUndef({location});"),
        value => writeln!(text, "check {location} = {};", value.show(program)),
    };
}
