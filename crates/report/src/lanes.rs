//! The place of each lane of the timeline: the one layout that the still drawing and the script of the page share.
//!
//! In: a report. Out: lanes from top to bottom with their strips, all lengths in CSS pixels, y from the top of the
//! first lane. INVARIANT: lanes do not overlap. Neither do the strips of a lane, nor headings and lanes.

use crate::report::{Buffer, Report, Series, Task};
use crate::track::{Curve, Track};

/// Height of a group's heading.
const HEADING: f64 = 30.0;
/// Space between two lanes.
const GAP: f64 = 8.0;
const TASK: f64 = 22.0;
const ROW: f64 = 9.0;
const ROW_GAP: f64 = 1.5;
const LOCK: f64 = 4.0;
const QUEUE: f64 = 20.0;
const SERIES: f64 = 78.0;
/// Room for the label of a bound.
const HEAD: f64 = 15.0;
/// The least height of a lane whose label has two lines.
const TWO_LINES: f64 = 26.0;

/// A lane.
#[derive(Debug)]
pub(crate) struct Lane<'a> {
    /// The heading above it, if it begins a group, and the heading's base line.
    pub heading: Option<(&'static str, f64)>,
    /// First line of its label.
    pub name: String,
    /// Second line of its label.
    pub caption: String,
    pub y: f64,
    pub height: f64,
    pub strips: Vec<Strip<'a>>,
    /// Thin lines across the lane, in the foreground or in the background, and their meaning.
    pub lines: &'a [u64],
    pub line: LineKind,
    /// From the beginning of a period to its deadline, if that is not the end of the period.
    pub deadline: Option<u64>,
    /// Crosses: deadlines missed.
    pub crosses: &'a [u64],
    pub graph: Option<Graph<'a>>,
}

/// What the thin lines of a lane mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LineKind {
    /// A period begins, and the deadline of the one before ends.
    Due,
    /// The arrays are swapped.
    Swap,
}

/// A track drawn as a row of boxes.
#[derive(Debug)]
pub(crate) struct Strip<'a> {
    pub y: f64,
    pub height: f64,
    pub track: &'a Track,
    /// Boxes fill the height, whatever their tone.
    pub full: bool,
    /// The ticks after which the pattern comes again.
    pub rhythm: Option<u64>,
}

/// A value drawn as a line.
#[derive(Debug)]
pub(crate) struct Graph<'a> {
    pub curve: &'a Curve,
    /// The value at the top, and the one at the bottom: 0, or the least value if that is lower.
    pub top: i64,
    pub low: i64,
    /// Room above the top, for the bound's label: no value is drawn there.
    pub head: f64,
    pub bound: Option<i64>,
    /// Values are ticks.
    pub ticks: bool,
    /// What the bound is called.
    pub bound_label: String,
}

/// The lanes of a report and the height of them all.
pub(crate) fn lanes(report: &Report) -> (Vec<Lane<'_>>, f64) {
    let groups: [(&'static str, Vec<Lane>); 3] = [
        (
            if report.has_tasks() { "Tasks" } else { "States" },
            report.tasks.iter().map(|task| task_lane(report, task)).collect(),
        ),
        ("Channels", channels(report)),
        ("Over time", report.series.iter().map(|series| series_lane(report, series)).collect()),
    ];
    let mut all = Vec::new();
    let mut y = 0.0;
    for (heading, lanes) in groups {
        for (index, mut lane) in lanes.into_iter().enumerate() {
            if index == 0 {
                lane.heading = Some((heading, y + HEADING - 12.0));
                y += HEADING;
            }
            lane.y = y;
            lane.strips.iter_mut().for_each(|strip| strip.y += y);
            y += lane.height + GAP;
            all.push(lane);
        }
    }
    (all, y)
}

fn task_lane<'a>(report: &'a Report, task: &'a Task) -> Lane<'a> {
    Lane {
        strips: vec![Strip { y: 0.0, height: TASK, track: &task.track, full: false, rhythm: task.period }],
        lines: &task.releases,
        deadline: task.early_deadline(),
        crosses: &task.misses,
        ..Lane::plain(task.name.clone(), task.describe(report.time), TASK)
    }
}

fn channels(report: &Report) -> Vec<Lane<'_>> {
    let buffers = report.buffers.iter().map(buffer_lane);
    let queues = report.queues.iter().map(|queue| {
        let most = queue.lengths.greatest().map_or(1, |(most, _)| most).max(queue.capacity.unwrap_or(1)) as i64;
        let graph = Graph {
            curve: &queue.length,
            top: most,
            low: 0,
            head: 0.0,
            bound: None,
            ticks: false,
            bound_label: String::new(),
        };
        let lane =
            Lane::plain(queue.from.clone(), format!("\u{2192} {}, {}", queue.to, queue.kind), TWO_LINES.max(QUEUE));
        Lane { graph: Some(graph), ..lane }
    });
    buffers.chain(queues).collect()
}

