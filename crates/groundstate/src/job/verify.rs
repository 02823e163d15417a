//! Verifies a model, as a job.
//!
//! In: a [`Request`], SMT solvers, and a keeper if the search is kept. Out: progress, and violations while the search
//! goes on; at the end the report, and the keeper.

use std::io;

use verify::{Keeper, Listener, NoStart, Progress, Report, Request, Subject, Trace};

use solve::session::Solvers;

use crate::job::{Cancel, Job, Port};

/// An event of a verification.
#[derive(Debug, Clone, PartialEq)]
pub enum VerifyEvent {
    /// The progress of the search.
    Progress(Progress),
    /// A run that violates a check. The report contains it again.
    Violated(Subject, Box<Trace>),
}

/// A verification: its result is the report, or why there is none, and the keeper that was passed in.
pub type VerifyJob<K> = Job<VerifyEvent, (Result<Report, NoStart>, Option<K>)>;

/// For a search that is not kept.
pub const NO_KEEPER: Option<NoKeeper> = None;

/// A keeper that cannot exist, for searches that are not kept.
#[derive(Debug, Clone, Copy)]
pub enum NoKeeper {}

impl Keeper for NoKeeper {
    fn model(&self) -> u64 {
        match *self {}
    }

    fn is_due(&mut self) -> bool {
        match *self {}
    }

    fn open(&mut self) -> bool {
        match *self {}
    }

    fn read(&mut self, _words: &mut [u64]) -> bool {
        match *self {}
    }

    fn write(&mut self, _words: &[u64]) {
        match *self {}
    }

    fn end(&mut self) {
        match *self {}
    }

    fn remove(&mut self) {
        match *self {}
    }
}

struct Told<'p, W> {
    port: &'p Port<VerifyEvent>,
    wants: W,
}

impl<W: FnMut() -> bool> Listener for Told<'_, W> {
    fn at(&mut self, progress: &Progress) -> bool {
        self.port.mention(VerifyEvent::Progress(*progress));
        !self.port.is_cancelled()
    }

    fn wants(&mut self) -> bool {
        (self.wants)()
    }

    fn violated(&mut self, subject: Subject, trace: &Trace) {
        self.port.tell(VerifyEvent::Violated(subject, Box::new(trace.clone())));
    }
}

/// Starts a verification. If cancelled, it stops where it is and reports what it found until then. `wants` tells
/// whether to report violations before the end; each then costs a search for its run.
///
/// # Errors
/// The system cannot start a thread.
///
/// # Panics
/// The request was built for a keeper and `keeper` is `None`, or the other way round.
pub fn verify<S, K>(
    request: Request,
    cancel: Cancel,
    mut solvers: S,
    keeper: Option<K>,
    wants: impl FnMut() -> bool + Send + 'static,
) -> io::Result<VerifyJob<K>>
where
    S: Solvers + Send + 'static,
    K: Keeper + Send + 'static,
{
    let request = request.interrupted_by(cancel.interrupt().clone());
    Job::start("verify", cancel, move |port| {
        let (mut keeper, mut told) = (keeper, Told { port: &port, wants });
        let report = match &mut keeper {
            Some(keeper) => request.verify_kept(&mut solvers, keeper, &mut told),
            None => request.verify(&mut solvers, &mut told),
        };
        (report, keeper)
    })
}
