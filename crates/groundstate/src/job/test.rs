//! Runs scenarios, as a job.
//!
//! In: their texts and a loader. Out: each scenario's verdict as soon as it is known; at the end the suite, which knows
//! the coverage.

use std::io;

use model::Loader;
use scenario::{FirstCandidate, Options};
use syntax::SourceFile;

use crate::job::{Cancel, Job};
use crate::{SeededChoices, Suite, Tested};

/// The result of one scenario.
#[derive(Debug)]
pub struct TestEvent(pub Box<Tested>);

/// Starts to run scenarios one after the other. A choice that no `pick` decides takes the first candidate, or is drawn
/// from a seed. If the job is cancelled while a scenario runs, neither that scenario, unless it passed, nor those after
/// it are reported.
///
/// # Errors
/// The system cannot start a thread.
pub fn test(
    scenarios: impl IntoIterator<Item = SourceFile> + Send + 'static,
    mut loader: impl Loader + Send + 'static,
    options: Options,
    seed: Option<u64>,
    cancel: Cancel,
) -> io::Result<Job<TestEvent, Suite>> {
    let mut options = options;
    options.limits.interrupt = cancel.interrupt().clone();
    Job::start("test", cancel, move |port| {
        let mut suite = Suite::new();
        let mut scenarios = scenarios.into_iter();
        while !port.is_cancelled()
            && let Some(scenario) = scenarios.next()
        {
            let options = options.clone();
            let tested = match seed {
                None => suite.test(scenario, &mut loader, options, &mut FirstCandidate),
                Some(seed) => suite.test(scenario, &mut loader, options, &mut SeededChoices::new(seed)),
            };
            if port.is_cancelled() && !tested.passed() {
                break;
            }
            port.tell(TestEvent(Box::new(tested)));
        }
        suite
    })
}
