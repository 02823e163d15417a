//! The timeline of a window: axis, lanes, the way of data through them. SYNC(drawing)

use crate::lanes::{Lane, LineKind, lanes};
use crate::markup::{Px, Text, put};
use crate::report::Report;
use crate::svg::view::View;
use crate::svg::{axis, fitted, graph, strip};

/// Space above the first lane, for the axis.
pub(crate) const HEAD: f64 = 22.0;

/// The same of the lines of periods and swaps.
const LINES_APART: f64 = 7.0;
/// The least distance, on average, of the ways of two data.
const WAYS_APART: f64 = 14.0;

/// How to draw a timeline.
pub(crate) struct Timeline {
    /// Boxes tell what they are.
    pub titles: bool,
    /// Makes ids unique in a page of several drawings.
    pub id: &'static str,
}

/// A drawing.
pub(crate) struct Drawn {
    pub markup: String,
    pub height: f64,
    /// What it shows, in words.
    pub description: String,
}

/// Draws a window.
pub(crate) fn timeline(report: &Report, view: &View, options: &Timeline) -> Drawn {
    let (lanes, height) = lanes(report);
    let mut out = String::new();
    put!(out, "<g transform=\"translate(0 {HEAD})\">\n");
    axis::axis(&mut out, view, report.time, height);
    for lane in &lanes {
        labels(&mut out, lane, view);
    }
    put!(
        out,
        "<clipPath id=\"{}\"><rect x=\"{}\" y=\"-6\" width=\"{}\" height=\"{}\"/></clipPath>\n",
        options.id,
        Px(view.left - 0.5),
        Px(view.right() - view.left + 1.0),
        Px(height + 6.0)
    );
    put!(out, "<g clip-path=\"url(#{})\">\n", options.id);
    for lane in &lanes {
        draw_lane(&mut out, report, lane, view, options);
    }
    flows(&mut out, report, &lanes, view);
    out.push_str("</g>\n");
    for lane in &lanes {
        if let Some(plan) = &lane.graph {
            graph::graph(&mut out, plan, view, lane.y, lane.height, report.time);
        }
    }
    out.push_str("</g>\n");
    Drawn { markup: out, height: height + HEAD, description: describe(report, view) }
}

fn describe(report: &Report, view: &View) -> String {
    let names: Vec<&str> = report.tasks.iter().map(|task| task.name.as_str()).collect();
    format!(
        "Timeline from {} to {}. One lane for each task ({}), one for each of {} channels, then the values over time. \
         The tables of the report give the same in numbers.",
        report.time.bare(view.start as i64),
        report.time.show(view.end),
        names.join(", "),
        report.buffers.len() + report.queues.len(),
    )
}

fn labels(out: &mut String, lane: &Lane, view: &View) {
    if let Some((heading, y)) = lane.heading {
        put!(out, "<text class=\"heading\" x=\"0\" y=\"{}\">{heading}</text>\n", Px(y));
    }
    let room = view.left - 12.0 - if lane.height > 40.0 { 30.0 } else { 0.0 };
    let middle = lane.middle().min(lane.y + 17.0);
    let (name, caption) = (fitted(&lane.name, 13.0, room), fitted(&lane.caption, 11.0, room));
    let is_cut = name != lane.name || caption != lane.caption;
    if is_cut {
        let whole = format!("{} {}", lane.name, lane.caption);
        put!(out, "<g><title>{}</title>", Text(whole.trim_end()));
    }
    if lane.caption.is_empty() {
        put!(out, "<text class=\"name\" x=\"0\" y=\"{}\">{}</text>\n", Px(middle + 4.0), Text(name));
    } else {
        put!(out, "<text class=\"name\" x=\"0\" y=\"{}\">{}</text>", Px(middle - 1.5), Text(name));
        put!(out, "<text class=\"caption\" x=\"0\" y=\"{}\">{}</text>\n", Px(middle + 11.5), Text(caption));
    }
    if is_cut {
        out.push_str("</g>\n");
    }
}

