//! The whole run in a strip: how busy each task was, and where a task waited. The script lays a window over it.

use crate::lanes::Graph;
use crate::markup::{Px, put};
use crate::report::{Report, Task};
use crate::svg::columns::columns;
use crate::svg::graph::curve_paths;
use crate::svg::view::{View, box_path};
use crate::tone::Tone;

/// Height of a task's row.
const ROW: f64 = 5.0;
const GAP: f64 = 2.0;
/// Height of the curve.
const CURVE: f64 = 20.0;
/// The least width of a waiting.
const LEAST: f64 = 1.0;
/// How many shades busy has.
const SHADES: usize = 4;

/// The strip's own width; the page stretches it.
pub(crate) const WIDTH: f64 = 1000.0;

/// The strip as an element: a row for each task, and the first value over time. A frame marks the first view.
pub(crate) fn overview(report: &Report) -> String {
    let view = View::plain(0, report.shown.max(1), WIDTH);
    let rows = report.tasks.len() as f64 * (ROW + GAP);
    let height = rows + if report.series.is_empty() { 6.0 } else { CURVE + 8.0 };
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
    if let Some(series) = report.series.first() {
        let plan = Graph { bound: None, head: 0.0, ..Graph::of_series(report, series) };
        let place = |value: f64| plan.place(value, rows + 1.0, CURVE);
        let (line, area) = curve_paths(&series.curve, &view, place(0.0), &place);
        put!(out, "<path class=\"area\" d=\"{area}\"/>\n<path class=\"curve\" d=\"{line}\"/>\n");
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
    let columns = columns(&task.track, view, task.period);
    // Idle comes first in the order of tones.
    let busy: Vec<f64> = columns.iter().map(|column| column.shares[1..].iter().sum()).collect();
    let x = |tick: f64| tick * view.scale();
    for shade in 1..=SHADES {
        let shaded = |share: f64| (share.min(1.0) * SHADES as f64).ceil() as usize == shade;
        let mut path = String::new();
        runs(
            &busy,
            |share| *share > 0.01 && shaded(*share),
            |from, to| {
                let (from, to) = (x(columns[from].from), x(columns[to - 1].to));
                box_path(&mut path, from, y, to - from, ROW);
            },
        );
        if !path.is_empty() {
            put!(out, "<path class=\"busy b{shade}\" d=\"{path}\"/>\n");
        }
    }
    let mut path = String::new();
    let mut drawn = f64::MIN;
    for span in task.track.spans().iter().filter(|span| task.track.kind(**span).tone == Tone::Wait) {
        let from = view.x(span.start).max(drawn);
        let to = view.x(span.end).max(view.x(span.start) + LEAST);
        if to > from {
            box_path(&mut path, from, y + ROW - 2.0, to - from, 2.0);
            drawn = to;
        }
    }
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
