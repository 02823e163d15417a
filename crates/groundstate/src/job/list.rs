//! Lists the states of a small model, as a job.
//!
//! In: a program, how far to go, and conditions on states. Out: progress; at the end the listing, or why there is none.

use std::io;
use std::sync::Arc;

use program::{Expression, Program};
use verify::listing::{Listing, list as listed};
use verify::{NoStart, Options, Progress};

use crate::job::{Cancel, Job};

/// The progress of a listing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListEvent(pub Progress);

/// A listing in the making. If cancelled, it has what was listed until then.
pub type ListJob = Job<ListEvent, Result<Listing, NoStart>>;

/// Starts a listing; of each state it says which of the terms are true in it.
///
/// # Errors
/// The system cannot start a thread.
pub fn list(program: Arc<Program>, options: Options, terms: Vec<Expression>, cancel: Cancel) -> io::Result<ListJob> {
    let options = Options { interrupt: cancel.interrupt().clone(), ..options };
    Job::start("graph", cancel, move |port| {
        listed(&program, &options, &terms, &mut |progress| {
            port.mention(ListEvent(*progress));
            !port.is_cancelled()
        })
    })
}
