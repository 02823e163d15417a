//! The runs of a program in short: verdicts, and a table of its tasks.

use super::table::Table;
use crate::markup::put;
use crate::program::{LOSSY, Program, show_greatest};
use crate::svg::show_ns;
use crate::time::count;

/// How to summarise.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RunSummary {
    /// Colours by ANSI sequences.
    pub colour: bool,
}

/// The runs in short.
pub fn summarise_program(program: &Program, options: &RunSummary) -> String {
    let mut out = format!("{}\n", program.title);
    for run in &program.runs {
        put!(out, "\n{} in {}\n", run.span(), run.name);
        if let Some(held) = &run.verdict {
            line(&mut out, held.conforms, &held.words, options);
            held.beside.iter().for_each(|words| line(&mut out, None, words, options));
        }
        if run.lossy {
            line(&mut out, None, LOSSY, options);
        }
        if let Some(world) = &run.closed_loop {
            line(&mut out, world.reached, &world.end, options);
        }
        out.push('\n');
        let mut tasks = Table::new(&HEAD);
        for task in &run.tasks {
            let tally =
                |percent, tally: &crate::Tally| tally.percentile(percent).map_or_else(|| "-".to_owned(), show_ns);
            tasks.row(vec![
                task.name.clone(),
                task.period_ns.map_or_else(|| "-".to_owned(), show_ns),
                count(task.activations),
                task.missed.map_or_else(|| "-".to_owned(), count),
                count(task.skips),
                tally(99, &task.responses),
                tally(100, &task.responses),
                tally(99, &task.wake_ups),
                tally(100, &task.wake_ups),
            ]);
        }
        out.push_str(&tasks.render("  ", false));
        if run.bounds.is_empty() {
            continue;
        }
        out.push('\n');
        let mut bounds = Table::new(&BOUNDS);
        for bound in &run.bounds {
            bounds.row(vec![
                bound.what.clone(),
                bound.limit.clone(),
                count(bound.seen),
                count(bound.outside()),
                show_greatest(bound),
            ]);
        }
        out.push_str(&bounds.render("  ", false));
    }
    out.push('\n');
    out.replace('\u{202f}', " ")
}

/// The columns: for responses and wake-ups, what 99 of 100 do not exceed, and the worst.
const HEAD: [&str; 9] =
    ["task", "period", "activations", "missed", "skipped", "response p99", "worst", "wake-up p99", "worst"];

/// The columns of what the chart bounds: what was seen of it, and how often it was not kept.
const BOUNDS: [&str; 5] = ["bound", "limit", "seen", "outside", "most"];

fn line(out: &mut String, good: Option<bool>, words: &str, options: &RunSummary) {
    let (mark, colour) = match good {
        Some(true) => ('\u{2713}', "32"),
        Some(false) => ('\u{2717}', "31"),
        None => ('\u{b7}', "33"),
    };
    match options.colour {
        true => put!(out, "\u{1b}[{colour}m{mark}\u{1b}[0m {words}\n"),
        false => put!(out, "{mark} {words}\n"),
    }
}
