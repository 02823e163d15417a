//! Generates tests, as a job.
//!
//! In: a [`TestsRequest`]. Out: progress of the search; at the end scenarios and goals, or why there are none.

use std::collections::BTreeSet;
use std::io;
use std::sync::Arc;

use model::Model;
use program::Program;
use syntax::FileId;
use verify::{NoStart, Options, Progress};

use crate::job::{Cancel, Job};
use crate::test_generation::{Method, Subject, Tests, chart_turns};

/// The tests to generate.
#[derive(Debug)]
pub struct TestsRequest {
    /// The model.
    pub model: Arc<Model>,
    /// Its program.
    pub program: Arc<Program>,
    /// The path by which the scenarios load the model.
    pub path: String,
    /// How far the search goes.
    pub options: Options,
    /// How the search for goals works.
    pub method: Method,
    /// Only parts of the model in these files are goals.
    pub files: BTreeSet<FileId>,
}

/// The progress of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TestsEvent(pub Progress);

/// A generation of tests. If cancelled, it returns tests for what was reached until then.
pub type TestsJob = Job<TestsEvent, Result<Tests, NoStart>>;

/// Starts to generate tests.
///
/// # Errors
/// The system cannot start a thread.
pub fn generate_tests(request: TestsRequest, cancel: Cancel) -> io::Result<TestsJob> {
    let TestsRequest { model, program, path, options, method, files } = request;
    let options = Options { interrupt: cancel.interrupt().clone(), ..options };
    Job::start("generate-tests", cancel, move |port| {
        let turns = chart_turns(&model);
        let subject = Subject { model: &model, program: &program, turns: &turns, path: &path };
        let own = |file: FileId| files.contains(&file);
        crate::test_generation::generate_tests(subject, &options, method, &own, &mut |progress| {
            port.mention(TestsEvent(*progress));
            !port.is_cancelled()
        })
    })
}
