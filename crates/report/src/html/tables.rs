//! Figures of tasks, waiting, age and channels: tables with small drawings beside the numbers.

use crate::html::{go, section};
use crate::markup::{Px, Text, put};
use crate::report::{Buffer, Report, Series, Task};
use crate::svg::{histogram, legs, profile};
use crate::time::count;
use crate::tone::Tone;

/// Width of the bars in tables.
const BAR: f64 = 132.0;

/// Writes the table of tasks.
pub(super) fn tasks(out: &mut String, report: &Report) {
    if !report.has_tasks() {
        return;
    }
    section(
        out,
        "tasks",
        "Tasks",
        "Response is the time from the begin of a period to the end of its cycle; for a task without periods, from when it is no longer idle, or from one end to the next if it never is. The bar shows it within the time up to the deadline: the mean dark, the longest pale.",
    );
    out.push_str("<div class=\"wide\"><table class=\"tasks\">\n<thead><tr><th scope=\"col\">Task</th><th scope=\"col\">Cycles</th><th scope=\"col\">Deadlines met</th><th scope=\"col\">missed</th><th scope=\"col\">Response, mean</th><th scope=\"col\">longest</th><th scope=\"col\" class=\"drawn\">within the deadline</th><th scope=\"col\">Given up</th><th scope=\"col\" class=\"drawn\">Use of time</th></tr></thead>\n<tbody>\n");
    for task in &report.tasks {
        task_row(out, report, task);
    }
    out.push_str("</tbody></table></div>\n</section>\n");
}

fn number(out: &mut String, n: Option<u64>, bad: bool) {
    match n {
        None => out.push_str("<td class=\"nil\">\u{2013}</td>"),
        Some(n) if bad && n > 0 => put!(out, "<td class=\"bad\">{}</td>", count(n)),
        Some(n) => put!(out, "<td>{}</td>", count(n)),
    }
}

fn task_row(out: &mut String, report: &Report, task: &Task) {
    let time = report.time;
    put!(out, "<tr><th scope=\"row\">{}<small>{}</small></th>", Text(&task.name), Text(task.describe(time)));
    number(out, task.completed, false);
    number(out, task.met, false);
    number(out, task.missed.map(|missed| missed + u64::from(task.overdue.is_some())), !task.may_miss);
    match task.cycles.greatest() {
        Some((most, at)) => {
            put!(out, "<td>{}</td><td>{}</td>", time.mean(task.cycles.mean()), go(at, &time.show(most)));
        }
        None => out.push_str("<td class=\"nil\">\u{2013}</td><td class=\"nil\">\u{2013}</td>"),
    }
    out.push_str("<td class=\"drawn\">");
    if let (Some(allowed), Some((most, _))) = (task.allowed(), task.cycles.greatest()) {
        response_bar(out, task.cycles.mean() / allowed as f64, most as f64 / allowed as f64);
    }
    out.push_str("</td>");
    number(out, task.skipped, true);
    out.push_str("<td class=\"drawn\">");
    share_bar(out, report, task);
    out.push_str("</td></tr>\n");
}

/// Mean and longest response as parts of the time up to the deadline.
fn response_bar(out: &mut String, mean: f64, most: f64) {
    let part = |share: f64| Px(BAR * share.min(1.0));
    let late = if most > 1.0 { " late" } else { "" };
    put!(
        out,
        "<svg class=\"bar\" viewBox=\"0 0 {w} 14\" width=\"{w}\" height=\"14\" role=\"img\"><title>mean {:.0} %, longest {:.0} % of the time up to the deadline</title>",
        mean * 100.0,
        most * 100.0,
        w = Px(BAR)
    );
    put!(
        out,
        "<rect class=\"rail\" y=\"4\" width=\"{}\" height=\"6\"/><rect class=\"most{late}\" y=\"4\" width=\"{}\" height=\"6\"/><rect class=\"mean{late}\" y=\"4\" width=\"{}\" height=\"6\"/>",
        Px(BAR),
        part(most),
        part(mean)
    );
    put!(out, "<path class=\"due\" d=\"M{x} 0V14\"/></svg>", x = Px(BAR - 0.5));
}

