//! Reports progress and findings of a search while it goes on.
//!
//! In: a [`Listener`] from outside, which knows checks. Out: a [`Heed`] for the search, which knows targets. INVARIANT:
//! reported violations equal the final verdicts. The least of several findings at one distance is known only when
//! everything at that distance was explored, so it is not reported sooner.

use std::collections::BTreeMap;

use crate::progress::Progress;
use crate::question::Subject;
use crate::target::{Found, Target};
use crate::trace::Trace;

/// Receives the progress and the violations of a verification.
pub trait Listener {
    /// Reports progress; returns whether to go on.
    fn at(&mut self, progress: &Progress) -> bool;

    /// Whether to report what was found already. Asked only after something was found.
    fn wants(&mut self) -> bool {
        false
    }

    /// Reports a violation, at the end of this run. Each check is reported at most once here; the report contains it
    /// again.
    fn violated(&mut self, subject: Subject, trace: &Trace) {
        let _ = (subject, trace);
    }
}

/// A function that receives only progress.
impl<F: FnMut(&Progress) -> bool> Listener for F {
    fn at(&mut self, progress: &Progress) -> bool {
        self(progress)
    }
}

/// Translates a search's findings for its listener.
pub(crate) struct Heed<'l> {
    pub listener: &'l mut dyn Listener,
    /// The check that each target violates.
    pub subjects: BTreeMap<Target, Subject>,
    /// What was reported, and its distance.
    pub told: BTreeMap<Target, (usize, Trace)>,
}

impl Heed<'_> {
    /// Reports progress; returns whether to go on.
    pub fn at(&mut self, progress: &Progress) -> bool {
        self.listener.at(progress)
    }

    /// Reports a finding, unless it was reported before.
    pub fn tell(&mut self, found: &Found, trace: Trace) {
        let known = self.told.insert(found.target, (found.depth, trace)).is_some();
        if let (Some(subject), false) = (self.subjects.get(&found.target), known) {
            self.listener.violated(*subject, &self.told[&found.target].1);
        }
    }

    /// Whether this finding should be reported now.
    pub fn is_news(&self, found: &Found) -> bool {
        self.subjects.contains_key(&found.target) && !self.told.contains_key(&found.target)
    }
}
