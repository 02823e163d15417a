//! The page of a program's runs: verdicts, what the camera saw, error, set-points, timeline, wake-ups, age, deadlines.
//!
//! In: a [`Program`]. Out: a page like the one that [`render_html`](crate::render_html) makes of a model's run: one
//! file, nothing fetched. The first run is shown in detail; the figures of all runs stand side by side.

use crate::html::{data, lanes, section, verdicts};
use crate::markup::{Base64, Text, put};
use crate::program::{ChannelAge, ClosedLoop, LOSSY, Program, ProgramRun, TaskTiming, show_greatest};
use crate::svg::{distribution, error_norm, joint, show_ns};
use crate::tally::Tally;
use crate::time::count;

/// The runs of a program as a page.
pub fn render_program(program: &Program) -> String {
    let mut out = String::new();
    super::open(&mut out, &program.title, "");
    header(&mut out, program);
    out.push_str("<main>\n");
    let first = program.runs.first();
    let world = first.and_then(|run| run.closed_loop.as_ref());
    if let Some(world) = world {
        views(&mut out, world);
        error(&mut out, world);
        joints(&mut out, world);
    }
    if let Some(run) = first.filter(|run| run.lanes.has_lanes()) {
        lanes::timeline_section(&mut out, &run.lanes);
    }
    wake_ups(&mut out, program);
    ages(&mut out, program);
    deadlines(&mut out, program);
    bounds(&mut out, program);
    verdicts::list_facts(&mut out, &program.facts);
    out.push_str("</main>\n");
    let model = Text(&program.model);
    put!(
        out,
        "<footer>Written by Groundstate from runs of a program made for {model}. This page is complete: it loads nothing.</footer>\n"
    );
    if let Some(run) = first.filter(|run| run.lanes.has_lanes()) {
        super::scripts(&mut out, &data::run_data(&run.lanes), "");
    }
    out.push_str("</body>\n</html>\n");
    out
}

fn header(out: &mut String, program: &Program) {
    out.push_str("<header>\n");
    put!(out, "<p class=\"eyebrow\">Program held to {}</p>\n<h1>{}</h1>\n", Text(&program.model), Text(&program.title));
    if !program.note.is_empty() {
        put!(out, "<p class=\"note\">{}</p>\n", Text(&program.note));
    }
    out.push_str("<ul class=\"checks held\">\n");
    for run in &program.runs {
        let name = format!("{} in {}", run.span(), run.name);
        if let Some(held) = &run.verdict {
            check(out, held.conforms, &name, &held.words);
            held.beside.iter().for_each(|words| check(out, None, &name, words));
        }
        if let Some(words) = run.outside() {
            check(out, Some(false), &name, &words);
        }
        if run.lossy {
            check(out, None, &name, LOSSY);
        }
        if let Some(world) = &run.closed_loop {
            check(out, world.reached, &name, &world.end);
        }
    }
    out.push_str("</ul>\n<dl class=\"figures\">\n");
    for run in &program.runs {
        let missed: u64 = run.tasks.iter().filter_map(|task| task.missed).sum();
        let met: u64 = run.tasks.iter().filter_map(|task| task.met).sum();
        let remark = if missed == 0 { "none missed".to_owned() } else { format!("{} missed", count(missed)) };
        let label = format!("Deadlines met, {}", run.name);
        figure(out, &label, &count(met), &remark, missed > 0 && run.verdict.is_none());
        if let Some((name, tally)) = run.closed_loop.as_ref().and_then(|world| world.image_ages.last()) {
            let p99 =
                tally.percentile(99).map_or_else(String::new, |ns| format!("99\u{202f}% at most {}", show_ns(ns)));
            let half = tally.percentile(50).map_or_else(|| "\u{2013}".to_owned(), show_ns);
            figure(out, &format!("Image \u{2192} {name}, {}", run.name), &half, &p99, false);
        }
    }
    out.push_str("</dl>\n</header>\n");
}

