//! The states that one worker of a search owns.
//!
//! In: a plan, and successors from all workers ([`crate::explicit::crew`]). Out: the states that hash to this shard, by distance, and the
//! findings in them; the successors of its states. It must not know who works on it, nor when.

use std::collections::BTreeSet;
use std::sync::Arc;

use explore::{Expansion, Explorer, Orbits, Truth, Unbounded, Widening, hash};
use syntax::Span;

use crate::explicit::edges::{Edges, LEFT_OUT};
use crate::explicit::lineage::Lineage;
use crate::explicit::tally::Tally;
use crate::partial_order::Reduction;
use crate::plan::Plan;
use crate::storage::Store;
use crate::target::{Found, Target};

/// How many states a worker expands before successors are exchanged.
const ROUND: usize = 1 << 12;
/// A worker stops expanding in a round at this many words of successors.
const BULK: u64 = 1 << 20;

/// A worker's states, and what it knows of them.
#[derive(Debug)]
pub(crate) struct Shard {
    pub store: Store,
    /// For each level that is or was expanded, where its states end in the store.
    pub levels: Vec<usize>,
    pub found: Vec<Found>,
    pub transitions: u64,
    /// How many states' steps were made by machine code.
    pub compiled: u64,
    /// How many of them before this explorer.
    pub compiled_before: u64,
    /// Of how many states the assumptions leave no step.
    pub blocked: u64,
    /// The next state to expand.
    pub next: usize,
    /// Conditions whose truth is unknown in some state.
    pub unknown: BTreeSet<usize>,
    pub widening: Widening,
    /// The steps of the state for which that was found are still to be made.
    pub is_retried: bool,
    pub unbounded: BTreeSet<Unbounded>,
    /// How often each rule ran; only whether it is 0 matters.
    pub executed: Vec<u64>,
    /// The partial-order reduction, if it is used.
    pub reduction: Option<Arc<Reduction>>,
    /// The symmetry reduction, if it is used.
    pub orbits: Option<Arc<Orbits>>,
    /// Where the order of elements was found to matter.
    pub order_mattered: Option<Span>,
    /// For a pass that only looks for runs to some states.
    pub lineage: Option<Lineage>,
    /// The edges walked, if they are wanted: only of states that are stored in full, in memory, and in several words.
    pub edges: Option<Edges>,
    /// Some work was left undone because the caller asked to stop.
    pub cut: bool,
    /// Room for the successors of a state.
    pub successors: Vec<u64>,
}

/// The worker that owns a state.
pub(crate) fn owner(state: &[u64], workers: usize) -> usize {
    if workers == 1 { 0 } else { (hash(state) & 0xffff) as usize % workers }
}

/// Keeps the nearest finding, and of equally near ones the least.
pub(crate) fn note(found: &mut Vec<Found>, one: Found, explorer: &mut Explorer) {
    match found.iter_mut().find(|other| other.target == one.target) {
        None => found.push(one),
        Some(other) => {
            let nearer = one.depth.cmp(&other.depth).then_with(|| explorer.compare(&one.state, &other.state));
            if nearer.is_lt() {
                *other = one;
            }
        }
    }
}

impl Shard {
    /// A shard without states.
    pub fn new(store: Store, reduction: &Option<Arc<Reduction>>) -> Shard {
        Shard {
            store,
            levels: Vec::new(),
            found: Vec::new(),
            transitions: 0,
            compiled: 0,
            compiled_before: 0,
            blocked: 0,
            next: 0,
            unknown: BTreeSet::new(),
            widening: Widening::default(),
            is_retried: false,
            unbounded: BTreeSet::new(),
            executed: Vec::new(),
            reduction: reduction.clone(),
            orbits: None,
            order_mattered: None,
            lineage: None,
            edges: None,
            cut: false,
            successors: Vec::new(),
        }
    }

    /// Findings at distances of which this worker has explored all states. Incoming states are at the next distance;
    /// steps may be missing at this one.
    pub fn certain(&self) -> impl Iterator<Item = &Found> {
        let (steps, states) = (self.levels.len().saturating_sub(1), self.levels.len());
        self.found.iter().filter(move |found| match found.target {
            Target::Condition(_) => found.depth < states,
            Target::Fault(_) | Target::Rest | Target::StepCondition(_) => found.depth < steps,
        })
    }

