//! What is checked of a program, and what each check comes to.
//!
//! In: a program and [`Options`]. Out: a [`Report`]: a verdict for each of the checks that nobody need ask for and for each
//! property as written. INVARIANT: nothing Holds unless every state was met and every alternative taken; what was cut off
//! is named in the verdict.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use explore::{Settings, Trouble, Unbounded};
use machine::{Bounds, Fault, Interrupt, Limits};
use program::{Expression, FunctionId, Program, PropertyKind};
use solve::Outside;
use solve::session::Solvers;
use syntax::Span;

use crate::again::made_again;
use crate::assumed::assumed_bounds;
use crate::checkpoint::{Keeper, Refusal};
use crate::coverage::unreachable_rules;
use crate::engine::{Ended, run_engine};
use crate::heed::{Heed, Listener};
use crate::partial_order::Unreduced;
use crate::runs::{OfRuns, Question, Why, decide};
use crate::search::{Plan, Progress, Stop, Target};
use crate::solver::{Left, Method, Proof};
use crate::storage::Storage;
use crate::storage::disk::Disk;
use crate::symmetry::Symmetry;
use crate::temporal::fairness::AgentFairness;
use crate::trace::Trace;

/// How states are gone through.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Engine {
    /// One after the other, and a solver where that has no end.
    #[default]
    Automatic,
    /// One after the other.
    Explicit,
    /// As sets, by binary decision diagrams.
    Symbolic,
    /// Not at all: by an SMT solver.
    Solver(Method),
}

/// How a program is checked.
#[derive(Debug, Clone)]
pub struct Options {
    /// The machine's limits.
    pub limits: Limits,
    /// How states are gone through.
    pub engine: Engine,
    /// How many workers search.
    pub workers: usize,
    /// The search ends with the first level in which a check is violated.
    pub first: bool,
    /// The most states.
    pub max_states: u64,
    /// The most steps from an initial state.
    pub max_depth: u64,
    /// The most bytes for states.
    pub max_bytes: u64,
    /// The values that inputs are given, where they are not all those of their domains. What Holds under such a bound is
    /// Unknown without.
    pub bounds: Bounds,
    /// States in which this holds may rest.
    pub terminal: Option<Expression>,
    /// Steps are always made by a machine, never remembered.
    pub forgetful: bool,
    /// What is kept of each state; where that is not all of it, nothing Holds.
    pub storage: Storage,
    /// Draws the hash, where less than the state is kept.
    pub seed: u64,
    /// Where the main rule chooses who moves: of moves that do not concern each other one order is enough.
    pub partial_order: bool,
    /// States that differ by a permutation of elements that nothing tells apart are one. They are gone through one by one then;
    /// not with `partial_order`, nor where the search is kept.
    pub symmetry: bool,
    /// Where states go that memory has no room for, if all of each is kept. They are gone through one by one then.
    pub disk: Option<Arc<dyn Disk>>,
    /// Raised from another thread to end whatever takes long; looked at more often than the one who watches is asked.
    pub interrupt: Interrupt,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            limits: Limits::default(),
            engine: Engine::Automatic,
            workers: 1,
            first: false,
            max_states: u64::MAX,
            max_depth: u64::MAX,
            max_bytes: u64::MAX,
            bounds: BTreeMap::new(),
            terminal: None,
            forgetful: false,
            storage: Storage::Exact,
            seed: 0,
            partial_order: false,
            symmetry: false,
            disk: None,
            interrupt: Interrupt::default(),
        }
    }
}

/// What a verdict is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// No step has an inconsistent update set.
    Consistent,
    /// No update has a value outside its location's domain.
    InDomain,
    /// No step meets an undefined guard or operation.
    Defined,
    /// Each state that is not terminal has a step that changes it.
    NoDeadlock,
    /// A property of the program, by its index.
    Property(usize),
}

/// Why it is not known whether a property holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// The search ended before it had met all states.
    Stopped(Stop),
    /// Less than the states was kept, so some may be left out; [`Report::omission`] tells how likely that is.
    Compacted,
    /// Alternatives that cannot be gone through.
    Unbounded(Unbounded),
    /// An input was given only some of its values.
    Bounded(FunctionId),
    /// An assumption could not be evaluated in some state.
    Assumption(usize),
    /// It asks in some state for what cannot be gone through.
    Undecided,
    /// It speaks of runs; [`Report::runs`] tells why it is not known.
    Temporal,
    /// A solver left it open; [`Report::left`] tells why.
    Left,
    /// A run was found that the machine does not make: this program is at fault, not the model.
    Odd,
}

/// What a check comes to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// In every state that can be reached.
    Holds,
    /// Not at the end of this run, which is a shortest one.
    Violated(Box<Trace>),
    /// Not known; why, at least one reason.
    Unknown(Vec<Reason>),
}

/// A check and what it comes to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verdict {
    /// What is checked.
    pub subject: Subject,
    /// What it comes to.
    pub outcome: Outcome,
}

