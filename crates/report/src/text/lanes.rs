//! Lanes of blocks: one column of text for a few ticks.

use super::SummaryOptions;
use crate::markup::put;
use crate::report::{Buffer, Report, Task};
use crate::tone::Tone;
use crate::track::Track;

const BLOCKS: [char; 9] =
    ['\u{b7}', '\u{2581}', '\u{2582}', '\u{2583}', '\u{2584}', '\u{2585}', '\u{2586}', '\u{2587}', '\u{2588}'];
const WAITED: char = '\u{d7}';

/// Columns of time.
struct Scale {
    start: u64,
    /// Ticks a column.
    per: u64,
    columns: usize,
    names: usize,
}

/// Writes the lanes of the first view.
pub(super) fn lanes(out: &mut String, report: &Report, options: &SummaryOptions) {
    let channel = |from: &str, to: &str| format!("{from} > {to}");
    let names = report.tasks.iter().map(|task| task.name.clone());
    let names: Vec<String> =
        names.chain(report.buffers.iter().map(|buffer| channel(&buffer.from, &buffer.to))).collect();
    if names.is_empty() {
        return;
    }
    let widest = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let room = options.width.saturating_sub(widest + 4).clamp(10, 120) as u64;
    let window = report.window.min(report.shown).max(1);
    let per = round(window / room);
    let scale = Scale { start: 0, per, columns: (window / per).clamp(1, room) as usize, names: widest };
    out.push('\n');
    axis(out, report, &scale);
    for (index, name) in names.iter().enumerate() {
        put!(out, "  {name:<widest$}  ");
        match report.tasks.get(index) {
            Some(task) => task_lane(out, task, &scale, options.colour),
            None => buffer_lane(out, &report.buffers[index - report.tasks.len()], &scale),
        }
        out.push('\n');
    }
    let width = if options.colour { key(report) } else { "height: how busy".to_owned() };
    put!(out, "  {:widest$}  {width}, {WAITED} waited", "");
    if !report.buffers.is_empty() {
        out.push_str("; digits: the array on the reader's side");
    }
    out.push('\n');
}

/// The next of 1, 2, 5, 10, … so columns begin at round times; the lanes then end where the line does.
fn round(least: u64) -> u64 {
    let powers = (0..18).map(|power| 10u64.pow(power));
    powers.flat_map(|power| [1, 2, 5].map(|factor| factor * power)).find(|per| *per >= least).unwrap_or(least.max(1))
}

/// A mark every ten columns, a column being so long.
fn axis(out: &mut String, report: &Report, scale: &Scale) {
    let mut line: Vec<char> = Vec::new();
    for column in (0..scale.columns).step_by(10) {
        line.resize(line.len().max(column), ' ');
        if line.len() == column {
            let tick = scale.start + column as u64 * scale.per;
            let label = report.time.short(tick);
            let label = if column == 0 { label } else { label.split('\u{202f}').next().unwrap_or("").to_owned() };
            line.extend(label.chars().chain([' ']));
        }
    }
    let line: String = line.into_iter().collect();
    put!(out, "  {:width$}  {}\n", "", line.trim_end(), width = scale.names);
}

/// Ticks of each tone in a window.
fn times(track: &Track, start: u64, end: u64) -> [u64; Tone::ALL.len()] {
    let mut times = [0; Tone::ALL.len()];
    for span in track.within(start, end) {
        let place = Tone::ALL.iter().position(|tone| *tone == track.kind(*span).tone).unwrap_or(0);
        times[place] += span.end.min(end) - span.start.max(start);
    }
    times
}

fn task_lane(out: &mut String, task: &Task, scale: &Scale, colour: bool) {
    for column in 0..scale.columns as u64 {
        let start = scale.start + column * scale.per;
        let mut times = times(&task.track, start, start + scale.per);
        times[0] = 0;
        let busy: u64 = times.iter().sum();
        let waited = Tone::ALL.iter().zip(times).any(|(tone, ticks)| *tone == Tone::Wait && ticks > 0);
        let most = (0..times.len()).max_by_key(|place| times[*place]).unwrap_or(0);
        let tone = if waited { Tone::Wait } else { Tone::ALL[most] };
        let block = if waited { WAITED } else { BLOCKS[(busy * 8).div_ceil(scale.per).min(8) as usize] };
        match (colour, busy) {
            (true, 1..) => put!(out, "\u{1b}[{}m{block}\u{1b}[0m", code(tone)),
            (true, 0) => put!(out, "\u{1b}[2m{block}\u{1b}[0m"),
            _ => out.push(block),
        }
    }
}

fn buffer_lane(out: &mut String, buffer: &Buffer, scale: &Scale) {
    for column in 0..scale.columns as u64 {
        let start = scale.start + column * scale.per;
        let of_reader = |track: &Track| {
            let times = times(track, start, start + scale.per);
            Tone::ALL
                .iter()
                .zip(times)
                .filter(|(tone, _)| matches!(tone, Tone::Read | Tone::ReadPlace))
                .map(|(_, n)| n)
                .sum::<u64>()
        };
        let row = buffer
            .rows
            .iter()
            .map(of_reader)
            .enumerate()
            .filter(|(_, ticks)| *ticks > 0)
            .max_by_key(|(_, ticks)| *ticks);
        out.push(row.and_then(|(row, _)| char::from_digit(row as u32, 36)).unwrap_or('\u{b7}'));
    }
}

fn code(tone: Tone) -> &'static str {
    match tone {
        Tone::Work => "34",
        Tone::Read | Tone::ReadPlace => "32",
        Tone::Write | Tone::WritePlace => "36",
        Tone::Hold => "33",
        Tone::Wait => "91",
        Tone::Message => "35",
        Tone::Idle | Tone::Other | Tone::Undef => "37",
    }
}

fn key(report: &Report) -> String {
    let seen = report.activities.iter().filter(|kind| !matches!(kind.tone, Tone::Idle | Tone::Wait | Tone::Undef));
    let keys: Vec<String> =
        seen.map(|kind| format!("\u{1b}[{}m\u{2588}\u{1b}[0m {}", code(kind.tone), kind.label)).collect();
    keys.join(", ")
}
