//! The whole run in a strip: how busy each task was, and where anybody waited. The script lays a window over it.

use crate::markup::{Px, put};
use crate::report::{Report, Task};
use crate::svg::view::{View, box_path};
use crate::tone::Tone;

/// Height of a task's row.
const ROW: f64 = 5.0;
const GAP: f64 = 2.0;
/// Width of a column.
const COLUMN: f64 = 2.5;
/// How many shades busy has.
const SHADES: usize = 4;

/// The strip's own width; the page stretches it.
pub(crate) const WIDTH: f64 = 1000.0;

/// The strip as an element. Its first view is marked by a frame.
pub(crate) fn overview(report: &Report) -> String {
    let view = View::plain(0, report.shown.max(1), WIDTH);
    let height = report.tasks.len() as f64 * (ROW + GAP) + 6.0;
    let mut out = String::new();
    put!(
        out,
        "<svg id=\"overview\" viewBox=\"0 -4 {WIDTH} {h}\" height=\"{h}\" preserveAspectRatio=\"none\" role=\"img\">\n",
        h = Px(height)
    );
    out.push_str("<title>The whole run: how busy each task was, and where it waited</title>\n");
    for (index, task) in report.tasks.iter().enumerate() {
        row(&mut out, task, &view, index as f64 * (ROW + GAP));
    }
    let to = view.x(report.window.min(report.shown)).max(2.0);
    put!(
        out,
        "<rect class=\"brush\" x=\"0\" y=\"-3\" width=\"{}\" height=\"{}\"/>\n</svg>\n",
        Px(to),
        Px(height - 2.0)
    );
    out
}

fn row(out: &mut String, task: &Task, view: &View, y: f64) {
    let columns = ((view.right() - view.left) / COLUMN).ceil() as usize;
    let per_column = COLUMN / view.scale();
    let mut busy = vec![0.0f64; columns];
    let mut waits = vec![false; columns];
    for span in task.track.spans() {
        let tone = task.track.kind(*span).tone;
        if tone == Tone::Idle {
            continue;
        }
        let (from, to) = (span.start as f64 / per_column, span.end as f64 / per_column);
        for column in from as usize..(to.ceil() as usize).min(columns) {
            busy[column] += (to.min(column as f64 + 1.0) - from.max(column as f64)).max(0.0);
            waits[column] |= tone == Tone::Wait;
        }
    }
    for shade in 1..=SHADES {
        let shaded = |share: f64| (share.min(1.0) * SHADES as f64).ceil() as usize == shade;
        let mut path = String::new();
        runs(
            &busy,
            |share| *share > 0.01 && shaded(*share),
            |from, to| {
                box_path(&mut path, view.left + from as f64 * COLUMN, y, (to - from) as f64 * COLUMN, ROW);
            },
        );
        if !path.is_empty() {
            put!(out, "<path class=\"busy b{shade}\" d=\"{path}\"/>\n");
        }
    }
    let mut path = String::new();
    runs(
        &waits,
        |wait| *wait,
        |from, to| {
            box_path(&mut path, view.left + from as f64 * COLUMN, y + ROW - 2.0, (to - from) as f64 * COLUMN, 2.0);
        },
    );
    for tick in &task.misses {
        box_path(&mut path, view.x(*tick) - 1.0, y - 1.0, 2.0, ROW + 2.0);
    }
    if !path.is_empty() {
        put!(out, "<path class=\"wait\" d=\"{path}\"/>\n");
    }
}

/// Calls `found` with each longest run of items for which `test` holds.
fn runs<T>(items: &[T], test: impl Fn(&T) -> bool, mut found: impl FnMut(usize, usize)) {
    let mut from = None;
    for (index, item) in items.iter().enumerate() {
        match (test(item), from) {
            (true, None) => from = Some(index),
            (false, Some(start)) => {
                found(start, index);
                from = None;
            }
            _ => {}
        }
    }
    if let Some(start) = from {
        found(start, items.len());
    }
}
