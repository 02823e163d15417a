//! Reviews a model, as a job.
//!
//! In: a [`ReviewRequest`]. Out: progress; at the end what is odd about the model, or why nothing is known of it.

use std::collections::BTreeSet;
use std::io;
use std::sync::Arc;

use model::Model;
use program::Program;
use syntax::FileId;
use verify::review::{Meta, Review};
use verify::{NoStart, Options, Progress};

use crate::job::{Cancel, Job};

/// The review to make.
#[derive(Debug)]
pub struct ReviewRequest {
    /// The model.
    pub model: Arc<Model>,
    /// Its program.
    pub program: Arc<Program>,
    /// How far the search goes.
    pub options: Options,
    /// The meta-properties to check.
    pub metas: Vec<Meta>,
    /// Only findings in these files are reported.
    pub files: BTreeSet<FileId>,
}

/// The progress of a review's search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReviewEvent(pub Progress);

/// A review. If cancelled, it reports what it found until then.
pub type ReviewJob = Job<ReviewEvent, Result<Review, NoStart>>;

/// Starts a review.
///
/// # Errors
/// The system cannot start a thread.
pub fn review(request: ReviewRequest, cancel: Cancel) -> io::Result<ReviewJob> {
    let ReviewRequest { model, program, options, metas, files } = request;
    let options = Options { interrupt: cancel.interrupt().clone(), ..options };
    Job::start("review", cancel, move |port| {
        let own = |file: FileId| files.contains(&file);
        verify::review::review(&model, &program, &options, &metas, &own, &mut |progress| {
            port.mention(ReviewEvent(*progress));
            !port.is_cancelled()
        })
    })
}
