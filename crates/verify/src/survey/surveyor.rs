//! The survey: explores all states one after another and records what happens in their steps, and where first.
//!
//! In: a program and bounds. Out: a [`Survey`]: sightings, each with a shortest run to it; the values of locations; the
//! extent of the search. Review and test generation read it. INVARIANT: there is one worker, so the first sighting is
//! always the same; the explorer makes the same steps as in verification.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use explore::{Explorer, Interner, Met, Outcome, Told, Trouble, Truth, Unbounded, Widening};
use machine::{Cause, Location, Observation, Value};
use program::{DomainId, Program};
use rustc_hash::FxHashSet;

use crate::explorers::widened;
use crate::options::Options;
use crate::plan::Plan;
use crate::progress::{Progress, Stop};
use crate::question::Question;
use crate::report::{NoStart, Reason};
use crate::table::Table;

/// How many states are expanded before the caller is asked whether to go on.
const ROUND: usize = 1 << 6;
/// Stands for the parent of an initial state.
const NONE: u32 = u32::MAX;

/// An event in some step, and where it happened first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sighting {
    /// The event.
    pub observation: Observation,
    /// Whether the step succeeds.
    pub made: bool,
    /// The distance of its state from an initial one.
    pub depth: u32,
    pub(super) state: u32,
    pub(super) picks: Vec<u32>,
}

impl Sighting {
    /// An event on a random walk; its first place is unknown.
    pub fn at_random(observation: Observation) -> Sighting {
        Sighting { observation, made: true, depth: 0, state: NONE, picks: Vec::new() }
    }

    /// Whether both are in the same step.
    pub fn same_step(&self, other: &Sighting) -> bool {
        self.state == other.state && self.picks == other.picks
    }
}

/// A survey that has ended.
#[derive(Debug)]
pub struct Survey {
    pub(super) explorer: Explorer,
    pub(super) table: Table,
    parents: Vec<u32>,
    /// In the order of discovery, the nearest first.
    pub sightings: Vec<Sighting>,
    met: Met,
    /// For each state, the step by which it was discovered, once computed, and the events in it.
    pub(super) told: BTreeMap<u32, (Told, Vec<Observation>)>,
    /// Why it ended early; `None` if all states were explored.
    pub stop: Option<Stop>,
    /// How far it came.
    pub progress: Progress,
    /// Why an event that was not seen may still happen.
    pub reasons: Vec<Reason>,
    /// Whether some step led to a state that does not count.
    left_out: bool,
}

/// Surveys the states of a program. With `lawful`, states and steps that violate an invariant are skipped.
///
/// # Errors
/// There is no initial state.
pub fn survey(
    program: &Arc<Program>,
    options: &Options,
    lawful: bool,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Survey, NoStart> {
    let plan = plan_for(program, options, lawful);
    let mut survey = widened(|widening| Surveyor::begin(program, &plan, widening, Care::Least)?.run(watch))?;
    if survey.left_out {
        // Something may have been seen in a step that does not count, and not again where it does.
        survey = widened(|widening| Surveyor::begin(program, &plan, widening, Care::Most)?.run(watch))?;
    }
    let mut reasons: BTreeSet<Reason> = survey.reasons.drain(..).collect();
    reasons.extend(survey.stop.map(Reason::Stopped));
    // Where invariants leave nothing, assumptions need not.
    if survey.stop.is_none() && survey.table.len() == 0 && !reasons.contains(&Reason::Unlawful) {
        reasons.insert(Reason::Vacuous);
    }
    reasons.extend(survey.explorer.unbounded().iter().copied().map(Reason::Unbounded));
    reasons.extend(options.bounds.keys().copied().map(Reason::Bounded));
    survey.reasons = reasons.into_iter().collect();
    // Findings are reported however long that takes.
    survey.explorer.ignore_interrupts();
    Ok(survey)
}

/// The plan of a survey or a walk: what is `wanted` in it must hold of all that it passes through, as what is `assumed` must.
pub(crate) fn plan_for(program: &Program, options: &Options, lawful: bool) -> Plan {
    let mut plan = Question::of(program, options).plan;
    plan.settings.observed = true;
    match lawful {
        true => plan.settings.step_conditions.iter_mut().for_each(|(_, assumed)| *assumed = true),
        false => {
            plan.wanted.clear();
            plan.wanted_steps.clear();
        }
    }
    plan
}

/// Which steps are looked at for what happens in them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Care {
    /// Those that the machine makes, wherever they lead: enough while each leads to a state that counts.
    Least,
    /// All that lead to a state that counts, remembered or not.
    Most,
}

/// What was seen, whether in a step that can be made, and the answers that lead to the step.
type Seen = (Observation, bool, Vec<u32>);

