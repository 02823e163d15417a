//! What is violated, told while the search goes on.
//!
//! In: what a search tells of itself. Out: verdicts, as soon as it has been going on for a moment; those of a search that ends before
//! are told at its end, in their order. INVARIANT: each violation is shown once.

use std::collections::BTreeSet;
use std::time::Duration;

use groundstate::verify::{Listener, Progress, Subject, Trace};

use crate::failure::Failure;
use crate::shell::Shell;
use crate::verify::tell::Teller;
use crate::verify::watch::Watch;

/// Of shorter searches everything is told at the end.
const PATIENCE: Duration = Duration::from_secs(1);

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

    /// The search has ended: whether the time was up, and what was told.
    pub fn done(self) -> Result<(bool, BTreeSet<Subject>), Failure> {
        let timed_out = self.watch.done();
        self.failure.map_or(Ok((timed_out, self.told)), Err)
    }
}

impl Listener for Live<'_> {
    fn at(&mut self, progress: &Progress) -> bool {
        // Where nobody reads what is told there is nothing to search for.
        self.watch.at(progress) && self.failure.is_none()
    }

    fn wants(&mut self) -> bool {
        self.watch.elapsed() > PATIENCE
    }

    fn violated(&mut self, subject: Subject, trace: &Trace) {
        self.watch.hide();
        let told = self.teller.violated(self.shell, subject, trace).and_then(|()| self.shell.flush());
        self.told.insert(subject);
        self.failure = self.failure.take().or(told.err());
    }
}
