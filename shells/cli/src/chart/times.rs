//! `groundstate chart times FILE`: what can be told of a system's times before anything runs.
//!
//! In: a chart with a system. Out: a line for each task and for each bound. Exit code: 1 if a task misses its deadline for certain or
//! the processors cannot do the work, 3 if the analysis does not show that all deadlines and bounds hold.

use std::io::Write;
use std::path::PathBuf;

use ::chart::system::System;
use ::chart::system::{Timing, Tolerance, length};
use ::chart::times::{Order, Platform, TaskTimes, Times, Verdict, bounded, times, told};
use clap::{Args, ValueEnum};
use wire::TimesTold;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;

/// Arguments of `chart times`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A chart with a system
    file: PathBuf,
    /// How many processors the tasks share. Default: as the chart says, or else one
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    processors: Option<u64>,
    /// Which synchronous tasks are more urgent
    #[arg(long, value_enum, default_value_t = Priorities::Rate)]
    priorities: Priorities,
}

/// The order of urgency.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Priorities {
    /// Those with shorter periods, as in the generated program
    Rate,
    /// Those with shorter deadlines
    Deadline,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let (sources, chart) = match super::read(shell, &arguments.file)? {
        Ok(read) => read,
        Err(exit) => return Ok(exit),
    };
    let Some(system) = &chart.system else {
        return Err(Failure::usage_with_help("the chart has no system", "only the components of a system take time"));
    };
    let stated = Platform::of(system);
    let platform = Platform {
        processors: arguments.processors.unwrap_or(stated.processors),
        order: match arguments.priorities {
            Priorities::Rate => Order::Rate,
            Priorities::Deadline => Order::Deadline,
        },
    };
    let times = times(system, platform);
    // What the chart itself states was told when it was read.
    if system.processors.is_none() || stated != platform {
        let place = system.processors.map_or(system.span, |(_, place)| place);
        shell.diagnostics(&sources, &told(system, &times, place))?;
    }
    if shell.json() {
        shell.object(&TimesTold::of(system, &times))?;
    } else if shell.talks() {
        shell.out().write_all(table(system, &times).as_bytes())?;
    }
    Ok(exit(system, &times))
}

fn exit(system: &System, times: &Times) -> Exit {
    let tasks = || system.components.iter().zip(&times.tasks);
    let keeps: Vec<Option<bool>> = tasks().map(|(one, task)| task.keeps(one.tolerance.as_ref())).collect();
    let misses = keeps.contains(&Some(false));
    let ages = system.bounds.iter().zip(&times.ages);
    let ages_hold = ages.into_iter().all(|(bound, age)| age.most.is_some_and(|most| most <= bound.limit));
    let fresh = bounded(system).zip(&times.fresh);
    let fresh_holds = fresh.into_iter().all(|((_, bound), one)| one.most.is_some_and(|most| most <= bound.limit));
    match (misses || times.overloaded, keeps.contains(&None) || !ages_hold || !fresh_holds) {
        (true, _) => Exit::Model,
        (false, true) => Exit::Unknown,
        (false, false) => Exit::Good,
    }
}

fn processors(platform: Platform) -> String {
    let word = if platform.processors == 1 { "processor" } else { "processors" };
    let order = match platform.order {
        Order::Rate => "shorter periods first",
        Order::Deadline => "shorter deadlines first",
    };
    format!("{} {word}, {order}", platform.processors)
}

/// What follows for the deadline of a task.
fn verdict(task: &TaskTimes, tolerance: Option<&Tolerance>) -> String {
    let late = match task.verdict {
        Verdict::Meets => return "meets".to_string(),
        Verdict::None => return String::new(),
        Verdict::Misses => "misses",
        Verdict::Open(_) => "not shown",
    };
    match (task.keeps(tolerance), tolerance) {
        (Some(true), Some(one)) => format!("misses at most {} of {}", one.missed, one.cycles),
        _ => late.to_string(),
    }
}

/// The table for people.
fn table(system: &System, times: &Times) -> String {
    let shown = |ticks: u64| length(ticks as i64, system.tick_ns);
    let or_dash = |ticks: Option<u64>| ticks.map_or("-".to_string(), shown);
    let head = ["task", "priority", "period", "execution", "load", "blocking", "response", "deadline", ""];
    let mut rows = vec![head.map(str::to_string).to_vec()];
    for (component, task) in system.components.iter().zip(&times.tasks) {
        let (least, most) = task.execution;
        let deadline = match component.timing {
            Timing::Synchronous { deadline, .. } => Some(deadline),
            Timing::Asynchronous { .. } => None,
        };
        rows.push(vec![
            component.name.clone(),
            task.priority.to_string(),
            match (component.timing.period(), task.interval) {
                (Some(period), _) => match component.timing.jitter() {
                    0 => shown(period),
                    jitter => format!("{}, jitter {}", shown(period), shown(jitter)),
                },
                (None, Some(interval)) => format!("after data, {}", shown(interval)),
                (None, None) => "any time".to_string(),
            },
            if least == most { shown(most) } else { format!("{}..{}", shown(least), shown(most)) },
            task.load.map_or("-".to_string(), |load| format!("{:.1} %", load * 100.0)),
            or_dash(task.blocking),
            or_dash(task.response),
            or_dash(deadline),
            verdict(task, component.tolerance.as_ref()),
        ]);
    }
    let mut out = format!("{}\n", processors(times.platform));
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..head.len()).map(width).collect();
    for row in &rows {
        let cells: Vec<String> = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:width$}")).collect();
        out += cells.join("  ").trim_end();
        out.push('\n');
    }
    out += &format!("load: {:.2} processors\n", times.load);
    for (component, task) in system.components.iter().zip(&times.tasks) {
        let Some((tolerance, missed)) = component.tolerance.zip(task.missed.as_ref()) else { continue };
        let (allowed, of) = (tolerance.missed, tolerance.cycles);
        let line = match (missed.most, &missed.reason) {
            (Some(most), _) if most <= allowed => format!("at most {most}: within {allowed} of {of}"),
            (Some(most), _) if missed.certain => format!("{most} in some run, more than {allowed} of {of}"),
            (Some(most), _) => format!("not shown within {allowed} of {of}: at most {most}"),
            (None, reason) => format!("not shown within {allowed} of {of}: {}", reason.as_deref().unwrap_or_default()),
        };
        out += &format!("deadlines missed by {}: {line}\n", component.name);
    }
    for ((phase, bound), one) in bounded(system).zip(&times.fresh) {
        let limit = shown(bound.limit);
        let line = match (one.most, &one.reason) {
            (Some(most), _) if most <= bound.limit => format!("every {}: within {limit}", shown(most)),
            (Some(most), _) => format!("not shown within {limit}: at most {}", shown(most)),
            (None, reason) => format!("not shown within {limit}: {}", reason.as_deref().unwrap_or_default()),
        };
        out += &format!("something new for {}: {line}\n", phase.name);
    }
    for (bound, age) in system.bounds.iter().zip(&times.ages) {
        let (from, to) = (&bound.from.text, &bound.to.text);
        let limit = shown(bound.limit);
        let line = match age.most {
            Some(most) if most <= bound.limit => format!("at most {}: within {limit}", shown(most)),
            Some(most) => format!("not shown within {limit}: at most {}", shown(most)),
            None => {
                let reason = age.ways.iter().find_map(|way| way.reason.as_deref()).unwrap_or_default();
                format!("not shown within {limit}: {reason}")
            }
        };
        out += &format!("age from {from} to {to}: {line}\n");
    }
    out
}
