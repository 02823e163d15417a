//! The search: all states that can be reached, level by level.
//!
//! In: a program and what is asked of its states. Out: a [`Search`] that has ended, with the states by their distance and
//! the first state of each kind that was looked for. Each worker owns the states whose hash is its own: it makes their
//! steps, and takes in the successors that the others send. A level is ended before the next begins, so what is found is
//! at the least distance, and of several states the least in canonical order: INVARIANT: what comes out is the same for
//! any number of workers.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, Barrier, Mutex, PoisonError};

use machine::explore::{Expansion, Explorer, Interner, Settings, Trouble, Truth, Unbounded, Widening};
use program::{Program, RuleId};

use crate::table::{Table, hash};

/// How many states a worker expands before all exchange successors.
const ROUND: usize = 1 << 12;

/// What is looked for in a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// A step that is a fault, by its class.
    Fault(usize),
    /// No step changes the state.
    Rest,
    /// A condition that does not hold, by its number.
    Condition(usize),
    /// A condition on the step that does not hold in one of its steps, by its number.
    StepCondition(usize),
}

/// What the search is to do.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// What explorers are made with.
    pub settings: Settings,
    /// The conditions on states that are assumptions: states in which one does not hold are left out.
    pub assumed: Vec<usize>,
    /// The condition on states that may rest.
    pub terminal: Option<usize>,
    /// The conditions on states that are looked for where they do not hold.
    pub wanted: Vec<usize>,
    /// The conditions on steps that are looked for where they do not hold.
    pub wanted_steps: Vec<usize>,
    /// How many workers.
    pub workers: usize,
    /// The search ends with the first level in which something is found.
    pub first: bool,
    /// The most states.
    pub max_states: u64,
    /// The most steps from an initial state.
    pub max_depth: u64,
    /// The most bytes for states.
    pub max_bytes: u64,
}

/// How far a search is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Progress {
    /// States met.
    pub states: u64,
    /// Steps that change the state.
    pub transitions: u64,
    /// States that are still to be expanded.
    pub queue: u64,
    /// The greatest distance of a state from an initial one.
    pub depth: u64,
    /// Bytes that states take.
    pub bytes: u64,
}

/// Why a search ended before it had met all states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stop {
    /// As many states as are allowed.
    States,
    /// As deep as is allowed.
    Depth,
    /// As many bytes as are allowed.
    Memory,
    /// Whoever watches the search has had enough.
    Asked,
    /// Something was found and that is enough.
    Found,
}

/// Where something was found first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// What.
    pub target: Target,
    /// The distance of the state.
    pub depth: usize,
    /// The state.
    pub state: Box<[u64]>,
}

/// The states that are a worker's own, and what it knows of them.
#[derive(Debug)]
pub(crate) struct Shard {
    pub table: Table,
    /// Where each level that is or was expanded ends among the states of the table.
    pub levels: Vec<usize>,
    found: Vec<Found>,
    transitions: u64,
    /// The next state to be expanded.
    next: usize,
    /// A truth that is not known.
    unknown: BTreeSet<usize>,
    widening: Widening,
    unbounded: BTreeSet<Unbounded>,
    /// How often each rule ran.
    executed: Vec<u64>,
}

/// A search that has ended.
#[derive(Debug)]
pub struct Search {
    pub(crate) explorer: Explorer,
    pub(crate) shards: Vec<Shard>,
    /// What was found, each target at most once.
    pub found: Vec<Found>,
    /// Why it ended early; none where all states were met.
    pub stop: Option<Stop>,
    /// How far it came.
    pub progress: Progress,
    /// What could not be gone through.
    pub unbounded: BTreeSet<Unbounded>,
    /// Conditions whose truth is not known in some state.
    pub unknown: BTreeSet<usize>,
}

/// Successors on their way: from one worker to another.
type Mail = Vec<Vec<Mutex<Vec<u64>>>>;

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What workers tell each other at the end of a round.
#[derive(Debug)]
struct Board {
    /// By worker.
    reports: Vec<Report>,
    decision: Decision,
}

