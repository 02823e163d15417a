//! A run in full: its initial state and its steps, one by one.
//!
//! In: states that each lead to the next. Out: a [`Trace`]. If several steps lead from one state to the next, the first
//! is used.

use std::ops::ControlFlow;

use explore::{Explorer, Outcome, Path, Told};
use machine::{FaultClass, Location, Value};

use crate::target::{Found, Target};

/// A run from an initial state.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Trace {
    /// The inputs and choices of the initial state.
    pub start: Told,
    /// The initial state.
    pub values: Vec<(Location, Value)>,
    /// The steps. The last one may fail, or its inputs may violate a condition.
    pub steps: Vec<Told>,
    /// The step to which the run returns after the last one, forever; `None` for a run that ends.
    pub turn: Option<usize>,
    /// Whether the run ends in its last state because no step from there satisfies the assumptions. Formulas see it stay there.
    pub ends: bool,
    /// Whether a tree of runs violates the property, of which this is only one branch.
    pub branch: bool,
}

/// The first alternative of a state that satisfies `wanted`.
fn first_path(explorer: &mut Explorer, state: &[u64], wanted: &mut dyn FnMut(&Path) -> bool) -> Option<Path> {
    let mut first = None;
    let _ = explorer.paths_until(state, &mut |path| {
        if wanted(&path) {
            first = Some(path);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    first
}

/// The picks of the first alternative that leads from one state to another.
pub(crate) fn picks_between(explorer: &mut Explorer, from: &[u64], to: &[u64]) -> Vec<u32> {
    let mut leads = |path: &Path| matches!(&path.outcome, Outcome::Next(next) if **next == *to);
    first_path(explorer, from, &mut leads).expect("the step was made before").picks
}

/// The run from an initial state along a chain of states.
pub(crate) fn tell_way(explorer: &mut Explorer, chain: &[Box<[u64]>]) -> Trace {
    let start = explorer.initial().iter().find(|(state, _)| **state == *chain[0]).map(|(_, start)| start);
    let start = start.map(|start| explorer.told_of_start(start)).unwrap_or_default();
    let mut trace = Trace { start, values: explorer.values(&chain[0]), ..Trace::default() };
    for pair in chain.windows(2) {
        let picks = picks_between(explorer, &pair[0], &pair[1]);
        trace.steps.push(explorer.tell(&pair[0], &picks));
    }
    trace
}

pub(crate) fn tell(explorer: &mut Explorer, chain: &[Box<[u64]>], found: &Found) -> Trace {
    let mut trace = tell_way(explorer, chain);
    let last = &chain[chain.len() - 1];
    let path = match found.target {
        Target::Fault(class) => first_path(
            explorer,
            last,
            &mut |path| matches!(&path.outcome, Outcome::Fault(fault) if FaultClass::of(fault) as usize == class),
        ),
        Target::StepCondition(condition) => {
            first_path(explorer, last, &mut |path| path.failed.contains(&(condition as u32)))
        }
        Target::Rest | Target::Condition(_) => None,
    };
    if let Some(path) = path {
        trace.steps.push(explorer.tell(last, &path.picks));
    }
    trace
}
