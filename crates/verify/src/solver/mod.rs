//! Verification by an SMT solver, for models whose states, inputs or choices cannot be enumerated.
//!
//! In: a program and the targets. Out: findings, with runs that the machine has repeated, and proofs. [`solve::encode`]
//! encodes a step, `relation` the whole program; `bounded` searches for runs, `induction` and `horn` prove that
//! there are none. INVARIANT: a proof counts only if it is also proved that the machine does only what was encoded.

mod bounded;
pub(crate) mod engine;
mod horn;
mod induction;
pub(crate) mod method;
mod relation;
mod replay;
mod unrolling;

use std::collections::BTreeMap;
use std::sync::Arc;

use explore::Trouble;
use program::{Program, PropertyKind};
pub use solve::Outside;
use solve::session::{Session, Silence, Solvers, Verdict};

use crate::plan::Plan;
use crate::progress::Progress;
use crate::target::Target;
use bounded::Bounded;
use induction::Induction;
use method::{Lacking, Solved};
pub use method::{Left, Method, Proof};
use relation::{Relation, Unrelated};
use unrolling::{Patience, Unrolling};

/// Why there is no result.
#[derive(Debug)]
pub(crate) enum Unsolved {
    /// A part of the program cannot be encoded.
    Outside(Outside),
    /// There is no initial state.
    Trouble(Trouble),
    /// There is no solver; a clause says why.
    NoSolver(String),
}

impl From<Unrelated> for Unsolved {
    fn from(unrelated: Unrelated) -> Unsolved {
        match unrelated {
            Unrelated::Outside(outside) => Unsolved::Outside(outside),
            Unrelated::Trouble(trouble) => Unsolved::Trouble(trouble),
        }
    }
}

impl From<Silence> for Unsolved {
    fn from(silence: Silence) -> Unsolved {
        Unsolved::NoSolver(match silence {
            Silence::Broken(reason) => reason,
            Silence::Late | Silence::Stopped => "the solver does not start".to_string(),
        })
    }
}

/// LIMIT: the most steps if the user sets no limit; `SHORT` in a portfolio.
const DEPTH: u64 = 100;
const SHORT: u64 = 12;
/// LIMIT: seconds for one question in a portfolio; `LONG` for property-directed reachability.
const SECONDS: u32 = 10;
const LONG: u32 = 30;

