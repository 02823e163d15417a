//! Whether the head of a recording speaks of the tasks that the model has.
//!
//! In: what a recording says of its tasks before their first event, and the model's initial state. Out: the first thing that the two
//! say otherwise. A program whose periods are others may well record events that the model could have, for a while: its
//! verdict would be one about another system. What a recording leaves out is not held against it; it is [`unsaid`].

use std::collections::BTreeSet;

use machine::{Machine, Value};
use recording::{Awaited, Recording, Rhythm, Track};

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

/// What the model says of tasks and the recording does not, each as a phrase.
pub fn unsaid(head: &Recording, machine: &Machine, vocabulary: &Vocabulary) -> Vec<String> {
    let of_track = |track: &Track| {
        let component = &vocabulary.components[vocabulary.component_named(&track.task)?];
        let period = vocabulary.get(machine, Named::Period, std::slice::from_ref(&component.task));
        let has_period = matches!(period, Value::Integer(_));
        let wakes = vocabulary.wakes(machine, component);
        match (track.rhythm, &track.awaits) {
            (None, _) if has_period => Some(format!("which period {} has", track.task)),
            (_, None) if wakes.is_some() => Some(format!("what {} awaits", track.task)),
            _ => None,
        }
    };
    head.tracks.iter().filter_map(of_track).collect()
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

/// The data that wake the task.
fn awaited(track: &Track, component: &Component, machine: &Machine, vocabulary: &Vocabulary) -> Option<String> {
    let recorded = track.awaits.as_ref()?;
    let modelled = vocabulary.wakes(machine, component).map(|wakes| Awaited {
        channels: wakes.channels.iter().map(|channel| channel.to_string()).collect(),
        all: wakes.all,
    });
    let names = |awaited: &Awaited| awaited.channels.iter().cloned().collect::<BTreeSet<String>>();
    let is_same = |modelled: &Awaited| {
        names(modelled) == names(recorded) && (recorded.channels.len() == 1 || modelled.all == recorded.all)
    };
    if modelled.as_ref().is_some_and(is_same) {
        return None;
    }
    let modelled = modelled.map_or("nothing".to_string(), |modelled| modelled.to_string());
    Some(format!("{} awaits {recorded} in the recording, {modelled} in the model", track.task))
}
