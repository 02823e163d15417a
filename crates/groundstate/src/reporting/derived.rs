//! The report specification of a model: the one beside it, or one derived from the chart beside it, or from the model itself.
//!
//! In: the model's path and program, and the files beside it. Out: the text of a specification. One that is derived from a system
//! is like one written by hand: a lane for each component and channel, the deadlines, the picture of the system.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use chart::Chart;
use chart::build::{Figure, figures};
use chart::system::{Channel, ChannelKind, Component, System, Timing};
use model::Loader;
use program::Program;
use syntax::SourceFile;

use crate::has_errors;
use crate::reporting::of_model::{model_specification, quoted};
use crate::workspace::{Absent, Files};

/// The specification `MODEL.report.yaml` beside a model, or what `MODEL.chart` or the model itself says.
///
/// # Errors
/// There is a specification or a chart, and it cannot be read: its path, and why.
pub fn specification_beside<F: Files + Loader>(
    model: &str,
    program: &Arc<Program>,
    files: &mut F,
) -> Result<SourceFile, (String, Absent)> {
    if let Some(written) = beside(model, "report.yaml", files)? {
        return Ok(written);
    }
    let path = path_beside(model, "chart");
    let file = Path::new(&path).file_name().unwrap_or_default().to_string_lossy().into_owned();
    let chart = chart_beside(model, files)?;
    let of_system = chart.as_ref().and_then(|chart| specification(chart, &file));
    Ok(match of_system {
        Some(text) => SourceFile::new(format!("<what {path} says>"), text),
        None => {
            let text = model_specification(program, chart.as_ref().map(|chart| (chart, file.as_str())));
            SourceFile::new(format!("<what {model} says>"), text)
        }
    })
}

/// The system that `MODEL.chart` beside a model draws; none if there is no chart, or one with errors.
///
/// # Errors
/// There is a chart, and it cannot be read: its path, and why.
pub fn system_beside<F: Files + Loader>(model: &str, files: &mut F) -> Result<Option<System>, (String, Absent)> {
    Ok(chart_beside(model, files)?.and_then(|chart| chart.system))
}

fn chart_beside<F: Files + Loader>(model: &str, files: &mut F) -> Result<Option<Chart>, (String, Absent)> {
    let loaded = beside(model, "chart", files)?.map(|source| chart::load(source, files));
    Ok(loaded.filter(|loaded| !has_errors(&loaded.diagnostics)).map(|loaded| loaded.chart))
}

fn path_beside(model: &str, extension: &str) -> String {
    Path::new(model).with_extension(extension).to_string_lossy().into_owned()
}

/// The file with this extension beside a model, if it is there.
fn beside(model: &str, extension: &str, files: &mut impl Files) -> Result<Option<SourceFile>, (String, Absent)> {
    let path = path_beside(model, extension);
    match files.read(&path) {
        Ok(source) => Ok(Some(source)),
        Err(Absent::Missing) => Ok(None),
        Err(absent) => Err((path, absent)),
    }
}

fn specification(chart: &Chart, file: &str) -> Option<String> {
    let system = chart.system.as_ref()?;
    let mut out = String::new();
    let title = if system.text.is_empty() { &system.name } else { &system.text };
    let _ = writeln!(out, "title: {}", quoted(title));
    let _ = writeln!(out, "note: {}", quoted(&format!("The components and channels of {file}.")));
    let _ = writeln!(out, "tick: {} ns", system.tick_ns);
    let longest = system.components.iter().filter_map(|component| component.timing.period()).max().unwrap_or(0);
    let _ = writeln!(out, "window: {}", (2 * longest).max(400));
    out.push_str(ACTIVITIES);
    tasks(&mut out, system);
    buffers(&mut out, system);
    queues(&mut out, system);
    bounds(&mut out, system);
    let _ = writeln!(out, "charts: {{ {}: {{}} }}", quoted(file));
    Some(out)
}

const ACTIVITIES: &str = "\
activities:
  IDLE: [idle, idle]
  ELABORATION: [elaborating, work]
  READ_ACCESS: [reading, read]
  WRITE_ACCESS: [writing, write]
  LOCK_HELD: [holding the lock, hold]
  LOCK_WAIT: [waiting for the lock, wait]
  ROOM_WAIT: [waiting for room, wait]
  MESSAGE_ACCESS: [passing a message, message]
