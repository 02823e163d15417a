//! Whether what a component got from a channel is what was decided for it, datum by datum.
//!
//! In: the recorded events and decisions of all tasks. Out: the first datum that was got otherwise than it was decided. A writing takes
//! what its task decided last, and gives it a number; a reading names the number, and what is got after it is that datum. Neither model
//! nor machine is asked. INVARIANT: the events and decisions of a task are walked in the order in which it recorded them. A datum that
//! was read before its writer's record of it has come waits for that; one that no machine decided is not compared.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use recording::{Decision, Kind, Recording, Track};

/// What has been seen of the tasks.
#[derive(Debug, Default)]
pub(crate) struct Carried {
    walks: Vec<Walk>,
    /// What was decided for each datum, by channel and number; none if no machine did.
    written: BTreeMap<(Arc<str>, u64), Option<Vec<Decision>>>,
    /// Data that were got, and not compared yet.
    got: Vec<Got>,
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
}

/// A datum that a task got.
#[derive(Debug)]
struct Got {
    track: usize,
    number: u64,
    /// Its records among the task's decisions.
    records: Range<usize>,
}

/// A datum that a task got otherwise than it was decided.
#[derive(Debug)]
pub(crate) struct Unlike {
    /// The task's place among the tracks.
    pub(crate) track: usize,
    /// The datum's number.
    pub(crate) number: u64,
    /// The records of what the task got.
    pub(crate) got: Vec<Decision>,
    /// The records of what was decided; empty if there was no such datum.
    pub(crate) decided: Vec<Decision>,
}

impl Carried {
    /// Goes on as far as the recording is known.
    pub(crate) fn go_on(&mut self, recording: &Recording, more: bool) -> Option<Unlike> {
        // Most programs record no decisions.
        if recording.tracks.iter().all(|track| track.decisions.is_empty()) {
            return None;
        }
        self.walks.resize_with(recording.tracks.len(), Walk::default);
        for (index, track) in recording.tracks.iter().enumerate() {
            while self.walks[index].events < track.events.len() {
                self.decide(index, track);
                self.happen(index, track);
            }
            // Of what comes last a part may be missing.
            if !goes_on(recording, track, more) {
                self.decide(index, track);
            }
        }
        let written = &self.written;
        let mut found = None;
        self.got.retain(|got| {
            let track = &recording.tracks[got.track];
            let records = &track.decisions[got.records.clone()];
            let none = Vec::new();
            let decided = match (got.number, written.get(&(Arc::clone(&records[0].object), got.number))) {
                (0, _) => &none,
                (_, Some(Some(decided))) => decided,
                (_, Some(None)) => return false,
                (_, None) => return true,
            };
            if found.is_none() && !same(records, decided) {
                let (at, number) = (got.track, got.number);
                let (got, decided) = (records.to_vec(), decided.clone());
                found = Some(Unlike { track: at, number, got, decided });
            }
            false
        });
        found
    }

    /// Takes the decisions that come before the task's next event.
    fn decide(&mut self, index: usize, track: &Track) {
        let walk = &mut self.walks[index];
        while let Some(first) = track.decisions.get(walk.decisions).filter(|one| one.events <= walk.events) {
            let from = walk.decisions;
            let same = |one: &&Decision| one.object == first.object && one.is_got == first.is_got;
            let rest = track.decisions[from + 1..].iter().take_while(|one| one.part != 0 && same(one)).count();
            walk.decisions += 1 + rest;
            let records = from..walk.decisions;
            if !first.is_got {
                walk.decided.insert(Arc::clone(&first.object), track.decisions[records].to_vec());
            } else if let Some(number) = walk.read.get(&first.object) {
                self.got.push(Got { track: index, number: *number, records });
            }
        }
    }

    /// Takes the task's next event.
    fn happen(&mut self, index: usize, track: &Track) {
        let walk = &mut self.walks[index];
        let event = &track.events[walk.events];
        walk.events += 1;
        match event.kind {
            Kind::Writes | Kind::Sends | Kind::Stores => {
                let decided = walk.decided.get(&event.object).cloned();
                self.written.insert((Arc::clone(&event.object), event.number), decided);
            }
            // Without a new message the last one stays.
            Kind::Takes if event.number == 0 => {}
            Kind::Reads | Kind::Loads | Kind::Takes => _ = walk.read.insert(Arc::clone(&event.object), event.number),
            _ => {}
        }
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
