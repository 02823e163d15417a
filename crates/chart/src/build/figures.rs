//! What a ground model counts of the bounds of its chart: for those who draw its runs.
//!
//! In: a system without errors. Out: for each age, each time until something new comes, and each task that may be late, the terms of what
//! was seen so far and of what is allowed. The elements have the names that the ground model gives them.

use crate::system::{Named, System, length};

use super::ages::Ages;
use super::observed::{reading, readings, weakly_hard};

/// A figure that has a bound.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// What it is, in words.
    pub name: String,
    /// What is bounded, and by how much.
    pub caption: String,
    /// The greatest value so far, as a term of the ground model.
    pub value: String,
    /// The greatest value that is allowed, as a term.
    pub bound: String,
    /// It is a number of ticks.
    pub ticks: bool,
}

/// The figures of a system's bounds.
pub fn figures(system: &System) -> Vec<Figure> {
    let shown = |ticks: u64| length(ticks as i64, system.tick_ns);
    let of_end = |named: &Named| named.text.replace('_', " ");
    let ages = Ages::of(system);
    let of_way = |(name, bound): (&str, usize)| {
        let stated = &system.bounds[bound];
        let number = name.rsplit_once("_way").map_or("1", |(_, number)| number);
        let which = match ages.ways().filter(|(_, other)| *other == bound).count() {
            1 => String::new(),
            _ => format!(", way {number}"),
        };
        Figure {
            name: format!("age from {} to {}{which}", of_end(&stated.from), of_end(&stated.to)),
            caption: format!("the greatest so far; within {}", shown(stated.limit)),
            value: format!("way_oldest({name})"),
            bound: format!("way_limit({name})"),
            ticks: true,
        }
    };
    let of_reading = |(phase, bound): (&crate::system::Phase, &crate::system::FreshBound)| Figure {
        name: format!("new data in {}", phase.name.replace('_', " ")),
        caption: format!("the longest time so far; every {} fresh", shown(bound.limit)),
        value: format!("reading_longest({})", reading(phase)),
        bound: format!("reading_limit({})", reading(phase)),
        ticks: true,
    };
    let of_task = |(component, tolerance): (&crate::system::Component, &crate::system::Tolerance)| Figure {
        name: format!("late cycles of {}", component.name.replace('_', " ")),
        caption: format!("the most so far; {} of {} may be", tolerance.missed, tolerance.cycles),
        value: format!("task_mostMissed({}_task)", component.name),
        bound: format!("task_mayMiss({}_task)", component.name),
        ticks: false,
    };
    let ways = ages.ways().map(of_way);
    ways.chain(readings(system).map(of_reading)).chain(weakly_hard(system).map(of_task)).collect()
}
