//! Tick by tick: in virtual time that follows the model, each tick is a step of the main rule.
//!
//! In: the model, a recording whose pace is `modelled`. Every event must be one of the step of its tick, and every event
//! of a step must have been recorded at its tick, those of one task in the order that `claims` gives them.

use machine::{EngineChoice, Interrupt, Limits, Machine};

use crate::Verdict;
use crate::ends::Ends;
use crate::events::Longest;
use crate::evidence::{Claim, Parted, Recorded, conforms, interrupted, missing, objects, out_of_turn};
use crate::steps::Steps;
use crate::vocabulary::Vocabulary;
use crate::way::Way;
use recording::{Event, Kind, Recording};

/// This many of the last events are shown where the two differ.
const SHOWN: usize = 12;

/// The model's own run, compared with a recording that may still be written.
#[derive(Debug)]
pub struct Replay {
    machine: Machine,
    vocabulary: Vocabulary,
    ends: Ends,
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
    pub fn new(limits: Limits, steps: &Steps) -> Result<Replay, String> {
        let (machine, vocabulary, ends) = steps.start(Way::Timed, limits)?;
        let cursors = vec![0; vocabulary.components.len()];
        Ok(Replay { machine, vocabulary, ends, tick: 0, cursors, agreed: 0 })
    }

    /// Compiles no step.
    pub fn interpret(&mut self) {
        self.machine.use_engine(EngineChoice::Interpreted);
    }

    /// How many events agreed.
    pub fn agreed(&self) -> usize {
        self.agreed
    }

    /// Goes on as far as the recording is known, or until interrupted; none: it agrees so far, and `more` may come.
    ///
    /// # Errors
    /// The recording is of another system, in words.
    pub fn go_on(&mut self, recording: &Recording, more: bool, asked: &Interrupt) -> Result<Option<Verdict>, String> {
        let tracks = tracks(&self.vocabulary, recording)?;
        let known = recording.known_until_ns().unwrap_or(i64::MAX).min(recording.stopped_ns.unwrap_or(i64::MAX));
        let end = known / recording.tick_ns;
        while self.tick < end {
            if asked.is_raised() {
                return Ok(Some(interrupted(self.agreed)));
            }
            let stopped = self.step(&tracks, recording);
            if stopped.is_some() {
                return Ok(stopped);
            }
            self.tick += 1;
        }
        if more {
            return Ok(None);
        }
        let unknown = |reason: String| Ok(Some(Verdict::Unknown { events: self.agreed, reason }));
        if !recording.is_whole() {
            return unknown(format!("{}; it is compared up to tick {end}", missing(recording)));
        }
        // What tasks do in order to stop is not part of a run of the model.
        let end_ns = end * recording.tick_ns;
        let compared = |events: &[Event]| events.partition_point(|event| event.time_ns < end_ns);
        if tracks.iter().zip(&self.cursors).any(|(events, cursor)| compared(events) != *cursor) {
            return unknown("an event was not come to".to_string());
        }
        Ok(Some(conforms(recording, self.agreed, self.tick.unsigned_abs())))
    }

    /// The step of a tick; none: it agrees.
    fn step(&mut self, tracks: &[&[Event]], recording: &Recording) -> Option<Verdict> {
        let tick = self.tick;
        let made = self.machine.step(&mut Longest).and_then(|_| {
            let claims = self.vocabulary.claims(&self.machine, &self.vocabulary.changes(&self.machine));
            let unlike = self.ends.unlike(&mut self.machine, &claims)?;
            Ok((claims, unlike))
        });
        let (claims, unlike) = match made {
            Ok(made) => made,
            Err(fault) => {
                let fault = fault.show(self.machine.program()).to_string();
                let reason = format!("the model cannot make the step of tick {tick}: {fault}");
                return Some(Verdict::Unknown { events: self.agreed, reason });
            }
        };
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
            if let Some(at) = differs(recorded, &own) {
                let event = recorded.get(at).cloned();
                let claims: Vec<Claim> = own[at.min(own.len())..].iter().map(|claim| (*claim).clone()).collect();
                let reason = out_of_turn(event.as_ref(), &claims);
                return Some(self.parted(component, event, claims, reason, (tracks, recording)));
            }
            self.agreed += count;
            self.cursors[component] += count;
        }
        let (component, claim, reason) = unlike?;
        let event = claim.as_ref().map(|claim| Event { time_ns: tick * recording.tick_ns, ..claim.event.clone() });
        Some(self.parted(component, event, claim.into_iter().collect(), Some(reason), (tracks, recording)))
    }

    /// A difference in the present tick.
    fn parted(
        &self,
        component: usize,
        event: Option<Event>,
        claims: Vec<Claim>,
        reason: Option<String>,
        (tracks, recording): (&[&[Event]], &Recording),
    ) -> Verdict {
        let state = self.vocabulary.state(&self.machine, component, &objects(event.as_ref(), &claims));
        Verdict::Parts(Box::new(Parted {
            tick: self.tick,
            task: self.vocabulary.components[component].name.clone(),
            reason,
            event,
            claims,
            decides: false,
            agreed: self.agreed,
            before: before(&self.vocabulary, tracks, recording, self.tick),
            state,
        }))
    }
}

/// The place of the first event that differs: where another one was recorded, one more, or one less.
fn differs(recorded: &[Event], claims: &[&Claim]) -> Option<usize> {
    let agree = recorded.iter().zip(claims).take_while(|(event, claim)| claim.event.same(event)).count();
    (agree < recorded.len().max(claims.len())).then_some(agree)
}

/// The tracks in the order of the components.
pub(crate) fn tracks<'r>(vocabulary: &Vocabulary, recording: &'r Recording) -> Result<Vec<&'r [Event]>, String> {
    if let Some(track) = recording.tracks.iter().find(|track| vocabulary.component_named(&track.task).is_none()) {
        return Err(format!("the model has no component {}, which the recording has", track.task));
    }
    let track = |name: &String| {
        let mut found = recording.tracks.iter().filter(|track| track.task == *name);
        let first = found.next().ok_or(format!("the recording has no task {name}"))?;
        match found.next() {
            Some(_) => Err(format!("the recording has two tasks {name}")),
            None => Ok(first.events.as_slice()),
        }
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
