//! Watches a search: shows its progress on stderr, and stops it when its time is up.
//!
//! A thread of its own keeps the time and raises the request to stop. The search reports progress between rounds, but
//! checks the request more often.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

use groundstate::verify::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use machine::Cause;

use crate::interrupt;

/// Searches shorter than this show nothing.
const PATIENCE: Duration = Duration::from_millis(700);

/// Watches a search.
pub struct Watch {
    began: Instant,
    wanted: bool,
    bar: Option<ProgressBar>,
    timed_out: Arc<AtomicBool>,
    /// Keeps the clock running; dropping it stops the clock.
    _clock: Option<Sender<()>>,
}

impl Watch {
    pub fn new(seconds: Option<u64>, quiet: bool) -> Watch {
        let timed_out = Arc::new(AtomicBool::new(false));
        Watch {
            began: Instant::now(),
            wanted: !quiet && std::io::stderr().is_terminal(),
            bar: None,
            _clock: seconds.map(|seconds| clock(Duration::from_secs(seconds), Arc::clone(&timed_out))),
            timed_out,
        }
    }

    /// Shows how far the search is; returns whether to go on.
    pub fn at(&mut self, progress: &Progress) -> bool {
        let elapsed = self.began.elapsed();
        if self.wanted && elapsed > PATIENCE {
            let bar = self.bar.get_or_insert_with(bar);
            let rate = progress.states as f64 / elapsed.as_secs_f64();
            let disk = match progress.spilled {
                0 => String::new(),
                bytes => format!(", {} MiB on disk", bytes >> 20),
            };
            bar.set_message(format!(
                "{} states, {:.0} a second, {} to do, depth {}, {} MiB{disk}",
                progress.states,
                rate,
                progress.queue,
                progress.depth,
                progress.bytes >> 20
            ));
        }
        !interrupt::asked()
    }

    /// Hides the bar while something else is written.
    pub fn hide(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }

    /// Removes the bar; returns whether the time was up.
    pub fn done(self) -> bool {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
        self.timed_out.load(Ordering::Relaxed)
    }
}

/// Starts a clock that raises the request to stop when the time is up, unless the returned sender is dropped before.
fn clock(limit: Duration, timed_out: Arc<AtomicBool>) -> Sender<()> {
    let (sender, ended) = channel::<()>();
    std::thread::spawn(move || {
        if ended.recv_timeout(limit) == Err(RecvTimeoutError::Timeout) {
            timed_out.store(true, Ordering::Relaxed);
            interrupt::request().raise(Cause::Asked);
        }
    });
    sender
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::no_length();
    bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(5));
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed}") {
        bar.set_style(style);
    }
    bar
}
