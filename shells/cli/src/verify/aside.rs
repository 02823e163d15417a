//! A search beside the one that was asked for: nothing is told of it but how far it is.
//!
//! In: a request without a keeper. Out: its report, or why there is none.

use groundstate::job::{self, Cancel, VerifyEvent};
use groundstate::verify::{NoStart, Report, Request};
use solve::session::Solvers;

use super::watch::Watch;
use crate::failure::Failure;

/// Searches to the end, until it is cancelled, or until `is_up`.
pub fn search(
    request: Request,
    solvers: impl Solvers + Send + 'static,
    cancel: Cancel,
    watch: &mut Watch,
    is_up: &dyn Fn() -> bool,
) -> Result<Result<Report, NoStart>, Failure> {
    let job = job::verify(request, cancel, solvers, job::NO_KEEPER, || false);
    let job = job.map_err(|error| Failure::usage(format!("the search cannot be started: {error}")))?;
    while let Some(event) = job.next_event() {
        if let VerifyEvent::Progress(progress) = event
            && (!watch.at(&progress) || is_up())
        {
            job.cancel().cancel();
        }
    }
    let (outcome, _) = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    watch.hide();
    Ok(outcome)
}
