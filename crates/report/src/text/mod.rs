//! The report in short, for a terminal: verdict, lanes, tables, all in plain lines of text.
//!
//! The height of a lane's block shows how busy the task is in its column; a cross stands where it waited. Colour, if
//! wanted, shows what it did most. A buffer's lane shows which array is on the reader's side.

mod lanes;
mod program;
mod table;

pub use program::{RunSummary, summarise_program};

use crate::markup::put;
use crate::report::{Report, Series, Task, UNCHECKED};
use crate::time::count;
use table::Table;

/// How to summarise.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SummaryOptions {
    /// Columns of the terminal.
    pub width: usize,
    /// Colours by ANSI sequences.
    pub colour: bool,
}

impl Default for SummaryOptions {
    fn default() -> SummaryOptions {
        SummaryOptions { width: 100, colour: false }
    }
}

/// The report in short.
///
/// ```
/// let mut builder = report::ReportBuilder::new(report::Spec::default());
/// builder.step();
/// let text = report::summarise(&builder.finish("Small"), &report::SummaryOptions::default());
/// assert!(text.starts_with("Small"));
/// ```
pub fn summarise(report: &Report, options: &SummaryOptions) -> String {
    let mut out = String::new();
    put!(out, "{}\n", report.title);
    let steps = format!("{} steps", count(report.steps()));
    match report.time.tick_ns() {
        Some(_) => {
            put!(out, "{}: {}, {steps} of {}\n", report.model, report.time.run(report.steps()), report.time.short(1))
        }
        None => put!(out, "{}: {steps}\n", report.model),
    }
    lanes::lanes(&mut out, report, options);
    tasks(&mut out, report);
    channels(&mut out, report);
    let mut lines = Table::new(&["", ""]);
    for series in &report.series {
        lines.row(vec![series.name.clone(), series_line(report, series)]);
    }
    if let Some(flow) = &report.flow {
        lines.row(vec![format!("Way of the {}", flow.noun.1), flow_line(report)]);
    }
    verdicts(&mut lines, report);
    out.push_str(&lines.render("", true));
    verdict(&mut out, report, options);
    // Only ordinary blanks are one column wide everywhere, so narrow ones become ordinary.
    out.replace('\u{202f}', " ")
}

fn optional(n: Option<u64>) -> String {
    n.map_or_else(|| "-".to_owned(), count)
}

fn tasks(out: &mut String, report: &Report) {
    if !report.has_tasks() {
        return;
    }
    let mut table = Table::new(&[
        "task",
        "period",
        "cycles",
        "met",
        "missed",
        "response",
        "longest",
        "waits",
        "longest wait",
        "given up",
    ]);
    for task in &report.tasks {
        let time = report.time;
        let (mean, most) = match task.cycles.greatest() {
            Some((most, _)) => (time.mean(task.cycles.mean()), time.show(most)),
            None => ("-".to_owned(), "-".to_owned()),
        };
        table.row(vec![
            task.name.clone(),
            task.period.map_or("-".to_owned(), |period| time.short(period)),
            optional(task.completed),
            optional(task.met),
            optional(task.missed),
            mean,
            most,
            if task.waits.is_empty() { "-".to_owned() } else { count(task.waits.count()) },
            longest_wait(report, task),
            optional(task.skipped),
        ]);
    }
    out.push('\n');
    out.push_str(&table.render("  ", false));
}

fn longest_wait(report: &Report, task: &Task) -> String {
    task.waits.greatest().map_or("-".to_owned(), |(ticks, _)| report.time.show(ticks))
}

fn channels(out: &mut String, report: &Report) {
    let buffers = report.buffers.iter().map(|b| (format!("{} > {}", b.from, b.to), b.swapped, &b.counters));
    let queues = report.queues.iter().map(|q| (format!("{} > {}", q.from, q.to), None, &q.counters));
    let all: Vec<_> = buffers.chain(queues).collect();
    if all.is_empty() {
        out.push('\n');
        return;
    }
    let mut labels: Vec<&str> = Vec::new();
    for (label, _) in all.iter().flat_map(|(_, _, counters)| counters.iter()) {
        if !labels.contains(&label.as_str()) {
            labels.push(label);
        }
    }
    let mut table = Table::new(&[&["channel", "swaps"], labels.as_slice()].concat());
    for (name, swapped, counters) in all {
        let mut row = vec![name, optional(swapped)];
        row.extend(labels.iter().map(|label| {
            let found = counters.iter().find(|(known, _)| known == label).and_then(|(_, n)| *n);
            optional(found.map(|n| n.max(0) as u64))
        }));
        table.row(row);
    }
    out.push('\n');
    out.push_str(&table.render("  ", false));
    out.push('\n');
}

fn series_line(report: &Report, series: &Series) -> String {
    let Some((most, at)) = series.values.greatest() else { return "never defined".to_owned() };
    let mut line = format!(
        "mean {}, most {} (at {})",
        series.show_mean(report.time),
        series.show(report.time, most),
        report.time.show(at)
    );
    if let Some(bound) = series.bound {
        put!(line, ", bound {}", series.show(report.time, bound));
    }
    line
}

fn flow_line(report: &Report) -> String {
    let Some(flow) = &report.flow else { return String::new() };
    let (first, last) = (&flow.hops[0], &flow.hops[flow.hops.len() - 1]);
    let mut line = format!(
        "{} {}, {} {} by {}",
        count(flow.reached[0]),
        first.1,
        count(flow.reached[flow.reached.len() - 1]),
        last.1,
        last.0
    );
    if let Some((most, _)) = flow.whole.greatest() {
        put!(line, ", mean {}, longest {}", report.time.mean(flow.whole.mean()), report.time.show(most));
    }
    line
}

fn verdicts(lines: &mut Table, report: &Report) {
    if !report.invariants.is_empty() {
        let held = report.invariants.iter().filter(|invariant| invariant.violated.is_none()).count();
        lines.row(vec!["Invariants".to_owned(), format!("{held} of {} held in every state", report.invariants.len())]);
    }
    if !report.scenarios.is_empty() {
        let text = format!("{} of {} ended as they should", report.passed(), report.scenarios.len());
        lines.row(vec!["Scenarios".to_owned(), text]);
    }
    if let Some(coverage) = &report.coverage {
        let measures: Vec<String> = coverage
            .measures
            .iter()
            .filter(|m| m.total > 0)
            .map(|m| format!("{} {:.1} % ({} of {})", m.what, m.percent(), count(m.covered), count(m.total)))
            .collect();
        lines.row(vec!["Coverage".to_owned(), measures.join(", ")]);
    }
}

fn verdict(out: &mut String, report: &Report, options: &SummaryOptions) {
    let paint = |code: &str, text: &str| {
        if options.colour { format!("\u{1b}[{code}m{text}\u{1b}[0m") } else { text.to_owned() }
    };
    let troubles = report.troubles();
    out.push('\n');
    if troubles.is_empty() && !report.is_checked() {
        put!(out, "{} {UNCHECKED}\n", paint("33", "?"));
    } else if troubles.is_empty() {
        put!(out, "{} Everything that was checked held.\n", paint("32", "\u{2713}"));
    }
    for trouble in troubles {
        put!(out, "{} {trouble}\n", paint("91", "\u{2717}"));
    }
}
