//! Whether the head of a recording speaks of the tasks that the model has.
//!
//! In: what a recording says of its tasks before their first event, and the model's initial state. Out: the first thing that the two
//! say otherwise. A program whose periods are others may well record events that the model could have, for a while: its
//! verdict would be one about another system. What a recording leaves out is not held against it here.

use machine::{Machine, Value};
use recording::{Recording, Rhythm, Track};

use crate::vocabulary::{Component, Named, Vocabulary};

/// How the recording contradicts the model, as a sentence.
pub fn contradiction(head: &Recording, machine: &Machine, vocabulary: &Vocabulary) -> Option<String> {
    head.tracks.iter().find_map(|track| {
        // That the tasks are the model's own is asked where they are paired.
        let component = &vocabulary.components[vocabulary.component_named(&track.task)?];
        timing(head.tick_ns, track, component, machine, vocabulary)
            .or_else(|| awaited(track, component, machine, vocabulary))
    })
}

/// Period, offset and deadline.
fn timing(
    tick_ns: i64,
    track: &Track,
    component: &Component,
    machine: &Machine,
    vocabulary: &Vocabulary,
) -> Option<String> {
    let Rhythm { period_ns, offset_ns, deadline_ns } = track.rhythm?;
    let ticks = |named: Named| match vocabulary.get(machine, named, std::slice::from_ref(&component.task)) {
        Value::Integer(ticks) => Some(ticks),
        _ => None,
    };
    let Some(period) = ticks(Named::Period) else {
        return Some(format!("{} has a period in the recording, and none in the model", track.task));
    };
    // Before its first cycle a task is in the last one that it does not have.
    let offset = ticks(Named::PeriodStart).map(|start| start.saturating_add(period));
    let deadline = ticks(Named::Deadline).unwrap_or(period);
    let in_ns = |ticks: i64| ticks.saturating_mul(tick_ns);
    let pairs = [
        ("period", period_ns, in_ns(period)),
        ("offset", offset_ns, in_ns(offset.unwrap_or(0))),
        ("deadline", deadline_ns, in_ns(deadline)),
    ];
    let (what, recorded, modelled) = pairs.into_iter().find(|(_, recorded, modelled)| recorded != modelled)?;
    let ms = |ns: i64| ns as f64 / 1e6;
    Some(format!(
        "the {what} of {} is {} ms in the recording, {} ms in the model",
        track.task,
        ms(recorded),
        ms(modelled)
    ))
}

/// The channel whose data wake the task.
fn awaited(track: &Track, component: &Component, machine: &Machine, vocabulary: &Vocabulary) -> Option<String> {
    let recorded = track.awaits.as_deref()?;
    match vocabulary.wakes(machine, component) {
        Some((_, channel)) if *channel == *recorded => None,
        Some((_, channel)) => {
            Some(format!("{} awaits {recorded} in the recording, {channel} in the model", track.task))
        }
        None => Some(format!("{} awaits {recorded} in the recording, nothing in the model", track.task)),
    }
}
