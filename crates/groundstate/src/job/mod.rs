//! Runs work on its own thread: it reports progress, can be cancelled, and returns its result at the end.
//!
//! In: the work, which gets a [`Port`] to its owner. Out: a [`Job`]. Events go through a bounded channel: a job that
//! sends faster than its owner reads waits, so memory does not grow. Frequent events are sent in batches, which the
//! reader does not see. What is only mentioned, such as progress, wakes nobody: the reader looks for it now and then.
//! INVARIANT: a job whose owner is gone ends as if it had been cancelled; events arrive in the
//! order in which they were sent, and nothing that is mentioned arrives after an event that was sent later.

mod conform;
pub(crate) mod desk;
mod generate;
mod generate_tests;
mod list;
mod mutate;
mod refine;
mod review;
mod run;
mod test;
mod verify;

use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TryRecvError, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

use machine::{Cause, Interrupt};

pub use conform::{
    Agreed, ConformEvent, ConformJob, ConformRequest, Conformed, Events, LastPhase, NoTail, NotConformed, Piece, Tail,
    conform,
};
pub use desk::{Command, Frozen, Remote, RunEvent};
pub use generate::{
    Folder, GenerateEvent, GenerateJob, NotGenerated, generate_model, generate_system, machine_of_component,
};
pub use generate_tests::{TestsEvent, TestsJob, TestsRequest, generate_tests};
pub use list::{ListEvent, ListJob, list};
pub use mutate::{Hands, MutateEvent, MutateJob, Mutated, mutate};
pub use refine::{About, Ask, How, RefineEvent, RefineJob, refine};
pub use review::{ReviewEvent, ReviewJob, ReviewRequest, review};
pub use run::{RunJob, RunRequest, at_once, report, run};
pub use test::{TestEvent, test};
pub use verify::{NO_KEEPER, VerifyEvent, VerifyJob, verify};

/// How many batches may wait to be read.
const WAITING: usize = 64;

/// The largest number of events in a batch.
const BATCH: usize = 64;

/// How often a reader that waits for events looks for what was mentioned. A search mentions its progress a hundred thousand times a
/// second, and to wake a thread takes as long as to make some steps.
const LOOK: Duration = Duration::from_millis(20);

/// At least as large as a main thread's stack: deep terms are evaluated by recursion.
const STACK: usize = 16 << 20;

/// Work in progress. `E` is its events, `T` its result.
#[derive(Debug)]
pub struct Job<E, T> {
    events: Receiver<Vec<E>>,
    /// Events of the last batch that were not read yet.
    read: RefCell<VecDeque<E>>,
    mentioned: Mentioned<E>,
    thread: JoinHandle<T>,
    cancel: Cancel,
}

/// The work panicked, which is a bug of this program; contains the panic's message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Crashed(pub String);

/// Cancels a job, from any thread.
#[derive(Debug, Clone)]
pub struct Cancel(Interrupt);

impl Cancel {
    /// A handle for one job; its clones cancel the same job.
    pub fn new() -> Cancel {
        Cancel(Interrupt::new())
    }

    /// Asks the job to end. It checks for this between and within steps.
    pub fn cancel(&self) {
        self.0.raise(Cause::Asked);
    }

    /// Whether the job was asked to end.
    pub fn is_cancelled(&self) -> bool {
        self.0.cause() == Some(Cause::Asked)
    }

    /// The flag that machines and searches check.
    pub fn interrupt(&self) -> &Interrupt {
        &self.0
    }
}

impl Default for Cancel {
    fn default() -> Cancel {
        Cancel::new()
    }
}

/// Lets a shell cancel a job by an interrupt that it has already, such as one raised by a signal.
impl From<Interrupt> for Cancel {
    fn from(interrupt: Interrupt) -> Cancel {
        Cancel(interrupt)
    }
}

/// The job's side: sends events, and tells whether the job was cancelled.
#[derive(Debug)]
pub struct Port<E> {
    events: SyncSender<Vec<E>>,
    held: RefCell<Vec<E>>,
    mentioned: Mentioned<E>,
    cancel: Cancel,
}

/// The last event that was mentioned and not read.
type Mentioned<E> = Arc<Mutex<Option<E>>>;