    pub(super) fn report(&self) -> Tally {
        let end = self.levels.last().copied().unwrap_or(0);
        Tally {
            states: self.store.len() as u64,
            transitions: self.transitions,
            compiled: self.compiled,
            blocked: self.blocked,
            left: (end - self.next) as u64,
            fresh: (self.store.len() - end) as u64,
            pending: self.store.pending() as u64,
            bytes: (self.store.bytes() + self.edges.as_ref().map_or(0, Edges::bytes)) as u64,
            spilled: self.store.spilled() as u64,
            full: self.store.is_full(),
            lost: self.store.is_lost(),
            narrow: !self.widening.is_empty() || self.order_mattered.is_some(),
            found: !self.found.is_empty(),
            certain: self.certain().count(),
            cut: self.cut,
            broken: false,
        }
    }

    /// Makes the steps of some states on the level and sends the successors to their owners. Returns `false` if the
    /// caller asked to stop while a state's steps were made; that state then counts as not expanded.
    pub(super) fn expand_round(
        &mut self,
        explorer: &mut Explorer,
        plan: &Plan,
        quota: u64,
        sent: &mut [Vec<u64>],
    ) -> bool {
        let mut successors = std::mem::take(&mut self.successors);
        let whole = self.expand_some(explorer, plan, quota, sent, &mut successors);
        successors.clear();
        self.successors = successors;
        whole
    }

    fn expand_some(
        &mut self,
        explorer: &mut Explorer,
        plan: &Plan,
        quota: u64,
        sent: &mut [Vec<u64>],
        successors: &mut Vec<u64>,
    ) -> bool {
        let end = self.levels.last().copied().unwrap_or(0).min(self.next + ROUND);
        let words = explorer.words();
        let (mut made, most) = (0, quota.min(BULK / words as u64));
        let workers = sent.len();
        if self.next < end && !self.store.load(self.next..end) {
            return true;
        }
        while self.next < end && made < most {
            if plan.settings.interrupt.is_raised() {
                return false;
            }
            let state = self.store.state(self.next);
            self.next += 1;
            let direct = workers == 1 && self.lineage.is_none();
            let out = if direct { &mut sent[0] } else { &mut *successors };
            let begin = out.len();
            let expanded = match &self.reduction {
                None => explorer.expand(state, out),
                Some(reduction) => reduction.expand(explorer, state, out),
            };
            if let (Some(orbits), Ok(_)) = (&self.orbits, &expanded) {
                explorer.normalise(orbits, &mut out[begin..]);
            }
            match expanded {
                Ok(expansion) if expansion.interrupted => {
                    out.truncate(begin);
                    self.next -= 1;
                    self.look_at(explorer, plan, self.next, &expansion);
                    return false;
                }
                Ok(expansion) => {
                    if let Some(edges) = &mut self.edges {
                        let walked = out[begin..].chunks_exact(words);
                        walked.for_each(|successor| edges.leads_to(owner(successor, workers)));
                        edges.end(&expansion);
                    }
                    self.blocked += u64::from(plan.leaves_no_step(explorer, &expansion, &out[begin..]));
                    self.transitions += u64::from(expansion.moved);
                    made += u64::from(expansion.moved);
                    if expansion.moved == 0 || expansion.failed > 0 || expansion.faults != [0; 3] {
                        self.look_at(explorer, plan, self.next - 1, &expansion);
                        if !self.widening.is_empty() {
                            return true;
                        }
                    }
                }
                Err(widening) => {
                    out.truncate(begin);
                    if widening.is_outgrown() {
                        (self.next, self.is_retried) = (self.next - 1, true);
                    }
                    self.widening = widening;
                    return true;
                }
            }
            for successor in successors.chunks_exact(words) {
                let out = owner(successor, sent.len());
                sent[out].extend_from_slice(successor);
                if let Some(lineage) = &self.lineage {
                    sent[out].extend_from_slice(lineage.ancestor(&self.store, self.next - 1, self.levels.len() - 1));
                }
            }
            successors.clear();
        }
        true
    }

