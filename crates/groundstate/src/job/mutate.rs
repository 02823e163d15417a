//! Judges mutants, as a job: several at a time.
//!
//! In: what is wanted, the files, a [`Timer`]. Out: an event as each mutant is judged, in no order; at the end all of them in
//! the order of the texts. If the job is cancelled, it ends with those that were judged until then.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::thread::{Builder, scope};

use crate::Workspace;
use crate::job::{Cancel, Job, Port, STACK};
use crate::mutation::{Bench, Ledger, Outcome, Timer, Wanted, Worker};
use crate::workspace::Files;

/// An event of a mutation analysis.
#[derive(Debug)]
pub enum MutateEvent {
    /// A model or a scenario is tried as it is.
    Tried(String),
    /// All were; so many mutants are to be judged.
    Begun(usize),
    /// The mutant of this number was judged.
    Judged(usize, Box<Outcome>),
}

/// What came of a mutation analysis.
#[derive(Debug)]
pub struct Mutated {
    /// Who judged, and what.
    pub bench: Arc<Bench>,
    /// By mutant, the outcome; none if it was not judged.
    pub outcomes: Vec<Option<Outcome>>,
    /// Of so many, the outcome was kept.
    pub kept: usize,
}

/// A mutation analysis.
pub type MutateJob = Job<MutateEvent, Mutated>;

/// How to judge.
pub struct Hands<F> {
    /// Makes what a worker reads texts from.
    pub files: Box<dyn Fn() -> F + Send + Sync>,
    /// Measures each judgement.
    pub timer: Arc<dyn Timer>,
    /// Keeps outcomes from one analysis to the next.
    pub ledger: Option<Box<dyn Ledger>>,
    /// How many mutants are judged at a time.
    pub workers: usize,
}

impl<F> std::fmt::Debug for Hands<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Hands").field("workers", &self.workers).finish_non_exhaustive()
    }
}

/// Starts to judge mutants. No mutant is judged if a model or a scenario is unfit and `strict`.
///
/// # Errors
/// The system cannot start a thread.
pub fn mutate<F: Files + Send + 'static>(
    wanted: Wanted,
    hands: Hands<F>,
    strict: bool,
    cancel: Cancel,
) -> io::Result<MutateJob> {
    Job::start("mutate", cancel.clone(), move |port| {
        let Hands { files, timer, ledger, workers } = hands;
        let mut workspace = Workspace::new(files());
        let bench = Bench::new(wanted, &mut workspace, cancel.interrupt(), &mut |path| {
            port.tell(MutateEvent::Tried(path.to_string()));
        });
        let bench = Arc::new(bench);
        let mut outcomes = vec![None; bench.candidates.len()];
        let mut kept = 0;
        if bench.unfit.is_empty() || !strict {
            let mut ledger = ledger.map(|ledger| (ledger, keys(&bench)));
            if let Some((ledger, keys)) = &ledger {
                outcomes = keys.iter().map(|key| ledger.known(key)).collect();
                kept = outcomes.iter().flatten().count();
            }
            port.tell(MutateEvent::Begun(outcomes.len() - kept));
            judge(&bench, (&*files, &*timer, workers), &port, &mut outcomes, &mut |number, outcome| {
                if let Some((ledger, keys)) = ledger.as_mut().filter(|_| outcome.is_final()) {
                    ledger.keep(&keys[number], outcome);
                }
            });
        }
        Mutated { bench, outcomes, kept }
    })
}

fn keys(bench: &Bench) -> Vec<String> {
    (0..bench.candidates.len()).map(|number| bench.key(number)).collect()
}

/// Judges those mutants that have no outcome yet.
fn judge<F: Files + Send>(
    bench: &Arc<Bench>,
    (files, timer, workers): (&(dyn Fn() -> F + Send + Sync), &dyn Timer, usize),
    port: &Port<MutateEvent>,
    outcomes: &mut [Option<Outcome>],
    judged_one: &mut dyn FnMut(usize, &Outcome),
) {
    let open: Vec<usize> = (0..outcomes.len()).filter(|number| outcomes[*number].is_none()).collect();
    let open = &open;
    let (next, (sender, judged)) = (AtomicUsize::new(0), channel());
    let (next, cancel) = (&next, port.cancel.clone());
    scope(|scope| {
        for _ in 0..workers.clamp(1, open.len().max(1)) {
            let (sender, cancel) = (sender.clone(), cancel.clone());
            let work = move || {
                let mut worker = Worker::new(bench, files());
                loop {
                    let next = next.fetch_add(1, Ordering::Relaxed);
                    let Some(number) = open.get(next).copied().filter(|_| !cancel.is_cancelled()) else { return };
                    let outcome = worker.judge(number, timer);
                    // What was stopped says nothing of the mutant.
                    if cancel.is_cancelled() && matches!(outcome, Outcome::Open(_) | Outcome::Survived(_)) {
                        return;
                    }
                    if sender.send((number, outcome)).is_err() {
                        return;
                    }
                }
            };
            let started = Builder::new().name("mutate".to_string()).stack_size(STACK).spawn_scoped(scope, work);
            if started.is_err() {
                break;
            }
        }
        drop(sender);
        for (number, outcome) in judged {
            port.tell(MutateEvent::Judged(number, Box::new(outcome.clone())));
            judged_one(number, &outcome);
            outcomes[number] = Some(outcome);
        }
    });
}
