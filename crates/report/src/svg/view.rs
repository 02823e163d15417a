//! A window of time on a strip of paper: from ticks to pixels.

use crate::markup::Px;

/// The ticks `start..end` over a width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct View {
    pub start: u64,
    pub end: u64,
    /// The whole width, labels included.
    pub width: f64,
    /// Where time begins.
    pub left: f64,
}

/// Width of the column of labels.
const LABELS: f64 = 168.0;
/// Space to the right, for half an axis label.
const RIGHT: f64 = 14.0;

impl View {
    /// A window with a column of labels to its left.
    pub fn new(start: u64, end: u64, width: f64) -> View {
        View { start, end, width, left: LABELS.min(width * 0.3) }
    }

    /// A window that fills the width.
    pub fn plain(start: u64, end: u64, width: f64) -> View {
        View { start, end, width, left: 0.0 }
    }

    /// Pixels a tick.
    pub fn scale(&self) -> f64 {
        (self.right() - self.left) / (self.end - self.start).max(1) as f64
    }

    /// Where time ends.
    pub fn right(&self) -> f64 {
        if self.left > 0.0 { self.width - RIGHT } else { self.width }
    }

    /// Where a tick begins.
    pub fn x(&self, tick: u64) -> f64 {
        self.left + (tick as f64 - self.start as f64) * self.scale()
    }

    /// Where a tick begins, not outside the window.
    pub fn clamped(&self, tick: u64) -> f64 {
        self.x(tick.clamp(self.start, self.end))
    }

    /// Those of some ticks in order that lie in the window; none if they would be closer than this many pixels.
    pub fn visible<'a>(&self, ticks: &'a [u64], least: f64) -> &'a [u64] {
        let from = ticks.partition_point(|tick| *tick < self.start);
        let to = ticks.partition_point(|tick| *tick <= self.end);
        let found = &ticks[from..to];
        let crowded = found.len() as f64 * least > self.right() - self.left;
        if crowded { &[] } else { found }
    }
}

/// A closed box as a path.
pub(crate) fn box_path(out: &mut String, x: f64, y: f64, width: f64, height: f64) {
    crate::markup::put!(out, "M{} {}h{}v{}h-{}z", Px(x), Px(y), Px(width), Px(height), Px(width));
}
