//! The page: one file, style and script inside, nothing fetched.
//!
//! Everything can be read without the script: the first window of the timeline as a still drawing, the whole run to
//! scroll through, every figure in a table. The script adds zooming, moving and reading off. The markup is also
//! well-formed XML, except for the doctype and the contents of `style` and `script`.

mod charts;
mod data;
mod figures;
mod lanes;
mod mutation;
mod program;
mod refinement;
mod tables;
mod verdicts;

pub use mutation::render_mutation;
pub use program::render_program;
pub use refinement::{render_refinement, render_refinement_part};

use crate::markup::{Text, put};
use crate::report::Report;
use crate::svg::svg_css;

/// The report as a page.
///
/// ```
/// let mut builder = report::ReportBuilder::new(report::Spec::default());
/// builder.step();
/// let page = report::render_html(&builder.finish("Small"));
/// assert!(page.starts_with("<!DOCTYPE html>") && page.contains("<h1>Small</h1>"));
/// ```
pub fn render_html(report: &Report) -> String {
    let mut out = String::new();
    open(&mut out, &report.title, if report.charts.is_empty() { "" } else { &report.chart_style });
    figures::header(&mut out, report);
    out.push_str("<main>\n");
    if report.has_lanes() {
        lanes::timeline_section(&mut out, report);
    }
    charts::charts(&mut out, report, None);
    tables::tasks(&mut out, report);
    tables::waiting(&mut out, report);
    tables::ages(&mut out, report);
    tables::channels(&mut out, report);
    verdicts::invariants(&mut out, report);
    verdicts::scenarios(&mut out, report);
    verdicts::coverage(&mut out, report);
    verdicts::facts(&mut out, report);
    out.push_str("</main>\n");
    put!(
        out,
        "<footer>Written by Groundstate from a run of {}. This page is complete: it loads nothing.</footer>\n",
        Text(&report.model)
    );
    if report.has_lanes() {
        scripts(
            &mut out,
            &data::run_data(report),
            if report.charts.is_empty() { "" } else { include_str!("charts.js") },
        );
    }
    out.push_str("</body>\n</html>\n");
    out
}

/// A part of a page to be put into another page, which runs the scripts `draw.js`, `explore.js` and, where there are charts, `charts.js` on
/// it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LivePart {
    /// The sections, with the first window of a timeline as a still drawing.
    pub markup: String,
    /// The run, as the scripts read it: JSON; `null` if there is nothing to draw.
    pub run: String,
    /// The style sheet, for a tree of its own (a shadow root); colours are the variables of the palette, `var(--ink)`.
    pub style: String,
}

/// The timeline of a report, without its page.
pub fn render_timeline(report: &Report) -> LivePart {
    let mut markup = String::new();
    lanes::timeline_section(&mut markup, report);
    LivePart { markup, run: data::run_data(report), style: part_css() }
}

/// The style sheet of a part of a page.
fn part_css() -> String {
    format!("{}{}", include_str!("page.css"), crate::svg::svg_css_of(palette::named))
}

/// The style sheet of every page.
fn page_css() -> String {
    format!("{}{}", palette::both(include_str!("colours.css")), include_str!("page.css"))
}

/// The head of a page, up to its body.
fn open(out: &mut String, title: &str, style: &str) {
    out.push_str("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n");
    out.push_str("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n");
    out.push_str(
        "<meta name=\"color-scheme\" content=\"light dark\"/>\n<meta name=\"generator\" content=\"Groundstate\"/>\n",
    );
    put!(out, "<title>{}</title>\n", Text(title));
    put!(out, "<style>\n{}{}{style}</style>\n</head>\n<body>\n", page_css(), svg_css());
}

/// The lanes as data, and the script that draws other windows of them.
fn scripts(out: &mut String, data: &str, more: &str) {
    put!(out, "<script type=\"application/json\" id=\"run\">\n{data}</script>\n");
    let (draw, explore, page) = (include_str!("draw.js"), include_str!("explore.js"), include_str!("page.js"));
    put!(out, "<script>\n{draw}{explore}{more}{page}</script>\n");
}

/// A link that moves the timeline to a tick; without the script it leads to the timeline.
fn go(tick: u64, text: &str) -> String {
    format!("<a class=\"go\" href=\"#timeline\" data-at=\"{tick}\">{}</a>", Text(text))
}

/// The head of a section.
fn section(out: &mut String, id: &str, title: &str, lead: &str) {
    put!(out, "<section id=\"{id}\" aria-labelledby=\"{id}-title\">\n<h2 id=\"{id}-title\">{}</h2>\n", Text(title));
    if !lead.is_empty() {
        put!(out, "<p class=\"lead\">{}</p>\n", Text(lead));
    }
}
