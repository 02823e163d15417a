//! Drawings as SVG text: the timeline of a window, the overview of a run, small charts.
//!
//! In: a report. Out: markup whose look comes only from CSS classes, so light, dark and print differ only in the style
//! sheet. The script of the page draws other windows of the same lanes in the same way; SYNC(drawing): `strip.rs`,
//! `axis.rs`, `graph.rs` and `timeline.rs` here, `draw.js` there.

mod axis;
mod chart;
mod columns;
mod distribution;
mod graph;
mod overview;
mod plot;
mod scale;
mod strip;
mod timeline;
mod view;

pub(crate) use chart::{histogram, legs, profile};
pub(crate) use distribution::{distribution, show_ns};
pub(crate) use overview::overview;
pub(crate) use plot::{error_norm, joint};
pub(crate) use timeline::{Timeline, flow_indices, timeline};
pub(crate) use view::View;

use crate::markup::{Px, Text, put};
use crate::report::Report;
use crate::tone::tone_css;

/// What a still picture shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SvgOptions {
    /// The first tick.
    pub start: u64,
    /// How many ticks; 0: as many as the report's first view.
    pub ticks: u64,
    /// Width in pixels; the height follows from the lanes.
    pub width: u32,
    /// Title and legend above the lanes.
    pub heading: bool,
}

impl Default for SvgOptions {
    fn default() -> SvgOptions {
        SvgOptions { start: 0, ticks: 0, width: 1120, heading: true }
    }
}

/// The style sheet of every drawing.
pub(crate) fn svg_css() -> String {
    svg_css_of(palette::both)
}

/// The same with colours put in by `painted`.
pub(crate) fn svg_css_of(painted: impl Fn(&str) -> String) -> String {
    let colours = format!("{}{}", include_str!("colours.css"), tone_css());
    format!("{}{}", include_str!("drawing.css"), painted(&colours))
}

/// The timeline of a window as a picture of its own, light or dark like the reader's system.
///
/// ```
/// let mut builder = report::ReportBuilder::new(report::Spec::default());
/// builder.step();
/// let report = builder.finish("Small");
/// assert!(report::render_svg(&report, &report::SvgOptions::default()).starts_with("<svg "));
/// ```
pub fn render_svg(report: &Report, options: &SvgOptions) -> String {
    let ticks = if options.ticks == 0 { report.window } else { options.ticks };
    let start = options.start.min(report.shown.saturating_sub(1));
    let end = (start + ticks.max(1)).min(report.shown.max(1));
    let width = f64::from(options.width.max(480));
    let margin = 20.0;
    let top = if options.heading { 84.0 } else { margin };
    let window = View::new(start, end.max(start + 1), width - 2.0 * margin);
    let body = timeline(report, &window, &Timeline { titles: false, id: "picture" });
    let height = top + body.height + margin;
    let mut out = String::new();
    put!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\">\n",
        w = Px(width),
        h = Px(height)
    );
    put!(out, "<title>{}</title>\n<desc>{}</desc>\n", Text(&report.title), Text(&body.description));
    put!(out, "<style>\n{}</style>\n", svg_css());
    put!(out, "<rect class=\"paper\" width=\"100%\" height=\"100%\" rx=\"6\"/>\n");
    if options.heading {
        put!(out, "<text class=\"headline\" x=\"{margin}\" y=\"34\">{}</text>\n", Text(&report.title));
        legend(&mut out, report, margin, 58.0);
    }
    put!(out, "<g transform=\"translate({margin} {top})\">\n{}</g>\n</svg>\n", body.markup);
    out
}

/// The activities and their colours in a line.
fn legend(out: &mut String, report: &Report, left: f64, y: f64) {
    let mut x = left;
    for kind in &report.activities {
        put!(
            out,
            "<rect class=\"{}{}\" x=\"{}\" y=\"{}\" width=\"12\" height=\"10\" rx=\"2\"/>",
            kind.tone.name(),
            if kind.tone == crate::Tone::Idle { " outline" } else { "" },
            Px(x),
            Px(y - 9.0)
        );
        put!(out, "<text class=\"key\" x=\"{}\" y=\"{}\">{}</text>\n", Px(x + 17.0), Px(y), Text(&kind.label));
        x += 17.0 + text_width(&kind.label, 12.0) + 18.0;
    }
}

/// About how wide a text is in the system's sans-serif face.
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    let em: f64 = text
        .chars()
        .map(|c| match c {
            'i' | 'j' | 'l' | '.' | ',' | ':' | '\'' | '|' | '!' | 'I' | '\u{202f}' => 0.28,
            'f' | 't' | 'r' | ' ' | '(' | ')' | '-' | '/' => 0.36,
            'm' | 'w' | 'M' | 'W' | '\u{2192}' => 0.88,
            c if c.is_ascii_uppercase() => 0.68,
            c if c.is_ascii() => 0.57,
            _ => 0.7,
        })
        .sum();
    em * size
}

/// A text cut to a width, with an ellipsis where something is missing.
pub(crate) fn fitted(text: &str, size: f64, width: f64) -> String {
    if text_width(text, size) <= width {
        return text.to_owned();
    }
    let mut cut = text.to_owned();
    while cut.pop().is_some() {
        let tried = format!("{}\u{2026}", cut.trim_end());
        if text_width(&tried, size) <= width || cut.is_empty() {
            return tried;
        }
    }
    cut
}