    /// Checks an expansion for targets.
    #[cold]
    fn look_at(&mut self, explorer: &mut Explorer, plan: &Plan, place: usize, expansion: &Expansion) {
        let depth = self.levels.len() - 1;
        let state: Box<[u64]> = self.store.state(place).into();
        let mut targets = Vec::new();
        targets.extend((0..3).filter(|class| expansion.faults[*class] > 0).map(Target::Fault));
        let rests = expansion.moved == 0 && expansion.stayed > 0 && !expansion.interrupted;
        if rests && expansion.faults == [0; 3] && expansion.unbounded == 0 {
            let may_rest = plan.terminal.map(|terminal| explorer.truth(terminal, &state));
            match may_rest {
                Some(Truth::True) => {}
                // Evaluation was interrupted, and the search ends.
                Some(Truth::Unknown) if plan.settings.interrupt.is_raised() => self.cut = true,
                Some(Truth::Fault | Truth::Unknown) => {
                    self.unknown.extend(plan.terminal);
                }
                _ => targets.push(Target::Rest),
            }
        }
        let missing = |target: &usize| {
            !self.found.iter().any(|found| found.target == Target::StepCondition(*target) && found.depth < depth)
        };
        let mut failing: BTreeSet<usize> =
            plan.wanted_steps.iter().copied().filter(|wanted| expansion.may_fail(*wanted)).collect();
        if failing.iter().filter(|wanted| **wanted >= Expansion::TOLD).any(missing) {
            let mut failed = BTreeSet::new();
            let looked = explorer.paths(&state, &mut |path| failed.extend(path.failed));
            if let Err(widening) = looked {
                self.widening = widening;
            }
            failing.retain(|wanted| failed.contains(&(*wanted as u32)));
        }
        targets.extend(failing.into_iter().filter(missing).map(Target::StepCondition));
        for target in targets {
            note(&mut self.found, Found { target, depth, state: state.clone() }, explorer);
        }
    }

    /// Adds incoming states, or settles pending ones. Where edges are kept, says where each has its place.
    pub(super) fn take_in(
        &mut self,
        explorer: &mut Explorer,
        plan: &Plan,
        states: &mut Vec<u64>,
        settles: bool,
        places: &mut Vec<u32>,
    ) {
        let Shard { store, levels, found, unknown, lineage, edges, cut, .. } = self;
        let first = places.len();
        if !plan.assumed.is_empty() {
            let mut admitted = Vec::with_capacity(states.len());
            let words = explorer.words();
            for state in states.chunks_exact(if lineage.is_some() { 2 * words } else { words }) {
                let mut all = true;
                for condition in &plan.assumed {
                    let truth = explorer.truth(*condition, &state[..words]);
                    all &= truth == Truth::True;
                    match truth {
                        Truth::Unknown if plan.settings.interrupt.is_raised() => *cut = true,
                        Truth::Fault | Truth::Unknown => _ = unknown.insert(*condition),
                        _ => {}
                    }
                }
                if all {
                    admitted.extend_from_slice(state);
                }
                if edges.is_some() {
                    places.push(if all { 0 } else { LEFT_OUT });
                }
            }
            *states = admitted;
        }
        let depth = levels.len();
        let mut meet = |state: &[u64]| {
            if let Some(lineage) = lineage {
                lineage.meet(depth, state);
                return;
            }
            for condition in &plan.wanted {
                match explorer.truth(*condition, state) {
                    Truth::True => {}
                    Truth::Unknown if plan.settings.interrupt.is_raised() => *cut = true,
                    Truth::Unknown => {
                        unknown.insert(*condition);
                    }
                    Truth::False | Truth::Undef | Truth::Fault => {
                        let target = Target::Condition(*condition);
                        note(found, Found { target, depth, state: state.into() }, explorer);
                    }
                }
            }
        };
        match (settles, edges, store) {
            (true, _, store) => store.settle(&mut meet),
            (false, Some(_), Store::Exact(table)) => {
                // Those that are admitted have a slot already.
                let assumes = !plan.assumed.is_empty();
                let mut slots = first;
                table.insert_each(states, &mut meet, &mut |place| match assumes {
                    false => places.push(place),
                    true => {
                        slots += places[slots..].iter().take_while(|place| **place == LEFT_OUT).count();
                        places[slots] = place;
                        slots += 1;
                    }
                });
            }
            (false, _, store) => store.insert_all(states, &mut meet),
        }
        states.clear();
    }
}
