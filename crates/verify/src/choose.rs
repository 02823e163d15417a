//! Which engine is taken: the one that was named; where none was, states one after the other, and a solver where that has no
//! end.
//!
//! In: what was chosen, and the plan. Out: an [`Engine`]. Sets are for whoever names them: the library that makes them has once
//! given nodes away twice (`symbolic/apart.rs`), and what mends that has not been tried for long enough to be what is taken
//! unasked.

use machine::Cause;
use model::Basic;
use program::{DomainId, DomainKind, FunctionKind, Program, Rule};

use crate::engine::{Ended, Engine, Task};
use crate::explicit::Explicit;
use crate::options::EngineKind;
use crate::plan::Plan;
use crate::progress::Stop;
use crate::report::NoStart;
use crate::solver::engine::BySolver;
use crate::solver::method::Method;
use crate::solver::solve;
use crate::storage::Storage;
use crate::symbolic::apart::Symbolic;

/// LIMIT: of states that may have no end so many are gone through before a solver is asked.
const FEW: u64 = 4_000_000;

/// The engine that is taken for a plan.
pub(crate) fn engine_of(choice: EngineKind, plan: &Plan, is_kept: bool) -> Box<dyn Engine> {
    // Sets are not made level by level, and have no bound of their size that a user could think of.
    let bounded = plan.max_depth < u64::MAX || plan.max_states < u64::MAX || plan.first;
    // Only states that are gone through one by one are kept in one way or another.
    let one_by_one =
        plan.storage != Storage::Exact || plan.partial_order || plan.symmetry || plan.disk.is_some() || is_kept;
    match choice {
        EngineKind::Solver(method) => Box::new(BySolver(method)),
        EngineKind::Symbolic if !bounded => Box::new(Symbolic),
        EngineKind::Automatic if !one_by_one => Box::new(Automatic { bounded }),
        EngineKind::Automatic | EngineKind::Explicit | EngineKind::Symbolic => Box::new(Explicit),
    }
}

/// States one after the other; where they may have no end, first a few of them, then a solver, then all that there is room for.
struct Automatic {
    /// Somebody has said where the search is to end.
    bounded: bool,
}

impl Engine for Automatic {
    fn run(&self, task: Task<'_, '_, '_>) -> Result<Ended, NoStart> {
        let Task { program, plan, solvers, heed, .. } = task;
        let (endless, asks) = (has_infinite_values(program), solvers.name().is_ok());
        let whole = self.bounded || !(endless && asks);
        let few = Plan { max_states: if whole { plan.max_states } else { FEW }, ..plan.clone() };
        let first = Task { program, plan: &few, solvers: &mut *solvers, keeper: None, heed: &mut *heed };
        let mut ended = Explicit.run(first)?;
        let full = matches!(ended.stop, Some(Stop::States | Stop::Memory));
        let memory = ended.stop == Some(Stop::Memory);
        let mut solved = None;
        if ((endless && full) || !ended.unbounded.is_empty()) && ended.stop != Some(Stop::Asked) && asks {
            // What solvers have no place for, or do not know, stays as it is.
            solved = solve(program, plan, Method::Portfolio, solvers, &mut |progress| heed.at(progress)).ok();
            if solved.as_ref().is_some_and(|solved| solved.left.is_empty()) {
                ended.take(solved);
                return Ok(ended);
            }
        }
        let cause = plan.settings.interrupt.cause().filter(|cause| *cause == Cause::Asked);
        if whole || !full || memory || cause.is_some() {
            if full {
                ended.stop = cause.map(Stop::from).or(ended.stop);
            }
            ended.take(solved);
            return Ok(ended);
        }
        let (found, odd) = (std::mem::take(&mut ended.found), std::mem::take(&mut ended.odd));
        drop(ended);
        // What was given back makes room for what comes.
        plan.settings.interrupt.relieve();
        let mut ended = unless_stopped(Explicit.run(Task { program, plan, solvers, keeper: None, heed }))?;
        // It may have been ended before it came as far as the search before it.
        found.into_iter().for_each(|(target, trace)| _ = ended.found.entry(target).or_insert(trace));
        ended.odd.extend(odd);
        ended.take(solved);
        Ok(ended)
    }
}

/// A search that comes after another one: where it was stopped before it began, what was found before still counts.
fn unless_stopped(ended: Result<Ended, NoStart>) -> Result<Ended, NoStart> {
    match ended {
        Err(NoStart::Stopped(stop)) => Ok(Ended { stop: Some(stop), ..Ended::without_states(EngineKind::Explicit) }),
        ended => ended,
    }
}

/// Whether some location has infinitely many values to take, or some domain may grow.
fn has_infinite_values(program: &Program) -> bool {
    let kept = |kind| matches!(kind, FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Shared);
    let mut functions = program.functions.iter().filter(|function| kept(function.kind) && !function.library);
    functions.any(|function| !is_finite(program, function.codomain))
        || program.rules.iter().any(|rule| matches!(rule, Rule::Extend { .. }))
}

/// Whether a domain has finitely many elements, as far as its kind tells.
fn is_finite(program: &Program, domain: DomainId) -> bool {
    match &program.domain(domain).kind {
        DomainKind::Basic(basic) => {
            !matches!(basic, Basic::Integer | Basic::Natural | Basic::Real | Basic::Complex | Basic::String)
        }
        DomainKind::Prod(parts) => parts.iter().all(|part| is_finite(program, *part)),
        DomainKind::Powerset(of) => is_finite(program, *of),
        DomainKind::Map(from, to) => is_finite(program, *from) && is_finite(program, *to),
        DomainKind::Seq(_) | DomainKind::Bag(_) | DomainKind::Any => false,
        _ => true,
    }
}
