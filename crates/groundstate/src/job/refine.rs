//! Decides a refinement, as a job.
//!
//! In: a coupling of two machines and options; solvers where they are asked, or a keeper if the search is kept. Out: progress while it goes
//! on; at the end the report, or why there is none.

use std::io;

use ::refine::{Coupling, Keeper, Options, Progress, Provers, Report, Trouble, refine_kept};
use solve::session::Solvers;

use crate::job::{Cancel, Job};

/// The progress of the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RefineEvent(pub Progress);

/// A refinement check: its result is the report, or why there is none, the coupling, and the keeper that was passed in.
pub type RefineJob<K> = Job<RefineEvent, (Result<Report, Trouble>, Coupling, Option<K>)>;

/// How it is decided.
#[derive(Debug)]
pub enum How<S, K> {
    /// By looking at the pairs of states; with a keeper, the search goes on from its checkpoint.
    Search(Option<K>),
    /// By solvers.
    Ask(Ask<S>),
}

/// What solvers are asked.
#[derive(Debug)]
pub struct Ask<S> {
    /// What for.
    pub about: About,
    /// Whom.
    pub solvers: Vec<S>,
    /// The most seconds for a question.
    pub seconds: u32,
    /// The most steps of runs.
    pub depth: u64,
}

/// What solvers are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum About {
    /// For a proof by induction, which two of them must accept; where it fails, for runs of a few steps.
    Induction,
    /// For runs that refute.
    Runs,
}

/// Starts the check. If cancelled, it stops where it is and says what it knows by then.
///
/// # Errors
/// The system cannot start a thread.
pub fn refine<S, K>(
    coupling: Coupling,
    mut options: Options,
    how: How<S, K>,
    cancel: Cancel,
) -> io::Result<RefineJob<K>>
where
    S: Solvers + Send + 'static,
    K: Keeper + Send + 'static,
{
    options.extents.iter_mut().for_each(|extent| extent.interrupt = cancel.interrupt().clone());
    Job::start("refine", cancel, move |port| {
        let mut watch = |progress: &Progress| {
            port.mention(RefineEvent(*progress));
            !port.is_cancelled()
        };
        match how {
            How::Search(mut keeper) => {
                let kept = keeper.as_mut().map(|keeper| -> &mut dyn Keeper { keeper });
                (refine_kept(&coupling, &options, kept, &mut watch), coupling, keeper)
            }
            How::Ask(Ask { about, mut solvers, seconds, depth }) => {
                let solvers = solvers.iter_mut().map(|solver| -> &mut dyn Solvers { solver }).collect();
                let provers = Provers { solvers, seconds, depth };
                let report = match about {
                    About::Induction => ::refine::prove(&coupling, &options, provers, &mut watch),
                    About::Runs => ::refine::refute(&coupling, &options, provers, &mut watch),
                };
                (report, coupling, None)
            }
        }
    })
}
