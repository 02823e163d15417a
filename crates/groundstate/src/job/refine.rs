//! Decides a refinement, as a job.
//!
//! In: a coupling of two machines and options, for a proof by induction solvers as well. Out: progress while the search goes on; at the end the report, or why there is none.

use std::io;

use ::refine::{Coupling, Options, Progress, Provers, Report, Trouble};
use solve::session::Solvers;

use crate::job::{Cancel, Job};

/// The progress of the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RefineEvent(pub Progress);

/// A refinement check: its result is the report, or why there is none, and the coupling.
pub type RefineJob = Job<RefineEvent, (Result<Report, Trouble>, Coupling)>;

/// Starts the check. If cancelled, it stops where it is and says what it knows by then.
///
/// # Errors
/// The system cannot start a thread.
pub fn refine(coupling: Coupling, mut options: Options, cancel: Cancel) -> io::Result<RefineJob> {
    options.extents.iter_mut().for_each(|extent| extent.interrupt = cancel.interrupt().clone());
    Job::start("refine", cancel, move |port| {
        let mut watch = |progress: &Progress| {
            port.mention(RefineEvent(*progress));
            !port.is_cancelled()
        };
        let report = ::refine::refine(&coupling, &options, &mut watch);
        (report, coupling)
    })
}

/// Starts a proof by induction, like [`refine()`]. Two solvers must accept it.
///
/// # Errors
/// The system cannot start a thread.
pub fn prove<S: Solvers + Send + 'static>(
    coupling: Coupling,
    mut options: Options,
    mut solvers: Vec<S>,
    seconds: u32,
    cancel: Cancel,
) -> io::Result<RefineJob> {
    options.extents.iter_mut().for_each(|extent| extent.interrupt = cancel.interrupt().clone());
    Job::start("refine", cancel, move |port| {
        let mut watch = |progress: &Progress| {
            port.mention(RefineEvent(*progress));
            !port.is_cancelled()
        };
        let solvers = solvers.iter_mut().map(|solver| -> &mut dyn Solvers { solver }).collect();
        let report = ::refine::prove(&coupling, &options, Provers { solvers, seconds }, &mut watch);
        (report, coupling)
    })
}
