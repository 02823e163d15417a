//! A worker of a search, with the states that it owns.
//!
//! In: a plan, and successors from all workers. Out: the states that hash to this worker, by distance, and the findings
//! in them. All workers proceed in rounds: each makes the steps of some of its states on the level and sends the
//! successors to their owners; each takes in what it received; then the first worker decides how to continue.
//! INVARIANT: what a worker receives, and in which order, depends only on the number of workers.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, Barrier, Mutex, PoisonError};

use explore::{Expansion, Explorer, Orbits, Trouble, Truth, Unbounded, Widening};
use syntax::Span;

use crate::checkpoint::journal::Journal;
use crate::explicit::edges::{Edges, LEFT_OUT};
use crate::explicit::lineage::Lineage;
use crate::partial_order::Reduction;
use crate::plan::Plan;
use crate::progress::{Progress, Stop};
use crate::storage::{Storage, Store};
use crate::table::hash;
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
    /// For a checkpoint with numbered values: which states' steps introduced new values.
    pub journal: Option<Journal>,
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
}

/// What all workers share besides their messages.
pub(crate) struct Crew<'a> {
    pub plan: &'a Plan,
    /// A machine cannot move between threads, so each worker creates its own explorer; the first has one.
    pub explore: &'a (dyn Fn() -> Result<Explorer, Trouble> + Sync),
}

/// Successors on their way from one worker to another.
type Mail = Vec<Vec<Mutex<Vec<u64>>>>;
/// Where the owner of successors has put them: by the worker that made them and that which owns them. Empty where no edges are kept.
type Places = Vec<Vec<Mutex<Vec<u32>>>>;

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What workers share at the end of a round.
#[derive(Debug)]
struct Board {
    /// By worker.
    reports: Vec<Tally>,
    decision: Decision,
    /// How many successors each worker may make in the next round before it expands no further state, so that the limit
    /// of states is not exceeded by much.
    quota: u64,
    /// The round was cut short and its results do not count: finding runs repeats whole rounds.
    void: bool,
    /// The edges take too much memory: nobody keeps them any more.
    forgets_edges: bool,
}

/// What a worker reports to the leader.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Tally {
    pub states: u64,
    pub transitions: u64,
    pub compiled: u64,
    pub blocked: u64,
    /// States of this level that still have to be expanded.
    pub left: u64,
    /// States of the next level.
    pub fresh: u64,
    /// States that may turn out not to be new on the next level.
    pub pending: u64,
    pub bytes: u64,
    /// Bytes of files.
    pub spilled: u64,
    pub full: bool,
    /// A file could not be read or written.
    pub lost: bool,
    /// A state did not fit, so the search starts again.
    pub narrow: bool,
    pub found: bool,
    /// The number of findings at distances that were explored completely.
    pub certain: usize,
    /// Some of the round was left undone because the caller asked to stop.
    pub cut: bool,
    /// The worker has panicked.
    pub broken: bool,
}

impl Tally {
    /// The progress of a search, from its workers' reports.
    pub fn progress(reports: &[Tally], depth: u64) -> Progress {
        let sum = |of: fn(&Tally) -> u64| reports.iter().map(of).sum::<u64>();
        let fresh = sum(|report| report.fresh);
        Progress {
            states: sum(|report| report.states),
            transitions: sum(|report| report.transitions),
            queue: sum(|report| report.left + report.pending) + fresh,
            depth: if fresh > 0 { depth } else { depth.saturating_sub(1) },
            bytes: sum(|report| report.bytes),
            spilled: sum(|report| report.spilled),
            compiled: sum(|report| report.compiled),
            blocked: sum(|report| report.blocked),
        }
    }
}

/// How to continue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Decision {
    /// Continue the level.
    Round,
    /// The level has ended: settle pending states.
    Settle,
    /// Begin the next level.
    Level,
    /// Stop all workers.
    Stop(Option<Stop>),
}

/// Decides how to continue, from the reports of all workers and the depth of the incoming states.
pub(crate) type Leader<'a> = dyn FnMut(&[Tally], u64) -> Decision + 'a;

