//! The run of a scenario that failed, for people and as JSON.

use std::io::Write;

use groundstate::scenario::{Passage, PassageKind, Story};
use machine::{Location, Show, Value};
use program::Program;
use serde_json::json;

use crate::failure::Failure;
use crate::shell::Shell;

/// Tells a run: the initial state, then of each step its inputs, its choices and what it changed.
pub fn tell(shell: &mut Shell, program: &Program, story: &Story) -> Result<(), Failure> {
    let at = |location: &Location| location.show(program).to_string();
    let value = |value: &Value| value.show(program).to_string();
    writeln!(shell.out(), "  state 0")?;
    for (location, of) in &story.initial {
        writeln!(shell.out(), "    {} = {}", at(location), value(of))?;
    }
    if story.left_out > 0 {
        writeln!(shell.out(), "  \u{2026} {} steps before those that follow", story.left_out)?;
    }
    let binders = groundstate::choice_variables(program);
    for Passage { kind, inputs, choices, changes } in &story.passages {
        match kind {
            PassageKind::Step(number) => writeln!(shell.out(), "  step {number}")?,
            PassageKind::Attempt(number) => writeln!(shell.out(), "  step {number}, not made")?,
            PassageKind::Exec => writeln!(shell.out(), "  exec")?,
        }
        for (location, of) in inputs {
            writeln!(shell.out(), "    in {} = {}", at(location), value(of))?;
        }
        for choice in choices {
            let names = binders.get(&choice.span).filter(|names| names.len() == choice.values.len());
            let said = choice.values.iter().enumerate().map(|(index, of)| match names {
                Some(names) => format!("{} = {}", names[index], value(of)),
                None => value(of),
            });
            writeln!(shell.out(), "    choose {}", said.collect::<Vec<_>>().join(", "))?;
        }
        for change in changes {
            writeln!(
                shell.out(),
                "    {}: {} -> {}",
                at(&change.location),
                value(&change.before),
                value(&change.after)
            )?;
        }
        if changes.is_empty() && !matches!(kind, PassageKind::Attempt(_)) {
            writeln!(shell.out(), "    no change")?;
        }
    }
    writeln!(shell.out())?;
    Ok(())
}

/// The same as a list of objects.
pub fn object(program: &Program, story: &Story) -> serde_json::Value {
    let at = |location: &Location| location.show(program).to_string();
    let value = |value: &Value| value.show(program).to_string();
    let pairs = |values: &[(Location, Value)]| -> serde_json::Map<String, serde_json::Value> {
        values.iter().map(|(location, of)| (at(location), json!(value(of)))).collect()
    };
    let mut run = vec![json!({"kind": "state", "values": pairs(&story.initial), "left_out": story.left_out})];
    run.extend(story.passages.iter().map(|passage| {
        let (kind, step) = match passage.kind {
            PassageKind::Step(step) => ("step", Some(step)),
            PassageKind::Attempt(step) => ("attempt", Some(step)),
            PassageKind::Exec => ("exec", None),
        };
        let choices: Vec<Vec<String>> =
            passage.choices.iter().map(|choice| choice.values.iter().map(value).collect()).collect();
        let changes: serde_json::Map<String, serde_json::Value> = passage
            .changes
            .iter()
            .map(|change| (at(&change.location), json!({"from": value(&change.before), "to": value(&change.after)})))
            .collect();
        json!({"kind": kind, "step": step, "inputs": pairs(&passage.inputs), "choices": choices, "changes": changes})
    }));
    json!(run)
}
