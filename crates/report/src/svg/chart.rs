//! Small charts beside the tables: how often each length occurs, how long each leg takes, a value over a whole run.

use crate::flow::Flow;
use crate::lanes::Graph;
use crate::markup::{Px, Text, put};
use crate::report::{Report, Series};
use crate::svg::view::{View, box_path};
use crate::svg::{axis, graph, text_width};
use crate::tally::Tally;
use crate::time::TimeBase;

/// Most bars of a histogram.
const BARS: u64 = 24;

fn open(out: &mut String, class: &str, width: f64, height: f64, title: &str) {
    put!(
        out,
        "<svg class=\"{class}\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\"><title>{}</title>\n",
        Text(title),
        w = Px(width),
        h = Px(height)
    );
}

/// How often each length occurs: a bar for each, its count above it where there is room.
pub(crate) fn histogram(tally: &Tally, time: TimeBase, tone: &str, title: &str) -> String {
    let (width, height, base, top) = (252.0, 92.0, 72.0, 16.0);
    let (first, step, bins) = tally.bins(BARS);
    let mut out = String::new();
    open(&mut out, "histogram", width, height, title);
    let most = bins.iter().copied().max().unwrap_or(1).max(1);
    // From zero if that is not far: lengths are then compared by eye.
    let lead = if first / step <= 4 { first / step } else { 0 };
    let slots = (lead + bins.len() as u64).max(6) as f64;
    let pitch = (width / slots).min(36.0);
    let bar = (pitch * 0.72).min(22.0);
    let origin = if lead > 0 || first == 0 { 0 } else { first };
    let mut path = String::new();
    let mut counts = String::new();
    for (index, count) in bins.iter().enumerate().filter(|(_, count)| **count > 0) {
        let x = (lead as f64 + index as f64) * pitch + (pitch - bar) / 2.0;
        let bar_height = ((base - top) * *count as f64 / most as f64).max(1.5);
        box_path(&mut path, x, base - bar_height, bar, bar_height);
        let label = crate::time::count(*count);
        if text_width(&label, 10.0) < pitch + 6.0 || *count == most {
            put!(counts, "<text x=\"{}\" y=\"{}\">{label}</text>", Px(x + bar / 2.0), Px(base - bar_height - 4.0));
        }
    }
    put!(
        out,
        "<path class=\"{tone}\" d=\"{path}\"/>\n<path class=\"base\" d=\"M0 {}H{}\"/>\n",
        Px(base),
        Px((slots * pitch).min(width))
    );
    put!(out, "<g class=\"counts\">{counts}</g>\n<g class=\"ticks\">");
    let every = ((text_width("00.0", 10.0) + 10.0) / pitch).ceil().max(1.0) as u64;
    for slot in (0..slots as u64).step_by(every as usize) {
        let label = time.bare((origin + slot * step) as i64);
        put!(out, "<text x=\"{}\" y=\"{}\">{label}</text>", Px((slot as f64 + 0.5) * pitch), Px(base + 14.0));
    }
    out.push_str("</g></svg>\n");
    out
}

/// Each leg of a flow and the whole way: a line from the least to the greatest time, and a dot for the mean.
pub(crate) fn legs(flow: &Flow, time: TimeBase) -> String {
    let rows: Vec<(String, &Tally, &str)> = flow
        .legs
        .iter()
        .enumerate()
        .map(|(leg, tally)| (format!("{} \u{2192} {}", flow.hops[leg].0, flow.hops[leg + 1].0), tally, "leg"))
        .chain(std::iter::once(("the whole way".to_owned(), &flow.whole, "leg whole")))
        .collect();
    let most = rows.iter().filter_map(|(_, tally, _)| tally.greatest()).map(|(most, _)| most).max().unwrap_or(1).max(1);
    let labels = rows.iter().map(|(label, ..)| text_width(label, 12.5)).fold(80.0, f64::max) + 16.0;
    let (width, pitch, head) = (560.0, 30.0, 24.0);
    let height = head + pitch * rows.len() as f64 + 6.0;
    let mut out = String::new();
    open(&mut out, "legs", width, height, "Time of each leg: least, mean, greatest");
    let mut view = View::plain(0, most, width - 46.0);
    view.left = labels;
    put!(out, "<g transform=\"translate(0 {head})\">\n");
    axis::axis(&mut out, &view, time, pitch * rows.len() as f64);
    for (row, (label, tally, class)) in rows.iter().enumerate() {
        let y = pitch * (row as f64 + 0.5);
        put!(out, "<text class=\"name\" x=\"0\" y=\"{}\">{}</text>", Px(y + 4.0), Text(label));
        let (Some(least), Some((greatest, _))) = (tally.least(), tally.greatest()) else { continue };
        let mean = view.left + tally.mean() * view.scale();
        put!(out, "<path class=\"{class}\" d=\"M{} {y}H{}\"/>", Px(view.x(least)), Px(view.x(greatest)), y = Px(y));
        put!(out, "<circle class=\"mean\" cx=\"{}\" cy=\"{}\" r=\"4\"/>", Px(mean), Px(y));
        put!(
            out,
            "<text class=\"value\" x=\"{}\" y=\"{}\">{}</text>\n",
            Px(view.x(greatest) + 7.0),
            Px(y + 4.0),
            time.bare(greatest as i64)
        );
    }
    out.push_str("</g></svg>\n");
    out
}

/// A value over the whole run.
pub(crate) fn profile(report: &Report, series: &Series) -> String {
    let (width, height, head) = (1120.0, 150.0, 24.0);
    let plan = Graph::of_series(report, series);
    let mut view = View::new(0, report.shown.max(1), width);
    let shown = |value: i64| if plan.ticks { report.time.bare(value) } else { value.to_string() };
    let labels = [shown(plan.top), shown(plan.low)].map(|label| text_width(&label, 12.0));
    view.left = labels.into_iter().fold(text_width(report.time.unit(), 11.0) + 20.0, f64::max).max(42.0) + 10.0;
    let mut out = String::new();
    open(&mut out, "profile", width, head + height + 4.0, &format!("{} over the whole run", series.name));
    put!(out, "<g transform=\"translate(0 {head})\">\n");
    axis::axis(&mut out, &view, report.time, height);
    graph::graph(&mut out, &plan, &view, 0.0, height, report.time);
    out.push_str("</g></svg>\n");
    out
}
