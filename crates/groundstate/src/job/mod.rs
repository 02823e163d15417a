//! Work on a thread of its own: it tells how it goes, can be cancelled, and gives its result at the end.
//!
//! In: what is to be done, with a [`Port`] to the one who waits. Out: a [`Job`]. Events go through a bounded channel: work that
//! tells more than is read waits, so that nothing grows. Those that come by the thousand go in batches, which whoever reads does not see.
//! INVARIANT: a job whose owner is gone ends as if it had been cancelled; events are read in the order in which they were told.

mod conform;
mod generate;
mod generate_tests;
mod review;
mod run;
mod test;
mod verify;

use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TryRecvError, sync_channel};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

use machine::{Cause, Interrupt};

pub use conform::{
    ConformEvent, ConformJob, ConformRequest, Conformed, Events, NoTail, NotConformed, Piece, Tail, conform,
};
pub use generate::{Folder, GenerateEvent, GenerateJob, Headers, NotGenerated, generate_model, generate_system};
pub use generate_tests::{TestsEvent, TestsJob, TestsRequest, generate_tests};
pub use review::{ReviewEvent, ReviewJob, ReviewRequest, review};
pub use run::{Command, Remote, RunEvent, RunJob, RunRequest, at_once, report, run};
pub use test::{TestEvent, test};
pub use verify::{NO_KEEPER, VerifyEvent, VerifyJob, verify};

/// Batches that wait to be read.
const WAITING: usize = 64;

/// The most events of a batch.
const BATCH: usize = 64;

/// As much as a main thread has, and more: deep terms are evaluated by recursion.
const STACK: usize = 16 << 20;

/// Work that is being done. `E` is what it tells while it goes on, `T` its result.
#[derive(Debug)]
pub struct Job<E, T> {
    events: Receiver<Vec<E>>,
    /// Those of the last batch that are not read yet.
    read: RefCell<VecDeque<E>>,
    thread: JoinHandle<T>,
    cancel: Cancel,
}

/// The work ended by a panic, which is a bug of this program; what it said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Crashed(pub String);

/// Ends a job from anywhere.
#[derive(Debug, Clone)]
pub struct Cancel(Interrupt);

impl Cancel {
    /// For one job, by way of any of its clones.
    pub fn new() -> Cancel {
        Cancel(Interrupt::new())
    }

    /// Asks the job to end. It looks at this between steps and within them.
    pub fn cancel(&self) {
        self.0.raise(Cause::Asked);
    }

    /// Whether the job was asked to end.
    pub fn is_cancelled(&self) -> bool {
        self.0.cause() == Some(Cause::Asked)
    }

    /// What a machine and a search look at.
    pub fn interrupt(&self) -> &Interrupt {
        &self.0
    }
}

impl Default for Cancel {
    fn default() -> Cancel {
        Cancel::new()
    }
}

/// By what a shell asks all of its work to end, a signal for one.
impl From<Interrupt> for Cancel {
    fn from(interrupt: Interrupt) -> Cancel {
        Cancel(interrupt)
    }
}

/// The job's side: where it tells its events, and learns that it is to end.
#[derive(Debug)]
pub struct Port<E> {
    events: SyncSender<Vec<E>>,
    held: RefCell<Vec<E>>,
    cancel: Cancel,
}

impl<E> Port<E> {
    /// Tells an event; waits where too many are not read yet.
    pub fn tell(&self, event: E) {
        self.held.borrow_mut().push(event);
        self.flush();
    }

    /// Tells an event with others, when there are enough of them or it `is_due`.
    pub fn add(&self, event: E, is_due: bool) {
        let mut held = self.held.borrow_mut();
        held.push(event);
        if is_due || held.len() >= BATCH {
            drop(held);
            self.flush();
        }
    }

    /// Tells an event, unless too many are not read yet: for those that are out of date by the next.
    pub fn mention(&self, event: E) {
        if self.held.borrow().is_empty() {
            let _ = self.events.try_send(vec![event]);
        }
    }

    fn flush(&self) {
        let held = self.held.take();
        if !held.is_empty() && self.events.send(held).is_err() {
            self.cancel.cancel();
        }
    }

    /// Whether to end.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }
}

/// What is held is told when the work ends.
impl<E> Drop for Port<E> {
    fn drop(&mut self) {
        let held = self.held.take();
        if !held.is_empty() {
            let _ = self.events.send(held);
        }
    }
}

impl<E: Send + 'static, T: Send + 'static> Job<E, T> {
    /// Starts work. `name` is that of its thread.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn start(
        name: &str,
        cancel: Cancel,
        work: impl FnOnce(Port<E>) -> T + Send + 'static,
    ) -> Result<Job<E, T>, std::io::Error> {
        let (sender, events) = sync_channel(WAITING);
        let port = Port { events: sender, held: RefCell::default(), cancel: cancel.clone() };
        let thread = Builder::new().name(name.to_string()).stack_size(STACK).spawn(move || work(port))?;
        Ok(Job { events, read: RefCell::default(), thread, cancel })
    }
}

impl<E, T> Job<E, T> {
    /// The next event, when it comes; none when the work has ended.
    pub fn next_event(&self) -> Option<E> {
        self.next_of(|events| events.recv()).ok()
    }

    /// The next event if it comes within this time. The work has ended where that is [`RecvTimeoutError::Disconnected`].
    ///
    /// # Errors
    /// None came.
    pub fn next_event_within(&self, time: Duration) -> Result<E, RecvTimeoutError> {
        self.next_of(|events| events.recv_timeout(time))
    }

    /// The next event if it is there.
    ///
    /// # Errors
    /// None is.
    pub fn poll(&self) -> Result<E, TryRecvError> {
        self.next_of(|events| events.try_recv())
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

    /// By what the job is cancelled, also from another thread.
    pub fn cancel(&self) -> &Cancel {
        &self.cancel
    }

    /// Waits for the end; events that were not read are dropped.
    ///
    /// # Errors
    /// The work panicked.
    pub fn finish(self) -> Result<T, Crashed> {
        let Job { events, thread, .. } = self;
        events.iter().for_each(drop);
        thread.join().map_err(|panic| Crashed(said(&*panic)))
    }
}

/// What a panic said.
fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_string());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default()
}