fn buffer_lane(buffer: &Buffer) -> Lane<'_> {
    let mut y = 0.0;
    let mut strips = Vec::new();
    for track in &buffer.rows {
        strips.push(Strip { y, height: ROW, track, full: true, rhythm: None });
        y += ROW + ROW_GAP;
    }
    if let Some(track) = &buffer.lock {
        strips.push(Strip { y, height: LOCK, track, full: true, rhythm: None });
        y += LOCK;
    }
    let lane = Lane::plain(buffer.from.clone(), format!("\u{2192} {}", buffer.to), y.max(TWO_LINES));
    Lane { strips, lines: &buffer.swaps, line: LineKind::Swap, ..lane }
}

fn series_lane<'a>(report: &'a Report, series: &'a Series) -> Lane<'a> {
    let graph = Graph::of_series(report, series);
    Lane { graph: Some(graph), ..Lane::plain(series.name.clone(), series.caption.clone(), SERIES) }
}

impl<'a> Graph<'a> {
    /// A series with a scale that holds all its values.
    pub fn of_series(report: &Report, series: &'a Series) -> Graph<'a> {
        let greatest = series.values.greatest().map_or(1, |(greatest, _)| greatest);
        // A bound far above all values would press the curve flat; it is then written, not drawn.
        let bound = series.bound.filter(|bound| *bound <= greatest.max(1).saturating_mul(3));
        let low = series.values.least().unwrap_or(0).min(bound.unwrap_or(0)).min(0);
        let top = greatest.max(bound.unwrap_or(0)).max(low + 1).max(if low < 0 { 0 } else { 1 });
        let bound_label = bound.map_or(String::new(), |bound| format!("bound {}", series.show(report.time, bound)));
        let head = if bound.is_some() { HEAD } else { 0.0 };
        Graph { curve: &series.curve, top, low, head, bound, ticks: series.ticks, bound_label }
    }

    /// Where a value lies in a drawing from `y` on, of this height.
    pub fn place(&self, value: f64, y: f64, height: f64) -> f64 {
        let share = (value - self.low as f64) / (self.top - self.low) as f64;
        y + height - share.clamp(0.0, 1.0) * (height - self.head)
    }
}

impl Lane<'_> {
    fn plain(name: String, caption: String, height: f64) -> Self {
        let (heading, y, strips, graph) = (None, 0.0, Vec::new(), None);
        Lane {
            heading,
            name,
            caption,
            y,
            height,
            strips,
            lines: &[],
            line: LineKind::Due,
            deadline: None,
            crosses: &[],
            graph,
        }
    }

    /// The ticks of its deadlines.
    pub fn deadlines(&self) -> Vec<u64> {
        let of = |length: u64| self.lines.iter().map(move |begin| begin.saturating_add(length)).collect();
        self.deadline.map_or_else(Vec::new, of)
    }

    /// Where its middle lies.
    pub fn middle(&self) -> f64 {
        self.y + self.height / 2.0
    }
}