fn figure(out: &mut String, what: &str, value: &str, remark: &str, bad: bool) {
    let class = if bad { " class=\"bad\"" } else { "" };
    put!(
        out,
        "<div{class}><dt>{}</dt><dd><b>{}</b><span>{}</span></dd></div>\n",
        Text(what),
        Text(value),
        Text(remark)
    );
}

fn check(out: &mut String, good: Option<bool>, name: &str, words: &str) {
    let (class, mark) = match good {
        Some(true) => ("good", '\u{2713}'),
        Some(false) => ("bad", '\u{2717}'),
        None => ("unknown", '\u{2013}'),
    };
    put!(
        out,
        "<li class=\"{class}\"><span class=\"mark\" aria-hidden=\"true\">{mark}</span><span><b>{}</b>: {}</span></li>\n",
        Text(name),
        Text(words)
    );
}

fn views(out: &mut String, world: &ClosedLoop) {
    if world.views.is_empty() {
        return;
    }
    section(
        out,
        "views",
        "What the camera saw",
        "Circles are the features as they were detected, lines the way that they have come since the goal was sent, crosses where they are to be.",
    );
    out.push_str("<div class=\"views\">\n");
    for view in &world.views {
        put!(
            out,
            "<figure><img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"The camera's image: {c}\"/><figcaption>{c}</figcaption></figure>\n",
            Base64(&view.png),
            world.image.0,
            world.image.1,
            c = Text(&view.caption)
        );
    }
    out.push_str("</div>\n</section>\n");
}

fn error(out: &mut String, world: &ClosedLoop) {
    if world.error.is_empty() {
        return;
    }
    section(
        out,
        "error",
        "Error of the features",
        "The norm of the difference between the features and where they are to be, in the image plane at distance 1, for each image.",
    );
    put!(out, "<div class=\"wide\">{}</div>\n</section>\n", error_norm(world));
}

fn joints(out: &mut String, world: &ClosedLoop) {
    if world.joints.is_empty() {
        return;
    }
    section(out, "joints", "Set-points of the joints", "In radians.");
    out.push_str(
        "<ul class=\"legend\"><li><i class=\"thin\"></i>set-point</li><li><i class=\"broad\"></i>measured</li></ul>\n<div class=\"multiples plots\">\n",
    );
    for found in &world.joints {
        put!(out, "<figure><figcaption>{}</figcaption>\n{}</figure>\n", Text(&found.name), joint(found));
    }
    out.push_str("</div>\n</section>\n");
}

/// How a picture tells the runs apart; a single run needs no such mark.
fn key(out: &mut String, program: &Program) {
    if program.runs.len() < 2 {
        return;
    }
    out.push_str("<ul class=\"legend\">\n");
    for (index, run) in program.runs.iter().enumerate() {
        put!(out, "<li><i class=\"swatch{index}\"></i>{}</li>\n", Text(&run.name));
    }
    out.push_str("</ul>\n");
}

/// A distribution, and its figures run by run.
fn spread(out: &mut String, program: &Program, name: &str, caption: &str, axis: &str, tallies: &[&Tally]) {
    put!(out, "<figure><figcaption>{}<small>{}</small></figcaption>\n", Text(name), Text(caption));
    match always(tallies) {
        Some(value) => put!(out, "<p>{} always {}</p>\n", Text(axis), show_ns(value)),
        None => out.push_str(&distribution(tallies, &format!("{name}: {axis}"), axis)),
    }
    out.push_str("<table class=\"small\">\n<thead><tr><th scope=\"col\"></th><th scope=\"col\">p50</th><th scope=\"col\">p99</th><th scope=\"col\">max</th></tr></thead>\n<tbody>\n");
    for (run, tally) in program.runs.iter().zip(tallies) {
        let Some((most, _)) = tally.greatest() else { continue };
        let at = |percent| show_ns(tally.percentile(percent).unwrap_or(0));
        put!(
            out,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            Text(&run.name),
            at(50),
            at(99),
            show_ns(most)
        );
    }
    out.push_str("</tbody></table></figure>\n");
}

