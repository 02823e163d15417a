//! How often each task accessed its channels, and how often it did not when it was its turn.
//!
//! In: the recorded events, until the tasks were asked to stop, and the model's phases. Out: for each task and channel, how many
//! phases there were, and in how many the access was given up or left out. A replay holds each of these events to the model; but a run
//! in which a task never comes to write is one of the model, too, and whoever reads that it conforms must be told.

use recording::{Event, Kind, Recording};

use crate::vocabulary::{End, Vocabulary};
use machine::Machine;

/// A task's phases on a channel.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Access {
    /// The component.
    pub task: String,
    /// The channel.
    pub channel: String,
    /// It writes there; otherwise it reads.
    pub writes: bool,
    /// How many phases were its turn, those that were left out among them.
    pub turns: usize,
    /// How often it got the lock, sent or took a message, stored or loaded a value.
    pub made: usize,
    /// The watchdog ended before the lock came.
    pub given_up: usize,
    /// The queue stayed full.
    pub refused: usize,
    /// The component had nothing to hand over.
    pub left_out: usize,
}

impl Access {
    /// Whether it was never made, and at least once given up, refused or left out.
    pub fn never(&self) -> bool {
        self.made == 0 && self.given_up + self.refused + self.left_out > 0
    }

    /// Another phase of the task is on the channel, too. The events of a channel are counted once.
    fn in_another_phase(&mut self, turns: usize, left_out: usize) {
        self.turns += turns;
        self.left_out += left_out;
    }
}

/// Of each task and channel, in the order of the model.
pub(crate) fn accesses(recording: &Recording, machine: &Machine, vocabulary: &Vocabulary) -> Vec<Access> {
    let until_ns = recording.stopped_ns.unwrap_or(i64::MAX);
    let mut all = Vec::new();
    for (index, component) in vocabulary.components.iter().enumerate() {
        let Some(track) = recording.tracks.iter().find(|track| track.task == component.name) else { continue };
        let events = &track.events[..track.events.partition_point(|event| event.time_ns < until_ns)];
        let mut own: Vec<Access> = Vec::new();
        for phase in &component.phases {
            let channel = vocabulary.channel(machine, phase);
            if channel.is_undef() {
                continue;
            }
            let phase = vocabulary.object(machine, phase);
            let name = vocabulary.object(machine, &channel);
            let writes = vocabulary.end(&channel, End::Writes) == Some(index);
            let count = |kind: Kind, object: &str| {
                events.iter().filter(|event: &&Event| event.kind == kind && *event.object == *object).count()
            };
            let left_out = count(Kind::Passes, &phase);
            let turns = count(Kind::Begins, &phase) + left_out;
            let made = [Kind::Enters, Kind::Sends, Kind::Takes, Kind::Stores, Kind::Loads];
            match own.iter_mut().find(|access| access.channel == *name) {
                Some(access) => access.in_another_phase(turns, left_out),
                None => own.push(Access {
                    task: component.name.clone(),
                    channel: name.to_string(),
                    writes,
                    turns,
                    made: made.into_iter().map(|kind| count(kind, &name)).sum(),
                    given_up: count(Kind::GivesUp, &name),
                    refused: count(Kind::Refuses, &name),
                    left_out,
                }),
            }
        }
        all.extend(own);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::Access;

    #[test]
    fn two_phases_on_one_channel_are_one_access() {
        let mut access = Access { turns: 3, made: 2, left_out: 1, ..Access::default() };
        access.in_another_phase(4, 2);
        assert_eq!(access, Access { turns: 7, made: 2, left_out: 3, ..Access::default() });
    }

    #[test]
    fn never_made_means_that_something_kept_it_away_each_time() {
        let counts = || 0..3_usize;
        for (made, given_up, refused, left_out) in counts()
            .flat_map(|a| counts().flat_map(move |b| counts().flat_map(move |c| counts().map(move |d| (a, b, c, d)))))
        {
            let access = Access { made, given_up, refused, left_out, ..Access::default() };
            let kept_away = given_up > 0 || refused > 0 || left_out > 0;
            assert_eq!(access.never(), made == 0 && kept_away, "{access:?}");
        }
    }
}
