//! Which engine goes through the states: one after the other, or as sets; or a solver, which proves what it can.
//!
//! In: a plan. Out: what any has found, in one form. INVARIANT: whichever it is, nothing Holds by one that is violated by
//! another; a shortest run may be another one.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use explore::{Trouble, Unbounded, Widening};
use machine::Cause;
use model::Basic;
use program::{DomainId, DomainKind, FunctionKind, Program, Rule};
use solve::session::Solvers;

use crate::again::made_again;
use crate::check::{Engine, NoStart};
use crate::checkpoint::{Keeper, Unfit};
use crate::heed::Heed;
use crate::partial_order::Unreduced;
use crate::search::{Plan, Progress, Search, Stop, Target, widened};
use crate::solver::{Left, Method, Proof, Solved, Unsolved, solve};
use crate::storage::Storage;
use crate::symbolic::Reach;
use crate::symmetry::Symmetry;
use crate::trace::Trace;

/// LIMIT: of states that may have no end so many are gone through before a solver is asked.
const FEW: u64 = 4_000_000;

/// A search of either engine that has ended.
pub(crate) struct Ended {
    /// What was found, with a shortest run to it.
    pub found: BTreeMap<Target, Trace>,
    /// What was found with a run that the machine does not make.
    pub odd: BTreeSet<Target>,
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
    heed: &mut Heed<'_>,
) -> Result<Ended, NoStart> {
    // Sets are not made level by level, and have no bound of their size that a user could think of.
    let bounded = plan.max_depth < u64::MAX || plan.max_states < u64::MAX || plan.first;
    match engine {
        Engine::Symbolic if !bounded => Ok(symbolic(program, plan, &mut |progress| heed.at(progress))?),
        Engine::Solver(method) => by_solver(program, plan, method, solvers, &mut |progress| heed.at(progress)),
        // Only states that are gone through one by one are kept in one way or another.
        Engine::Automatic
            if plan.storage == Storage::Exact
                && !(plan.partial_order || plan.symmetry)
                && plan.disk.is_none()
                && keeper.is_none() =>
        {
            let (endless, asks) = (has_infinite_values(program), solvers.name().is_ok());
            // Sets are for whoever names them: the library that makes them has once given nodes away twice (`apart`), and what
            // mends that has not been tried for long enough to be what is taken unasked.
            let whole = bounded || !(endless && asks);
            let few = Plan { max_states: if whole { plan.max_states } else { FEW }, ..plan.clone() };
            let mut ended = explicit(program, &few, None, heed)?;
            let full = matches!(ended.stop, Some(Stop::States | Stop::Memory));
            let memory = ended.stop == Some(Stop::Memory);
            let mut solved = None;
            if ((endless && full) || !ended.unbounded.is_empty()) && ended.stop != Some(Stop::Asked) && asks {
                // What solvers have no place for, or do not know, stays as it is.
                solved = solve(program, plan, Method::Portfolio, solvers, &mut |progress| heed.at(progress)).ok();
                let decided = solved.as_ref().is_some_and(|solved| solved.left.is_empty());
                if decided {
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
            let mut ended = unless_stopped(explicit(program, plan, None, heed))?;
            // It may have been ended before it came as far as the search before it.
            found.into_iter().for_each(|(target, trace)| _ = ended.found.entry(target).or_insert(trace));
            ended.odd.extend(odd);
            ended.take(solved);
            Ok(ended)
        }
        _ => explicit(program, plan, keeper, heed),
    }
}

/// A search that comes after another one: where it was stopped before it began, what was found before still counts.
fn unless_stopped(ended: Result<Ended, NoStart>) -> Result<Ended, NoStart> {
    match ended {
        Err(NoStart::Stopped(stop)) => Ok(Ended { stop: Some(stop), ..Ended::without_states(Engine::Explicit) }),
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
    let mut ended = Ended { progress, ..Ended::without_states(Engine::Solver(method)) };
    ended.take(Some(solved));
    Ok(ended)
}

impl Ended {
    /// Nothing is known of states.
    fn without_states(engine: Engine) -> Ended {
        Ended {
            found: BTreeMap::new(),
            odd: BTreeSet::new(),
            stop: None,
            omission: None,
            unreduced: None,
            symmetry: None,
            progress: Progress::default(),
            unbounded: BTreeSet::new(),
            unknown: BTreeSet::new(),
            width: (0, 0),
            executed: Vec::new(),
            engine,
            proved: BTreeMap::new(),
            left: BTreeMap::new(),
            solver: None,
        }
    }

    /// Keeps of what was found only what the machine comes to by the same runs.
    fn judged(mut self, program: &Arc<Program>, plan: &Plan) -> Ended {
        let Ended { found, odd, .. } = &mut self;
        found.retain(|target, trace| {
            let made = made_again(program, &plan.settings, trace, Some(*target));
            if !made {
                odd.insert(*target);
            }
            made
        });
        self
    }

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
    heed: &mut Heed<'_>,
) -> Result<Ended, NoStart> {
    // LIMIT: a search that is kept has its states in memory.
    let spills = plan.storage == Storage::Exact && keeper.is_none();
    let symmetry = plan.symmetry && !plan.partial_order && keeper.is_none();
    let plan = &Plan { disk: plan.disk.clone().filter(|_| spills), symmetry, ..plan.clone() };
    let mut search = Search::run(program, plan, keeper, heed).map_err(|unfit| match unfit {
        Unfit::Refused(refusal) => NoStart::Refused(refusal),
        Unfit::Trouble(trouble) => NoStart::from(trouble),
    })?;
    let traces = search.traces(heed);
    let ended = Ended {
        odd: BTreeSet::new(),
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
    };
    Ok(ended.judged(program, plan))
}

/// Searches by sets.
fn symbolic(program: &Arc<Program>, plan: &Plan, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<Ended, Trouble> {
    let ended = widened(|widening| apart(program, plan, widening, watch))?;
    Ok(ended.judged(program, plan))
}

/// Searches by sets in a thread of its own: no operation on sets can be ended before it is done. LIMIT: where whoever waits has had
/// enough the thread is left to itself after a moment, and what it would have found is not known.
///
/// INVARIANT: no thread ever has two managers of diagrams, and all that belongs to one is dropped where it was made. The library
/// keeps, for each thread, the places of new nodes that the thread has taken from a manager, and knows the manager by its
/// address alone: a thread that went on to another manager at the address of one that is gone would put nodes where others are.
fn apart(
    program: &Arc<Program>,
    plan: &Plan,
    widening: &Widening,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Ended, Trouble> {
    let (sender, news) = channel();
    let widening = widening.clone();
    let goes_on = Arc::new(AtomicBool::new(true));
    let (program, thread_plan, asked) = (Arc::clone(program), plan.clone(), Arc::clone(&goes_on));
    let body = move || {
        let mut told = |progress: &Progress| {
            // Whoever waits may be gone.
            let _ = sender.send(News::Progress(*progress));
            asked.load(Ordering::Relaxed)
        };
        let ended = by_sets(&program, &thread_plan, &widening, &mut told);
        let _ = sender.send(News::Ended(Box::new(ended)));
    };
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(body).expect("a thread can be made");
    let (mut progress, mut waited) = (Progress::default(), 0);
    loop {
        match news.recv_timeout(BETWEEN) {
            Ok(News::Progress(further)) => progress = further,
            Ok(News::Ended(ended)) => return *ended,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match thread.join() {
                Err(panic) => std::panic::resume_unwind(panic),
                Ok(()) => unreachable!("it sends what it came to before it ends"),
            },
        }
        if !watch(&progress) {
            goes_on.store(false, Ordering::Relaxed);
        }
        let cause = plan.settings.interrupt.cause();
        let stop = cause.map(Stop::from).or((!goes_on.load(Ordering::Relaxed)).then_some(Stop::Asked));
        waited += u32::from(stop.is_some());
        if stop.is_some() && waited > GRACE {
            return Ok(Ended { stop, progress, ..Ended::without_states(Engine::Symbolic) });
        }
    }
}

/// What the thread that searches tells.
enum News {
    Progress(Progress),
    Ended(Box<Result<Ended, Trouble>>),
}

/// How often it is looked at whether whoever waits has had enough.
const BETWEEN: Duration = Duration::from_millis(50);
/// LIMIT: so often until an operation on sets is waited for no longer.
const GRACE: u32 = 20;
/// Operations on sets go as deep as there are variables, and are asked for along trees of steps.
const STACK: usize = 256 << 20;

fn by_sets(
    program: &Arc<Program>,
    plan: &Plan,
    widening: &Widening,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Ended, Trouble> {
    let mut reach = Reach::attempt(program, plan, widening, watch)?;
    let traces = reach.traces();
    Ok(Ended {
        odd: BTreeSet::new(),
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
