//! Shows the progress of a long run on stderr: only on a terminal, and only after a moment.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A progress bar that appears only if the run takes long.
pub struct Progress {
    began: Instant,
    total: Option<u64>,
    bar: Option<ProgressBar>,
    wanted: bool,
    what: &'static str,
}

/// The shortest time between two reports of a run.
const PACE: Duration = Duration::from_millis(20);

/// Decides when a run reports what has happened.
pub fn now_and_then() -> Box<dyn FnMut() -> bool + Send> {
    let mut last = Instant::now();
    Box::new(move || {
        let is_due = last.elapsed() > PACE;
        if is_due {
            last = Instant::now();
        }
        is_due
    })
}

/// Runs shorter than this show nothing.
const PATIENCE: Duration = Duration::from_millis(700);

impl Progress {
    /// A bar for this many steps, if known; with `busy`, none, since the terminal is used for something else.
    pub fn new(total: Option<u64>, busy: bool) -> Progress {
        Progress {
            began: Instant::now(),
            total,
            bar: None,
            wanted: !busy && std::io::stderr().is_terminal(),
            what: "steps",
        }
    }

    /// A bar for this many of something else than steps.
    pub fn of(what: &'static str, total: u64, busy: bool) -> Progress {
        Progress { what, ..Progress::new(Some(total), busy) }
    }

    /// A line that says what goes on, and for how long, while nothing is counted.
    pub fn busy_with(what: &str, busy: bool) -> Progress {
        let progress = Progress::new(None, busy);
        let shown = progress.wanted.then(|| {
            let bar = spinner("{spinner} {msg}, {elapsed}");
            bar.set_message(what.to_string());
            bar.enable_steady_tick(Duration::from_millis(100));
            bar
        });
        Progress { bar: shown, ..progress }
    }

    /// Shows how many steps have been made.
    pub fn at(&mut self, steps: u64) {
        if !self.wanted {
            return;
        }
        if self.bar.is_none() && self.began.elapsed() > PATIENCE {
            self.bar = Some(bar(self.total, self.what));
        }
        if let Some(bar) = &self.bar {
            bar.set_position(steps);
        }
    }

    /// Removes the bar.
    pub fn done(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}

fn bar(total: Option<u64>, what: &str) -> ProgressBar {
    match total {
        Some(total) => {
            let template = format!("{{wide_bar}} {{human_pos}}/{{human_len}} {what}, {{per_sec}}, {{eta}} left");
            styled(ProgressBar::new(total), &template)
        }
        None => spinner(&format!("{{spinner}} {{human_pos}} {what}, {{per_sec}}, {{elapsed}}")),
    }
}

fn spinner(template: &str) -> ProgressBar {
    styled(ProgressBar::no_length(), template)
}

fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(10));
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}
