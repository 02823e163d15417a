//! The charts of the page: pictures in which the script lights where each machine is at a moment of the run.
//!
//! Without the script the pictures do not change, and a table shows how long each machine was in each place.

use crate::html::section;
use crate::markup::{Text, put};
use crate::report::{Chart, Report};

/// Writes the section. The script shows a third of the first view, or the moment that is asked for, first.
pub(super) fn charts(out: &mut String, report: &Report, first: Option<u64>) {
    if report.charts.is_empty() {
        return;
    }
    section(out, "charts", "Control states", "");
    let first = first.map_or(String::new(), |tick| format!(" data-first=\"{tick}\""));
    put!(
        out,
        "<div class=\"moment\" id=\"moment\" hidden=\"hidden\">\n\
         <span class=\"group\"><button type=\"button\" id=\"play\" aria-pressed=\"false\">Play</button>\
         <button type=\"button\" data-step=\"-1\" aria-label=\"A step back\" title=\"A step back\">\u{2190}</button>\
         <button type=\"button\" data-step=\"1\" aria-label=\"A step on\" title=\"A step on\">\u{2192}</button></span>\n\
         <input type=\"range\" id=\"tick\" min=\"0\" max=\"{}\" value=\"0\" step=\"1\"{first} aria-label=\"Moment of the run\"/>\n\
         <output id=\"now\" for=\"tick\"></output>\n\
         <span class=\"hint\">or point at the timeline</span>\n</div>\n",
        report.shown.max(1) - 1
    );
    out.push_str("<div class=\"charts\">\n");
    for (index, chart) in report.charts.iter().enumerate() {
        put!(
            out,
            "<figure class=\"chartbox\" data-chart=\"{index}\">\n<figcaption><h3>{}</h3>\
             <button type=\"button\" class=\"enlarge\" aria-pressed=\"false\" hidden=\"hidden\">Enlarge</button>\
             </figcaption>\n<div class=\"wide\">{}</div>\n",
            Text(&chart.title),
            chart.picture
        );
        out.push_str("<p class=\"told\"></p>\n");
        numbers(out, report, chart);
        out.push_str("</figure>\n");
    }
    out.push_str("</div>\n</section>\n");
}

/// How long each machine was where.
fn numbers(out: &mut String, report: &Report, chart: &Chart) {
    let spent = |lights: &crate::report::Lights| lights.shares.iter().any(|share| *share > 0);
    if !chart.lights.iter().any(spent) {
        out.push_str("<p class=\"lead\">Never entered in this run.</p>\n");
        return;
    }
    out.push_str(
        "<details class=\"numbers\"><summary>How long in each, in numbers</summary>\n<div class=\"wide\"><table>\n<tbody>\n",
    );
    for lights in chart.lights.iter().filter(|lights| spent(lights)) {
        for (kind, share) in lights.track.kinds.iter().zip(&lights.shares).filter(|(_, share)| **share > 0) {
            let percent = *share as f64 * 100.0 / report.ticks.max(1) as f64;
            put!(
                out,
                "<tr><th scope=\"row\">{}</th><td>{}<small>{percent:.1}\u{202f}%</small></td></tr>\n",
                Text(if lights.name.is_empty() {
                    kind.label.clone()
                } else {
                    format!("{}: {}", lights.name, kind.label)
                }),
                report.time.show(*share)
            );
        }
    }
    out.push_str("</tbody></table></div></details>\n");
}