#[derive(Debug, Clone, Copy, Default)]
struct Report {
    states: u64,
    transitions: u64,
    /// States of this level that are still to be expanded.
    left: u64,
    /// States of the next level.
    fresh: u64,
    bytes: u64,
    full: bool,
    narrow: bool,
    found: bool,
    /// The worker has panicked.
    broken: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Decision {
    /// The level goes on.
    Round,
    /// The next level begins.
    Level,
    Stop(Option<Stop>),
}

/// Attempts a search again and again, each time with room for what did not fit the time before.
pub(crate) fn widened<T>(mut attempt: impl FnMut(&Widening) -> Result<T, Trouble>) -> Result<T, Trouble> {
    let mut widening = Widening::default();
    loop {
        match attempt(&widening) {
            Err(Trouble::TooNarrow(more)) => widening.merge(&more),
            outcome => return outcome,
        }
    }
}

impl Search {
    /// Searches all states of a program.
    ///
    /// # Errors
    /// There is no initial state.
    pub fn run(
        program: &Arc<Program>,
        plan: &Plan,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<Search, Trouble> {
        widened(|widening| Search::attempt(program, plan, widening, watch))
    }

    fn attempt(
        program: &Arc<Program>,
        plan: &Plan,
        widening: &Widening,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<Search, Trouble> {
        let interner = Arc::new(Interner::default());
        let explore = || Explorer::new(program, plan.settings.clone(), widening, &interner);
        let mut explorer = explore()?;
        let count = plan.workers.max(1);
        let mut shards: Vec<Shard> = (0..count).map(|_| Shard::new(explorer.words())).collect();
        let mail: Mail = (0..count).map(|_| (0..count).map(|_| Mutex::default()).collect()).collect();
        for (state, _) in explorer.initial() {
            lock(&mail[owner(state, count)][0]).extend_from_slice(state);
        }
        let barrier = Barrier::new(count);
        let board = Mutex::new(Board { reports: vec![Report::default(); count], decision: Decision::Round });
        let mut progress = Progress::default();
        let (leader, others) = shards.split_first_mut().expect("at least one worker");
        let stop = std::thread::scope(|scope| {
            for (index, shard) in others.iter_mut().enumerate() {
                let (plan, mail, barrier, board, explore) = (&plan, &mail, &barrier, &board, &explore);
                let body = move || {
                    // A machine may not go from thread to thread; what the leader could make can be made here.
                    let mut explorer = explore().expect("the leader has made the same");
                    shard.work(&mut explorer, index + 1, plan, mail, barrier, board, &mut |_, _| Decision::Round);
                };
                // Steps may be deep; the stack grows on demand beyond this.
                let spawned = std::thread::Builder::new().stack_size(16 << 20).spawn_scoped(scope, body);
                assert!(spawned.is_ok(), "a thread can be made");
            }
            let mut decide = |reports: &[Report], depth: u64| decide(reports, depth, plan, &mut progress, watch);
            leader.work(&mut explorer, 0, plan, &mail, &barrier, &board, &mut decide)
        });
        for shard in &shards {
            if !shard.widening.is_empty() {
                return Err(Trouble::TooNarrow(shard.widening.clone()));
            }
        }
        Ok(Search::gather(explorer, shards, stop, progress))
    }

    fn gather(mut explorer: Explorer, mut shards: Vec<Shard>, stop: Option<Stop>, progress: Progress) -> Search {
        let mut found: Vec<Found> = Vec::new();
        for one in shards.iter_mut().flat_map(|shard| std::mem::take(&mut shard.found)) {
            note(&mut found, one, &mut explorer);
        }
        found.sort_by_key(|found| found.target);
        let unbounded = shards.iter().flat_map(|shard| &shard.unbounded).copied().collect();
        let unknown = shards.iter().flat_map(|shard| &shard.unknown).copied().collect();
        Search { explorer, shards, found, stop, progress, unbounded, unknown }
    }

    /// How many words a state has, and how many bits of them are used.
    pub fn width(&self) -> (usize, usize) {
        (self.explorer.words(), self.explorer.bits())
    }

    /// How often each rule ran in the steps that a machine made; 0 for a rule that never can.
    pub fn executed(&self, rule: RuleId) -> u64 {
        self.shards.iter().map(|shard| shard.executed[rule.0 as usize]).sum()
    }
}

/// Which worker a state belongs to.
fn owner(state: &[u64], workers: usize) -> usize {
    if workers == 1 { 0 } else { (hash(state) & 0xffff) as usize % workers }
}

/// Keeps the nearest, and of equally near ones the least.
fn note(found: &mut Vec<Found>, one: Found, explorer: &mut Explorer) {
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

fn decide(
    reports: &[Report],
    depth: u64,
    plan: &Plan,
    progress: &mut Progress,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Decision {
    let sum = |of: fn(&Report) -> u64| reports.iter().map(of).sum::<u64>();
    let any = |of: fn(&Report) -> bool| reports.iter().any(of);
    let (left, fresh) = (sum(|report| report.left), sum(|report| report.fresh));
    *progress = Progress {
        states: sum(|report| report.states),
        transitions: sum(|report| report.transitions),
        queue: left + fresh,
        depth: if fresh > 0 { depth } else { depth.saturating_sub(1) },
        bytes: sum(|report| report.bytes),
    };
    let go_on = watch(progress);
    if any(|report| report.narrow || report.broken) || left + fresh == 0 {
        return Decision::Stop(None);
    }
    if any(|report| report.full) || progress.bytes > plan.max_bytes {
        return Decision::Stop(Some(Stop::Memory));
    }
    if !go_on {
        return Decision::Stop(Some(Stop::Asked));
    }
    // The rest is decided between levels, where it does not depend on how the work is shared.
    if left > 0 {
        return Decision::Round;
    }
    if plan.first && any(|report| report.found) {
        return Decision::Stop(Some(Stop::Found));
    }
    if progress.states >= plan.max_states {
        return Decision::Stop(Some(Stop::States));
    }
    if depth >= plan.max_depth {
        return Decision::Stop(Some(Stop::Depth));
    }
    Decision::Level
}

impl Shard {
    fn new(words: usize) -> Shard {
        Shard {
            table: Table::new(words),
            levels: Vec::new(),
            found: Vec::new(),
            transitions: 0,
            next: 0,
            unknown: BTreeSet::new(),
            widening: Widening::default(),
            unbounded: BTreeSet::new(),
            executed: Vec::new(),
        }
    }

    /// Works until the leader, who is worker 0, decides to stop.
    #[allow(clippy::too_many_arguments, reason = "all of them are shared by the workers and used here alone")]
    fn work(
        &mut self,
        explorer: &mut Explorer,
        index: usize,
        plan: &Plan,
        mail: &Mail,
        barrier: &Barrier,
        board: &Mutex<Board>,
        leader: &mut dyn FnMut(&[Report], u64) -> Decision,
    ) -> Option<Stop> {
        let mut sent = vec![Vec::new(); mail.len()];
        loop {
            let mut panic = None;
            // Who panics still meets the others at the barriers, so that all end; then the panic goes on.
            let mut guard = |body: &mut dyn FnMut()| {
                panic = panic.take().or(catch_unwind(AssertUnwindSafe(body)).err());
            };
            guard(&mut || {
                self.expand_round(explorer, plan, &mut sent);
                for (to, successors) in sent.iter_mut().enumerate() {
                    lock(&mail[to][index]).append(successors);
                }
            });
            barrier.wait();
            guard(&mut || {
                for received in &mail[index] {
                    self.take_in(explorer, plan, &mut lock(received));
                }
            });
            let broken = panic.is_some();
            lock(board).reports[index] = Report { broken, ..self.report() };
            barrier.wait();
            if index == 0 {
                let reports = lock(board).reports.clone();
                // The depth of the states that come in, once the initial ones are there.
                let depth = self.levels.len() as u64;
                let decided = catch_unwind(AssertUnwindSafe(|| leader(&reports, depth)));
                lock(board).decision = decided.unwrap_or_else(|payload| {
                    panic = Some(payload);
                    Decision::Stop(None)
                });
            }
            barrier.wait();
            if let Some(panic) = panic {
                resume_unwind(panic);
            }
            let decision = lock(board).decision;
            match decision {
                Decision::Round => {}
                Decision::Level => self.levels.push(self.table.len()),
                Decision::Stop(stop) => {
                    self.unbounded.clone_from(explorer.unbounded());
                    self.executed.clone_from(&explorer.coverage().executed);
                    return stop;
                }
            }
        }
    }

    fn report(&self) -> Report {
        let end = self.levels.last().copied().unwrap_or(0);
        Report {
            states: self.table.len() as u64,
            transitions: self.transitions,
            left: (end - self.next) as u64,
            fresh: (self.table.len() - end) as u64,
            bytes: self.table.bytes() as u64,
            full: self.table.is_full(),
            narrow: !self.widening.is_empty(),
            found: !self.found.is_empty(),
            broken: false,
        }
    }

    /// Makes the steps of some states of the level, and puts the successors where they belong.
    fn expand_round(&mut self, explorer: &mut Explorer, plan: &Plan, sent: &mut [Vec<u64>]) {
        let end = self.levels.last().copied().unwrap_or(0).min(self.next + ROUND);
        let words = explorer.words();
        let mut successors = Vec::new();
        while self.next < end {
            let state = self.table.state(self.next);
            self.next += 1;
            let out = if sent.len() == 1 { &mut sent[0] } else { &mut successors };
            match explorer.expand(state, out) {
                Ok(expansion) => {
                    self.transitions += u64::from(expansion.moved);
                    if expansion.moved == 0 || expansion.failed > 0 || expansion.faults != [0; 3] {
                        self.look_at(explorer, plan, self.next - 1, &expansion);
                    }
                }
                Err(widening) => {
                    self.widening = widening;
                    return;
                }
            }
            for successor in successors.chunks_exact(words) {
                sent[owner(successor, sent.len())].extend_from_slice(successor);
            }
            successors.clear();
        }
    }

    /// Notes what is looked for in an expansion.
    #[cold]
    fn look_at(&mut self, explorer: &mut Explorer, plan: &Plan, place: usize, expansion: &Expansion) {
        let depth = self.levels.len() - 1;
        let state: Box<[u64]> = self.table.state(place).into();
        let mut targets = Vec::new();
        targets.extend((0..3).filter(|class| expansion.faults[*class] > 0).map(Target::Fault));
        if expansion.moved == 0 && expansion.stayed > 0 && expansion.faults == [0; 3] && expansion.unbounded == 0 {
            let may_rest = plan.terminal.map(|terminal| explorer.truth(terminal, &state));
            match may_rest {
                Some(Truth::True) => {}
                Some(Truth::Fault | Truth::Unknown) => {
                    self.unknown.extend(plan.terminal);
                }
                _ => targets.push(Target::Rest),
            }
        }
        let missing = |target: &usize| {
            !self.found.iter().any(|found| found.target == Target::StepCondition(*target) && found.depth < depth)
        };
        if expansion.failed > 0 && plan.wanted_steps.iter().any(missing) {
            let mut failed = BTreeSet::new();
            let looked = explorer.paths(&state, &mut |path| failed.extend(path.failed));
            if let Err(widening) = looked {
                self.widening = widening;
            }
            let wanted = plan.wanted_steps.iter().filter(|wanted| failed.contains(&(**wanted as u32)));
            targets.extend(wanted.map(|wanted| Target::StepCondition(*wanted)));
        }
        for target in targets {
            note(&mut self.found, Found { target, depth, state: state.clone() }, explorer);
        }
    }

    /// Adds states that have come in.
    fn take_in(&mut self, explorer: &mut Explorer, plan: &Plan, states: &mut Vec<u64>) {
        let Shard { table, levels, found, unknown, .. } = self;
        if !plan.assumed.is_empty() {
            let mut admitted = Vec::with_capacity(states.len());
            for state in states.chunks_exact(explorer.words()) {
                let mut all = true;
                for condition in &plan.assumed {
                    let truth = explorer.truth(*condition, state);
                    all &= truth == Truth::True;
                    if matches!(truth, Truth::Fault | Truth::Unknown) {
                        unknown.insert(*condition);
                    }
                }
                if all {
                    admitted.extend_from_slice(state);
                }
            }
            *states = admitted;
        }
        let depth = levels.len();
        table.insert_all(states, &mut |state| {
            for condition in &plan.wanted {
                match explorer.truth(*condition, state) {
                    Truth::True => {}
                    Truth::Unknown => {
                        unknown.insert(*condition);
                    }
                    Truth::False | Truth::Undef | Truth::Fault => {
                        let target = Target::Condition(*condition);
                        note(found, Found { target, depth, state: state.into() }, explorer);
                    }
                }
            }
        });
        states.clear();
    }
}
