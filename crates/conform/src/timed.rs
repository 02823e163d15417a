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
use crate::steps::Steps;
use crate::vocabulary::Vocabulary;
use recording::{Event, Kind, Recording};

/// The last so many events are shown where the two part.
const SHOWN: usize = 12;

/// The model's own run, held against a recording that may still be written.
#[derive(Debug)]
pub struct Replay {
    machine: Machine,
    vocabulary: Vocabulary,
    /// The next tick.
    tick: i64,
    cursors: Vec<usize>,
    agreed: usize,
}

impl Replay {
    /// Starts the model.
    ///
    /// # Errors
    /// It cannot be replayed, in words: it does not start, or is not made of the library's patterns.
    pub fn new(program: &Arc<Program>, limits: Limits, steps: &Steps) -> Result<Replay, String> {
        let (machine, vocabulary) = steps.start(program, limits)?;
        let cursors = vec![0; vocabulary.components.len()];
        Ok(Replay { machine, vocabulary, tick: 0, cursors, agreed: 0 })
    }

    /// How many events agreed.
    pub fn agreed(&self) -> usize {
        self.agreed
    }

    /// Goes on as far as the recording is known; none: it agrees so far, and `more` may come.
    ///
    /// # Errors
    /// The recording is of another system, in words.
    pub fn go_on(&mut self, recording: &Recording, more: bool) -> Result<Option<Verdict>, String> {
        let tracks = tracks(&self.vocabulary, recording)?;
        let known = recording.known_until_ns().unwrap_or(i64::MAX).min(recording.stopped_ns.unwrap_or(i64::MAX));
        let end = known / recording.tick_ns;
        while self.tick < end {
            let stopped = self.step(&tracks, recording);
            if stopped.is_some() {
                return Ok(stopped);
            }
            self.tick += 1;
        }
        if more {
            return Ok(None);
        }
        if !recording.is_whole() {
            let reason = format!("the recording has a gap, or ends early, after tick {end}");
            return Ok(Some(Verdict::Unknown { events: self.agreed, reason }));
        }
        Ok(Some(Verdict::Conforms { events: self.agreed, steps: self.machine.steps() }))
    }

    /// The step of a tick; none: it agrees.
    fn step(&mut self, tracks: &[&[Event]], recording: &Recording) -> Option<Verdict> {
        let tick = self.tick;
        if let Err(fault) = self.machine.step(&mut Closed) {
            let fault = fault.show(self.machine.program()).to_string();
            let reason = format!("the model cannot make the step of tick {tick}: {fault}");
            return Some(Verdict::Unknown { events: self.agreed, reason });
        }
        let claims = self.vocabulary.claims(&self.machine, &self.vocabulary.changes(&self.machine));
        for component in 0..self.vocabulary.components.len() {
            let events = &tracks[component][self.cursors[component]..];
            let count = events.iter().take_while(|event| event.time_ns / recording.tick_ns == tick).count();
            let recorded = &events[..count];
            let task = &self.vocabulary.components[component].name;
            if let Some(event) = recorded.iter().find(|event| matches!(event.kind, Kind::Passes | Kind::Faults)) {
                let reason = match event.kind {
                    Kind::Passes => {
                        format!("{task} had nothing to hand over in tick {tick}, which the model always has")
                    }
                    _ => format!("{task} failed in tick {tick}"),
                };
                return Some(Verdict::Unknown { events: self.agreed, reason });
            }
            let own: Vec<&Claim> = claims.iter().filter(|(of, _)| *of == component).map(|(_, claim)| claim).collect();
            if let Some(event) = differs(recorded, &own) {
                let mut claims: Vec<Claim> = own.into_iter().cloned().collect();
                if event.is_none() {
                    claims.retain(|claim| !recorded.iter().any(|event| event.same(&claim.event)));
                }
                let state = self.vocabulary.state(&self.machine, component, &objects(event.as_ref(), &claims));
                return Some(Verdict::Parts(Box::new(Parted {
                    tick,
                    task: task.clone(),
                    event,
                    claims,
                    reason: None,
                    agreed: self.agreed,
                    before: before(&self.vocabulary, tracks, recording, tick),
                    state,
                })));
            }
            self.agreed += count;
            self.cursors[component] += count;
        }
        None
    }
}

/// The first recorded event that is no claim; or no event, if a claim is left over.
#[expect(clippy::option_option, reason = "whether they differ, and by which event if by one")]
fn differs(recorded: &[Event], claims: &[&Claim]) -> Option<Option<Event>> {
    let mut open: Vec<&&Claim> = claims.iter().collect();
    for event in recorded {
        if event.kind == Kind::Invalid {
            continue;
        }
        match open.iter().position(|claim| claim.event.same(event)) {
            Some(found) => _ = open.swap_remove(found),
            None => return Some(Some(event.clone())),
        }
    }
    (!open.is_empty()).then_some(None)
}

/// The tracks in the order of the components.
pub(crate) fn tracks<'r>(vocabulary: &Vocabulary, recording: &'r Recording) -> Result<Vec<&'r [Event]>, String> {
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
