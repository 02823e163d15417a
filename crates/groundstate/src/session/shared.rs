//! What the thread of a session and its owner share: the present moment, what stops the run, what its timeline is made of.
//!
//! The thread writes moments, which never change, and notes the timeline; the owner sets breaks, and reads the rest whenever it likes.

use std::sync::{Arc, Mutex, PoisonError};

use crate::session::breaks::Breaks;
use crate::session::moment::Moment;
use crate::session::tape::Tape;
use crate::session::written::Notes;

/// What the thread of a session and its owner share.
#[derive(Debug, Default)]
pub(crate) struct Shared {
    moment: Mutex<Option<Arc<Moment>>>,
    /// What a timeline is made of.
    pub tape: Tape,
    /// What a scenario of the run is made of.
    pub notes: Notes,
    breaks: Mutex<Arc<Breaks>>,
}

impl Shared {
    /// The present moment; none as long as the initial state is being set.
    pub fn moment(&self) -> Option<Arc<Moment>> {
        self.moment.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// From now on this is the present moment.
    pub fn set_moment(&self, moment: Moment) {
        *self.moment.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::new(moment));
    }

    /// What stops the run.
    pub fn breaks(&self) -> Arc<Breaks> {
        Arc::clone(&self.breaks.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// From now on this stops it.
    pub fn set_breaks(&self, breaks: Breaks) {
        *self.breaks.lock().unwrap_or_else(PoisonError::into_inner) = Arc::new(breaks);
    }
}
