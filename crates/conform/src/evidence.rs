//! What a difference shows: the recorded events, what the model has instead, the state, the rule.

use syntax::Span;

use recording::{Event, Recording};

use crate::Verdict;

/// An event that a step of the model has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// What happens; its time is not looked at.
    pub event: Event,
    /// The rule whose update makes it.
    pub span: Span,
}

/// A recorded event with its task.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recorded {
    /// The component.
    pub task: String,
    /// The event.
    pub event: Event,
}

/// Where a program and its model differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parted {
    /// The tick.
    pub tick: i64,
    /// The component.
    pub task: String,
    /// What was recorded; none if the model has an event that the program lacks.
    pub event: Option<Event>,
    /// What the model has for the component at this point.
    pub claims: Vec<Claim>,
    /// Why, if the claims alone do not say it.
    pub reason: Option<String>,
    /// The two decide otherwise: `reason` says what, and no event does.
    pub decides: bool,
    /// How many events agreed before.
    pub agreed: usize,
    /// The last events of all tasks before, oldest first.
    pub before: Vec<Recorded>,
    /// The model's state around it: locations and values.
    pub state: Vec<(String, String)>,
}

/// What a difference is about: the channels, or the other objects of events.
pub(crate) fn objects<'e>(event: Option<&'e Event>, claims: &'e [Claim]) -> Vec<&'e str> {
    event.into_iter().chain(claims.iter().map(|claim| &claim.event)).map(|event| event.object.as_ref()).collect()
}

/// Text for an event that the model has in the same step, later or earlier.
pub(crate) fn out_of_turn(event: Option<&Event>, claims: &[Claim]) -> Option<String> {
    let event = event?;
    let later = claims.iter().any(|claim| claim.event.same(event));
    later.then(|| "the model's task does that in the same step, but not first".to_string())
}

/// The comparison was asked to end here.
pub(crate) fn interrupted(events: usize) -> Verdict {
    Verdict::Unknown { events, reason: "the comparison was interrupted".to_string() }
}

/// What of the run the recording lacks, in words.
pub(crate) fn missing(recording: &Recording) -> String {
    match recording.tracks.iter().find(|track| track.lost) {
        Some(track) => format!("events of {} are missing in the recording", track.task),
        None => "the recording has no end".to_string(),
    }
}

/// All events up to the stop agree. A recording without events says nothing about the program, and one of a run in which a task
/// failed or hung nothing about what was to come.
pub(crate) fn conforms(recording: &Recording, events: usize, steps: u64) -> Verdict {
    if let Some(failure) = &recording.failure {
        return Verdict::Unknown { events, reason: failure.clone() };
    }
    match events {
        0 => {
            Verdict::Unknown { events, reason: "nothing was recorded before the tasks were asked to stop".to_string() }
        }
        _ => Verdict::Conforms { events, steps, after: recording.events() - events },
    }
}
