//! The workers of a search: threads that proceed in rounds.
//!
//! In: a plan, and the states to begin with. Out: shards whose states are explored as far as the leader has decided. In a
//! round each worker makes the steps of some of its shard's states on the level and sends the successors to their owners; each takes
//! in what it received; then the first worker decides how to continue. Where there is little to do
//! the others wait, and the first works on all shards. INVARIANT: what a shard receives, and in which order, depends only on the
//! number of shards, not on who works on them.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Barrier, Mutex, MutexGuard, PoisonError};

use explore::{Explorer, Trouble};

use crate::explicit::shard::{Shard, owner};
use crate::explicit::tally::{Decision, Leader, Tally};
use crate::plan::Plan;
use crate::progress::Stop;
use crate::storage::Storage;

/// LIMIT: fewer states of a round are not worth waking the others for. That takes some hundred microseconds, and much longer on
/// a busy machine; the steps of a state take one to twenty.
const ALONE: u64 = 64;

/// How many initial states are handed out at a time.
const BATCH: usize = 1 << 14;

/// What all workers share besides their messages.
pub(crate) struct Crew<'a> {
    pub plan: &'a Plan,
    /// A machine cannot move between threads, so each worker creates its own explorer; the first has one.
    pub explore: &'a (dyn Fn() -> Result<Explorer, Trouble> + Sync),
}

/// Successors on their way from one shard to another, by the shard that they go to and that which they come from.
type Mail = Vec<Vec<Mutex<Vec<u64>>>>;
/// Where the owner of successors has put them: by the shard that they come from and that which they went to. Empty where no edges
/// are kept.
type Places = Vec<Vec<Mutex<Vec<u32>>>>;

/// How to go on with a shard, for whoever works on it.
#[derive(Debug, Clone, Copy)]
struct Order {
    decision: Decision,
    /// How many successors each worker may make in the next round before it expands no further state, so that the limit
    /// of states is not exceeded by much.
    quota: u64,
    /// The edges take too much memory: nobody keeps them any more.
    forgets_edges: bool,
}

/// What workers share at the end of a round.
#[derive(Debug)]
struct Board {
    /// By shard.
    reports: Vec<Tally>,
    order: Order,
    /// The round was cut short and its results do not count: finding runs repeats whole rounds.
    void: bool,
}

/// A search at work.
struct Rounds<'s> {
    plan: &'s Plan,
    shards: Vec<Mutex<&'s mut Shard>>,
    mail: Mail,
    places: Places,
    barrier: Barrier,
    board: Mutex<Board>,
}

type Panic = Box<dyn Any + Send>;

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

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
        // Some at a time: there may be a great many, and they are in the tables soon.
        for some in starts.chunks(item * BATCH) {
            for one in some.chunks_exact(item) {
                lock(&mail[owner(&one[..words], count)][0]).extend_from_slice(one);
            }
            for (index, shard) in shards.iter_mut().enumerate() {
                let (mail, places) = (&mut *lock(&mail[index][0]), &mut *lock(&places[0][index]));
                shard.take_in(explorer, self.plan, mail, false, places);
                mail.clear();
            }
        }
        if let Some(edges) = shards[0].edges.as_mut().filter(|_| !starts.is_empty()) {
            edges.begin(starts.chunks_exact(item).map(|item| owner(&item[..words], count)));
        }
        let rounds = Rounds {
            plan: self.plan,
            shards: shards.iter_mut().map(Mutex::new).collect(),
            mail,
            places,
            barrier: Barrier::new(count),
            board: Mutex::new(Board {
                reports: vec![Tally::default(); count],
                order: Order { decision: Decision::Round, quota: 1, forgets_edges: false },
                void: false,
            }),
        };
        std::thread::scope(|scope| {
            for index in 1..count {
                let (rounds, explore) = (&rounds, self.explore);
                let body = move || {
                    let mut explorer = explore().expect("the leader has made the same");
                    rounds.work(&mut explorer, index, None);
                };
                // Steps may recurse deeply; beyond this, the stack grows on demand.
                let spawned = std::thread::Builder::new().stack_size(16 << 20).spawn_scoped(scope, body);
                assert!(spawned.is_ok(), "a thread can be made");
            }
            rounds.work(explorer, 0, Some(decide))
        })
    }
}