";

fn tasks(out: &mut String, system: &System) {
    out.push_str("tasks:\n  each:\n");
    for component in &system.components {
        let caption = match &component.timing {
            Timing::Synchronous { .. } => String::new(),
            Timing::Asynchronous { awaits } => match awaits.said(|channel| &system.channels[channel].name) {
                Some(said) => spoken(&said),
                None => "again and again".to_string(),
            },
        };
        let (id, name) = (&component.name, quoted(&name(component)));
        let _ = writeln!(out, "    {id}: {{ name: {name}, caption: {} }}", quoted(&caption));
    }
    out.push_str(
        "  terms:\n    activity: activity({})\n    period: task_period({}_task)\n    deadline: task_deadline({}_task)\n    \
         may_miss: mayBeLate({}_task)\n    release: task_periodStart({}_task)\n    \
         cycles: task_cycles({}_task)\n    met: task_deadlinesMet({}_task)\n    missed: task_deadlinesMissed({}_task)\n    \
         skipped: task_skipped({}_task)\n",
    );
}

/// Writes the channels of a kind as the entries of a group.
fn each(out: &mut String, system: &System, group: &str, of: impl Fn(&Channel) -> bool) -> bool {
    let channels: Vec<&Channel> = system.channels.iter().filter(|channel| of(channel)).collect();
    if channels.is_empty() {
        return false;
    }
    let _ = writeln!(out, "{group}:\n  each:");
    for channel in channels {
        let end = |index: usize| quoted(&name(&system.components[index]));
        let _ = writeln!(out, "    {}: {{ from: {}, to: {} }}", channel.name, end(channel.from), end(channel.to));
    }
    true
}

fn buffers(out: &mut String, system: &System) {
    if each(out, system, "buffers", |channel| matches!(channel.kind, ChannelKind::Buffer { .. })) {
        out.push_str(
            "  terms:\n    arrays: dimension({})\n    writing: sb_writingArray({})\n    reading: sb_readingArray({})\n    \
             write_index: indexWrite({})\n    read_index: indexRead({})\n    lock: sb_lockOwner({})\n    swaps: sb_swaps({})\n  \
             counters:\n    written: sb_written({})\n    delivered: sb_delivered({})\n    overwritten: sb_overwritten({})\n    \
             unread: sb_unread({})\n    dropped: sb_dropped({})\n",
        );
    }
}

/// Writes the queues, and the shared values as what holds one datum until it is read.
fn queues(out: &mut String, system: &System) {
    if each(out, system, "queues", |channel| matches!(channel.kind, ChannelKind::Queue { .. })) {
        out.push_str(
            "  terms:\n    length: mq_length({})\n    capacity: mq_capacity({})\n  counters:\n    written: mq_sent({})\n    \
             delivered: mq_taken({})\n    refused: mq_refused({})\n",
        );
    }
    if each(out, system, "values", |channel| channel.kind == ChannelKind::Shared) {
        out.push_str(
            "  terms:\n    unread: \"if sv_isNew({}) then 1 else 0 endif\"\n  counters:\n    written: sv_sequence({})\n    \
             overwritten: sv_overwritten({})\n",
        );
    }
}

/// Writes what is counted of the chart's bounds.
fn bounds(out: &mut String, system: &System) {
    let figures = figures(system);
    if figures.is_empty() {
        return;
    }
    out.push_str("series:\n");
    for Figure { name, caption, value, bound, ticks } in figures {
        let unit = if ticks { ", unit: ticks" } else { "" };
        let _ = writeln!(
            out,
            "  {}: {{ caption: {}, value: {value}, bound: {bound}{unit} }}",
            quoted(&name),
            quoted(&caption)
        );
    }
}

/// A component's name for people.
fn name(component: &Component) -> String {
    if component.text.is_empty() { spoken(&component.name) } else { component.text.clone() }
}

fn spoken(name: &str) -> String {
    name.replace('_', " ")
}
