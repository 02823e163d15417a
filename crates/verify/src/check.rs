//! Carries out a request: an engine explores the states, and its findings become a verdict for each check.
//!
//! In: a program and [`Options`]. Out: a [`Report`]: a verdict for each built-in check and for each property as
//! written. INVARIANT: nothing Holds unless every state was explored and every alternative taken, and there was one; the verdict names
//! what was cut off.

use explore::checkpoint::Keeper;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use program::Program;
use solve::session::Solvers;

use crate::again::made_again;
use crate::choose::engine_of;
use crate::coverage::unreachable_rules;
use crate::engine::{Ended, Task};
use crate::heed::{Heed, Listener};
use crate::options::{EngineKind, Options};
use crate::progress::{Progress, Stop};
use crate::question::{Question, Subject};
use crate::report::{Expected, NoStart, Outcome, Reason, Report, Verdict};
use crate::runs::outcome::{OfRuns, Why};
use crate::runs::{RunPlan, decide_after};
use crate::solver::method::Lacking;
use crate::target::Target;
use crate::temporal::fairness::AgentFairness;
use crate::walk::Walk;

/// Carries out a request. The listener receives progress, and violations while the search goes on.
///
/// # Errors
/// There is no initial state, a solver cannot be asked, or the checkpoint does not fit.
pub(crate) fn verify_request(
    program: &Arc<Program>,
    options: &Options,
    agents: Option<AgentFairness>,
    solvers: &mut dyn Solvers,
    keeper: Option<&mut dyn Keeper>,
    listener: &mut dyn Listener,
) -> Result<Report, NoStart> {
    let mut question = Question::of(program, options);
    // A scheduler's choices are no part of the edges.
    question.plan.edges = agents.is_none() && question.subjects.iter().any(|(_, target)| target.is_none());
    let heed = &mut Heed { listener: &mut *listener, subjects: question.violated(options), told: BTreeMap::new() };
    let task = Task { program, plan: &question.plan, solvers, keeper, heed };
    let mut ended = engine_of(options.engine, &question.plan, task.keeper.is_some()).run(task)?;
    let reasons = reasons(&ended, &question, options);
    let assumed =
        reasons.iter().filter(|reason| matches!(reason, Reason::Bounded(_) | Reason::Vacuous | Reason::Stepless));
    let assumed: Vec<Reason> = assumed.copied().collect();
    // All states may have been explored by then.
    let is_enough = options.first && !ended.found.is_empty();
    let (mut proofs, mut left) = (BTreeMap::new(), BTreeMap::new());
    let by_solver = matches!(ended.engine, EngineKind::Solver(_));
    let (mut of_runs, runs) = match by_solver {
        true => Default::default(),
        // The graph for temporal properties would store all states in full, and there are too many.
        false if ended.omission.is_some() => Default::default(),
        false if is_enough => Default::default(),
        false => {
            let walk = ended.walk.take();
            of_runs(program, &question, options, agents, &reasons, walk, &mut |progress| listener.at(progress))
        }
    };
    let verdicts = question.subjects.iter().map(|(subject, target)| {
        let outcome = match target {
            None if ended.omission.is_some() => Outcome::Unknown(reasons.clone()),
            None if is_enough => Outcome::Unknown(vec![Reason::Stopped(Stop::Found)]),
            None => of_runs.remove(subject).unwrap_or(Outcome::Unknown(vec![Reason::Temporal])),
            Some(target) => match ended.found.remove(target) {
                // With other inputs the state might not be a deadlock.
                Some(_) if *target == Target::Rest && !options.bounds.is_empty() => Outcome::Unknown(reasons.clone()),
                Some(trace) => Outcome::Violated(Box::new(trace)),
                None if ended.odd.contains(target) => {
                    Outcome::Unknown(reasons.iter().copied().chain([Reason::Odd]).collect())
                }
                None if ended.proved.contains_key(target) => {
                    proofs.extend(ended.proved.get(target).map(|proof| (*subject, *proof)));
                    if assumed.is_empty() { Outcome::Holds } else { Outcome::Unknown(assumed.clone()) }
                }
                None if ended.left.contains_key(target) => {
                    left.extend(ended.left.remove(target).map(|why| (*subject, why)));
                    Outcome::Unknown(reasons.iter().copied().chain([Reason::Left]).collect())
                }
                None => {
                    let mut reasons = reasons.clone();
                    if let Target::Condition(condition) = target
                        && ended.unknown.contains(condition)
                    {
                        reasons.push(Reason::Undecided);
                    }
                    if reasons.is_empty() { Outcome::Holds } else { Outcome::Unknown(reasons) }
                }
            },
        };
        Verdict { subject: *subject, outcome }
    });
    let verdicts = verdicts.collect();
    let exhaustive = reasons.is_empty() && !by_solver;
    let unreachable = if exhaustive { unreachable_rules(program, &ended.executed) } else { Vec::new() };
    let complete = ended.stop.is_none() && ended.unbounded.is_empty() && options.bounds.is_empty() && !by_solver;
    let complete = complete && ended.omission.is_none();
    let (storage, omission) = (options.storage, ended.omission.map(Expected));
    let reduced = options.partial_order.then_some(ended.unreduced.map_or(Ok(()), Err));
    let Ended { progress, stop, width, engine, solver, symmetry, .. } = ended;
    Ok(Report {
        verdicts,
        progress,
        stop,
        complete,
        width,
        unreachable,
        storage,
        omission,
        reduced,
        symmetry,
        runs,
        engine,
        proofs,
        left,
        solver,
    })
}

