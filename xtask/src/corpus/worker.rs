//! A worker: reads jobs, does them, catches panics.
//!
//! In: one job a line on standard input. Out: one answer a line on standard output, whatever happens.

use std::io::{BufRead, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use super::job::{Answer, Job};
use super::loader::Checkout;
use super::{accept, explore, scenario, simulation};
use crate::Failure;

/// Does the jobs of standard input until it ends.
///
/// # Errors
/// A line that is no job, or the pipe breaks.
pub fn work(root: PathBuf) -> Result<(), Failure> {
    let checkout = Checkout { root };
    let place = Arc::new(Mutex::new(String::new()));
    let noted = Arc::clone(&place);
    std::panic::set_hook(Box::new(move |info| {
        if let Ok(mut place) = noted.lock() {
            *place = info.to_string().replace('\n', " ");
        }
    }));
    for line in std::io::stdin().lock().lines() {
        let line = line.map_err(|error| error.to_string())?;
        let job: Job = serde_json::from_str(&line).map_err(|error| error.to_string())?;
        let answer = catch_unwind(AssertUnwindSafe(|| answer(&checkout, &job)))
            .unwrap_or_else(|_| Answer::Panic { detail: place.lock().map(|place| place.clone()).unwrap_or_default() });
        let text = serde_json::to_string(&answer).map_err(|error| error.to_string())?;
        let mut out = std::io::stdout().lock();
        writeln!(out, "{text}").and_then(|()| out.flush()).map_err(|error| error.to_string())?;
    }
    Ok(())
}

fn answer(checkout: &Checkout, job: &Job) -> Answer {
    match job {
        Job::Accept { path, accepted, message } => accept::compare(checkout, path, *accepted, message),
        Job::Replay { file, path, scripts, .. } => simulation::compare(checkout, path, file, scripts.as_deref()),
        Job::Explore { path, .. } => explore::explore(checkout, path),
        Job::Scenario { path, status, message, checks } => scenario::compare(checkout, path, status, message, *checks),
    }
}