fn draw_lane(out: &mut String, report: &Report, lane: &Lane, view: &View, options: &Timeline) {
    let mut lines = String::new();
    for tick in view.visible(lane.lines, LINES_APART) {
        put!(lines, "M{} {}V{}", Px(view.x(*tick)), Px(lane.y - 2.0), Px(lane.y + lane.height + 2.0));
    }
    if lane.line == LineKind::Due && !lane.strips.is_empty() {
        let middle = Px(lane.middle());
        put!(out, "<path class=\"base\" d=\"M{} {middle}H{}\"/>\n", Px(view.left), Px(view.right()));
        put!(out, "<path class=\"due\" d=\"{lines}\"/>\n");
    }
    let mut ends = String::new();
    for tick in view.visible(&lane.deadlines(), LINES_APART) {
        put!(ends, "M{} {}V{}", Px(view.x(*tick)), Px(lane.y - 2.0), Px(lane.y + lane.height + 2.0));
    }
    if !ends.is_empty() {
        put!(out, "<path class=\"deadline\" d=\"{ends}\"/>\n");
    }
    let told = options.titles.then_some((lane.name.as_str(), report.time));
    for plan in &lane.strips {
        strip::strip(out, plan, view, told);
    }
    if lane.line == LineKind::Swap {
        put!(out, "<path class=\"swap\" d=\"{lines}\"/>\n");
    }
    for tick in view.visible(lane.crosses, 1.0) {
        let (x, y) = (view.x(*tick), lane.y);
        put!(
            out,
            "<path class=\"miss\" d=\"M{} {}l4 -6h-8z\"><title>deadline missed</title></path>\n",
            Px(x),
            Px(y + 5.0)
        );
    }
}

/// The lane of each hop of the flow.
pub(crate) fn flow_indices(report: &Report) -> Vec<usize> {
    let place = |name: &str| report.tasks.iter().position(|task| task.name == name).unwrap_or(0);
    report.flow.iter().flat_map(|flow| flow.hops.iter().map(|(task, _)| place(task))).collect()
}

/// The way of each datum from lane to lane.
fn flows(out: &mut String, report: &Report, lanes: &[Lane], view: &View) {
    let Some(flow) = &report.flow else { return };
    let stops: Vec<&Lane> = flow_indices(report).iter().filter_map(|lane| lanes.get(*lane)).collect();
    let seen = flow.journeys.iter().enumerate().filter(|(_, journey)| {
        let (first, last) = (journey.times[0], journey.times[journey.times.len() - 1]);
        first < view.end && last > view.start && journey.times.len() > 1
    });
    let seen: Vec<_> = seen.collect();
    if seen.len() as f64 * WAYS_APART > view.right() - view.left {
        return;
    }
    for (number, journey) in seen {
        let mut path = String::new();
        let mut dots = String::new();
        for (hop, (tick, lane)) in journey.times.iter().zip(&stops).enumerate() {
            let (x, y) = (view.x(*tick), lane.middle());
            if hop == 0 {
                put!(path, "M{} {}", Px(x), Px(y));
            } else {
                // Along the gap below the lane while it waits, alternating so that neighbours stay apart.
                let before = stops[hop - 1];
                let gap = before.y + before.height + if number % 2 == 0 { 2.5 } else { 5.5 };
                put!(path, "V{}H{}V{}", Px(gap), Px(x), Px(y));
            }
            put!(dots, "M{} {}m-2.4 0a2.4 2.4 0 1 0 4.8 0a2.4 2.4 0 1 0 -4.8 0", Px(x), Px(y));
        }
        let arrived = if journey.times.len() == stops.len() { "" } else { " lost" };
        put!(out, "<path class=\"way{arrived}\" d=\"{path}\"/><path class=\"hop{arrived}\" d=\"{dots}\"/>\n");
    }
}
