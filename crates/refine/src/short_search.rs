//! The search that goes before solvers are asked.
//!
//! In: a coupling, and options with the inputs that machines share. Out: what a search of few pairs of states found; whether that is
//! the answer. INVARIANT: it answers only with a refutation, a fault of the question, or that somebody stopped it.

use std::ops::ControlFlow;

use crate::coupling::Coupling;
use crate::options::Options;
use crate::refine::{Trouble, refine};
use crate::report::{Progress, Report, Verdict, Why};

/// LIMIT: so many pairs of states are searched for a refutation, if the options say nothing.
const SEARCHED: u64 = 500;
/// LIMIT: so many steps are made for it.
const STEPS: u64 = 20_000;

/// Searches a few pairs; breaks with the answer.
///
/// # Errors
/// A machine has no initial states.
pub(crate) fn short_search(
    coupling: &Coupling,
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<ControlFlow<Report, Report>, Trouble> {
    let max_pairs = options.max_pairs.min(SEARCHED);
    let searched = Options { max_pairs, max_steps: options.max_steps.min(STEPS), ..options.clone() };
    let mut report = refine(coupling, &searched, watch)?;
    report.diagrams.clear();
    report.properties.clear();
    let is_interrupted = |why: &Why| matches!(why, Why::Stopped(_));
    Ok(match &report.verdict {
        Verdict::DoesNot(_) | Verdict::Vacuous(_) => ControlFlow::Break(report),
        Verdict::Unknown(whys) if whys.iter().any(is_interrupted) => ControlFlow::Break(report),
        Verdict::Refines | Verdict::Unknown(_) => {
            // It may not have come to the steps that matter.
            report.idle = false;
            ControlFlow::Continue(report)
        }
    })
}
