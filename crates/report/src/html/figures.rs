//! The head of the page: what ran, whether it is as it should be, and the five figures that matter.

use crate::html::go;
use crate::markup::{Text, put};
use crate::report::{Report, UNCHECKED};
use crate::time::count;

/// Writes the head.
pub(super) fn header(out: &mut String, report: &Report) {
    out.push_str("<header>\n");
    put!(out, "<p class=\"eyebrow\">Validated run of {}</p>\n<h1>{}</h1>\n", Text(&report.model), Text(&report.title));
    if !report.note.is_empty() {
        put!(out, "<p class=\"note\">{}</p>\n", Text(&report.note));
    }
    verdict(out, report);
    out.push_str("<dl class=\"figures\">\n");
    run(out, report);
    deadlines(out, report);
    waiting(out, report);
    age(out, report);
    scenarios(out, report);
    coverage(out, report);
    out.push_str("</dl>\n</header>\n");
}

fn verdict(out: &mut String, report: &Report) {
    let troubles = report.troubles();
    if troubles.is_empty() && !report.is_checked() {
        put!(out, "<p class=\"verdict unknown\"><span class=\"mark\" aria-hidden=\"true\">?</span>{UNCHECKED}</p>\n");
        return;
    }
    if troubles.is_empty() {
        out.push_str("<p class=\"verdict good\"><span class=\"mark\" aria-hidden=\"true\">\u{2713}</span>Everything that was checked held.</p>\n");
        return;
    }
    let sentence = if troubles.len() == 1 {
        "One thing went wrong".to_owned()
    } else {
        format!("{} things went wrong", troubles.len())
    };
    put!(
        out,
        "<div class=\"verdict bad\"><p><span class=\"mark\" aria-hidden=\"true\">\u{2717}</span>{sentence}:</p>\n<ul>"
    );
    for trouble in troubles {
        put!(out, "<li>{}</li>", Text(trouble));
    }
    out.push_str("</ul></div>\n");
}

/// A figure: what, how much, and a remark in markup.
pub(super) fn figure(out: &mut String, what: &str, value: &str, remark: &str, bad: bool) {
    let class = if bad { " class=\"bad\"" } else { "" };
    put!(out, "<div{class}><dt>{what}</dt><dd><b>{}</b><span>{remark}</span></dd></div>\n", Text(value));
}

fn run(out: &mut String, report: &Report) {
    let steps = if report.time.tick_ns().is_some() {
        format!("{} steps of {}", count(report.steps()), report.time.short(1))
    } else {
        "steps made".to_owned()
    };
    figure(out, "Simulated", &report.time.run(report.steps()), &steps, report.stopped.is_some());
}

fn deadlines(out: &mut String, report: &Report) {
    let (met, missed) = report.deadlines();
    if met + missed == 0 {
        return;
    }
    let allowed = report.tasks.iter().all(|task| task.may_miss || !task.is_late());
    let remark = match missed {
        0 => "none missed".to_owned(),
        _ if allowed => format!("{} missed, by tasks that may", count(missed)),
        _ => format!("{} missed", count(missed)),
    };
    figure(out, "Deadlines met", &count(met), &remark, !allowed);
}

fn waiting(out: &mut String, report: &Report) {
    match report.longest_wait() {
        Some((ticks, at, task)) => {
            let remark = format!("{}, at {}", Text(&task.name), go(at, &report.time.show(at)));
            figure(out, "Longest wait", &report.time.show(ticks), &remark, false);
        }
        None if !report.has_tasks() => {}
        None => figure(out, "Longest wait", "none", "no task ever waited", false),
    }
}

fn age(out: &mut String, report: &Report) {
    let Some(series) = report.series.first() else { return };
    let Some((most, at)) = series.values.greatest() else { return };
    let mut remark = format!("at {}", go(at, &report.time.show(at)));
    let mut bad = false;
    if let Some(bound) = series.bound {
        put!(remark, ", bound {}", Text(series.show(report.time, bound)));
        bad = most > bound;
    }
    figure(out, &Text(format!("{}, most", series.name)).to_string(), &series.show(report.time, most), &remark, bad);
}

fn scenarios(out: &mut String, report: &Report) {
    if report.scenarios.is_empty() {
        return;
    }
    let (passed, all) = (report.passed(), report.scenarios.len());
    let remark = if passed == all { "all as they should".to_owned() } else { format!("{} failed", all - passed) };
    figure(out, "Scenarios", &format!("{passed} of {all}"), &remark, passed < all);
}

fn coverage(out: &mut String, report: &Report) {
    let Some(measure) =
        report.coverage.as_ref().and_then(|coverage| coverage.measures.first().filter(|measure| measure.total > 0))
    else {
        return;
    };
    let remark = format!("{} of {} {}", count(measure.covered), count(measure.total), Text(&measure.what));
    figure(out, "Coverage", &format!("{:.1}\u{202f}%", measure.percent()), &remark, false);
}
