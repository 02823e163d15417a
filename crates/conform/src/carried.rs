//! Whether what a component got from a channel is what was decided for it, datum by datum, and was as new as its readings say.
//!
//! In: the recorded events and decisions of all tasks, and the names of the channels. Out: the first datum that was got otherwise than it
//! was decided, or than it was got before, or as new though it was not, or the other way around. A writing takes what its task decided last,
//! and gives it a number; a reading names the number, and what is got after it is that datum. Neither model nor machine is asked. INVARIANT:
//! the events and decisions of a task are walked in the order in which it recorded them. A datum that was read before its writer's record of
//! it has come waits for that. What no machine decided has the value with which it is got first.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

use recording::{Decision, Kind, Recording, Track};

/// What has been seen of the tasks.
#[derive(Debug, Default)]
pub(crate) struct Carried {
    /// The names of the channels; all else that is got comes from sensors.
    channels: BTreeSet<String>,
    walks: Vec<Walk>,
    /// Of a channel that is drawn to several readers, and is one for each here, the name that is drawn.
    drawn: BTreeMap<String, String>,
    /// The phases that elaborate.
    elaborations: BTreeSet<String>,
    /// Each datum, by channel and number.
    written: BTreeMap<(Arc<str>, u64), Written>,
    /// Data that were got, and not compared yet.
    got: Vec<Got>,
    /// What no machine decided, as it was got first.
    first: BTreeMap<Origin, Got>,
}

/// What is known of a datum.
#[derive(Debug)]
enum Written {
    /// A machine decided it, by these records.
    Decided(Vec<Decision>),
    /// No machine did. Data of one origin are one value.
    From(Origin),
}

/// Where a value comes from that no machine decided.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Origin {
    /// The datum of a channel with this number.
    Datum(Arc<str>, u64),
    /// What a task computed for all readers of a channel as it is drawn, after so many elaborations.
    Elaboration { drawn: String, track: usize, count: usize },
}

/// How far a task has come.
#[derive(Debug, Default)]
struct Walk {
    events: usize,
    decisions: usize,
    /// What it has decided last for each channel.
    decided: BTreeMap<Arc<str>, Vec<Decision>>,
    /// The number of the datum that it has read last from each channel.
    read: BTreeMap<Arc<str>, u64>,
    /// The channels whose last reading brought something new, and for messages: since the decision before.
    fresh: BTreeSet<Arc<str>>,
    /// The channels from which messages are taken.
    queues: BTreeSet<Arc<str>>,
    /// How many elaborations have ended, and the channels written to since the last one.
    elaborations: usize,
    wrote: BTreeSet<Arc<str>>,
}

/// A datum that a task got.
#[derive(Debug, Clone)]
struct Got {
    track: usize,
    number: u64,
    /// Its records among the task's decisions.
    records: Range<usize>,
}

/// A datum that a task got otherwise than it was decided or read.
#[derive(Debug)]
pub(crate) struct Unlike {
    /// The task's place among the tracks.
    pub(crate) track: usize,
    /// The datum's number.
    pub(crate) number: u64,
    /// The records of what the task got.
    pub(crate) got: Vec<Decision>,
    /// What it is unlike.
    pub(crate) to: To,
}

/// What a datum that was got should have been.
#[derive(Debug)]
pub(crate) enum To {
    /// As it was decided, by these records.
    Decided(Vec<Decision>),
    /// As a task got it before, as a datum of a number, by these records.
    Before { track: usize, number: u64, got: Vec<Decision> },
    /// Not there: nothing had been read.
    Nothing,
    /// New, or not new.
    Newness(bool),
}

impl Carried {
    /// Nothing has been seen of the tasks, which have these channels, some of them drawn by another name, and these elaborations.
    pub(crate) fn new(
        channels: BTreeSet<String>,
        drawn: BTreeMap<String, String>,
        elaborations: BTreeSet<String>,
    ) -> Carried {
        Carried { channels, drawn, elaborations, ..Carried::default() }
    }

    /// Goes on as far as the recording is known.
    pub(crate) fn go_on(&mut self, recording: &Recording, more: bool) -> Option<Unlike> {
        // Most programs record no decisions.
        if recording.tracks.iter().all(|track| track.decisions.is_empty()) {
            return None;
        }
        self.walks.resize_with(recording.tracks.len(), Walk::default);
        let mut found = None;
        for (index, track) in recording.tracks.iter().enumerate() {
            while self.walks[index].events < track.events.len() {
                found = found.or(self.decide(index, track));
                self.happen(index, track);
            }
            // Of what comes last a part may be missing.
            if !goes_on(recording, track, more) {
                found = found.or(self.decide(index, track));
            }
        }
        let (written, first) = (&self.written, &mut self.first);
        self.got.retain(|got| {
            let records = got.records(recording);
            let to = match written.get(&(Arc::clone(&records[0].object), got.number)) {
                None => return true,
                Some(Written::Decided(decided)) if same(records, decided) => return false,
                Some(Written::Decided(decided)) => To::Decided(decided.clone()),
                Some(Written::From(origin)) => match first.get(origin) {
                    None => {
                        first.insert(origin.clone(), got.clone());
                        return false;
                    }
                    Some(before) if same(records, before.records(recording)) => return false,
                    Some(before) => {
                        let (track, number) = (before.track, before.number);
                        To::Before { track, number, got: before.records(recording).to_vec() }
                    }
                },
            };
            if found.is_none() {
                found = Some(Unlike { track: got.track, number: got.number, got: records.to_vec(), to });
            }
            false
        });
        found
    }

