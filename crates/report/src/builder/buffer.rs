//! Watches one buffer: which array is written and read, where the indexes stand, which task is inside the lock.

use std::collections::BTreeMap;

use super::Moment;
use super::reading::{Reading, Readings, Slot};
use crate::report::Buffer;
use crate::spec::BufferSpec;
use crate::tally::Tally;
use crate::tone::Tone;
use crate::track::{Kind, Track};

/// LIMIT: this many arrays get a row of their own.
const ROWS: usize = 16;

/// The kinds of a row, by index.
const WRITING: u16 = 0;
const READING: u16 = 1;
const WRITE_PLACE: u16 = 2;
const READ_PLACE: u16 = 3;

#[derive(Debug)]
pub(super) struct BufferWatch {
    arrays: Option<Slot>,
    writing: Option<Slot>,
    reading: Option<Slot>,
    write_index: Option<Slot>,
    read_index: Option<Slot>,
    lock: Option<Slot>,
    swaps: Option<Slot>,
    holders: BTreeMap<Reading, u16>,
    /// Who is inside, and since when.
    inside: Option<(u16, u64)>,
    track: Track,
    buffer: Buffer,
}

impl BufferWatch {
    pub fn new(spec: &BufferSpec, readings: &Readings) -> BufferWatch {
        let buffer = Buffer {
            from: spec.from.clone(),
            to: spec.to.clone(),
            rows: Vec::new(),
            lock: None,
            held: Tally::default(),
            swaps: Vec::new(),
            swapped: None,
            counters: Vec::new(),
        };
        BufferWatch {
            arrays: readings.optional(spec.arrays.as_ref()),
            writing: readings.optional(spec.writing.as_ref()),
            reading: readings.optional(spec.reading.as_ref()),
            write_index: readings.optional(spec.write_index.as_ref()),
            read_index: readings.optional(spec.read_index.as_ref()),
            lock: readings.optional(spec.lock.as_ref()),
            swaps: readings.optional(spec.swaps.as_ref()),
            holders: BTreeMap::new(),
            inside: None,
            track: Track::default(),
            buffer,
        }
    }

    pub fn begin(&mut self, moment: &Moment) {
        let arrays = array(moment.readings, self.arrays).unwrap_or(0);
        self.grow(arrays);
    }

    pub fn step(&mut self, moment: &Moment) {
        let readings = moment.readings;
        let places = [self.writing, self.reading, self.write_index, self.read_index].map(|slot| array(readings, slot));
        if moment.shown {
            let most = places.iter().flatten().max().map_or(0, |most| most + 1);
            self.grow(most);
            for (index, row) in self.buffer.rows.iter_mut().enumerate() {
                // What happens hides where it would happen next.
                let kind = [WRITING, READING, WRITE_PLACE, READ_PLACE]
                    .into_iter()
                    .find(|k| places[*k as usize] == Some(index));
                row.push(moment.tick, kind);
            }
            if self.swaps.is_some_and(|slot| readings.changed(slot)) {
                self.buffer.swaps.push(moment.tick);
            }
        }
        self.note_holder(moment);
    }

    fn grow(&mut self, rows: usize) {
        while self.buffer.rows.len() < rows.min(ROWS) {
            let kind = |label: &str, tone| Kind { label: label.to_owned(), tone };
            self.buffer.rows.push(Track::new(vec![
                kind("being written", Tone::Write),
                kind("being read", Tone::Read),
                kind("next to be written", Tone::WritePlace),
                kind("next to be read", Tone::ReadPlace),
            ]));
        }
    }

    fn note_holder(&mut self, moment: &Moment) {
        let Some(lock) = self.lock else { return };
        let holder = moment.readings.value(lock).map(|value| {
            *self.holders.entry(value).or_insert_with(|| {
                let label = format!("lock held by {}", moment.readings.text(lock));
                self.track.kinds.push(Kind { label, tone: Tone::Hold });
                self.track.kinds.len() as u16 - 1
            })
        });
        if moment.shown {
            self.track.push(moment.tick, holder);
        }
        if self.inside.map(|(holder, _)| holder) != holder {
            self.end_holding(moment.tick);
            self.inside = holder.map(|holder| (holder, moment.tick));
        }
    }

    fn end_holding(&mut self, tick: u64) {
        if let Some((_, since)) = self.inside.take() {
            self.buffer.held.add(tick - since, since);
        }
    }

    pub fn finish(mut self, moment: &Moment, counters: Vec<(String, Option<i64>)>) -> Buffer {
        self.end_holding(moment.tick);
        let swapped = self.swaps.and_then(|slot| moment.readings.integer(slot)).map(|n| n.max(0) as u64);
        let lock = self.lock.map(|_| self.track);
        Buffer { lock, swapped, counters, ..self.buffer }
    }
}

/// The array that a term names.
fn array(readings: &Readings, slot: Option<Slot>) -> Option<usize> {
    slot.and_then(|slot| readings.integer(slot)).and_then(|index| usize::try_from(index).ok())
}
