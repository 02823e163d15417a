//! Describes the run of a scenario that failed, as text for people.

use std::fmt::{self, Write};

use machine::{Location, Show, Value};
use program::Program;
use scenario::{Passage, PassageKind, Story};

/// Describes a run: the initial state, then each step's inputs, choices and changes.
pub fn story(program: &Program, story: &Story) -> String {
    let mut out = String::new();
    let _ = write(&mut out, program, story);
    out
}

fn write(out: &mut String, program: &Program, story: &Story) -> fmt::Result {
    let at = |location: &Location| location.show(program).to_string();
    let value = |value: &Value| value.show(program).to_string();
    writeln!(out, "  state 0")?;
    for (location, of) in &story.initial {
        writeln!(out, "    {} = {}", at(location), value(of))?;
    }
    if story.left_out > 0 {
        writeln!(out, "  \u{2026} {} steps before those that follow", story.left_out)?;
    }
    let binders = crate::choice_variables(program);
    for Passage { kind, inputs, choices, changes } in &story.passages {
        match kind {
            PassageKind::Step(number) => writeln!(out, "  step {number}")?,
            PassageKind::Attempt(number) => writeln!(out, "  step {number}, not made")?,
            PassageKind::Exec => writeln!(out, "  exec")?,
        }
        for (location, of) in inputs {
            writeln!(out, "    in {} = {}", at(location), value(of))?;
        }
        for choice in choices {
            let names = binders.get(&choice.span).filter(|names| names.len() == choice.values.len());
            let said = choice.values.iter().enumerate().map(|(index, of)| match names {
                Some(names) => format!("{} = {}", names[index], value(of)),
                None => value(of),
            });
            writeln!(out, "    choose {}", said.collect::<Vec<_>>().join(", "))?;
        }
        for change in changes {
            writeln!(out, "    {}: {} -> {}", at(&change.location), value(&change.before), value(&change.after))?;
        }
        if changes.is_empty() && !matches!(kind, PassageKind::Attempt(_)) {
            writeln!(out, "    no change")?;
        }
    }
    writeln!(out)?;
    Ok(())
}
