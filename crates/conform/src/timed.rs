//! Tick by tick: in virtual time that follows the model, each tick is a step of the main rule.
//!
//! In: the model, a recording whose pace is `modelled`. Every event must be one of the step of its tick, and every event
//! of a step must have been recorded at its tick. The events of one task in one step are compared as a set: the step has
//! no order within.

use std::sync::Arc;

use machine::{Closed, Limits, Machine};
use program::Program;

use crate::Verdict;
use crate::evidence::{Claim, Parted, Recorded, objects};
use crate::vocabulary::Vocabulary;
use recording::{Event, Recording};

/// The last so many events are shown where the two part.
const SHOWN: usize = 12;

/// Holds a recording against the model's own run.
///
/// # Errors
/// The model cannot be replayed, in words: it does not start, or is not made of the library's patterns.
pub fn check(program: &Arc<Program>, limits: Limits, recording: &Recording) -> Result<Verdict, String> {
    let mut machine = Machine::new(Arc::clone(program), limits);
    machine.start(&mut Closed).map_err(|fault| fault.show(program).to_string())?;
    let vocabulary = Vocabulary::new(program, &mut machine)?;
    let tracks = tracks(&vocabulary, recording)?;
    let tick_of = |event: &Event| event.time_ns / recording.tick_ns;
    let end = match (recording.known_until_ns(), recording.stopped_ns) {
        (Some(known), _) => known / recording.tick_ns,
        (None, Some(stopped)) => stopped / recording.tick_ns,
        (None, None) => 0,
    };
    let mut cursors = vec![0; vocabulary.components.len()];
    let mut agreed = 0;
    for tick in 0..end {
        if let Err(fault) = machine.step(&mut Closed) {
            let reason = format!("the model cannot make the step of tick {tick}: {}", fault.show(program));
            return Ok(Verdict::Unknown { events: agreed, reason });
        }
        let claims = vocabulary.claims(&machine, &machine.changes());
        for component in 0..vocabulary.components.len() {
            let events = tracks[component];
            let start = cursors[component];
            let count = events[start..].iter().take_while(|event| tick_of(event) == tick).count();
            let recorded = &events[start..start + count];
            if let Some(event) = recorded.iter().find(|event| ["passes", "faults"].contains(&event.kind.as_str())) {
                let task = &vocabulary.components[component].name;
                let reason = match event.kind.as_str() {
                    "passes" => format!("{task} had nothing to hand over in tick {tick}, which the model always has"),
                    _ => format!("{task} failed in tick {tick}"),
                };
                return Ok(Verdict::Unknown { events: agreed, reason });
            }
            let own: Vec<&Claim> = claims.iter().filter(|(of, _)| *of == component).map(|(_, claim)| claim).collect();
            if let Some((event, at)) = differs(recorded, &own) {
                cursors[component] += at;
                let mut claims: Vec<Claim> = own.into_iter().cloned().collect();
                if event.is_none() {
                    claims.retain(|claim| !recorded.iter().any(|event| event.same(&claim.event)));
                }
                let state = vocabulary.state(&machine, component, &objects(event.as_ref(), &claims));
                return Ok(Verdict::Parts(Box::new(Parted {
                    tick,
                    task: vocabulary.components[component].name.clone(),
                    event,
                    claims,
                    reason: None,
                    agreed,
                    before: before(&vocabulary, &tracks, recording, tick),
                    state,
                })));
            }
            agreed += count;
            cursors[component] += count;
        }
    }
    if !recording.is_whole() {
        let reason = format!("the recording has a gap, or ends early, after tick {end}");
        return Ok(Verdict::Unknown { events: agreed, reason });
    }
    Ok(Verdict::Conforms { events: agreed, steps: machine.steps() })
}

/// The first recorded event that is no claim, or none and its place behind all, if a claim is left over.
fn differs(recorded: &[Event], claims: &[&Claim]) -> Option<(Option<Event>, usize)> {
    let mut open: Vec<&&Claim> = claims.iter().collect();
    for (at, event) in recorded.iter().enumerate() {
        if event.kind == "invalid" {
            continue;
        }
        match open.iter().position(|claim| claim.event.same(event)) {
            Some(found) => _ = open.swap_remove(found),
            None => return Some((Some(event.clone()), at)),
        }
    }
    (!open.is_empty()).then_some((None, recorded.len()))
}

/// The tracks in the order of the components.
pub(crate) fn tracks<'r>(vocabulary: &Vocabulary, recording: &'r Recording) -> Result<Vec<&'r [Event]>, String> {
    if let Some(channel) = recording.wait_free.first() {
        return Err(format!("the channel {channel} was generated wait-free, and the model has its lock"));
    }
    if let Some(track) = recording.tracks.iter().find(|track| vocabulary.component_named(&track.task).is_none()) {
        return Err(format!("the model has no component {}, which the recording has", track.task));
    }
    let track = |name: &String| {
        let found = recording.tracks.iter().find(|track| track.task == *name);
        found.map(|track| track.events.as_slice()).ok_or(format!("the recording has no task {name}"))
    };
    vocabulary.components.iter().map(|component| track(&component.name)).collect()
}

/// The last events of all tasks up to a tick.
fn before(vocabulary: &Vocabulary, tracks: &[&[Event]], recording: &Recording, tick: i64) -> Vec<Recorded> {
    let named = vocabulary.components.iter().zip(tracks);
    let mut all: Vec<Recorded> = named
        .flat_map(|(component, events)| {
            let until = events.partition_point(|event| event.time_ns / recording.tick_ns <= tick);
            events[until.saturating_sub(SHOWN)..until]
                .iter()
                .map(|event| Recorded { task: component.name.clone(), event: event.clone() })
        })
        .collect();
    all.sort_by_key(|recorded| recorded.event.time_ns);
    all.split_off(all.len().saturating_sub(SHOWN))
}
