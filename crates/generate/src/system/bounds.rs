//! Generates what the plan says of the times that a chart bounds: what the program counts as outside.
//!
//! In: a system without errors. Out: the parts `.bounds` and `.ways` of the plan; nothing if the chart bounds nothing. What is counted is
//! in cpp/include/groundstate/bounds.hpp.
//! SYNC(bounds): crates/conform/src/bounds.rs reads the words in which a bound is stated.

use std::fmt::Write;

use chart::system::{Action, Component, Phase, System, length};
use chart::ways::followed;

use super::plan::numbers;

/// Both parts.
pub(super) fn bounds(system: &System) -> String {
    let mut text = String::new();
    let counted: Vec<String> = (0..system.components.len()).flat_map(|index| of_task(system, index)).collect();
    if !counted.is_empty() {
        let _ = writeln!(text, "        .bounds = {{\n            {},\n        }},", counted.join(",\n            "));
    }
    let ways = ways(system);
    if !ways.is_empty() {
        let _ = writeln!(text, "        .ways = {{\n            {},\n        }},", ways.join(",\n            "));
    }
    text
}

fn of_task(system: &System, index: usize) -> Vec<String> {
    let component = &system.components[index];
    let shown = |ticks: u64| length(ticks as i64, system.tick_ns);
    let mut all = Vec::new();
    let jitter = component.timing.jitter();
    if jitter > 0 {
        all.push(bound("release", &format!("releases of {}", component.name), &shown(jitter), index, &most(jitter)));
    }
    for (at, phase) in component.phases.iter().enumerate() {
        let number = numbers(system).phases[index] + at;
        if phase.least < phase.time {
            let limit = interval(&shown(phase.least), &shown(phase.time));
            let lengths = format!(".phase = {number}, .least = {}, .most = {}", phase.least, phase.time);
            all.push(bound("elaboration", &spoken(component, phase), &limit, index, &lengths));
        }
        if let (Action::Read(channel), Some(fresh)) = (&phase.action, &phase.fresh) {
            let what = format!("new {} for {}", system.channels[*channel].drawn, component.name);
            let limit = format!("every {}", shown(fresh.limit));
            let lengths = format!(".phase = {number}, {}", most(fresh.limit));
            all.push(bound("reading", &what, &limit, index, &lengths));
        }
    }
    if let Some(one) = component.tolerance {
        let numbers = format!("{}, .cycles = {}", most(one.missed), one.cycles);
        let limit = format!("{} of {}", one.missed, one.cycles);
        all.push(bound("misses", &format!("deadlines missed by {}", component.name), &limit, index, &numbers));
    }
    all
}

/// Two lengths; a unit that both have is written once.
fn interval(least: &str, most: &str) -> String {
    match (least.split_once(' '), most.split_once(' ')) {
        (Some((number, one)), Some((_, other))) if one == other => format!("{number}..{most}"),
        _ => format!("{least}..{most}"),
    }
}

fn spoken(component: &Component, phase: &Phase) -> String {
    format!("{} of {}", phase.subject, component.name)
}

fn most(ticks: u64) -> String {
    format!(".most = {ticks}")
}

fn bound(kind: &str, what: &str, limit: &str, task: usize, numbers: &str) -> String {
    format!(
        "{{.kind = groundstate::Bounded::{kind}, .what = \"{what}\", .limit = \"{limit}\", .task = {task}, {numbers}}}"
    )
}

fn ways(system: &System) -> Vec<String> {
    let numbers = numbers(system);
    let decided = |component: usize, at: Option<usize>| {
        at.map_or("-1".to_string(), |at| (numbers.phases[component] + at).to_string())
    };
    let mut all = Vec::new();
    for stated in &system.bounds {
        let ways = followed(system, stated);
        let several = ways.len() > 1;
        for way in ways {
            let over = way.hops.iter().map(|(channel, _)| system.channels[*channel].name.as_str());
            let over = match several {
                true => format!(" over {}", over.collect::<Vec<_>>().join(", ")),
                false => String::new(),
            };
            let what = format!("age from {} to {}{over}", stated.from.text, stated.to.text);
            let limit = format!("within {}", length(stated.limit as i64, system.tick_ns));
            let hops = way.hops.iter().map(|(channel, at)| {
                let (from, to) = (system.channels[*channel].from, system.channels[*channel].to);
                format!(
                    "{{.channel = {}, .writer = {from}, .reader = {to}, .decided = {}}}",
                    numbers.channels + channel,
                    decided(from, *at)
                )
            });
            all.push(format!(
                "{{.bound = {}, .first = {}, .hops = {{{}}}, .decided = {}}}",
                bound("age", &what, &limit, way.end, &most(stated.limit)),
                way.first,
                hops.collect::<Vec<_>>().join(", "),
                decided(way.end, way.decided)
            ));
        }
    }
    all
}
