//! What is violated, told while the search goes on.
//!
//! In: what a search tells of itself. Out: verdicts, as soon as it has been going on for a moment; those of a search that ends before
//! are told at its end, in their order. INVARIANT: each violation is shown once.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use groundstate::job::VerifyEvent;
use groundstate::verify::{Subject, Trace};

use crate::failure::Failure;
use crate::shell::Shell;
use crate::verify::tell::Teller;
use crate::verify::watch::Watch;

/// Of shorter searches everything is told at the end.
const PATIENCE: Duration = Duration::from_secs(1);

/// Says from when on a search that begins now is to tell of violations.
pub fn impatience() -> impl FnMut() -> bool + Send + 'static {
    let began = Instant::now();
    move || began.elapsed() > PATIENCE
}

/// See the module.
pub struct Live<'a> {
    shell: &'a mut Shell,
    teller: &'a Teller<'a>,
    watch: Watch,
    told: BTreeSet<Subject>,
    failure: Option<Failure>,
}

impl<'a> Live<'a> {
    pub fn new(shell: &'a mut Shell, teller: &'a Teller<'a>, watch: Watch) -> Live<'a> {
        Live { shell, teller, watch, told: BTreeSet::new(), failure: None }
    }

    /// Tells of an event; `false` where the search is to end.
    pub fn hear(&mut self, event: &VerifyEvent) -> bool {
        match event {
            VerifyEvent::Progress(progress) => return self.watch.at(progress),
            VerifyEvent::Violated(subject, trace) => self.violated(*subject, trace),
        }
        // Where nobody reads what is told there is nothing to search for.
        self.failure.is_none()
    }

    fn violated(&mut self, subject: Subject, trace: &Trace) {
        self.watch.hide();
        let told = self.teller.violated(self.shell, subject, trace).and_then(|()| self.shell.flush());
        self.told.insert(subject);
        self.failure = self.failure.take().or(told.err());
    }

    /// The search has ended: whether the time was up, and what was told.
    pub fn done(self) -> Result<(bool, BTreeSet<Subject>), Failure> {
        let timed_out = self.watch.done();
        self.failure.map_or(Ok((timed_out, self.told)), Err)
    }
}