/// How a task divides its time.
fn share_bar(out: &mut String, report: &Report, task: &Task) {
    put!(
        out,
        "<svg class=\"bar\" viewBox=\"0 0 {w} 14\" width=\"{w}\" height=\"14\" role=\"img\"><title>",
        w = Px(BAR)
    );
    let told: Vec<String> = report
        .activities
        .iter()
        .zip(&task.shares)
        .filter(|(_, share)| **share > 0)
        .map(|(kind, share)| format!("{} {:.1} %", kind.label, *share as f64 * 100.0 / report.ticks.max(1) as f64))
        .collect();
    put!(out, "{}</title><rect class=\"rail\" y=\"2\" width=\"{}\" height=\"10\"/>", Text(told.join(", ")), Px(BAR));
    let mut x = 0.0;
    for tone in Tone::ALL.into_iter().filter(|tone| *tone != Tone::Idle) {
        let ticks: u64 =
            report.activities.iter().zip(&task.shares).filter(|(kind, _)| kind.tone == tone).map(|(_, n)| n).sum();
        if ticks > 0 {
            let width = BAR * ticks as f64 / report.ticks.max(1) as f64;
            put!(
                out,
                "<rect class=\"{}\" x=\"{}\" y=\"2\" width=\"{}\" height=\"10\"/>",
                tone.name(),
                Px(x),
                Px(width)
            );
            x += width;
        }
    }
    out.push_str("</svg>");
}

/// Writes how long each task waited.
pub(super) fn waiting(out: &mut String, report: &Report) {
    if report.tasks.is_empty() {
        return;
    }
    let waiting: Vec<&str> =
        report.activities.iter().filter(|k| k.tone == Tone::Wait).map(|k| k.label.as_str()).collect();
    let (waited, never): (Vec<&Task>, Vec<&Task>) = report.tasks.iter().partition(|task| !task.waits.is_empty());
    let mut lead = match waiting.as_slice() {
        [] => return,
        labels => format!("Every time a task was {}, by its length in {}.", labels.join(" or "), report.time.unit()),
    };
    if waited.is_empty() {
        return;
    }
    if !never.is_empty() {
        let names: Vec<&str> = never.iter().map(|task| task.name.as_str()).collect();
        put!(lead, " Never: {}.", names.join(", "));
    }
    section(out, "waiting", "Waiting", &lead);
    out.push_str("<div class=\"multiples\">\n");
    for task in waited {
        let (most, at) = task.waits.greatest().unwrap_or_default();
        put!(out, "<figure><figcaption>{}</figcaption>\n", Text(&task.name));
        out.push_str(&histogram(
            &task.waits,
            report.time,
            "wait",
            &format!("How long {} waited, and how often", task.name),
        ));
        put!(
            out,
            "<p>{}, mean {}, longest {}, in all {}</p></figure>\n",
            times(task.waits.count()),
            report.time.mean(task.waits.mean()),
            go(at, &report.time.show(most)),
            report.time.show(task.waits.total())
        );
    }
    out.push_str("</div>\n</section>\n");
}

fn times(n: u64) -> String {
    match n {
        1 => "once".to_owned(),
        2 => "twice".to_owned(),
        n => format!("{} times", count(n)),
    }
}

/// Writes the values over time and the way of data.
pub(super) fn ages(out: &mut String, report: &Report) {
    for (index, series) in report.series.iter().enumerate() {
        series_section(out, report, series, index);
    }
    let Some(flow) = &report.flow else { return };
    let (noun, nouns) = &flow.noun;
    let first = flow.hops.first().map_or("", |(_, event)| event);
    let counts: Vec<String> = flow
        .hops
        .iter()
        .zip(&flow.reached)
        .skip(1)
        .map(|((task, event), n)| format!("{} were {event} by {task}", count(*n)))
        .collect();
    let lead = format!(
        "Of {} {nouns} {first}, {}. A {noun} that a later one overtakes goes no further. From the least to the longest time of each leg; the dot is the mean.",
        count(flow.reached[0]),
        counts.join(", ")
    );
    section(out, "way", &format!("Way of the {nouns}"), &lead);
    put!(out, "<div class=\"pair\">\n<div class=\"wide\">{}</div>\n", legs(flow, report.time));
    out.push_str("<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">Leg</th><th scope=\"col\">Times</th><th scope=\"col\">Least</th><th scope=\"col\">Mean</th><th scope=\"col\">Longest</th></tr></thead>\n<tbody>\n");
    for (leg, tally) in flow.legs.iter().chain(std::iter::once(&flow.whole)).enumerate() {
        let name = match flow.hops.get(leg + 1) {
            Some((task, _)) => format!("{} \u{2192} {task}", flow.hops[leg].0),
            None => "the whole way".to_owned(),
        };
        put!(out, "<tr><th scope=\"row\">{}</th><td>{}</td>", Text(name), count(tally.count()));
        match tally.least().zip(tally.greatest()) {
            Some((least, (most, at))) => put!(
                out,
                "<td>{}</td><td>{}</td><td>{}</td></tr>\n",
                report.time.show(least),
                report.time.mean(tally.mean()),
                go(at, &report.time.show(most))
            ),
            None => out.push_str(
                "<td class=\"nil\">\u{2013}</td><td class=\"nil\">\u{2013}</td><td class=\"nil\">\u{2013}</td></tr>\n",
            ),
        }
    }
    out.push_str("</tbody></table></div>\n</div>\n</section>\n");
}