struct Surveyor<'p> {
    plan: &'p Plan,
    care: Care,
    /// What has been seen by [`Care::Most`], and whether in a step that can be made.
    seen: FxHashSet<(Observation, bool)>,
    survey: Survey,
    depth: u32,
    transitions: u64,
    /// Whether the truth of an assumption is unknown in some state.
    unclear: bool,
    /// Whether a state or a step was left out that no assumption excludes, as an invariant does not hold.
    unlawful: bool,
    /// Whether the assumptions leave a step of some state.
    has_step: bool,
}

impl<'p> Surveyor<'p> {
    fn begin(program: &Arc<Program>, plan: &'p Plan, widening: &Widening, care: Care) -> Result<Surveyor<'p>, Trouble> {
        let explorer = Explorer::new(program, plan.settings.clone(), widening, &Arc::new(Interner::default()))?;
        let survey = Survey {
            table: Table::new(explorer.words()),
            explorer,
            parents: Vec::new(),
            sightings: Vec::new(),
            met: Met::default(),
            told: BTreeMap::new(),
            stop: None,
            progress: Progress::default(),
            reasons: Vec::new(),
            left_out: false,
        };
        let seen = FxHashSet::default();
        Ok(Surveyor {
            plan,
            care,
            seen,
            survey,
            depth: 0,
            transitions: 0,
            unclear: false,
            unlawful: false,
            has_step: false,
        })
    }

    fn run(mut self, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<Survey, Trouble> {
        let states = self.survey.explorer.initial().words().to_vec();
        self.take_in(NONE, &states);
        let (mut next, mut level) = (0, self.survey.table.len());
        let mut successors = Vec::new();
        // What was seen so far with too little care is not asked for.
        while next < self.survey.table.len() && !(self.care == Care::Least && self.survey.left_out) {
            if next == level {
                self.depth += 1;
                level = self.survey.table.len();
            }
            self.survey.stop = self.stop(next, watch);
            if self.survey.stop.is_some() {
                break;
            }
            let state: Box<[u64]> = self.survey.table.state(next).into();
            successors.clear();
            let expansion = self.survey.explorer.expand(&state, &mut successors).map_err(Trouble::TooNarrow)?;
            self.survey.left_out |= self.survey.explorer.reads_in_no_step();
            let closely = match self.care {
                Care::Least => Some(Vec::new()),
                Care::Most => self.look_closely(&state)?,
            };
            let Some(mut seen) = closely.filter(|_| !expansion.interrupted) else {
                let cause = self.plan.settings.interrupt.cause().unwrap_or(Cause::Memory);
                self.survey.stop = Some(cause.into());
                break;
            };
            self.transitions += u64::from(expansion.moved);
            // What an assumption leaves out and what an invariant does are one number.
            self.unlawful |= expansion.excluded > 0 && !self.plan.wanted_steps.is_empty();
            seen.extend(
                self.survey.explorer.sightings().into_iter().map(|seen| (seen.observation, seen.made, seen.picks)),
            );
            for (observation, made, picks) in seen {
                let (depth, state) = (self.depth, next as u32);
                self.survey.sightings.push(Sighting { observation, made, depth, state, picks });
            }
            self.has_step =
                self.has_step || !self.plan.leaves_no_step(&mut self.survey.explorer, &expansion, &successors);
            self.take_in(next as u32, &successors);
            next += 1;
        }
        // The state that there was no room for may have been the last one.
        if self.survey.stop.is_none() && self.survey.table.is_full() {
            self.survey.stop = Some(Stop::Memory);
        }
        self.survey.progress = self.progress(next);
        if self.unclear {
            self.survey.reasons.push(Reason::Undecided);
        }
        if self.unlawful {
            self.survey.reasons.push(Reason::Unlawful);
        } else if !self.has_step && next > 0 && self.survey.stop.is_none() {
            self.survey.reasons.push(Reason::Stepless);
        }
        Ok(self.survey)
    }

    fn stop(&self, next: usize, watch: &mut dyn FnMut(&Progress) -> bool) -> Option<Stop> {
        if u64::from(self.depth) >= self.plan.max_depth {
            return Some(Stop::Depth);
        }
        if self.survey.table.len() as u64 >= self.plan.max_states {
            return Some(Stop::States);
        }
        if let Some(cause) = self.plan.settings.interrupt.cause() {
            return Some(cause.into());
        }
        if !next.is_multiple_of(ROUND) {
            return None;
        }
        let progress = self.progress(next);
        if !watch(&progress) {
            return Some(Stop::Asked);
        }
        (progress.bytes > self.plan.max_bytes || self.survey.table.is_full()).then_some(Stop::Memory)
    }

    fn progress(&self, next: usize) -> Progress {
        let states = self.survey.table.len();
        Progress {
            states: states as u64,
            transitions: self.transitions,
            queue: (states - next) as u64,
            depth: u64::from(self.depth),
            bytes: (self.survey.table.bytes() + 4 * self.survey.parents.len()) as u64,
            ..Progress::default()
        }
    }

    /// What happens for the first time in a step of a state that leads to one that counts, or cannot be made; none if whoever waits has had
    /// enough before all steps were made.
    fn look_closely(&mut self, state: &[u64]) -> Result<Option<Vec<Seen>>, Trouble> {
        let mut paths = Vec::new();
        let explorer = &mut self.survey.explorer;
        let whole = explorer.paths(state, &mut |path| paths.push((path.picks, path.outcome)));
        if !whole.map_err(Trouble::TooNarrow)? {
            return Ok(None);
        }
        let (mut found, mut steps) = (Vec::new(), Vec::new());
        let refused = self.survey.explorer.refused();
        for (picks, outcome) in paths {
            let made = match outcome {
                Outcome::Next(next) if self.admits(&next) => true,
                Outcome::Fault(_) => false,
                Outcome::Next(_) | Outcome::Unbounded(_) | Outcome::Excluded => continue,
            };
            for observation in self.survey.explorer.observe(state, &picks) {
                if self.seen.insert((observation, made)) {
                    found.push((observation, made, picks.clone()));
                }
            }
            if made {
                steps.push(picks);
            }
        }
        let read = self.survey.explorer.read_by_refused(state, &refused, &steps);
        found.extend(
            read.into_iter()
                .filter(|(observation, _)| self.seen.insert((*observation, true)))
                .map(|(observation, picks)| (observation, true, picks)),
        );
        // The explorer's own look at them counts for nothing.
        self.survey.explorer.sightings();
        Ok(Some(found))
    }

    /// Whether a state counts: it satisfies the assumptions, and the invariants if they are asked for.
    fn admits(&mut self, state: &[u64]) -> bool {
        let explorer = &mut self.survey.explorer;
        let mut truth = |conditions: &[usize]| {
            let truths = conditions.iter().map(|condition| explorer.truth(*condition, state));
            truths.max().unwrap_or(Truth::True)
        };
        let (assumed, wanted) = (truth(&self.plan.assumed), truth(&self.plan.wanted));
        let is_unclear = |truth: Truth| matches!(truth, Truth::Fault | Truth::Unknown);
        self.unclear |= is_unclear(assumed) || assumed == Truth::True && is_unclear(wanted);
        self.unlawful |= assumed == Truth::True && matches!(wanted, Truth::False | Truth::Undef);
        assumed == Truth::True && wanted == Truth::True
    }

    /// Adds states that count.
    fn take_in(&mut self, parent: u32, states: &[u64]) {
        let mut admitted = Vec::with_capacity(states.len());
        for state in states.chunks_exact(self.survey.explorer.words()) {
            match self.admits(state) {
                true => admitted.extend_from_slice(state),
                false => self.survey.left_out = true,
            }
        }
        let Survey { explorer, table, parents, met, .. } = &mut self.survey;
        table.insert_all(&admitted, &mut |state| {
            parents.push(parent);
            explorer.meet(state, met);
        });
    }
}

impl Survey {
    /// Whether what was not seen never happens.
    pub fn is_complete(&self) -> bool {
        self.reasons.is_empty()
    }

    /// What could not be enumerated.
    pub fn unbounded(&self) -> &BTreeSet<Unbounded> {
        self.explorer.unbounded()
    }

    /// The states of a shortest run to a state, by index.
    pub(super) fn places(&self, state: u32) -> Vec<u32> {
        let parent = |place: &u32| Some(self.parents[*place as usize]).filter(|parent| *parent != NONE);
        let mut places: Vec<u32> = std::iter::successors(Some(state), parent).collect();
        places.reverse();
        places
    }

    /// The location with a number, as observations name it.
    pub fn location(&self, index: u32) -> Location {
        self.explorer.location(index)
    }

    /// Whether observations name a location by its number.
    pub fn is_numbered(&self, location: &Location) -> bool {
        self.explorer.is_numbered(location)
    }

    /// The elements of a domain that are the same in all states, if there are at most `most`.
    pub fn elements(&mut self, domain: DomainId, most: usize) -> Option<Vec<Value>> {
        self.explorer.elements(domain, most)
    }

    /// The values of locations in all discovered states.
    pub fn values(&mut self) -> BTreeMap<Location, BTreeSet<Value>> {
        self.explorer.values_met(&self.met)
    }
}
