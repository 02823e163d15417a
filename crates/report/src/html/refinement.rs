//! The page of a refinement check: the verdict, the part of the coupling that fails, both runs as lanes and pictures on one axis and side
//! by side in words.
//!
//! Without the script all of it can be read; the script moves through the runs. INVARIANT: what is not known is shown as such.

use crate::html::{LivePart, charts, data, figures, lanes, open, part_css, scripts, section, verdicts};
use crate::markup::{Text, put};
use crate::refinement::{Judgement, RefinementCheck};

/// A refinement check as a page.
///
/// ```
/// let check = report::RefinementCheck { models: ["Light.asm".into(), "Relay.asm".into()], ..Default::default() };
/// let page = report::render_refinement(&check);
/// assert!(page.starts_with("<!DOCTYPE html>") && page.contains("Relay.asm"));
/// ```
pub fn render_refinement(check: &RefinementCheck) -> String {
    let mut out = String::new();
    let runs = check.runs.as_ref();
    let pictures = runs.filter(|runs| !runs.charts.is_empty()).map_or("", |runs| &runs.chart_style);
    let [one, other] = &check.models;
    open(&mut out, &format!("{other} refines {one}?"), &format!("{}{pictures}", include_str!("refinement.css")));
    header(&mut out, check);
    out.push_str("<main>\n");
    sections(&mut out, check);
    told(&mut out, check);
    verdicts::list_facts(&mut out, &check.facts);
    out.push_str("</main>\n<footer>Written by Groundstate. This page is complete: it loads nothing.</footer>\n");
    if let Some(runs) = runs.filter(|runs| runs.has_lanes()) {
        let lights = if runs.charts.is_empty() { "" } else { include_str!("charts.js") };
        scripts(&mut out, &data::run_data(runs), lights);
    }
    out.push_str("</body>\n</html>\n");
    out
}

/// The sections that show where a refinement fails, without their page.
pub fn render_refinement_part(check: &RefinementCheck) -> LivePart {
    let mut markup = String::new();
    sections(&mut markup, check);
    let runs = check.runs.as_ref().filter(|runs| runs.has_lanes());
    let pictures = runs.map_or("", |runs| &runs.chart_style);
    let style = format!("{}{}{pictures}", part_css(), include_str!("refinement.css"));
    LivePart { markup, run: runs.map_or("null".to_string(), data::run_data), style }
}

/// Where it fails: the part of the coupling, both runs as lanes, pictures and words.
fn sections(out: &mut String, check: &RefinementCheck) {
    failing(out, check);
    if let Some(runs) = check.runs.as_ref().filter(|runs| runs.has_lanes()) {
        lanes::timeline_section(out, runs);
        charts::charts(out, runs, Some(runs.shown.max(1) - 1));
    }
    diagrams(out, check);
}

fn header(out: &mut String, check: &RefinementCheck) {
    let [one, other] = &check.models;
    put!(
        out,
        "<header>\n<p class=\"eyebrow\">Refinement</p>\n<h1>{}</h1>\n<p class=\"note\">Whether every run of {} (the concrete machine) corresponds to a run of {} (the abstract one).</p>\n",
        Text(format!("{one} \u{2190} {other}")),
        Text(other),
        Text(one)
    );
    let (class, mark, verdict) = match check.judgement {
        Judgement::Refines => ("good", '\u{2713}', "Refines"),
        Judgement::DoesNotRefine => ("bad", '\u{2717}', "Does not refine"),
        Judgement::NotKnown => ("unknown", '?', "Not known"),
        Judgement::SaysNothing => ("unknown", '?', "Says nothing"),
    };
    let why = if check.why.is_empty() { ".".to_string() } else { format!(": {}.", check.why) };
    put!(
        out,
        "<div class=\"verdict {class}\"><p><span class=\"mark\" aria-hidden=\"true\">{mark}</span>{verdict}{}</p></div>\n",
        Text(why)
    );
    if !check.figures.is_empty() {
        out.push_str("<dl class=\"figures\">\n");
        for (what, value, remark) in &check.figures {
            figures::figure(out, what, value, &Text(remark).to_string(), false);
        }
        out.push_str("</dl>\n");
    }
    out.push_str("</header>\n");
}

/// What the abstract machine could have done, and the parts of the coupling that fail then.
fn failing(out: &mut String, check: &RefinementCheck) {
    if check.candidates.is_empty() && check.remarks.is_empty() {
        return;
    }
    let lead = match check.candidates.len() {
        0 => "",
        1 => "What the abstract machine could do, and the part of the coupling that fails then.",
        _ => "What the abstract machine could do, the nearest first, and the parts of the coupling that fail then.",
    };
    section(out, "end", "Where it fails", lead);
    for remark in &check.remarks {
        put!(out, "<p>{}</p>\n", coded(remark));
    }
    for candidate in &check.candidates {
        put!(out, "<article class=\"candidate\"><h3>{}</h3>\n<ul>\n", Text(&candidate.does));
        for part in &candidate.failing {
            let (first, more) = part.split_first().map_or(("", &[][..]), |(first, more)| (first.as_str(), more));
            put!(out, "<li><span class=\"fails\" aria-hidden=\"true\">\u{2717}</span>{}", coded(first));
            more.iter().for_each(|line| put!(out, "<small>{}</small>", coded(line.trim())));
            out.push_str("</li>\n");
        }
        out.push_str("</ul></article>\n");
    }
    out.push_str("</section>\n");
}

/// A text in which what stands between two backticks is code.
fn coded(text: &str) -> String {
    let parts = text.split('`').enumerate();
    let part = |(index, part): (usize, &str)| match index % 2 {
        0 => Text(part).to_string(),
        _ => format!("<code>{}</code>", Text(part)),
    };
    parts.map(part).collect()
}

/// Both runs in words, side by side.
fn diagrams(out: &mut String, check: &RefinementCheck) {
    if check.diagrams.is_empty() {
        return;
    }
    let lead = "Each row is a diagram: so many steps of the abstract machine and of the concrete one, behind which their states correspond.";
    section(out, "steps", "Both runs, side by side", lead);
    let [one, other] = &check.models;
    put!(
        out,
        "<div class=\"wide\"><table class=\"besides\">\n<thead><tr><th scope=\"col\">Diagram</th><th scope=\"col\">abstract: {}</th><th scope=\"col\">concrete: {}</th></tr></thead>\n<tbody>\n",
        Text(one),
        Text(other)
    );
    for diagram in &check.diagrams {
        let class = if diagram.is_loose { " class=\"loose\"" } else { "" };
        put!(out, "<tr{class}><th scope=\"row\">");
        match &check.runs {
            Some(runs) if runs.has_lanes() => out.push_str(&super::go(diagram.tick, &diagram.label)),
            _ => put!(out, "{}", Text(&diagram.label)),
        }
        out.push_str("</th>");
        for lines in &diagram.sides {
            out.push_str("<td>");
            lines.iter().for_each(|line| put!(out, "<code>{}</code>", Text(line)));
            out.push_str("</td>");
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n</section>\n");
}

fn told(out: &mut String, check: &RefinementCheck) {
    if check.told.is_empty() {
        return;
    }
    section(
        out,
        "told",
        "All that was found",
        "As a terminal shows it: what was observed, which diagrams were used, what was assumed.",
    );
    put!(out, "<pre class=\"told\">{}</pre>\n</section>\n", Text(&check.told));
}