fn series_section(out: &mut String, report: &Report, series: &Series, index: usize) {
    let time = report.time;
    let mut lead = capital(&series.caption);
    if let Some((most, _)) = series.values.greatest() {
        let show = |value: Option<i64>| series.show(time, value.unwrap_or(0));
        put!(
            lead,
            "{}mean {}, in 95\u{202f}% of the time at most {}, most {}",
            if lead.is_empty() { "" } else { ": " },
            series.show_mean(time),
            show(series.values.percentile(95)),
            show(Some(most))
        );
        if let Some(bound) = series.bound {
            put!(lead, ", bound {}", series.show(time, bound));
        }
        lead.push('.');
    }
    if series.values.is_empty() {
        put!(lead, "{}never defined in this run.", if lead.is_empty() { "" } else { ": " });
        section(out, &format!("series-{index}"), &series.name, &capital(&lead));
        out.push_str("</section>\n");
        return;
    }
    section(out, &format!("series-{index}"), &series.name, &lead);
    put!(out, "<div class=\"wide\">{}</div>\n</section>\n", profile(report, series));
}

/// A text as the begin of a sentence.
fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}

/// Writes the tables of buffers and queues.
pub(super) fn channels(out: &mut String, report: &Report) {
    if report.buffers.is_empty() && report.queues.is_empty() {
        return;
    }
    section(out, "channels", "Channels", "What went through each, and how long its lock was held at a time.");
    let labels =
        |counters: &[(String, Option<i64>)]| counters.iter().map(|(label, _)| label.clone()).collect::<Vec<_>>();
    let mut columns: Vec<String> = Vec::new();
    for label in report
        .buffers
        .iter()
        .flat_map(|buffer| labels(&buffer.counters))
        .chain(report.queues.iter().flat_map(|queue| labels(&queue.counters)))
    {
        if !columns.contains(&label) {
            columns.push(label);
        }
    }
    out.push_str("<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">Channel</th><th scope=\"col\">Swaps</th><th scope=\"col\">Lock held, mean</th><th scope=\"col\">longest</th>");
    columns.iter().for_each(|label| put!(out, "<th scope=\"col\">{}</th>", Text(label)));
    out.push_str("</tr></thead>\n<tbody>\n");
    for buffer in &report.buffers {
        let kind = format!("{} arrays", buffer.rows.len());
        channel_head(out, &buffer.from, &buffer.to, &kind);
        held(out, report, buffer);
        counters(out, &columns, &buffer.counters);
    }
    for queue in &report.queues {
        let most = queue.lengths.greatest().map_or(0, |(most, _)| most);
        let kind = queue
            .capacity
            .map_or(queue.kind.clone(), |capacity| format!("{}, {most} of {capacity} places used at most", queue.kind));
        channel_head(out, &queue.from, &queue.to, &kind);
        out.push_str("<td class=\"nil\">\u{2013}</td><td class=\"nil\">\u{2013}</td><td class=\"nil\">\u{2013}</td>");
        counters(out, &columns, &queue.counters);
    }
    out.push_str("</tbody></table></div>\n</section>\n");
}

fn channel_head(out: &mut String, from: &str, to: &str, kind: &str) {
    put!(out, "<tr><th scope=\"row\">{} \u{2192} {}<small>{}</small></th>", Text(from), Text(to), Text(kind));
}

fn held(out: &mut String, report: &Report, buffer: &Buffer) {
    number(out, buffer.swapped, false);
    match buffer.held.greatest() {
        Some((most, at)) => {
            put!(out, "<td>{}</td><td>{}</td>", report.time.mean(buffer.held.mean()), go(at, &report.time.show(most)))
        }
        None => out.push_str("<td class=\"nil\">\u{2013}</td><td class=\"nil\">\u{2013}</td>"),
    }
}

fn counters(out: &mut String, columns: &[String], counters: &[(String, Option<i64>)]) {
    for column in columns {
        let found = counters.iter().find(|(label, _)| label == column).and_then(|(_, n)| *n);
        number(out, found.map(|n| n.max(0) as u64), false);
    }
    out.push_str("</tr>\n");
}