impl Crew<'_> {
    /// Runs the workers of the shards until the leader decides to stop. `starts` are the initial states, each followed
    /// by its additional words.
    pub fn work(
        &self,
        explorer: &mut Explorer,
        shards: &mut [Shard],
        starts: &[u64],
        item: usize,
        decide: &mut Leader<'_>,
    ) -> Option<Stop> {
        let (count, words) = (shards.len(), explorer.words());
        let mail: Mail = (0..count).map(|_| (0..count).map(|_| Mutex::default()).collect()).collect();
        let places: Places = (0..count).map(|_| (0..count).map(|_| Mutex::default()).collect()).collect();
        for item in starts.chunks_exact(item) {
            lock(&mail[owner(&item[..words], count)][0]).extend_from_slice(item);
        }
        if let Some(edges) = shards[0].edges.as_mut().filter(|_| !starts.is_empty()) {
            edges.begin(starts.chunks_exact(item).map(|item| owner(&item[..words], count)));
        }
        let barrier = Barrier::new(count);
        let board = Mutex::new(Board {
            reports: vec![Tally::default(); count],
            decision: Decision::Round,
            quota: 0,
            void: false,
            forgets_edges: false,
        });
        let (leader, others) = shards.split_first_mut().expect("at least one worker");
        std::thread::scope(|scope| {
            for (index, shard) in others.iter_mut().enumerate() {
                let (mail, places, barrier, board) = (&mail, &places, &barrier, &board);
                let (plan, explore) = (self.plan, self.explore);
                let body = move || {
                    let mut explorer = explore().expect("the leader has made the same");
                    let exchange = (mail, places);
                    shard.work(&mut explorer, index + 1, plan, exchange, barrier, board, &mut |_, _| Decision::Round);
                };
                // Steps may recurse deeply; beyond this, the stack grows on demand.
                let spawned = std::thread::Builder::new().stack_size(16 << 20).spawn_scoped(scope, body);
                assert!(spawned.is_ok(), "a thread can be made");
            }
            leader.work(explorer, 0, self.plan, (&mail, &places), &barrier, &board, decide)
        })
    }
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

