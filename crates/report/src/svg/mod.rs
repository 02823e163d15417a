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

use crate::legend::{Mark, activities, marks};
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
    let keys = if options.heading { legend(report, margin, 58.0, width - margin) } else { (String::new(), 58.0) };
    let top = if options.heading { keys.1 + 26.0 } else { margin };
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
        out.push_str(&keys.0);
    }
    put!(out, "<g transform=\"translate({margin} {top})\">\n{}</g>\n</svg>\n", body.markup);
    out
}

/// The activities with their colours, and the marks of lanes, in as many lines as they need; the base line of the last one.
fn legend(report: &Report, left: f64, top: f64, right: f64) -> (String, f64) {
    let mut out = String::new();
    let (mut x, mut y) = (left, top);
    let mut put = |key: &dyn Fn(f64, f64) -> String, words: &str| {
        let wide = KEY + text_width(words, 12.0) + 18.0;
        if x > left && x + wide - 18.0 > right {
            (x, y) = (left, y + 20.0);
        }
        put!(out, "{}", key(x, y));
        put!(out, "<text class=\"key\" x=\"{}\" y=\"{}\">{}</text>\n", Px(x + KEY), Px(y), Text(words));
        x += wide;
    };
    for kind in activities(report) {
        let outline = if kind.tone == crate::Tone::Idle { " outline" } else { "" };
        put(&|x, y| boxed(&format!("{}{outline}", kind.tone.name()), x, y), &kind.label);
    }
    for (mark, words) in marks(report) {
        put(&|x, y| sign(mark, x, y), &words);
    }
    (out, y)
}

/// Room for a key before its words.
const KEY: f64 = 17.0;

fn boxed(class: &str, x: f64, y: f64) -> String {
    let (x, y) = (Px(x), Px(y - 9.0));
    format!("<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"12\" height=\"10\" rx=\"2\"/>")
}

fn sign(mark: Mark, x: f64, y: f64) -> String {
    let line = |class: &str| format!("<path class=\"{class}\" d=\"M{} {}v12\"/>", Px(x + 6.0), Px(y - 10.0));
    match mark {
        Mark::Period => line("due"),
        Mark::Deadline => line("deadline"),
        Mark::Swap => line("swap"),
        Mark::Late => format!("<path class=\"miss\" d=\"M{} {}l4 -6h-8z\"/>", Px(x + 6.0), Px(y - 1.0)),
        Mark::Way => format!("<path class=\"way\" d=\"M{} {}h13\"/>", Px(x), Px(y - 4.0)),
        Mark::WritePlace => boxed("writeplace", x, y),
        Mark::ReadPlace => boxed("readplace", x, y),
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

/// A text cut to a width, with an ellipsis where something is missing. What stands in the brackets at its end is kept if it is short:
/// by their arguments the locations of a function differ. SYNC(drawing)
pub(crate) fn fitted(text: &str, size: f64, width: f64) -> String {
    if text_width(text, size) <= width {
        return text.to_owned();
    }
    let kept = text.ends_with(')').then(|| text.find('(')).flatten().map_or("", |at| &text[at..]);
    let kept = if text_width(kept, size) <= width * 0.7 { kept } else { "" };
    let mut cut = text[..text.len() - kept.len()].to_owned();
    while cut.pop().is_some() {
        let tried = format!("{}\u{2026}{kept}", cut.trim_end());
        if text_width(&tried, size) <= width || cut.is_empty() {
            return tried;
        }
    }
    cut
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cut_name_keeps_its_argument() {
        let cut = |text: &str, width: f64| fitted(text, 13.0, width);
        assert_eq!(cut("colour(1)", 200.0), "colour(1)");
        let named = cut("colourOfTheRobotWithTheLongName(11)", 150.0);
        assert!(named.starts_with("colourOfTheR") && named.ends_with("\u{2026}(11)"), "{named}");
        assert!(text_width(&named, 13.0) <= 150.0);
        let worded = cut("the way of all data through the system", 100.0);
        assert!(
            worded.starts_with("the way of") && worded.ends_with('\u{2026}') && !worded.contains(" \u{2026}"),
            "{worded}"
        );
        // Brackets that would leave no room for the name are cut as well.
        let long = cut("age(fromTheFirstOne, toTheVeryLastOne)", 120.0);
        assert!(long.starts_with("age(from") && long.ends_with('\u{2026}'), "{long}");
        assert!(text_width(&long, 13.0) <= 120.0);
        assert_eq!(cut("x", 0.0), "\u{2026}");
    }
}
