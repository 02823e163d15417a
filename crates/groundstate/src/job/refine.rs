//! Decides a refinement, as a job.
//!
//! In: a coupling of two machines and options, and solvers where they are asked. Out: progress while the search goes on; at the end the
//! report, or why there is none.

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

/// How solvers are asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// For a proof by induction, which two of them must accept; where it fails, for runs of a few steps.
    Induction,
    /// For runs that refute.
    Runs,
}

/// Starts to ask solvers, like [`refine()`]: so many seconds for a question, about runs of so many steps.
///
/// # Errors
/// The system cannot start a thread.
pub fn ask<S: Solvers + Send + 'static>(
    asked: Asked,
    coupling: Coupling,
    mut options: Options,
    mut solvers: Vec<S>,
    (seconds, depth): (u32, u64),
    cancel: Cancel,
) -> io::Result<RefineJob> {
    options.extents.iter_mut().for_each(|extent| extent.interrupt = cancel.interrupt().clone());
    Job::start("refine", cancel, move |port| {
        let mut watch = |progress: &Progress| {
            port.mention(RefineEvent(*progress));
            !port.is_cancelled()
        };
        let solvers = solvers.iter_mut().map(|solver| -> &mut dyn Solvers { solver }).collect();
        let provers = Provers { solvers, seconds, depth };
        let report = match asked {
            Asked::Induction => ::refine::prove(&coupling, &options, provers, &mut watch),
            Asked::Runs => ::refine::refute(&coupling, &options, provers, &mut watch),
        };
        (report, coupling)
    })
}
