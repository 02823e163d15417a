//! Which engine goes through the states: one after the other, or as sets.
//!
//! In: a plan. Out: what either has found, in one form. INVARIANT: whichever it is, what Holds and what does not is the
//! same; a shortest run may be another one.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::explore::{Trouble, Unbounded};
use program::{Program, RuleId};

use crate::check::Engine;
use crate::search::{Plan, Progress, Search, Stop, Target};
use crate::symbolic::Reach;
use crate::trace::Trace;

/// LIMIT: so many states are gone through one by one before sets are tried.
const FEW: u64 = 4_000_000;

/// A search of either engine that has ended.
pub(crate) struct Ended {
    /// What was found, with a shortest run to it.
    pub found: BTreeMap<Target, Trace>,
    /// Why it ended early; none where all states were met.
    pub stop: Option<Stop>,
    /// How far it came.
    pub progress: Progress,
    /// What could not be gone through.
    pub unbounded: BTreeSet<Unbounded>,
    /// Conditions whose truth is not known in some state.
    pub unknown: BTreeSet<usize>,
    /// How many words a state has, and how many bits of them are used.
    pub width: (usize, usize),
    /// By rule, whether a machine ran it.
    pub executed: Vec<bool>,
    /// Which engine it was.
    pub engine: Engine,
}

/// Searches all states of a program.
pub(crate) fn run_engine(
    program: &Arc<Program>,
    plan: &Plan,
    engine: Engine,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Ended, Trouble> {
    // Sets are not made level by level, and have no bound of their size that a user could think of.
    let bounded = plan.max_depth < u64::MAX || plan.max_states < u64::MAX || plan.first;
    match engine {
        Engine::Symbolic if !bounded => symbolic(program, plan, watch),
        Engine::Automatic if !bounded => {
            let mut stopped = false;
            let mut heard = |progress: &Progress| {
                stopped = !watch(progress);
                !stopped
            };
            let few = Plan { max_states: FEW, ..plan.clone() };
            let ended = explicit(program, &few, &mut heard)?;
            if !matches!(ended.stop, Some(Stop::States | Stop::Memory)) {
                return Ok(ended);
            }
            let memory = ended.stop == Some(Stop::Memory);
            drop(ended);
            let ended = symbolic(program, plan, &mut heard)?;
            if memory || ended.stop != Some(Stop::Memory) {
                return Ok(ended);
            }
            drop(ended);
            explicit(program, plan, &mut heard)
        }
        _ => explicit(program, plan, watch),
    }
}

fn explicit(program: &Arc<Program>, plan: &Plan, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<Ended, Trouble> {
    let mut search = Search::run(program, plan, watch)?;
    let traces = search.traces();
    Ok(Ended {
        found: search.found.iter().map(|found| found.target).zip(traces).collect(),
        stop: search.stop,
        progress: search.progress,
        width: search.width(),
        executed: (0..program.rules.len()).map(|rule| search.executed(RuleId(rule as u32)) > 0).collect(),
        unbounded: search.unbounded,
        unknown: search.unknown,
        engine: Engine::Explicit,
    })
}

fn symbolic(program: &Arc<Program>, plan: &Plan, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<Ended, Trouble> {
    let mut reach = Reach::run(program, plan, watch)?;
    let traces = reach.traces();
    Ok(Ended {
        found: reach.found.iter().map(|found| found.target).zip(traces).collect(),
        stop: reach.stop,
        progress: reach.progress,
        width: reach.width(),
        executed: reach.executed(),
        unbounded: reach.unbounded,
        unknown: reach.unknown,
        engine: Engine::Symbolic,
    })
}
