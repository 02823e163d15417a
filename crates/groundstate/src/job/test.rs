//! Scenarios as a job.
//!
//! In: their texts and a loader. Out: each scenario's verdict as it is there; at the end the suite, which knows what they
//! covered.

use std::io;

use model::Loader;
use scenario::{FirstCandidate, Options};
use syntax::SourceFile;

use crate::job::{Cancel, Job};
use crate::{SeededChoices, Suite, Tested};

/// What scenarios tell.
#[derive(Debug)]
pub struct TestEvent(pub Box<Tested>);

/// Starts scenarios, one after the other as they come. Choices that no `pick` makes take the first candidate, or are drawn from a
/// seed. One that was cancelled before it came to a good end is not told of, nor are those after it.
///
/// # Errors
/// The system gives no thread.
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