/// Whether the assumptions leave no step of a state whose alternatives lead to these.
fn is_blocked(explorer: &mut Explorer, plan: &Plan, expansion: &Expansion, successors: &[u64]) -> bool {
    if expansion.stayed > 0 || expansion.faults != [0; 3] || expansion.unbounded > 0 {
        return false;
    }
    if expansion.moved == 0 {
        return expansion.excluded > 0;
    }
    let words = explorer.words();
    let mut admitted = |state: &[u64]| plan.assumed.iter().all(|one| explorer.truth(*one, state) == Truth::True);
    !plan.assumed.is_empty() && !successors.chunks_exact(words).any(&mut admitted)
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
            journal: None,
            reduction: reduction.clone(),
            orbits: None,
            order_mattered: None,
            lineage: None,
            edges: None,
            cut: false,
        }
    }

    /// Works until the leader, worker 0, decides to stop.
    #[allow(clippy::too_many_arguments, reason = "all of them are shared by the workers and used here alone")]
    fn work(
        &mut self,
        explorer: &mut Explorer,
        index: usize,
        plan: &Plan,
        (mail, places): (&Mail, &Places),
        barrier: &Barrier,
        board: &Mutex<Board>,
        leader: &mut Leader<'_>,
    ) -> Option<Stop> {
        let mut sent = vec![Vec::new(); mail.len()];
        let mut settles = false;
        let mut quota = 1;
        self.compiled_before = self.compiled.saturating_sub(explorer.compiled_states());
        if self.reduction.is_some() {
            // Expanding a state determines the parts of the main rule.
            let initial = explorer.initial().first().map(|(state, _)| state.clone());
            let _ = initial.map(|state| explorer.expand(&state, &mut Vec::new()));
        }
        loop {
            let mut panic = None;
            // A worker that panics still meets the others at the barriers, so that all end; then the panic continues.
            let mut guard = |body: &mut dyn FnMut()| {
                panic = panic.take().or(catch_unwind(AssertUnwindSafe(body)).err());
            };
            guard(&mut || {
                self.cut |= !self.expand_round(explorer, plan, quota, &mut sent);
                if self.cut && plan.storage != Storage::Exact {
                    lock(board).void = true;
                }
                for (to, successors) in sent.iter_mut().enumerate() {
                    lock(&mail[to][index]).append(successors);
                }
            });
            barrier.wait();
            guard(&mut || {
                let void = lock(board).void;
                for (from, received) in mail[index].iter().enumerate() {
                    if void {
                        lock(received).clear();
                    }
                    self.take_in(explorer, plan, &mut lock(received), false, &mut lock(&places[from][index]));
                }
                if settles && self.store.pending() > 0 {
                    self.take_in(explorer, plan, &mut Vec::new(), true, &mut Vec::new());
                }
            });
            self.order_mattered = explorer.order_mattered();
            let broken = panic.is_some();
            lock(board).reports[index] = Tally { broken, ..self.report() };
            barrier.wait();
            let all_well = lock(board).reports.iter().all(|report| !report.broken);
            if all_well && let Some(edges) = &mut self.edges {
                let arrived: Vec<Vec<u32>> =
                    places[index].iter().map(|places| std::mem::take(&mut *lock(places))).collect();
                edges.arrive(&arrived);
            }
            if index == 0 {
                let reports = lock(board).reports.clone();
                // The depth of the incoming states, once the initial ones are there.
                let depth = self.levels.len() as u64;
                let decided = catch_unwind(AssertUnwindSafe(|| leader(&reports, depth)));
                let mut board = lock(board);
                board.decision = decided.unwrap_or_else(|payload| {
                    panic = Some(payload);
                    Decision::Stop(None)
                });
                let states: u64 = reports.iter().map(|report| report.states).sum();
                let bytes: u64 = reports.iter().map(|report| report.bytes).sum();
                board.forgets_edges |= bytes > plan.max_bytes / 2 || reports.iter().any(|report| report.full);
                board.quota = (plan.max_states.saturating_sub(states) / reports.len() as u64).max(1);
            }
            barrier.wait();
            if let Some(panic) = panic {
                resume_unwind(panic);
            }
            let (decision, forgets_edges);
            (decision, quota, forgets_edges) = {
                let board = lock(board);
                (board.decision, board.quota, board.forgets_edges)
            };
            if forgets_edges {
                self.edges = None;
            }
            settles = decision == Decision::Settle;
            match decision {
                Decision::Round | Decision::Settle => {}
                Decision::Level => {
                    self.store.forget_before(self.next);
                    self.levels.push(self.store.len());
                }
                Decision::Stop(stop) => {
                    self.unbounded.extend(explorer.unbounded());
                    let executed = explorer.executed();
                    self.executed.resize(executed.len(), 0);
                    let pairs = self.executed.iter_mut().zip(executed);
                    pairs.for_each(|(before, now)| *before |= u64::from(now));
                    return stop;
                }
            }
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

    fn report(&self) -> Tally {
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
    fn expand_round(&mut self, explorer: &mut Explorer, plan: &Plan, quota: u64, sent: &mut [Vec<u64>]) -> bool {
        let end = self.levels.last().copied().unwrap_or(0).min(self.next + ROUND);
        let words = explorer.words();
        let mut successors = Vec::new();
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
            let out = if direct { &mut sent[0] } else { &mut successors };
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
                    self.blocked += u64::from(is_blocked(explorer, plan, &expansion, &out[begin..]));
                    self.compiled = self.compiled_before + explorer.compiled_states();
                    self.transitions += u64::from(expansion.moved);
                    made += u64::from(expansion.moved);
                    if expansion.moved == 0 || expansion.failed > 0 || expansion.faults != [0; 3] {
                        self.look_at(explorer, plan, self.next - 1, &expansion);
                        if !self.widening.is_empty() {
                            return true;
                        }
                    }
                    if let Some(journal) = &mut self.journal {
                        journal.note(self.next - 1);
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
    fn take_in(
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
