//! What to do about a violation that is often none of the model's faults.
//!
//! In: a violated check and its run. Out: a line of advice, where there is one. It judges by the run alone.

use groundstate::verify::{Subject, Trace, runs::scheduler};
use program::Program;

/// The advice.
pub(super) fn hint(program: &Program, subject: Subject, trace: &Trace) -> Option<&'static str> {
    if subject == Subject::NoDeadlock {
        return Some("if runs may end there, say in which states: `--terminal CONDITION`");
    }
    let alone = matches!(subject, Subject::Property(_)) && always_the_same(program, trace);
    alone.then_some("from there on the same one is chosen for ever; if others get their turn: `--fair weak`")
}

/// The main rule chooses who moves, and in the part of the run that comes again and again it chooses the same one.
fn always_the_same(program: &Program, trace: &Trace) -> bool {
    let (Some(turn), Some(scheduler)) = (trace.turn, scheduler(program)) else { return false };
    let mut chosen = trace.steps[turn.min(trace.steps.len())..]
        .iter()
        .map(|step| step.choices.iter().find(|choice| choice.span == scheduler).map(|choice| &choice.values));
    let first = chosen.next().flatten();
    first.is_some() && chosen.all(|values| values == first)
}