/// The common value of all runs, if there is only one; then there is nothing to draw.
fn always(tallies: &[&Tally]) -> Option<u64> {
    let least = tallies.iter().filter_map(|tally| tally.least()).min()?;
    let most = tallies.iter().filter_map(|tally| tally.greatest()).map(|(most, _)| most).max()?;
    (least == most).then_some(least)
}

const NONE: &Tally = &Tally::new();

fn wake_ups(out: &mut String, program: &Program) {
    let Some(first) = program.runs.first() else { return };
    let of = |name: &str| -> Vec<&Tally> {
        let find = |run: &'_ ProgramRun| run.tasks.iter().position(|task| task.name == name);
        program.runs.iter().map(|run| find(run).map_or(NONE, |at| &run.tasks[at].wake_ups)).collect()
    };
    let never_late =
        |tallies: &[&Tally]| tallies.iter().all(|tally| tally.greatest().is_none_or(|(most, _)| most == 0));
    let timed: Vec<&TaskTiming> =
        first.tasks.iter().filter(|task| of(&task.name).iter().any(|t| !t.is_empty())).collect();
    // If no task ever was late there is nothing to draw; the table of deadlines says so.
    if timed.iter().all(|task| never_late(&of(&task.name))) {
        return;
    }
    let mut lead =
        "From when a cycle is due to when it begins; of a task that is woken by data, from when these are let go of."
            .to_owned();
    let punctual: Vec<&str> =
        timed.iter().filter(|task| never_late(&of(&task.name))).map(|task| task.name.as_str()).collect();
    if !punctual.is_empty() {
        put!(lead, " Always at once: {}.", punctual.join(", "));
    }
    section(out, "wake-ups", "Wake-up latency", &lead);
    key(out, program);
    out.push_str("<div class=\"multiples plots\">\n");
    for task in timed.into_iter().filter(|task| !never_late(&of(&task.name))) {
        spread(out, program, &task.name, &rhythm(task), "wake-up latency", &of(&task.name));
    }
    out.push_str("</div>\n</section>\n");
}

/// When a task's cycles begin, in words.
fn rhythm(task: &TaskTiming) -> String {
    match (task.period_ns, &task.awaits) {
        (Some(period), _) => format!("every {}", show_ns(period)),
        (None, Some(channel)) => format!("awaits {channel}"),
        (None, None) => "again and again".to_owned(),
    }
}

fn ages(out: &mut String, program: &Program) {
    let Some(first) = program.runs.first() else { return };
    let images: &[(String, Tally)] = first.closed_loop.as_ref().map_or(&[], |world| &world.image_ages);
    let of_image = |at: usize| -> Vec<&Tally> {
        let worlds = program.runs.iter().filter_map(|run| run.closed_loop.as_ref());
        worlds.filter_map(|world| world.image_ages.get(at)).map(|(_, tally)| tally).collect()
    };
    let of_channel = |name: &str| -> Vec<&Tally> {
        let find = |other: &&ChannelAge| other.name == name;
        program.runs.iter().map(|run| run.channels.iter().find(find).map_or(NONE, |found| &found.ages)).collect()
    };
    let known = |tallies: &[&Tally]| tallies.iter().any(|tally| !tally.is_empty());
    let images: Vec<(usize, &String)> =
        images.iter().map(|(name, _)| name).enumerate().filter(|(at, _)| known(&of_image(*at))).collect();
    let channels: Vec<&ChannelAge> =
        first.channels.iter().filter(|channel| known(&of_channel(&channel.name))).collect();
    if images.is_empty() && channels.is_empty() {
        return;
    }
    section(
        out,
        "ages",
        "Age of data",
        "Of an image: from its taking to its use by each task, however it came there. Of a channel: from the begin of a datum's writing to each of its readings, whether it is new or was read before.",
    );
    key(out, program);
    out.push_str("<div class=\"multiples plots\">\n");
    for (at, name) in images {
        spread(out, program, &format!("Image \u{2192} {name}"), "", "age of the image", &of_image(at));
    }
    for channel in channels {
        let caption = format!("{} \u{2192} {}", channel.from, channel.to);
        spread(out, program, &channel.name, &caption, "age when read", &of_channel(&channel.name));
    }
    out.push_str("</div>\n</section>\n");
}

