//! Reports violations while the search goes on.
//!
//! In: the events of a search. Out: verdicts, once the search has run for a moment; a shorter search reports them at
//! its end, in their order. INVARIANT: each violation is shown once.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use groundstate::job::VerifyEvent;
use groundstate::verify::{Subject, Trace};

use crate::failure::Failure;
use crate::shell::Shell;
use crate::verify::tell::Teller;
use crate::verify::watch::Watch;

/// Shorter searches report everything at the end.
const PATIENCE: Duration = Duration::from_secs(1);

/// Decides when a search that starts now may report violations.
pub fn impatience() -> impl FnMut() -> bool + Send + 'static {
    let began = Instant::now();
    move || began.elapsed() > PATIENCE
}

/// Reports the events of a search.
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

    /// Reports an event; `false` if the search should end.
    pub fn hear(&mut self, event: &VerifyEvent) -> bool {
        match event {
            VerifyEvent::Progress(progress) => return self.watch.at(progress),
            VerifyEvent::Violated(subject, trace) => self.violated(*subject, trace),
        }
        // If the output fails, there is no point in searching on.
        self.failure.is_none()
    }

    fn violated(&mut self, subject: Subject, trace: &Trace) {
        self.watch.hide();
        let told = self.teller.violated(self.shell, subject, trace).and_then(|()| self.shell.flush());
        self.told.insert(subject);
        self.failure = self.failure.take().or(told.err());
    }

    /// Ends the report: whether the time was up, and which violations were shown.
    pub fn done(self) -> Result<(bool, BTreeSet<Subject>), Failure> {
        let timed_out = self.watch.done();
        self.failure.map_or(Ok((timed_out, self.told)), Err)
    }
}
