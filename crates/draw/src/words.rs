//! The description of a picture, for those who cannot see it: its transitions in sentences.

use std::fmt::Write;

use chart::system::{Channel, ChannelKind, Component, Phase, System, Timing};
use chart::{Chart, Machine, Origin, Target, transitions};

/// LIMIT: a description tells so many transitions.
const TOLD: usize = 60;

/// A sentence for each transition.
pub fn of_machine(chart: &Chart, machine: &Machine) -> String {
    let kind = if machine.is_pattern { "Pattern machine" } else { "Control-state machine" };
    let mut out = format!("{kind} {}.", machine.name);
    let machine = machine.flat();
    let text = |id| machine.shape(id).text.replace('\n', " ");
    let all = transitions(chart, machine);
    for transition in all.iter().take(TOLD) {
        let _ = match transition.origin {
            Origin::Enter => write!(out, " On entering"),
            Origin::State(id) => write!(out, " From {}", text(id)),
            Origin::Left(id) => write!(out, " When {} has been left", text(id)),
        };
        let guards: Vec<String> = transition
            .guards
            .iter()
            .map(|(id, holds)| format!("{} is {}", text(*id), if *holds { "true" } else { "false" }))
            .collect();
        if !guards.is_empty() {
            let _ = write!(out, ", if {}", guards.join(" and "));
        }
        let actions: Vec<String> = transition.actions.iter().map(|id| text(*id)).collect();
        if !actions.is_empty() {
            let _ = write!(out, ": {};", actions.join(", "));
        }
        let _ = match transition.target {
            Target::State(id) | Target::Block(id) => write!(out, " go to {}.", text(id)),
            Target::Exit => write!(out, " leave."),
        };
    }
    if all.len() > TOLD {
        let _ = write!(out, " And {} more transitions.", all.len() - TOLD);
    }
    out
}

/// A length of time with its unit: milliseconds, or seconds from one on.
pub fn time(ticks: u64, tick_ns: u64) -> String {
    let nanoseconds = ticks * tick_ns;
    let (value, unit) = match nanoseconds {
        0..1_000 => (nanoseconds as f64, "ns"),
        1_000..100_000 => (nanoseconds as f64 / 1e3, "\u{b5}s"),
        100_000..1_000_000_000 => (nanoseconds as f64 / 1e6, "ms"),
        _ => (nanoseconds as f64 / 1e9, "s"),
    };
    format!("{value} {unit}")
}

/// How long a phase takes.
pub fn duration(phase: &Phase, tick_ns: u64) -> String {
    let most = time(phase.time, tick_ns);
    if phase.least == phase.time {
        return most;
    }
    let least = time(phase.least, tick_ns);
    // A unit that both have is written once.
    match (least.split_once(' '), most.split_once(' ')) {
        (Some((number, one)), Some((_, other))) if one == other => format!("{number}\u{2013}{most}"),
        _ => format!("{least} \u{2013} {most}"),
    }
}

/// When a component runs, and what of its deadlines it may miss.
pub fn timing(component: &Component, system: &System) -> String {
    let mut text = runs(&component.timing, system);
    if let Some(one) = component.tolerance {
        let _ = write!(text, ", misses {} of {}", one.missed, one.cycles);
    }
    text
}

fn runs(timing: &Timing, system: &System) -> String {
    let tick_ns = system.tick_ns;
    match timing {
        &Timing::Synchronous { period, jitter, offset, deadline } => {
            let mut text = format!("synchronous, {}", time(period, tick_ns));
            if jitter > 0 {
                let _ = write!(text, ", jitter {}", time(jitter, tick_ns));
            }
            if offset > 0 {
                let _ = write!(text, ", offset {}", time(offset, tick_ns));
            }
            if deadline != period {
                let _ = write!(text, ", deadline {}", time(deadline, tick_ns));
            }
            text
        }
        Timing::Asynchronous { awaits } => {
            let said = awaits.said(|channel| &system.channels[channel].drawn);
            format!("asynchronous, {}", said.as_deref().unwrap_or("again and again"))
        }
    }
}

/// What a channel is made of.
pub fn channel(kind: ChannelKind) -> String {
    match kind {
        ChannelKind::Buffer { arrays, .. } => format!("swinging buffer, {arrays} arrays"),
        ChannelKind::Queue { capacity } => format!("message queue of {capacity}"),
        ChannelKind::Shared => "shared value".to_string(),
    }
}

/// Who updates the indexes of a channel that is drawn as one: nobody, one for all its readers, or one for each.
pub fn masters(system: &System, drawn: &[Channel]) -> Vec<String> {
    let text = |component: usize| &system.components[component].text;
    let masters: Vec<(usize, usize)> = drawn
        .iter()
        .filter_map(|channel| match channel.kind {
            ChannelKind::Buffer { master, .. } => Some((master, channel.to)),
            ChannelKind::Queue { .. } | ChannelKind::Shared => None,
        })
        .collect();
    match masters.first() {
        None => Vec::new(),
        Some((first, _)) if masters.iter().all(|(master, _)| master == first) => {
            vec![format!("master: {}", text(*first))]
        }
        Some(_) => masters.iter().map(|(master, to)| format!("master for {}: {}", text(*to), text(*master))).collect(),
    }
}

/// A sentence for each component and channel.
pub fn of_system(system: &System) -> String {
    let mut out = format!("System {}.", system.name);
    for component in &system.components {
        let _ = write!(out, " {}: {}.", component.text, timing(component, system));
    }
    for one in &system.channels {
        let (from, to) = (&system.components[one.from].text, &system.components[one.to].text);
        let _ = write!(out, " From {from} to {to}: {}", channel(one.kind));
        if let ChannelKind::Buffer { master, .. } = one.kind {
            let _ = write!(out, ", master {}", system.components[master].text);
        }
        out.push('.');
    }
    out
}