fn deadlines(out: &mut String, program: &Program) {
    let Some(first) = program.runs.first().filter(|run| !run.tasks.is_empty()) else { return };
    section(
        out,
        "deadlines",
        "Deadlines",
        "Response: from when a cycle is due, or begins where nothing says when it is due, to its end. Skipped: accesses to a channel that the watchdog gave up.",
    );
    out.push_str("<div class=\"wide\"><table class=\"deadlines\">\n<thead><tr><th scope=\"col\">Task</th><th scope=\"col\" class=\"left\">Run</th><th scope=\"col\">Period</th><th scope=\"col\">Activations</th><th scope=\"col\">Deadlines missed</th><th scope=\"col\">Skipped</th><th scope=\"col\">Response, p99</th><th scope=\"col\">worst</th><th scope=\"col\">Wake-up latency, p99</th><th scope=\"col\">worst</th></tr></thead>\n");
    for task in &first.tasks {
        out.push_str("<tbody>\n");
        let runs: Vec<(&ProgramRun, &TaskTiming)> = program
            .runs
            .iter()
            .filter_map(|run| run.tasks.iter().find(|other| other.name == task.name).map(|found| (run, found)))
            .collect();
        for (index, (run, found)) in runs.iter().enumerate() {
            out.push_str("<tr>");
            if index == 0 {
                put!(out, "<th scope=\"rowgroup\" rowspan=\"{}\">{}</th>", runs.len(), Text(&task.name));
            }
            put!(out, "<td class=\"left\">{}</td>", Text(&run.name));
            cell(out, found.period_ns.map(show_ns), false);
            cell(out, Some(count(found.activations)), false);
            cell(out, found.missed.map(count), found.missed.unwrap_or(0) > 0);
            cell(out, Some(count(found.skips)), found.skips > 0);
            for tally in [&found.responses, &found.wake_ups] {
                cell(out, tally.percentile(99).map(show_ns), false);
                cell(out, tally.greatest().map(|(most, _)| show_ns(most)), false);
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</tbody>\n");
    }
    out.push_str("</table></div>\n</section>\n");
}

/// What the program counted of the bounds that its chart states.
fn bounds(out: &mut String, program: &Program) {
    if program.runs.iter().all(|run| run.bounds.is_empty()) {
        return;
    }
    section(
        out,
        "bounds",
        "What the chart bounds",
        "How late cycles are released, how long elaborations take, how soon something new comes, how many deadlines are missed, how old data get, as the program counted it. Outside: how often a bound was not kept.",
    );
    out.push_str("<div class=\"wide\"><table class=\"bounds\">\n<thead><tr><th scope=\"col\">Bound</th><th scope=\"col\" class=\"left\">Limit</th><th scope=\"col\" class=\"left\">Run</th><th scope=\"col\">Seen</th><th scope=\"col\">Outside</th><th scope=\"col\">Most</th></tr></thead>\n<tbody>\n");
    for run in &program.runs {
        for bound in &run.bounds {
            put!(
                out,
                "<tr><th scope=\"row\">{}</th><td class=\"left\">{}</td><td class=\"left\">{}</td>",
                Text(&bound.what),
                Text(&bound.limit),
                Text(&run.name)
            );
            cell(out, Some(count(bound.seen)), false);
            cell(out, Some(count(bound.outside())), bound.outside() > 0);
            cell(out, Some(show_greatest(bound)), false);
            out.push_str("</tr>\n");
        }
    }
    out.push_str("</tbody>\n</table></div>\n</section>\n");
}

fn cell(out: &mut String, text: Option<String>, bad: bool) {
    match text {
        None => out.push_str("<td class=\"nil\">\u{2013}</td>"),
        Some(text) => put!(out, "<td{}>{}</td>", if bad { " class=\"bad\"" } else { "" }, Text(text)),
    }
}