/// The report of a search that was stopped before it began: nothing is known.
pub fn unbegun(program: &Program, options: &Options, stop: Stop) -> Report {
    let subjects = Question::of(program, options).subjects;
    let outcome = Outcome::Unknown(vec![Reason::Stopped(stop)]);
    Report {
        verdicts: subjects.iter().map(|(subject, _)| Verdict { subject: *subject, outcome: outcome.clone() }).collect(),
        engine: EngineKind::Explicit,
        progress: Progress::default(),
        stop: Some(stop),
        complete: false,
        width: (0, 0),
        unreachable: Vec::new(),
        runs: BTreeMap::new(),
        storage: options.storage,
        omission: None,
        reduced: None,
        symmetry: None,
        proofs: BTreeMap::new(),
        left: BTreeMap::new(),
        solver: None,
    }
}

/// The outcomes of temporal properties, and why the unknown ones are unknown. A limit that ended the search does not
/// affect them if their own graph is complete.
fn of_runs(
    program: &Arc<Program>,
    question: &Question,
    options: &Options,
    agents: Option<AgentFairness>,
    reasons: &[Reason],
    walk: Option<Walk>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> (BTreeMap<Subject, Outcome>, BTreeMap<usize, Why>) {
    if question.subjects.iter().all(|(_, target)| target.is_some()) {
        return Default::default();
    }
    let plan = RunPlan {
        settings: question.plan.settings.clone(),
        assumed: question.plan.assumed.clone(),
        agents,
        max_states: options.max_states,
        max_depth: options.max_depth,
        max_bytes: options.max_bytes,
        first: options.first,
    };
    let stays = |reason: &&Reason| !matches!(reason, Reason::Stopped(_));
    let reasons: Vec<Reason> = reasons.iter().filter(stays).copied().collect();
    let mut unknown = BTreeMap::new();
    // The search has begun.
    let decided = decide_after(program, &plan, walk, watch).unwrap_or_default();
    let outcomes = decided.into_iter().map(|(index, decided)| {
        let outcome = match decided {
            OfRuns::Violated(trace) if !made_again(program, &plan.settings, &trace, None) => {
                Outcome::Unknown(vec![Reason::Odd])
            }
            OfRuns::Holds if reasons.is_empty() => Outcome::Holds,
            // Untried inputs may add what one tree of runs lacks, or let an ended run go on, but cannot undo what a single run does.
            OfRuns::Violated(trace) if !(trace.branch || trace.ends) || reasons.is_empty() => Outcome::Violated(trace),
            OfRuns::Holds | OfRuns::Violated(_) => Outcome::Unknown(reasons.clone()),
            // There are no runs, of which nothing could be told.
            OfRuns::Unknown(_) if reasons.contains(&Reason::Vacuous) => Outcome::Unknown(reasons.clone()),
            OfRuns::Unknown(why) => {
                unknown.insert(index, why);
                Outcome::Unknown(vec![Reason::Temporal])
            }
        };
        (Subject::Property(index), outcome)
    });
    (outcomes.collect(), unknown)
}

/// Why a check without a violation is still not known to hold.
fn reasons(search: &Ended, question: &Question, options: &Options) -> Vec<Reason> {
    let mut reasons = BTreeSet::new();
    reasons.extend(search.stop.map(Reason::Stopped));
    reasons.extend(search.omission.map(|_| Reason::Compacted));
    reasons.extend(search.unbounded.iter().copied().map(Reason::Unbounded));
    reasons.extend(options.bounds.keys().copied().map(Reason::Bounded));
    // A search that has ended has met all initial states that the assumptions admit.
    let has_searched = !matches!(search.engine, EngineKind::Solver(_)) && search.stop.is_none();
    if search.none == Some(Lacking::Start) || has_searched && search.progress.states == 0 && search.unbounded.is_empty()
    {
        reasons.insert(Reason::Vacuous);
    }
    let Progress { states, blocked, .. } = search.progress;
    if search.none == Some(Lacking::Step) || has_searched && states > 0 && blocked == states {
        reasons.insert(Reason::Stepless);
    }
    for condition in &question.plan.assumed {
        if search.unknown.contains(condition) {
            reasons.insert(Reason::Assumption(question.property_of(*condition)));
        }
    }
    reasons.into_iter().collect()
}