/// What verification came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Report {
    /// The verdicts, the checks that nobody asked for first, then properties in the order of the text.
    pub verdicts: Vec<Verdict>,
    /// What went through the states in the end.
    pub engine: Engine,
    /// How far the search came.
    pub progress: Progress,
    /// Why the search ended early, if it did.
    pub stop: Option<Stop>,
    /// Every state that can be reached was met.
    pub complete: bool,
    /// How many words a state has, and how many bits of them are used.
    pub width: (usize, usize),
    /// Rules that run in no step, though the rule around them or its caller does; only where every state was met.
    pub unreachable: Vec<Span>,
    /// By property: why it is not known whether a property of runs holds, where that is so.
    pub runs: BTreeMap<usize, Why>,
    /// What was kept of each state.
    pub storage: Storage,
    /// Where less than the states was kept: how many are to be expected to have been left out for being taken for others,
    /// which is no less than the probability that any was.
    pub omission: Option<Expected>,
    /// Where partial-order reduction was asked for: that states were reduced, or why not.
    pub reduced: Option<Result<(), Unreduced>>,
    /// Where interchangeable elements were to be found: which there are. States are counted up to their permutations.
    pub symmetry: Option<Symmetry>,
    /// How it was proved what a solver has proved.
    pub proofs: BTreeMap<Subject, Proof>,
    /// Why a solver left something open.
    pub left: BTreeMap<Subject, Left>,
    /// The solver that was asked.
    pub solver: Option<String>,
}

/// An expected number, which is no less than 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected(pub f64);

impl Eq for Expected {}

/// Why nothing could be checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoStart {
    /// An initial state cannot be made.
    Fault(Box<Fault>),
    /// The initial states cannot be gone through.
    Unbounded(Unbounded),
    /// Whoever waits has had enough before all initial states were made.
    Stopped(Stop),
    /// It has a part that solvers have no place for.
    Outside(Outside),
    /// There is no solver: why, as a clause.
    NoSolver(String),
    /// What was kept of a search is none to go on with.
    Refused(Refusal),
}

impl From<Trouble> for NoStart {
    fn from(trouble: Trouble) -> NoStart {
        match trouble {
            Trouble::Fault(fault) => NoStart::Fault(fault),
            Trouble::Unbounded(unbounded) => NoStart::Unbounded(unbounded),
            Trouble::Interrupted(cause) => NoStart::Stopped(cause.into()),
            Trouble::TooNarrow(_) => unreachable!("the search widens its states"),
        }
    }
}