/// Verifies a program by a solver.
pub(crate) fn solve(
    program: &Arc<Program>,
    plan: &Plan,
    method: Method,
    solvers: &mut dyn Solvers,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Solved, Unsolved> {
    let exact = Relation::of(program, plan, true)?;
    // The machine rounds reals: a proof must cover all effects of rounding, whereas runs are first searched with exact
    // numbers.
    let mut provable = Relation::of(program, plan, !exact.inexact)?;
    let solver = solvers.name().map_err(Unsolved::NoSolver)?;
    if method == Method::Reachability && !solver.starts_with("z3") {
        return Err(Unsolved::NoSolver(format!("{solver} has no engine for Horn clauses; z3 has")));
    }
    let portfolio = method == Method::Portfolio;
    let most = match (portfolio, plan.max_depth) {
        (true, depth) => depth.min(SHORT),
        (false, u64::MAX) => DEPTH,
        (false, depth) => depth,
    };
    let interrupt = &plan.settings.interrupt;
    let mut go_on = |depth: u64| watch(&Progress { depth, ..Progress::default() }) && !interrupt.is_raised();
    let mut patience = Patience { seconds: if portfolio { SECONDS } else { u32::MAX }, go_on: &mut go_on, depth: 0 };
    let mut solved = Solved { solver: solver.clone(), ..Solved::default() };
    let mut pending = exact.targets.clone();
    pending.extend(exact.untold.iter().map(|target| (*target, solve::shared::Terms::FALSE)));
    let mut bounded = Bounded::new(program, plan, &exact, solvers.start()?);
    let (mut told, mut late) = (false, None);
    let mut proves = BTreeMap::new();
    if method == Method::Reachability {
        // Runs are searched only for targets that are known to be reachable.
        let reached =
            by_reachability(&mut provable, &BTreeMap::new(), false, solvers, &mut patience, &mut proves, &mut told)?;
        match reached {
            Reached::Told(targets) => bounded.open.retain(|(target, _)| targets.contains(target)),
            Reached::Silent(left) => {
                bounded.open.clear();
                late = Some(left);
            }
        }
    }
    let (mut induction, mut base) = (None, None);
    if matches!(method, Method::Induction | Method::Portfolio) {
        induction = Some(Induction::new(&provable, solvers.start()?));
        if exact.inexact {
            base = Some(Bounded::new(program, plan, &provable, solvers.start()?));
        }
    }
    for _ in 0..=most {
        if bounded.open.is_empty() && induction.as_ref().is_none_or(Induction::is_done) {
            break;
        }
        let looked = bounded.advance(&mut patience);
        if let Err(silence) = looked {
            late = late.or(Some(left_by(silence, bounded.times)));
            break;
        }
        let Some(proof) = &mut induction else { continue };
        let mut advanced = base.as_mut().map_or(Ok(()), |base| base.advance(&mut patience));
        for bounded in std::iter::once(&bounded).chain(&base) {
            for target in bounded.found.keys().chain(&bounded.odd) {
                proof.give_up(Some(*target));
            }
            if bounded.beyond.is_some() {
                proof.give_up(None);
            }
        }
        if advanced.is_ok() {
            advanced = proof.advance(&mut patience);
        }
        if let Err(silence) = advanced {
            // Runs may still be found.
            late = Some(left_by(silence, bounded.times));
            proves.extend(proof.proved.iter().map(|(target, steps)| (*target, Proof::Induction(*steps))));
            told |= proof.told;
            induction = None;
            if portfolio {
                break;
            }
        } else {
            bounded.open.retain(|(target, _)| !proof.proved.contains_key(target));
        }
    }
    if let Some(base) = base {
        bounded
            .found
            .extend(base.found.into_iter().filter(|(target, _)| bounded.open.iter().any(|one| one.0 == *target)));
    }
    if let Some(proof) = induction {
        proves.extend(proof.proved.iter().map(|(target, steps)| (*target, Proof::Induction(*steps))));
        told |= proof.told;
    }
    let stopped = late == Some(Left::Stopped);
    if portfolio && !stopped && !bounded.open.is_empty() && solver.starts_with("z3") {
        patience.seconds = LONG;
        let known: BTreeMap<Target, ()> = pending
            .iter()
            .filter(|(target, _)| !bounded.open.iter().any(|(open, _)| open == target))
            .map(|(target, _)| (*target, ()))
            .collect();
        by_reachability(&mut provable, &known, told, solvers, &mut patience, &mut proves, &mut told)?;
    }
    // Without an initial state, everything can be proved; without a step, much. Only assumptions leave none.
    let assumes = program.properties.iter().any(|property| property.kind == PropertyKind::Invar);
    if assumes && !proves.is_empty() && bounded.found.is_empty() {
        match lacking(&exact, solvers.start()?, &mut patience) {
            Ok(none) => solved.none = none,
            Err(silence) => {
                proves.clear();
                late = late.or(Some(left_by(silence, 0)));
            }
        }
    }
    solved.depth = bounded.times.saturating_sub(1) as u64;
    for (target, _) in pending {
        let left = match proves.get(&target) {
            Some(proof) if told => {
                solved.proved.insert(target, *proof);
                continue;
            }
            _ if bounded.found.contains_key(&target) => continue,
            _ if bounded.odd.contains(&target) => Left::Odd,
            _ if exact.untold.contains(&target) => Left::Untold,
            _ => match (&bounded.beyond, &late) {
                (Some(beyond), _) => Left::Beyond(beyond.clone()),
                (None, Some(left)) => left.clone(),
                (None, None) if exact.inexact => Left::Exact(bounded.times.saturating_sub(1)),
                (None, None) => Left::Depth(bounded.times.saturating_sub(1)),
            },
        };
        solved.left.insert(target, left);
    }
    solved.found = bounded.found;
    Ok(solved)
}

/// What assumptions leave nothing of: an initial state, or a step from one.
fn lacking(
    relation: &Relation,
    session: Box<dyn Session>,
    patience: &mut Patience<'_>,
) -> Result<Option<Lacking>, Silence> {
    let mut unrolling = Unrolling::new(relation, session, true);
    for none in [Lacking::Start, Lacking::Step] {
        match unrolling.possible(&[], patience)? {
            Verdict::Possible => unrolling.step(),
            Verdict::Impossible => return Ok(Some(none)),
            Verdict::Unknown => return Err(Silence::Late),
        }
    }
    Ok(None)
}

fn left_by(silence: Silence, times: usize) -> Left {
    match silence {
        Silence::Late => Left::Late(times),
        Silence::Stopped => Left::Stopped,
        Silence::Broken(reason) => Left::Broken(reason),
    }
}

/// The result of property-directed reachability.
enum Reached {
    /// These targets are reachable; the others were proved unreachable.
    Told(Vec<Target>),
    Silent(Left),
}

/// Proves all targets that are not `known`: first together, then one by one.
fn by_reachability(
    relation: &mut Relation,
    known: &BTreeMap<Target, ()>,
    already: bool,
    solvers: &mut dyn Solvers,
    patience: &mut Patience<'_>,
    proves: &mut BTreeMap<Target, Proof>,
    told: &mut bool,
) -> Result<Reached, Unsolved> {
    let targets: Vec<_> = relation.targets.iter().filter(|(target, _)| !known.contains_key(target)).copied().collect();
    let beyond = if already { solve::shared::Terms::FALSE } else { relation.strays };
    let all = relation.terms.or(targets.iter().map(|one| one.1).chain([beyond]));
    let mut silent = None;
    match horn::reachable(relation, all, &mut *solvers.start()?, patience) {
        Ok(false) => {
            proves.extend(targets.iter().map(|(target, _)| (*target, Proof::Reachability)));
            *told = true;
            return Ok(Reached::Told(Vec::new()));
        }
        Ok(true) => {}
        Err(Silence::Stopped) => return Ok(Reached::Silent(Left::Stopped)),
        Err(silence) => silent = Some(left_by(silence, 0)),
    }
    if !already {
        match horn::reachable(relation, beyond, &mut *solvers.start()?, patience) {
            Ok(reached) => *told |= !reached,
            Err(Silence::Stopped) => return Ok(Reached::Silent(Left::Stopped)),
            Err(silence) => silent = Some(left_by(silence, 0)),
        }
    }
    let mut reached = Vec::new();
    for (target, node) in targets {
        match horn::reachable(relation, node, &mut *solvers.start()?, patience) {
            Ok(true) => reached.push(target),
            Ok(false) => _ = proves.insert(target, Proof::Reachability),
            Err(Silence::Stopped) => return Ok(Reached::Silent(Left::Stopped)),
            Err(silence) => silent = Some(left_by(silence, 0)),
        }
    }
    match silent {
        // Undecided targets may be reachable, so runs are searched anyway.
        Some(left) if reached.is_empty() => Ok(Reached::Silent(left)),
        _ => Ok(Reached::Told(reached)),
    }
}
