//! Chooses an engine: the one that was named; otherwise explicit search, and a solver if that has no end.
//!
//! In: the engine option and the plan. Out: an [`Engine`]. Symbolic search is used only if named: its library once
//! handed out nodes twice (`symbolic/apart.rs`), and the remedy has not been tested for long enough.

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

/// LIMIT: if the states may be infinitely many, this many are explored before a solver is asked.
const FEW: u64 = 4_000_000;

/// The engine for a plan.
pub(crate) fn engine_of(choice: EngineKind, plan: &Plan, is_kept: bool) -> Box<dyn Engine> {
    // Symbolic search does not proceed level by level, and its size has no bound that a user could give.
    let bounded = plan.max_depth < u64::MAX || plan.max_states < u64::MAX || plan.first;
    // These options apply only to single states.
    let one_by_one =
        plan.storage != Storage::Exact || plan.partial_order || plan.symmetry || plan.disk.is_some() || is_kept;
    match choice {
        EngineKind::Solver(method) => Box::new(BySolver(method)),
        EngineKind::Symbolic if !bounded => Box::new(Symbolic),
        EngineKind::Automatic if !one_by_one => Box::new(Automatic { bounded }),
        EngineKind::Automatic | EngineKind::Explicit | EngineKind::Symbolic => Box::new(Explicit),
    }
}

/// Explicit search. If it may not end: first a few states, then a solver, then all states that there is room for.
struct Automatic {
    /// Whether the user bounded the search.
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
            // If the solver cannot encode the model or does not know, the result of the search stands.
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
        // The memory of the first search has been freed.
        plan.settings.interrupt.relieve();
        let mut ended = unless_stopped(Explicit.run(Task { program, plan, solvers, keeper: None, heed }))?;
        // The second search may have ended earlier than the first.
        found.into_iter().for_each(|(target, trace)| _ = ended.found.entry(target).or_insert(trace));
        ended.odd.extend(odd);
        ended.take(solved);
        Ok(ended)
    }
}

/// If a second search is stopped before it begins, the findings of the first still count.
fn unless_stopped(ended: Result<Ended, NoStart>) -> Result<Ended, NoStart> {
    match ended {
        Err(NoStart::Stopped(stop)) => Ok(Ended { stop: Some(stop), ..Ended::without_states(EngineKind::Explicit) }),
        ended => ended,
    }
}

/// Whether a location can have infinitely many values, or a domain may grow.
fn has_infinite_values(program: &Program) -> bool {
    let kept = |kind| matches!(kind, FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Shared);
    let mut functions = program.functions.iter().filter(|function| kept(function.kind) && !function.library);
    functions.any(|function| !is_finite(program, function.codomain))
        || program.rules.iter().any(|rule| matches!(rule, Rule::Extend { .. }))
}

/// Whether a domain is finite, judged by its kind.
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
