//! Advice about violations that are often not the model's fault.
//!
//! In: a violated check and its run. Out: a line of advice, if there is one. It depends on the run alone.

use program::Program;
use verify::{Subject, Trace, runs::scheduler};

/// The advice.
pub fn hint(program: &Program, subject: Subject, trace: &Trace) -> Option<&'static str> {
    if subject == Subject::NoDeadlock {
        return Some("if runs may end there, name the final states: `--terminal CONDITION`");
    }
    let alone = matches!(subject, Subject::Property(_)) && always_the_same(program, trace);
    alone.then_some("from there on the same agent is always chosen; if the others get their turn, add `--fair weak`")
}

/// Whether the main rule chooses who moves, and chooses the same one throughout the repeating part of the run.
fn always_the_same(program: &Program, trace: &Trace) -> bool {
    let (Some(turn), Some(scheduler)) = (trace.turn, scheduler(program)) else { return false };
    let mut chosen = trace.steps[turn.min(trace.steps.len())..]
        .iter()
        .map(|step| step.choices.iter().find(|choice| choice.span == scheduler).map(|choice| &choice.values));
    let first = chosen.next().flatten();
    first.is_some() && chosen.all(|values| values == first)
}
