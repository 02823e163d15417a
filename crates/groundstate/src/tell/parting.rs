//! Describes where a run differs from its trace.
//!
//! In: the first record that differs, in both versions. Out: the first difference in it.

use machine::{Location, Show, Value};
use program::Program;
use simulate::{Parted, Record, StepRecord};

/// The first difference: in the trace, and now.
pub fn parting(parted: &Parted, program: &Program) -> (String, String) {
    match (parted.expected.as_ref(), parted.actual.as_deref()) {
        (Record::Step(then), Some(Record::Step(now))) => describe_steps(then, now, program),
        (Record::Initial { values: then, .. }, Some(Record::Initial { values: now, .. })) => {
            let text =
                |(location, value): &(Location, Value)| format!("{} = {}", location.show(program), value.show(program));
            differing(then.iter().map(text), now.iter().map(text))
        }
        (then, now) => (kind(then), now.map_or("the run had ended".to_string(), kind)),
    }
}

fn describe_steps(then: &StepRecord, now: &StepRecord, program: &Program) -> (String, String) {
    let inputs = |step: &StepRecord| -> Vec<String> {
        let text = step.inputs.iter().map(|(l, v)| format!("input {} = {}", l.show(program), v.show(program)));
        text.collect()
    };
    let changes = |step: &StepRecord| -> Vec<String> {
        let text = step.changes.iter().map(|change| {
            let (before, after) = (change.before.show(program), change.after.show(program));
            format!("{}: {before} -> {after}", change.location.show(program))
        });
        text.collect()
    };
    let all = |step: &StepRecord| -> Vec<String> {
        let violated = step.violations.iter().map(|violation| format!("violated {}", violation.name));
        let updates = [format!("{} updates", step.updates)];
        inputs(step).into_iter().chain(changes(step)).chain(violated).chain(updates).collect()
    };
    differing(all(then).into_iter(), all(now).into_iter())
}

fn differing(then: impl Iterator<Item = String>, mut now: impl Iterator<Item = String>) -> (String, String) {
    let nothing = || "nothing".to_string();
    for a in then {
        match now.next() {
            Some(b) if a == b => {}
            b => return (a, b.unwrap_or_else(nothing)),
        }
    }
    (nothing(), now.next().unwrap_or_else(nothing))
}

fn kind(record: &Record) -> String {
    match record {
        Record::Initial { .. } => "the initial state".to_string(),
        Record::Step(step) => format!("step {} is made", step.step),
        Record::Attempt(step) => format!("step {} cannot be made", step.step),
        Record::Back { step } => format!("back to step {step}"),
        Record::End(end) => format!("the run ends ({})", end.word()),
    }
}