/// Carries out a request. The listener hears of progress, and of violations while the search goes on.
///
/// # Errors
/// There is no initial state, a solver cannot be asked, or what was kept does not fit.
pub(crate) fn verify_request(
    program: &Arc<Program>,
    options: &Options,
    agents: Option<AgentFairness>,
    solvers: &mut dyn Solvers,
    keeper: Option<&mut dyn Keeper>,
    listener: &mut dyn Listener,
) -> Result<Report, NoStart> {
    let questions = Questions::of(program, options);
    let heed = &mut Heed { listener: &mut *listener, subjects: questions.violated(options), told: BTreeMap::new() };
    let mut ended = run_engine(program, &questions.plan, options.engine, solvers, keeper, heed)?;
    let reasons = reasons(&ended, &questions, options);
    let assumed: Vec<Reason> = reasons.iter().filter(|reason| matches!(reason, Reason::Bounded(_))).copied().collect();
    // All states may have been met by then.
    let is_enough = options.first && !ended.found.is_empty();
    let (mut proofs, mut left) = (BTreeMap::new(), BTreeMap::new());
    let by_solver = matches!(ended.engine, Engine::Solver(_));
    let (mut of_runs, runs) = match by_solver {
        true => Default::default(),
        // Their graph keeps all of the states, of which there are too many.
        false if ended.omission.is_some() => Default::default(),
        false if is_enough => Default::default(),
        false => of_runs(program, &questions, options, agents, &reasons, &mut |progress| listener.at(progress)),
    };
    let verdicts = questions.subjects.iter().map(|(subject, target)| {
        let outcome = match target {
            None if ended.omission.is_some() => Outcome::Unknown(reasons.clone()),
            None if is_enough => Outcome::Unknown(vec![Reason::Stopped(Stop::Found)]),
            None => of_runs.remove(subject).unwrap_or(Outcome::Unknown(vec![Reason::Temporal])),
            Some(target) => match ended.found.remove(target) {
                // With other inputs the state might not rest.
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

/// The outcomes of temporal properties, and why those are unknown that are. A limit that ended the search is none for them
/// if their own graph is complete.
fn of_runs(
    program: &Arc<Program>,
    questions: &Questions,
    options: &Options,
    agents: Option<AgentFairness>,
    reasons: &[Reason],
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> (BTreeMap<Subject, Outcome>, BTreeMap<usize, Why>) {
    if questions.subjects.iter().all(|(_, target)| target.is_some()) {
        return Default::default();
    }
    let question = Question {
        settings: questions.plan.settings.clone(),
        assumed: questions.plan.assumed.clone(),
        agents,
        max_states: options.max_states,
        max_depth: options.max_depth,
        max_bytes: options.max_bytes,
        first: options.first,
    };
    let stays = |reason: &&Reason| !matches!(reason, Reason::Stopped(_));
    let reasons: Vec<Reason> = reasons.iter().filter(stays).copied().collect();
    let mut unknown = BTreeMap::new();
    // There are initial states: the search has begun with them.
    let decided = decide(program, &question, watch).unwrap_or_default();
    let outcomes = decided.into_iter().map(|(index, decided)| {
        let outcome = match decided {
            OfRuns::Violated(trace) if !made_again(program, &question.settings, &trace, None) => {
                Outcome::Unknown(vec![Reason::Odd])
            }
            OfRuns::Holds if reasons.is_empty() => Outcome::Holds,
            // Inputs that were not tried may lead to what one tree of runs is found to lack, not undo what one run does.
            OfRuns::Violated(trace) if !trace.branch || reasons.is_empty() => Outcome::Violated(trace),
            OfRuns::Holds | OfRuns::Violated(_) => Outcome::Unknown(reasons.clone()),
            OfRuns::Unknown(why) => {
                unknown.insert(index, why);
                Outcome::Unknown(vec![Reason::Temporal])
            }
        };
        (Subject::Property(index), outcome)
    });
    (outcomes.collect(), unknown)
}

/// What a search is asked for by the properties of a program.
pub(crate) fn plan_of(program: &Program, options: &Options) -> Plan {
    Questions::of(program, options).plan
}

/// Why a check that found nothing is still not known to hold.
fn reasons(search: &Ended, questions: &Questions, options: &Options) -> Vec<Reason> {
    let mut reasons = BTreeSet::new();
    reasons.extend(search.stop.map(Reason::Stopped));
    reasons.extend(search.omission.map(|_| Reason::Compacted));
    reasons.extend(search.unbounded.iter().copied().map(Reason::Unbounded));
    reasons.extend(options.bounds.keys().copied().map(Reason::Bounded));
    for condition in &questions.plan.assumed {
        if search.unknown.contains(condition) {
            reasons.insert(Reason::Assumption(questions.property_of[*condition]));
        }
    }
    reasons.into_iter().collect()
}

/// The checks of a program, as a search is asked for them.
struct Questions {
    plan: Plan,
    subjects: Vec<(Subject, Option<Target>)>,
    /// By condition, the property that it comes from.
    property_of: Vec<usize>,
}

impl Questions {
    /// By what may be found, the check that is violated then. With other inputs a state might not rest.
    fn violated(&self, options: &Options) -> BTreeMap<Target, Subject> {
        let targets = self.subjects.iter().filter_map(|(subject, target)| Some(((*target)?, *subject)));
        targets.filter(|(target, _)| *target != Target::Rest || options.bounds.is_empty()).collect()
    }

    fn of(program: &Program, options: &Options) -> Questions {
        let mut bounds = assumed_bounds(program);
        bounds.extend(options.bounds.iter().map(|(function, values)| (*function, values.clone())));
        let mut settings = Settings { limits: options.limits.clone(), bounds: Arc::new(bounds), ..Settings::default() };
        settings.forgetful = options.forgetful;
        settings.interrupt = options.interrupt.clone();
        let mut plan = Plan {
            settings,
            workers: options.workers,
            first: options.first,
            max_states: options.max_states,
            max_depth: options.max_depth,
            max_bytes: options.max_bytes,
            storage: options.storage,
            seed: options.seed,
            partial_order: options.partial_order,
            symmetry: options.symmetry,
            disk: options.disk.clone(),
            ..Plan::default()
        };
        let mut property_of = Vec::new();
        let mut subjects = vec![
            (Subject::Consistent, Some(Target::Fault(0))),
            (Subject::InDomain, Some(Target::Fault(1))),
            (Subject::Defined, Some(Target::Fault(2))),
            (Subject::NoDeadlock, Some(Target::Rest)),
        ];
        for (index, property) in program.properties.iter().enumerate() {
            let (settings, subject) = (&mut plan.settings, Subject::Property(index));
            let formula = property.formula.clone();
            let assumed = property.kind == PropertyKind::Invar;
            match property.kind {
                PropertyKind::Invariant | PropertyKind::Invar if property.reads_monitored => {
                    let condition = settings.step_conditions.len();
                    settings.step_conditions.push((formula, assumed));
                    if !assumed {
                        plan.wanted_steps.push(condition);
                        subjects.push((subject, Some(Target::StepCondition(condition))));
                    }
                }
                PropertyKind::Invariant | PropertyKind::Invar => {
                    let condition = settings.conditions.len();
                    settings.conditions.push(formula);
                    property_of.push(index);
                    if assumed {
                        plan.assumed.push(condition);
                    } else {
                        plan.wanted.push(condition);
                        subjects.push((subject, Some(Target::Condition(condition))));
                    }
                }
                PropertyKind::Ctl | PropertyKind::Ltl => subjects.push((subject, None)),
                PropertyKind::Justice | PropertyKind::Compassion => {}
            }
        }
        if let Some(terminal) = &options.terminal {
            plan.terminal = Some(plan.settings.conditions.len());
            plan.settings.conditions.push(terminal.clone());
            property_of.push(usize::MAX);
        }
        Questions { plan, subjects, property_of }
    }
}