impl Rounds<'_> {
    /// Works on a shard until the leader decides to stop. Worker 0 is the leader.
    fn work(&self, explorer: &mut Explorer, index: usize, mut leader: Option<&mut Leader<'_>>) -> Option<Stop> {
        let mut sent = vec![Vec::new(); self.shards.len()];
        let mut settles = false;
        let mut quota = 1;
        {
            let mut shard = lock(&self.shards[index]);
            shard.compiled_before = shard.compiled.saturating_sub(explorer.compiled_states());
            if shard.reduction.is_some() {
                // Expanding a state determines the parts of the main rule.
                let initial = explorer.initial().first().map(Box::<[u64]>::from);
                let _ = initial.map(|state| explorer.expand(&state, &mut Vec::new()));
            }
        }
        // A worker that panics still meets the others at the barriers, so that all end; then the panic continues.
        let mut panic: Option<Panic> = None;
        loop {
            panic = panic.or(caught(|| self.send(index, explorer, quota, &mut sent)).err());
            self.barrier.wait();
            panic = panic.or(caught(|| self.receive(index, explorer, settles)).err());
            self.tell(index, index, explorer, panic.is_some());
            self.barrier.wait();
            if let Some(leader) = leader.as_deref_mut() {
                match caught(|| self.lead(explorer, &mut sent, leader)) {
                    Ok(order) => lock(&self.board).order = order,
                    Err(payload) => {
                        panic = Some(payload);
                        lock(&self.board).order.decision = Decision::Stop(None);
                    }
                }
            }
            self.barrier.wait();
            if let Some(panic) = panic {
                resume_unwind(panic);
            }
            let order = lock(&self.board).order;
            panic = caught(|| self.follow(index, order)).err();
            (quota, settles) = (order.quota, order.decision == Decision::Settle);
            if let Decision::Stop(stop) = order.decision {
                if let Some(panic) = panic {
                    resume_unwind(panic);
                }
                let mut shard = lock(&self.shards[index]);
                shard.unbounded.extend(explorer.unbounded());
                let executed = explorer.executed();
                shard.executed.resize(executed.len(), 0);
                let pairs = shard.executed.iter_mut().zip(executed);
                pairs.for_each(|(before, now)| *before |= u64::from(now));
                return stop;
            }
        }
    }

    /// Decides how to continue, and does all rounds that are not worth waking the others.
    fn lead(&self, explorer: &mut Explorer, sent: &mut [Vec<u64>], leader: &mut Leader<'_>) -> Order {
        let count = self.shards.len();
        loop {
            let reports = lock(&self.board).reports.clone();
            // The depth of the incoming states, once the initial ones are there.
            let depth = lock(&self.shards[0]).levels.len() as u64;
            let decision = leader(&reports, depth);
            let states: u64 = reports.iter().map(|report| report.states).sum();
            let bytes: u64 = reports.iter().map(|report| report.bytes).sum();
            let forgets_edges = bytes > self.plan.max_bytes / 2 || reports.iter().any(|report| report.full);
            let quota = (self.plan.max_states.saturating_sub(states) / count as u64).max(1);
            let order = {
                let board = &mut *lock(&self.board);
                board.order.forgets_edges |= forgets_edges;
                board.order = Order { decision, quota, forgets_edges: board.order.forgets_edges };
                board.order
            };
            let to_do: u64 = reports.iter().map(|report| report.left + report.fresh + report.pending).sum();
            let of_others = to_do - to_do.div_ceil(count as u64);
            if matches!(decision, Decision::Stop(_)) || of_others >= self.plan.alone.unwrap_or(ALONE) {
                return order;
            }
            (0..count).for_each(|index| self.follow(index, order));
            (0..count).for_each(|index| self.send(index, explorer, quota, sent));
            let settles = decision == Decision::Settle;
            (0..count).for_each(|index| self.receive(index, explorer, settles));
            (0..count).for_each(|index| self.tell(index, 0, explorer, false));
        }
    }

    /// Makes the steps of some states of a shard and sends the successors to their owners.
    fn send(&self, index: usize, explorer: &mut Explorer, quota: u64, sent: &mut [Vec<u64>]) {
        let mut shard = lock(&self.shards[index]);
        let whole = shard.expand_round(explorer, self.plan, quota, sent);
        shard.cut |= !whole;
        let voids = shard.cut && self.plan.storage != Storage::Exact;
        drop(shard);
        for (to, successors) in sent.iter_mut().enumerate() {
            lock(&self.mail[to][index]).append(successors);
        }
        lock(&self.board).void |= voids;
    }

    /// Takes in what was sent to a shard, and settles what is pending if it `settles`.
    fn receive(&self, index: usize, explorer: &mut Explorer, settles: bool) {
        let void = lock(&self.board).void;
        let mut shard = lock(&self.shards[index]);
        for (from, received) in self.mail[index].iter().enumerate() {
            if void {
                lock(received).clear();
            }
            shard.take_in(explorer, self.plan, &mut lock(received), false, &mut lock(&self.places[from][index]));
        }
        if settles && shard.store.pending() > 0 {
            shard.take_in(explorer, self.plan, &mut Vec::new(), true, &mut Vec::new());
        }
    }

    /// Tells the leader what has become of a shard in the hands of a worker.
    fn tell(&self, index: usize, worker: usize, explorer: &Explorer, broken: bool) {
        let mut shard = lock(&self.shards[index]);
        if index == worker {
            // An explorer's own findings belong to the shard of its worker.
            shard.order_mattered = explorer.order_mattered();
            shard.compiled = shard.compiled_before + explorer.compiled_states();
        }
        lock(&self.board).reports[index] = Tally { broken, ..shard.report() };
    }

    /// Does with a shard what was decided, after it was told where its successors have their places.
    fn follow(&self, index: usize, order: Order) {
        let mut shard = lock(&self.shards[index]);
        if order.forgets_edges {
            shard.edges = None;
        }
        let broken = lock(&self.board).reports.iter().any(|report| report.broken);
        if let Some(edges) = shard.edges.as_mut().filter(|_| !broken) {
            let mut arrived: Vec<MutexGuard<'_, Vec<u32>>> = self.places[index].iter().map(lock).collect();
            edges.arrive(&arrived);
            arrived.iter_mut().for_each(|places| places.clear());
        }
        match order.decision {
            Decision::Round | Decision::Settle | Decision::Stop(_) => {}
            Decision::Level => {
                let (next, end) = (shard.next, shard.store.len());
                shard.store.forget_before(next);
                shard.levels.push(end);
            }
        }
    }
}

/// Runs what may panic.
fn caught<T>(body: impl FnOnce() -> T) -> Result<T, Panic> {
    catch_unwind(AssertUnwindSafe(body))
}