fn slot<E>(mentioned: &Mentioned<E>) -> MutexGuard<'_, Option<E>> {
    mentioned.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<E> Port<E> {
    /// Sends an event; waits while too many are unread.
    pub fn tell(&self, event: E) {
        self.held.borrow_mut().push(event);
        self.flush();
    }

    /// Collects an event, and sends the batch when it is full or the event `is_due`.
    pub fn add(&self, event: E, is_due: bool) {
        let mut held = self.held.borrow_mut();
        held.push(event);
        if is_due || held.len() >= BATCH {
            drop(held);
            self.flush();
        }
    }

    /// Lays out an event for a reader who has nothing else to read, in place of the one before. For events that the
    /// next one makes out of date.
    pub fn mention(&self, event: E) {
        if self.held.borrow().is_empty() {
            *slot(&self.mentioned) = Some(event);
        }
    }

    fn flush(&self) {
        let held = self.held.take();
        if held.is_empty() {
            return;
        }
        *slot(&self.mentioned) = None;
        if self.events.send(held).is_err() {
            self.cancel.cancel();
        }
    }

    /// Whether the job was asked to end.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }
}

/// Sends the last batch when the work ends.
impl<E> Drop for Port<E> {
    fn drop(&mut self) {
        let held = self.held.take();
        if !held.is_empty() {
            let _ = self.events.send(held);
        }
    }
}

impl<E: Send + 'static, T: Send + 'static> Job<E, T> {
    /// Starts work on a thread called `name`.
    ///
    /// # Errors
    /// The system cannot start a thread.
    pub fn start(
        name: &str,
        cancel: Cancel,
        work: impl FnOnce(Port<E>) -> T + Send + 'static,
    ) -> Result<Job<E, T>, std::io::Error> {
        let (sender, events) = sync_channel(WAITING);
        let mentioned = Mentioned::default();
        let port = Port {
            events: sender,
            held: RefCell::default(),
            mentioned: Arc::clone(&mentioned),
            cancel: cancel.clone(),
        };
        let thread = Builder::new().name(name.to_string()).stack_size(STACK).spawn(move || work(port))?;
        Ok(Job { events, read: RefCell::default(), mentioned, thread, cancel })
    }
}

impl<E, T> Job<E, T> {
    /// Waits for the next event; `None` when the work has ended.
    pub fn next_event(&self) -> Option<E> {
        loop {
            match self.next_event_within(LOOK) {
                Ok(event) => return Some(event),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return None,
            }
        }
    }

    /// Waits at most this long for the next event.
    ///
    /// # Errors
    /// No event came in time, or the work has ended ([`RecvTimeoutError::Disconnected`]).
    pub fn next_event_within(&self, mut time: Duration) -> Result<E, RecvTimeoutError> {
        loop {
            let waits = time.min(LOOK);
            match self.next_of(|events| events.recv_timeout(waits)) {
                Ok(event) => return Ok(event),
                Err(ended) => match self.mentioned_event() {
                    Some(event) => return Ok(event),
                    None if ended == RecvTimeoutError::Disconnected || waits == time => return Err(ended),
                    None => time -= waits,
                },
            }
        }
    }

    /// The next event if there is one, without waiting.
    ///
    /// # Errors
    /// There is none.
    pub fn poll(&self) -> Result<E, TryRecvError> {
        self.next_of(|events| events.try_recv()).or_else(|none| self.mentioned_event().ok_or(none))
    }

    /// What was mentioned last, or what was sent before it and has not been read.
    fn mentioned_event(&self) -> Option<E> {
        let mut mentioned = slot(&self.mentioned);
        self.next_of(|events| events.try_recv()).ok().or_else(|| mentioned.take())
    }

    fn next_of<X>(&self, receive: impl Fn(&Receiver<Vec<E>>) -> Result<Vec<E>, X>) -> Result<E, X> {
        let mut read = self.read.borrow_mut();
        loop {
            if let Some(event) = read.pop_front() {
                return Ok(event);
            }
            read.extend(receive(&self.events)?);
        }
    }

    /// Cancels the job, also from another thread.
    pub fn cancel(&self) -> &Cancel {
        &self.cancel
    }

    /// Waits for the end, and drops unread events.
    ///
    /// # Errors
    /// The work panicked.
    pub fn finish(self) -> Result<T, Crashed> {
        let Job { events, thread, .. } = self;
        events.iter().for_each(drop);
        thread.join().map_err(|panic| Crashed(said(&*panic)))
    }
}

/// The message of a panic.
fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_string());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default()
}
