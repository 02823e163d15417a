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
use crate::mutation::{Bench, Outcome, Timer, Wanted, Worker};
use crate::workspace::Files;

/// An event of a mutation analysis.
#[derive(Debug)]
pub enum MutateEvent {
    /// A model or a scenario is tried as it is.
    Tried(String),
    /// All were; these many mutants are to be judged.
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
}

/// A mutation analysis.
pub type MutateJob = Job<MutateEvent, Mutated>;

/// How to judge.
pub struct Hands<F> {
    /// Makes what a worker reads texts from.
    pub files: Box<dyn Fn() -> F + Send + Sync>,
    /// Measures each judgement.
    pub timer: Arc<dyn Timer>,
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
        let mut workspace = Workspace::new((hands.files)());
        let bench = Bench::new(wanted, &mut workspace, cancel.interrupt(), &mut |path| {
            port.tell(MutateEvent::Tried(path.to_string()));
        });
        let bench = Arc::new(bench);
        let mut outcomes = vec![None; bench.candidates.len()];
        if bench.unfit.is_empty() || !strict {
            port.tell(MutateEvent::Begun(bench.candidates.len()));
            judge(&bench, &hands, &port, &mut outcomes);
        }
        Mutated { bench, outcomes }
    })
}

fn judge<F: Files + Send>(
    bench: &Arc<Bench>,
    hands: &Hands<F>,
    port: &Port<MutateEvent>,
    outcomes: &mut [Option<Outcome>],
) {
    let (next, (sender, judged)) = (AtomicUsize::new(0), channel());
    let (next, cancel) = (&next, port.cancel.clone());
    scope(|scope| {
        for _ in 0..hands.workers.clamp(1, outcomes.len().max(1)) {
            let (sender, cancel, count) = (sender.clone(), cancel.clone(), outcomes.len());
            let work = move || {
                let mut worker = Worker::new(bench, (hands.files)());
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= count || cancel.is_cancelled() {
                        return;
                    }
                    let outcome = worker.judge(number, &*hands.timer);
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
            outcomes[number] = Some(outcome);
        }
    });
}
