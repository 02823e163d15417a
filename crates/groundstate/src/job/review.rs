//! A review as a job.
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

/// The review that is wanted.
#[derive(Debug)]
pub struct ReviewRequest {
    /// The model.
    pub model: Arc<Model>,
    /// Its program.
    pub program: Arc<Program>,
    /// How far the search goes.
    pub options: Options,
    /// What is asked.
    pub metas: Vec<Meta>,
    /// What stands in other files is not told of.
    pub files: BTreeSet<FileId>,
}

/// The search of a review is so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReviewEvent(pub Progress);

/// A review; cancelled, it tells what it found until then.
pub type ReviewJob = Job<ReviewEvent, Result<Review, NoStart>>;

/// Starts a review.
///
/// # Errors
/// The system gives no thread.
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