    /// Takes the decisions that come before the task's next event; the first datum that was not there, or not as new as it was said to be.
    fn decide(&mut self, index: usize, track: &Track) -> Option<Unlike> {
        let walk = &mut self.walks[index];
        let mut found = None;
        while let Some(first) = track.decisions.get(walk.decisions).filter(|one| one.events <= walk.events) {
            let from = walk.decisions;
            let same = |one: &&Decision| one.object == first.object && one.is_got == first.is_got;
            let rest = track.decisions[from + 1..].iter().take_while(|one| one.part != 0 && same(one)).count();
            walk.decisions += 1 + rest;
            let records = from..walk.decisions;
            if !first.is_got {
                walk.decided.insert(Arc::clone(&first.object), track.decisions[records].to_vec());
                continue;
            }
            if !self.channels.contains(first.object.as_ref()) {
                continue;
            }
            let number = walk.read.get(&first.object).copied().unwrap_or(0);
            let is_new = walk.fresh.contains(&first.object);
            let got = &track.decisions[records.clone()];
            let to = match () {
                () if number == 0 && got.iter().any(|one| one.known) => Some(To::Nothing),
                () if got.iter().any(|one| one.fresh != is_new) => Some(To::Newness(is_new)),
                () => None,
            };
            if let Some(to) = to {
                found = found.or_else(|| Some(Unlike { track: index, number, got: got.to_vec(), to }));
            }
            // A message is new to one decision; a datum is until the next reading.
            if walk.queues.contains(&first.object) {
                walk.fresh.remove(&first.object);
            }
            if number != 0 {
                self.got.push(Got { track: index, number, records });
            }
        }
        found
    }

    /// Takes the task's next event.
    fn happen(&mut self, index: usize, track: &Track) {
        let walk = &mut self.walks[index];
        let event = &track.events[walk.events];
        walk.events += 1;
        match event.kind {
            Kind::Ends if self.elaborations.contains(&*event.object) => {
                walk.elaborations += 1;
                walk.wrote.clear();
            }
            Kind::Writes | Kind::Sends | Kind::Stores => {
                let datum = (Arc::clone(&event.object), event.number);
                // What is written to a channel again without a new elaboration may be what was there before.
                let is_first = walk.wrote.insert(Arc::clone(&event.object));
                let written = match (walk.decided.get(&event.object), self.drawn.get(&*event.object)) {
                    (Some(decided), _) => Written::Decided(decided.clone()),
                    (None, Some(drawn)) if is_first => {
                        let (drawn, count) = (drawn.clone(), walk.elaborations);
                        Written::From(Origin::Elaboration { drawn, track: index, count })
                    }
                    (None, _) => Written::From(Origin::Datum(datum.0.clone(), datum.1)),
                };
                self.written.insert(datum, written);
            }
            // Without a new message the last one stays.
            Kind::Takes => {
                walk.queues.insert(Arc::clone(&event.object));
                if event.number != 0 {
                    walk.read.insert(Arc::clone(&event.object), event.number);
                    walk.fresh.insert(Arc::clone(&event.object));
                }
            }
            Kind::Reads | Kind::Loads => {
                let before = walk.read.insert(Arc::clone(&event.object), event.number);
                if event.number != before.unwrap_or(0) {
                    walk.fresh.insert(Arc::clone(&event.object));
                } else {
                    walk.fresh.remove(&event.object);
                }
            }
            // A reading that was given up leaves the datum before, which is no longer new.
            Kind::GivesUp => _ = walk.fresh.remove(&event.object),
            _ => {}
        }
    }
}

impl Got {
    fn records<'r>(&self, recording: &'r Recording) -> &'r [Decision] {
        &recording.tracks[self.track].decisions[self.records.clone()]
    }
}

/// Whether what a task recorded last may be a part of what it got or decided: more is to come, or was lost.
pub(crate) fn goes_on(recording: &Recording, track: &Track, more: bool) -> bool {
    more || track.lost || !recording.ended
}

/// Whether a datum says the same as another one; none says that there is no value.
fn same(got: &[Decision], decided: &[Decision]) -> bool {
    let parts = |records: &[Decision]| -> Vec<(u64, u64)> {
        records.iter().filter(|one| one.known).map(|one| (one.part, one.bits)).collect()
    };
    parts(got) == parts(decided)
}

#[cfg(test)]
mod tests;
