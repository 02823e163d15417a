//! The timeline of the page: legend, overview, the first window as a still drawing that the script takes over, and,
//! for readers without the script, the whole run to scroll through.

use crate::html::section;
use crate::legend::{Mark, activities, marks};
use crate::markup::{Px, Text, put};
use crate::report::Report;
use crate::svg::{Timeline, View, overview, timeline};
use crate::tone::Tone;

/// Width of the still drawings.
const WIDTH: f64 = 1120.0;
/// LIMIT: the run to scroll through ends after this many spans.
const SPANS: usize = 60_000;

/// Writes the section.
pub(super) fn timeline_section(out: &mut String, report: &Report) {
    section(out, "timeline", "Timeline", "");
    legend(out, report);
    controls(out);
    put!(out, "<div class=\"run\" id=\"whole\"><span>whole run</span>{}</div>\n", overview(report));
    let window = View::new(0, report.window.min(report.shown).max(1), WIDTH);
    let drawn = timeline(report, &window, &Timeline { titles: true, id: "window" });
    out.push_str("<div class=\"stage\" id=\"stage\">\n");
    put!(
        out,
        "<svg id=\"detail\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" aria-labelledby=\"detail-title detail-desc\">\n",
        w = Px(WIDTH),
        h = Px(drawn.height)
    );
    put!(
        out,
        "<title id=\"detail-title\">Timeline</title><desc id=\"detail-desc\">{}</desc>\n",
        Text(&drawn.description)
    );
    put!(out, "{}</svg>\n<div id=\"tip\" hidden=\"hidden\"></div>\n</div>\n", drawn.markup);
    scrolled(out, report);
    if report.shown < report.ticks {
        put!(
            out,
            "<p class=\"lead\">The lanes show the first {} of the run; the figures below are of the whole run.</p>\n",
            report.time.run(report.shown)
        );
    }
    shares(out, report);
    out.push_str("</section>\n");
}

fn legend(out: &mut String, report: &Report) {
    let outlined = |tone: Tone| if tone == Tone::Idle { " outlined" } else { "" };
    let activities: Vec<(String, String)> = activities(report)
        .map(|kind| (format!("{}{}", kind.tone.name(), outlined(kind.tone)), kind.label.clone()))
        .collect();
    let class = |mark: Mark| match mark {
        Mark::Period => "bar",
        Mark::Deadline => "bar dashed",
        Mark::Late => "late",
        Mark::Way => "thread",
        Mark::WritePlace => "writeplace",
        Mark::ReadPlace => "readplace",
        Mark::Swap => "bar strong",
    };
    let marks: Vec<(String, String)> =
        marks(report).into_iter().map(|(mark, words)| (class(mark).to_owned(), words)).collect();
    for list in [activities, marks].into_iter().filter(|list| !list.is_empty()) {
        out.push_str("<ul class=\"legend\">\n");
        for (class, label) in list {
            put!(out, "<li><i class=\"{class}\"></i>{}</li>\n", Text(&label));
        }
        out.push_str("</ul>\n");
    }
}

fn controls(out: &mut String) {
    out.push_str("<div class=\"controls\" id=\"controls\" hidden=\"hidden\">\n<span class=\"group\">");
    for (action, sign, name) in [
        ("back", "\u{2190}", "Earlier"),
        ("forth", "\u{2192}", "Later"),
        ("out", "\u{2212}", "Zoom out"),
        ("in", "+", "Zoom in"),
    ] {
        put!(
            out,
            "<button type=\"button\" data-do=\"{action}\" aria-label=\"{name}\" title=\"{name}\">{sign}</button>"
        );
    }
    out.push_str("</span>\n<span class=\"group\">");
    for (action, name) in [("first", "First view"), ("all", "Whole run"), ("wait", "Next wait"), ("miss", "Next miss")]
    {
        put!(out, "<button type=\"button\" data-do=\"{action}\">{name}</button>");
    }
    out.push_str("</span>\n<output id=\"where\" aria-live=\"polite\"></output>\n");
    out.push_str(
        "<span class=\"hint\">drag to move, Ctrl and wheel to zoom, arrows and +/\u{2212} by keyboard; far out, heights are shares of time</span>\n</div>\n",
    );
}

/// The whole run at the scale of the first view.
fn scrolled(out: &mut String, report: &Report) {
    let tracks = report.tasks.iter().map(|task| &task.track);
    let tracks: Vec<_> = tracks.chain(report.buffers.iter().flat_map(|b| b.rows.iter().chain(&b.lock))).collect();
    let mut end = report.shown;
    while end > report.window && tracks.iter().map(|track| track.within(0, end).len()).sum::<usize>() > SPANS {
        end = (end / 2).max(report.window);
    }
    if end <= report.window {
        return;
    }
    let first = View::new(0, report.window.max(1), WIDTH);
    let width = first.left + 14.0 + first.scale() * end as f64;
    let view = View::new(0, end, width);
    let drawn = timeline(report, &view, &Timeline { titles: false, id: "run-to-scroll" });
    put!(
        out,
        "<noscript>\n<details><summary>The run to scroll through</summary>\n<div class=\"stage\"><svg viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\">",
        w = Px(width),
        h = Px(drawn.height)
    );
    put!(out, "<title>The run to scroll through</title>\n{}</svg></div></details>\n</noscript>\n", drawn.markup);
}

/// The timeline in numbers: how each task spent its time.
fn shares(out: &mut String, report: &Report) {
    if report.tasks.is_empty() {
        return;
    }
    out.push_str("<details class=\"numbers\"><summary>How each task spent its time, in numbers</summary>\n<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">Task</th>");
    for kind in &report.activities {
        put!(out, "<th scope=\"col\">{}</th>", Text(&kind.label));
    }
    out.push_str("</tr></thead>\n<tbody>\n");
    for task in &report.tasks {
        put!(out, "<tr><th scope=\"row\">{}</th>", Text(&task.name));
        for share in &task.shares {
            let percent = *share as f64 * 100.0 / report.ticks.max(1) as f64;
            match share {
                0 => out.push_str("<td class=\"nil\">\u{2013}</td>"),
                _ => put!(out, "<td>{}<small>{percent:.1}\u{202f}%</small></td>", report.time.show(*share)),
            }
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div></details>\n");
}
