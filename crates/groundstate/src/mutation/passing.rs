//! Whether a model passes its own checks, so that they can judge its mutants.
//!
//! In: what a model asks. Out: its report, and which checks count. INVARIANT: one that does not hold of the model does not count.

use machine::Interrupt;
use verify::{NoStart, Outcome, Reason, Report, Stop, Subject, Verdict};

use super::Extent;
use super::ask::{Asked, Counting, keys};
use crate::tell::Verdicts;

/// Verifies a model as it is, up to the first violation: with one, it judges nothing. That a state has no step only says that
/// this check does not count, so then the search goes on past such states.
pub(super) fn as_it_is(asked: &Asked, extent: &Extent, interrupt: &Interrupt) -> Result<Report, NoStart> {
    let mut report = asked.verified(extent, (None, true), interrupt)?;
    let rests =
        |verdict: &Verdict| verdict.subject == Subject::NoDeadlock && matches!(verdict.outcome, Outcome::Violated(_));
    let Some(at) = report.verdicts.iter().position(rests) else { return Ok(report) };
    let resting = report.verdicts.swap_remove(at);
    let may_rest = Counting { may_rest: true, ..Counting::default() };
    report = asked.clone().counting(&may_rest).verified(extent, (None, true), interrupt)?;
    if let Some(verdict) = report.verdicts.iter_mut().find(|verdict| verdict.subject == Subject::NoDeadlock) {
        *verdict = resting;
    }
    Ok(report)
}

/// Which checks count, or why none does, as a clause about the model.
pub(super) fn counting(report: &Report, asked: &Asked) -> Result<Counting, String> {
    let program = asked.program();
    let keys = keys(program);
    let mut counting = Counting::default();
    if report.stop.is_some() {
        counting.depth = Some(report.progress.depth.saturating_sub(1));
    }
    for verdict in &report.verdicts {
        match (&verdict.outcome, verdict.subject) {
            (Outcome::Holds, _) => {}
            (Outcome::Violated(_), Subject::NoDeadlock) => counting.may_rest = true,
            (Outcome::Violated(_), subject) => {
                let name = Verdicts::new(program, &asked.overlay.sources, false).name(subject);
                return Err(format!("does not pass as it is: {name} is violated"));
            }
            (Outcome::Unknown(reasons), _) if reasons.contains(&Reason::Vacuous) => {
                return Err("has no initial state that satisfies its assumptions".to_string());
            }
            (Outcome::Unknown(reasons), _) if reasons.contains(&Reason::Stepless) => {
                return Err("has no step that satisfies its assumptions".to_string());
            }
            (Outcome::Unknown(reasons), subject) => {
                // What was not found within the same bounds, or in the same number of steps, counts if it is found then.
                let bounded = |reason: &Reason| {
                    matches!(reason, Reason::Bounded(_) | Reason::Stopped(Stop::States | Stop::Depth | Stop::Memory))
                };
                match subject {
                    // With bounds no state is known to have no step.
                    Subject::NoDeadlock => counting.may_rest = true,
                    _ if !reasons.is_empty() && reasons.iter().all(bounded) => {}
                    Subject::Property(index) => _ = counting.left_out.insert(keys[index].clone()),
                    Subject::Consistent | Subject::InDomain | Subject::Defined => {}
                }
            }
        }
    }
    Ok(counting)
}
