//! Which engine goes through the states: one after the other, or as sets; or a solver, which proves what it can.
//!
//! In: a plan. Out: what any has found, in one form. INVARIANT: whichever it is, nothing Holds by one that is violated by
//! another; a shortest run may be another one.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::explore::{Trouble, Unbounded};
use model::Basic;
use program::{DomainKind, FunctionKind, Program};
use smt::session::Solvers;

use crate::check::{Engine, NoStart};
use crate::checkpoint::{Keeper, Unfit};
use crate::partial_order::Unreduced;
use crate::search::{Plan, Progress, Search, Stop, Target};
use crate::solver::{Left, Method, Proof, Solved, Unsolved, solve};
use crate::storage::Storage;
use crate::symbolic::Reach;
use crate::symmetry::Symmetry;
use crate::trace::Trace;

/// LIMIT: so many states are gone through one by one before sets are tried.
const FEW: u64 = 4_000_000;

/// A search of either engine that has ended.
pub(crate) struct Ended {
    /// What was found, with a shortest run to it.
    pub found: BTreeMap<Target, Trace>,
    /// Why it ended early; none where all states were met.
    pub stop: Option<Stop>,
    /// Where less than the states was kept: how many are to be expected to have been left out.
    pub omission: Option<f64>,
    /// Why all steps were made, where fewer were wanted.
    pub unreduced: Option<Unreduced>,
    /// Which elements were interchangeable, where that was to be found out.
    pub symmetry: Option<Symmetry>,
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
    /// What a solver has proved not to be found.
    pub proved: BTreeMap<Target, Proof>,
    /// What a solver has left open.
    pub left: BTreeMap<Target, Left>,
    /// The solver that was asked.
    pub solver: Option<String>,
}

/// Searches all states of a program, or asks a solver about them.
pub(crate) fn run_engine(
    program: &Arc<Program>,
    plan: &Plan,
    engine: Engine,
    solvers: &mut dyn Solvers,
    keeper: Option<&mut dyn Keeper>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Ended, NoStart> {
    // Sets are not made level by level, and have no bound of their size that a user could think of.
    let bounded = plan.max_depth < u64::MAX || plan.max_states < u64::MAX || plan.first;
    match engine {
        Engine::Symbolic if !bounded => Ok(symbolic(program, plan, watch)?),
        Engine::Solver(method) => by_solver(program, plan, method, solvers, watch),
        // Only states that are gone through one by one are kept in one way or another.
        Engine::Automatic
            if plan.storage == Storage::Exact
                && !(plan.partial_order || plan.symmetry)
                && plan.disk.is_none()
                && keeper.is_none() =>
        {
            let few = Plan { max_states: if bounded { plan.max_states } else { FEW }, ..plan.clone() };
            let mut ended = explicit(program, &few, None, watch)?;
            let full = matches!(ended.stop, Some(Stop::States | Stop::Memory));
            let endless = full && has_infinite_values(program);
            let mut solved = None;
            if (endless || !ended.unbounded.is_empty()) && ended.stop != Some(Stop::Asked) && solvers.name().is_ok() {
                // What solvers have no place for, or do not know, stays as it is.
                solved = solve(program, plan, Method::Portfolio, solvers, watch).ok();
                let decided = solved.as_ref().is_some_and(|solved| solved.left.is_empty());
                if decided || bounded || !full {
                    ended.take(solved);
                    return Ok(ended);
                }
            } else if bounded || !full {
                return Ok(ended);
            }
            let memory = ended.stop == Some(Stop::Memory);
            drop(ended);
            let mut ended = symbolic(program, plan, watch)?;
            if !memory && ended.stop == Some(Stop::Memory) {
                drop(ended);
                ended = explicit(program, plan, None, watch)?;
            }
            ended.take(solved);
            Ok(ended)
        }
        _ => explicit(program, plan, keeper, watch),
    }
}

/// Whether some location has infinitely many values to take.
fn has_infinite_values(program: &Program) -> bool {
    program.functions.iter().any(|function| {
        let kept = matches!(function.kind, FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Shared);
        let infinite = matches!(
            program.domain(function.codomain).kind,
            DomainKind::Basic(Basic::Integer | Basic::Natural | Basic::Real | Basic::String)
        );
        kept && infinite && !function.library
    })
}

fn by_solver(
    program: &Arc<Program>,
    plan: &Plan,
    method: Method,
    solvers: &mut dyn Solvers,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Ended, NoStart> {
    let solved = solve(program, plan, method, solvers, watch).map_err(|unsolved| match unsolved {
        Unsolved::Outside(outside) => NoStart::Outside(outside),
        Unsolved::Trouble(trouble) => NoStart::from(trouble),
        Unsolved::NoSolver(reason) => NoStart::NoSolver(reason),
    })?;
    let progress = Progress { depth: solved.depth, ..Progress::default() };
    let mut ended = Ended {
        found: BTreeMap::new(),
        stop: None,
        omission: None,
        unreduced: None,
        symmetry: None,
        progress,
        unbounded: BTreeSet::new(),
        unknown: BTreeSet::new(),
        width: (0, 0),
        executed: Vec::new(),
        engine: Engine::Solver(method),
        proved: BTreeMap::new(),
        left: BTreeMap::new(),
        solver: None,
    };
    ended.take(Some(solved));
    Ok(ended)
}

impl Ended {
    /// Adds what a solver has found and proved; what has been found before stays.
    fn take(&mut self, solved: Option<Solved>) {
        let Some(solved) = solved else { return };
        for (target, trace) in solved.found {
            self.found.entry(target).or_insert(trace);
        }
        self.proved = solved.proved;
        self.left = solved.left;
        self.solver = Some(solved.solver);
    }
}

fn explicit(
    program: &Arc<Program>,
    plan: &Plan,
    keeper: Option<&mut dyn Keeper>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Ended, NoStart> {
    // LIMIT: a search that is kept has its states in memory.
    let spills = plan.storage == Storage::Exact && keeper.is_none();
    let symmetry = plan.symmetry && !plan.partial_order && keeper.is_none();
    let plan = &Plan { disk: plan.disk.clone().filter(|_| spills), symmetry, ..plan.clone() };
    let mut search = Search::run(program, plan, keeper, watch).map_err(|unfit| match unfit {
        Unfit::Refused(refusal) => NoStart::Refused(refusal),
        Unfit::Trouble(trouble) => NoStart::from(trouble),
    })?;
    let traces = search.traces(watch);
    Ok(Ended {
        found: search.found.iter().map(|found| found.target).zip(traces).collect(),
        stop: search.stop,
        omission: (plan.storage != Storage::Exact).then_some(search.omission),
        unreduced: search.unreduced,
        symmetry: search.symmetry.take(),
        progress: search.progress,
        width: search.width(),
        executed: search.executed,
        unbounded: search.unbounded,
        unknown: search.unknown,
        engine: Engine::Explicit,
        proved: BTreeMap::new(),
        left: BTreeMap::new(),
        solver: None,
    })
}

fn symbolic(program: &Arc<Program>, plan: &Plan, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<Ended, Trouble> {
    let mut reach = Reach::run(program, plan, watch)?;
    let traces = reach.traces();
    Ok(Ended {
        found: reach.found.iter().map(|found| found.target).zip(traces).collect(),
        stop: reach.stop,
        omission: None,
        unreduced: None,
        symmetry: None,
        progress: reach.progress,
        width: reach.width(),
        executed: reach.executed(),
        unbounded: reach.unbounded,
        unknown: reach.unknown,
        engine: Engine::Symbolic,
        proved: BTreeMap::new(),
        left: BTreeMap::new(),
        solver: None,
    })
}
