//! Bounded search by solvers: a run of the concrete machine from an initial state that leaves every run of the abstract machine.
//!
//! In: a coupling, options, solvers, the most steps. Out: a [`Report`]. Lengths are tried in increasing order, so a run found is a shortest
//! one of those that end in this way. INVARIANT: *does not refine* is said only if the machines make the run again and the game on it is
//! lost ([`mod@again`]); *refines* is never said. That no run of so many steps is refuted is said if all solvers that are there say so, of
//! formulas that leave out nothing that a run of so many steps does. Decided in docs/adr/0051.

mod again;
mod unrolled;

use std::ops::ControlFlow;

use machine::Cause;
use solve::shared::{Node, Terms};

use crate::coupling::Coupling;
use crate::formulas::Formulas;
use crate::formulas::ask::{Ask, Provers};
use crate::formulas::obligation::{Origin, Said};
use crate::limited::with_shared_inputs;
use crate::options::Options;
use crate::refine::Trouble;
use crate::report::{Left, Progress, Report, Runs, Verdict, Why};
use crate::short_search::short_search;
use crate::{ABSTRACT, CONCRETE};
use again::{Again, again};
use unrolled::Unrolled;

/// Looks for a run of at most `depth` steps of the concrete machine that no run of the abstract machine matches. `watch` receives progress
/// and tells whether to go on.
///
/// # Errors
/// A machine has no initial states.
pub fn refute(
    coupling: &Coupling,
    options: &Options,
    provers: Provers<'_>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Report, Trouble> {
    let options = &with_shared_inputs(coupling, options);
    let mut report = match short_search(coupling, options, watch)? {
        ControlFlow::Continue(report) => report,
        ControlFlow::Break(report) => return Ok(report),
    };
    let progress = report.progress;
    let mut go_on = || watch(&progress) && options.extents.iter().all(|extent| !extent.interrupt.is_raised());
    let Provers { solvers, seconds, depth } = provers;
    let mut ask = Ask { solvers, seconds, go_on: &mut go_on, obligations: Vec::new(), stopped: false };
    let (runs, verdict) = match Formulas::of(coupling, options) {
        Err((origin, outside)) => {
            let runs = Runs { solvers: ask.names(), left: Some(Left::Outside(origin, outside)), ..Runs::default() };
            (runs, None)
        }
        Ok(mut formulas) => look(coupling, options, &mut formulas, &mut ask, depth, None),
    };
    report.verdict = verdict.unwrap_or_else(|| match runs.left {
        Some(Left::Stopped) => {
            let asked = |side: usize| options.extents[side].interrupt.cause();
            Verdict::Unknown(vec![Why::Stopped(asked(ABSTRACT).or(asked(CONCRETE)).unwrap_or(Cause::Asked))])
        }
        _ => Verdict::Unknown(vec![Why::NoRun]),
    });
    report.runs = Some(Box::new(runs));
    Ok(report)
}

/// Looks for a run; what was looked at, and the refutation if there is one. With a condition on pairs of states, notes whether a run comes
/// to one of these.
pub(crate) fn look(
    coupling: &Coupling,
    options: &Options,
    formulas: &mut Formulas,
    ask: &mut Ask<'_, '_>,
    depth: u64,
    pair: Option<Node>,
) -> (Runs, Option<Verdict>) {
    let mut runs = Runs { solvers: ask.names(), ..Runs::default() };
    let Formulas { store, machines, related, starts, begun } = formulas;
    let mut unrolled =
        Unrolled::new(coupling, [&machines[ABSTRACT], &machines[CONCRETE]], related, store, starts, begun);
    let mut pair = pair;
    for steps in 1..=depth {
        comes_to(&mut unrolled, &mut pair, steps - 1, ask, &mut runs);
        let next = match unrolled.next() {
            Ok(next) => next,
            Err(outside) => {
                runs.leave(Left::Outside(Origin::Side(ABSTRACT), outside));
                break;
            }
        };
        for (stray, outside) in next.strays {
            if stray != Terms::FALSE && !ask.denied(&unrolled.store.terms, stray) && !ask.stopped {
                runs.leave(Left::Beyond(steps, outside));
                break;
            }
        }
        let (said, model) = ask.look(&unrolled.store.terms, next.lost);
        if let Some(model) = model {
            let by = runs.solvers.get(said.len() - 1).cloned().unwrap_or_default();
            match again(coupling, options, &unrolled, starts, begun, &model) {
                Ok(refutation) => {
                    runs.found = Some((steps, by));
                    return (runs, Some(Verdict::DoesNot(Box::new(refutation))));
                }
                Err(Again::Odd) => runs.leave(Left::Odd(steps)),
                Err(Again::Unclear(why)) => runs.leave(Left::Unclear(steps, why)),
                Err(Again::Stopped) => ask.stopped = true,
            }
        } else if !ask.stopped && said.iter().any(|said| *said != Said::Impossible) {
            runs.leave(Left::Silent(steps, said));
            break;
        }
        if ask.stopped {
            break;
        }
        if runs.left.is_none() {
            runs.depth = steps;
        }
        unrolled.go_on(ask);
        if steps == depth {
            comes_to(&mut unrolled, &mut pair, steps, ask, &mut runs);
        }
    }
    if ask.stopped {
        runs.left = Some(Left::Stopped);
    }
    (runs, None)
}

/// Notes whether a run of so many steps comes to a pair of states, until that is known of one or not known.
fn comes_to(unrolled: &mut Unrolled<'_>, pair: &mut Option<Node>, steps: u64, ask: &mut Ask<'_, '_>, runs: &mut Runs) {
    let Some(condition) = *pair else { return };
    let here = unrolled.comes_to(condition);
    let (said, model) = ask.look(&unrolled.store.terms, here);
    match model {
        None if !said.is_empty() && said.iter().all(|said| *said == Said::Impossible) => runs.apart = Some(steps),
        None => *pair = None,
        Some(_) => {
            *pair = None;
            runs.reached = runs.solvers.get(said.len() - 1).map(|solver| (steps, solver.clone()));
        }
    }
}

impl Runs {
    /// Notes why longer runs are not known; the first reason counts.
    fn leave(&mut self, left: Left) {
        self.left.get_or_insert(left);
    }
}
