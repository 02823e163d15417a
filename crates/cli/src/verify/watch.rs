//! Watching a search: how far it is, on stderr, and whether it goes on.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use groundstate::verify::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::interrupt;

/// Shorter searches show nothing.
const PATIENCE: Duration = Duration::from_millis(700);

/// See the module.
pub struct Watch {
    began: Instant,
    limit: Option<Duration>,
    wanted: bool,
    bar: Option<ProgressBar>,
    timed_out: bool,
}

impl Watch {
    pub fn new(seconds: Option<u64>, quiet: bool) -> Watch {
        Watch {
            began: Instant::now(),
            limit: seconds.map(Duration::from_secs),
            wanted: !quiet && std::io::stderr().is_terminal(),
            bar: None,
            timed_out: false,
        }
    }

    /// Shows how far the search is and says whether it goes on.
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
        self.timed_out = self.limit.is_some_and(|limit| elapsed >= limit);
        !self.timed_out && !interrupt::asked()
    }

    /// Removes the bar; tells whether the time was up.
    pub fn done(self) -> bool {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
        self.timed_out
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::no_length();
    bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(5));
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed}") {
        bar.set_style(style);
    }
    bar
}
