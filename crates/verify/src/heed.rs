//! Whoever waits for a search: is told how far it is and what it has found, while it goes on.
//!
//! In: a [`Listener`], from outside, who knows of checks. Out: a [`Heed`] for who searches, who knows of what it looks for.
//! INVARIANT: what is told is what the verdict will be: of what is found at one distance the least is known only when all there is
//! at that distance was looked at, and is told no sooner.

use std::collections::BTreeMap;

use crate::progress::Progress;
use crate::question::Subject;
use crate::target::{Found, Target};
use crate::trace::Trace;

/// Whoever waits for verdicts.
pub trait Listener {
    /// The search is so far; whether it goes on.
    fn at(&mut self, progress: &Progress) -> bool;

    /// Whether it is time to be told of what was found already. Asked where something was.
    fn wants(&mut self) -> bool {
        false
    }

    /// A check is violated, at the end of this run. Each check is told of once at most; the report tells of it again.
    fn violated(&mut self, subject: Subject, trace: &Trace) {
        let _ = (subject, trace);
    }
}

/// A function hears of progress alone.
impl<F: FnMut(&Progress) -> bool> Listener for F {
    fn at(&mut self, progress: &Progress) -> bool {
        self(progress)
    }
}

/// See the module.
pub(crate) struct Heed<'l> {
    pub listener: &'l mut dyn Listener,
    /// The checks that are violated where something is found.
    pub subjects: BTreeMap<Target, Subject>,
    /// What was told, and the distance it is at.
    pub told: BTreeMap<Target, (usize, Trace)>,
}

impl Heed<'_> {
    /// The search is so far; whether it goes on.
    pub fn at(&mut self, progress: &Progress) -> bool {
        self.listener.at(progress)
    }

    /// Tells of what was found, unless that was told.
    pub fn tell(&mut self, found: &Found, trace: Trace) {
        let known = self.told.insert(found.target, (found.depth, trace)).is_some();
        if let (Some(subject), false) = (self.subjects.get(&found.target), known) {
            self.listener.violated(*subject, &self.told[&found.target].1);
        }
    }

    /// Whether this is to be told of now.
    pub fn is_news(&self, found: &Found) -> bool {
        self.subjects.contains_key(&found.target) && !self.told.contains_key(&found.target)
    }
}
