//! MCAP bytes → events, task by task.
//!
//! Reads what `cpp/include/groundstate/recorder.hpp` writes: records and uncompressed chunks, from the front, so a file
//! that ends early gives everything before its end. Checksums are checked wherever the file has them. INVARIANT: the
//! events of a track are in the task's order without a gap, and their instants do not go back; what comes after a lost
//! event is left out, and the track says so. Only a file that is there to its last byte has an end.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::Deserialize;

use crate::checksum::Checksum;
use crate::{Awaited, Bounded, Decision, Event, Greatest, Kind, Recording, Rhythm, Track};

/// What is wrong with a file that is no recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Malformed(pub String);

const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// The footer up to its checksum, which covers it, with what stands before it of every record.
const FOOTER: usize = 9 + 16;

/// What the end of a log says of bounds, each by its number. Where a task hung, its counts may be read while it counts.
fn bounds(values: &BTreeMap<&str, &str>) -> Result<Vec<Bounded>, Malformed> {
    let of = |number: usize| {
        let text = |what: &str| values.get(format!("{what} {number}").as_str()).copied();
        let count = |what: &str| text(what).and_then(|text| text.parse().ok());
        let greatest = count("greatest_ns").map(Greatest::Time).or(count("greatest").map(Greatest::Number))?;
        Some(Bounded {
            what: text("bound")?.to_string(),
            limit: text("limit")?.to_string(),
            seen: count("seen")?,
            below: count("below")?,
            beyond: count("beyond")?,
            greatest,
        })
    };
    let counted = |key: &&&str| {
        let words = ["bound", "limit", "seen", "below", "beyond", "greatest", "greatest_ns"];
        key.split_once(' ').is_some_and(|(what, number)| words.contains(&what) && number.parse::<usize>().is_ok())
    };
    let bounds: Vec<Bounded> = (0..).map_while(of).collect();
    // Each has six of them.
    if values.keys().filter(counted).count() != 6 * bounds.len() {
        return malformed(format!("it does not say whole and in numbers what was counted of bound {}", bounds.len()));
    }
    let is_at_rest = values.get("outcome") != Some(&"hung");
    match bounds.iter().find_map(impossible).filter(|_| is_at_rest) {
        Some(words) => malformed(format!("its end contradicts itself: {words}")),
        None => Ok(bounds),
    }
}

/// Why nothing can have been counted so; the limit itself is not asked.
fn impossible(bound: &Bounded) -> Option<String> {
    let Bounded { what, seen, below, beyond, .. } = bound;
    (bound.outside() > *seen)
        .then(|| format!("of {what} it counts {below} values below the bound and {beyond} beyond it, and saw {seen}"))
}

fn malformed<T>(words: impl Into<String>) -> Result<T, Malformed> {
    Err(Malformed(words.into()))
}

/// The checksum that a file states (0: none), and the one that its bytes have.
fn agree(stated: u32, found: u32, what: &str) -> Result<(), Malformed> {
    match stated == 0 || stated == found {
        true => Ok(()),
        false => malformed(format!("{what} is damaged: its checksum is not that of its bytes")),
    }
}

/// Reads numbers and texts of a record; none after its end.
struct Cursor<'a>(&'a [u8]);

impl<'a> Cursor<'a> {
    fn bytes(&mut self, count: usize) -> Option<&'a [u8]> {
        let (head, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(head)
    }

    fn number<const N: usize>(&mut self) -> Option<u64> {
        let mut all = [0; 8];
        all[..N].copy_from_slice(self.bytes(N)?);
        Some(u64::from_le_bytes(all))
    }

    fn text(&mut self) -> Option<&'a str> {
        let length = self.number::<4>()? as usize;
        std::str::from_utf8(self.bytes(length)?).ok()
    }

    /// The next record: its code and content.
    fn record(&mut self) -> Option<(u8, &'a [u8])> {
        let before = self.0;
        let record = (|| {
            let code = self.bytes(1)?[0];
            let length = self.number::<8>()?;
            Some((code, self.bytes(usize::try_from(length).ok()?)?))
        })();
        if record.is_none() {
            self.0 = before;
        }
        record
    }
}

/// A message, as it is written.
#[derive(Deserialize)]
struct Said<'a> {
    order: u64,
    #[serde(borrow)]
    kind: Cow<'a, str>,
    #[serde(borrow)]
    object: Cow<'a, str>,
    number: u64,
    array: Option<u64>,
    next: Option<u64>,
    fresh: Option<bool>,
    known: Option<bool>,
    #[serde(default)]
    part: u64,
}

/// Reads a file that may still be written, in pieces of any size.
#[derive(Debug, Default)]
pub struct Reader {
    recording: Recording,
    channels: BTreeMap<u64, usize>,
    /// What events have named so far.
    objects: BTreeSet<Arc<str>>,
    /// What is said of the tasks before they are named.
    timing: BTreeMap<String, String>,
    /// The beginning of a record whose rest has not come yet.
    rest: Vec<u8>,
    place: Place,
    /// Of all bytes of the present section so far.
    sum: Checksum,
    /// The end of the run was told; what the file itself ends with may still be missing.
    is_told: bool,
    /// For each track, the number of the event that was read last, whether it was kept or not.
    orders: Vec<Option<u64>>,
}

/// Where in a file the reader is.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
enum Place {
    #[default]
    Before,
    Data,
    /// Everything is said again.
    Summary,
    /// The bytes of [`MAGIC`] once more.
    Last,
    Behind,
}

impl Recording {
    /// Reads the bytes of an MCAP file.
    ///
    /// # Errors
    /// It is not an MCAP file, or not one of a generated program, or it is damaged.
    pub fn read(bytes: &[u8]) -> Result<Recording, Malformed> {
        let mut reader = Reader::default();
        reader.feed(bytes)?;
        reader.finish()
    }
}

impl Reader {
    /// Reads on.
    ///
    /// # Errors
    /// It is not an MCAP file, or not one of a generated program, or it is damaged.
    pub fn feed(&mut self, bytes: &[u8]) -> Result<(), Malformed> {
        // A file that is read whole is not copied. Nor is a record copied again with each piece of it that comes.
        if self.rest.is_empty() {
            let read = self.go_on(bytes)?;
            self.rest.extend_from_slice(&bytes[read..]);
            return Ok(());
        }
        let mut all = std::mem::take(&mut self.rest);
        all.extend_from_slice(bytes);
        let read = self.go_on(&all)?;
        all.drain(..read);
        self.rest = all;
        Ok(())
    }

    /// All that came, of a file that is at its end.
    ///
    /// # Errors
    /// It is not an MCAP file, or not one of a generated program.
    pub fn finish(self) -> Result<Recording, Malformed> {
        if self.place == Place::Before {
            return malformed("it is no MCAP file");
        }
        if self.recording.tick_ns <= 0 {
            return malformed("it is not the recording of a generated program");
        }
        Ok(self.recording)
    }

    /// Reads as many whole records as there are; gives their number of bytes.
    fn go_on(&mut self, all: &[u8]) -> Result<usize, Malformed> {
        let mut cursor = Cursor(all);
        if self.place == Place::Before {
            if all.len() < MAGIC.len() && MAGIC.starts_with(all) {
                return Ok(0);
            }
            cursor = Cursor(all.strip_prefix(MAGIC).ok_or(Malformed("it is no MCAP file".to_string()))?);
            self.sum.add(MAGIC);
            self.place = Place::Data;
        }
        while !matches!(self.place, Place::Last | Place::Behind) {
            let before = cursor.0;
            let Some((code, content)) = cursor.record() else { break };
            let bytes = &before[..before.len() - cursor.0.len()];
            match (self.place, code) {
                (Place::Data, 0x0f) => {
                    let stated = Cursor(content).number::<4>().unwrap_or(0) as u32;
                    agree(stated, self.sum.value(), "the file")?;
                    self.sum = Checksum::default();
                    self.place = Place::Summary;
                }
                (Place::Summary, 0x02) => {
                    self.sum.add(&bytes[..FOOTER.min(bytes.len())]);
                    let stated = Cursor(content.get(16..).unwrap_or_default()).number::<4>().unwrap_or(0) as u32;
                    agree(stated, self.sum.value(), "the file's summary")?;
                    self.place = Place::Last;
                }
                (Place::Summary, _) => self.sum.add(bytes),
                _ => {
                    self.sum.add(bytes);
                    self.record(code, content)?;
                }
            }
        }
        if self.place == Place::Last {
            if cursor.0.len() < MAGIC.len() && MAGIC.starts_with(cursor.0) {
                return Ok(all.len() - cursor.0.len());
            }
            cursor = Cursor(cursor.0.strip_prefix(MAGIC).ok_or(Malformed("its last bytes are damaged".to_string()))?);
            self.place = Place::Behind;
            self.recording.ended = self.is_told;
        }
        match self.place == Place::Behind && !cursor.0.is_empty() {
            true => malformed("something follows the end of the file"),
            false => Ok(all.len() - cursor.0.len()),
        }
    }

    /// What has come so far: the run's head first, then its events.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Whether the file is there to its end; nothing follows it.
    pub fn has_ended(&self) -> bool {
        self.place == Place::Behind
    }

    fn record(&mut self, code: u8, content: &[u8]) -> Result<(), Malformed> {
        let short = || Malformed("a record is shorter than it says".to_string());
        let mut cursor = Cursor(content);
        match code {
            0x04 => {
                let id = cursor.number::<2>().ok_or_else(short)?;
                cursor.number::<2>();
                let topic = cursor.text().ok_or_else(short)?;
                self.channel(id, topic.strip_prefix('/').unwrap_or(topic))?;
            }
            0x05 => self.message(&mut cursor).ok_or_else(short)??,
            0x06 => {
                cursor.bytes(24);
                let stated = cursor.number::<4>().ok_or_else(short)? as u32;
                if !cursor.text().ok_or_else(short)?.is_empty() {
                    return malformed("its chunks are compressed; `mcap` can write them anew without");
                }
                let length = cursor.number::<8>().ok_or_else(short)?;
                let inner = usize::try_from(length).ok().and_then(|length| cursor.bytes(length)).ok_or_else(short)?;
                agree(stated, Checksum::of(inner), "a chunk")?;
                let mut cursor = Cursor(inner);
                while let Some((code, content)) = cursor.record() {
                    if code == 0x06 {
                        return malformed("a chunk holds a chunk");
                    }
                    self.record(code, content)?;
                }
                if !cursor.0.is_empty() {
                    return Err(short());
                }
            }
            0x0c => {
                let name = cursor.text().ok_or_else(short)?;
                let mut map = Cursor(cursor.text().ok_or_else(short)?.as_bytes());
                let mut values = BTreeMap::new();
                while let (Some(key), Some(value)) = (map.text(), map.text()) {
                    values.insert(key, value);
                }
                self.about(name, &values)?;
            }
            0x80 => self.recording.horizon_ns = Some(cursor.number::<8>().ok_or_else(short)? as i64),
            _ => {}
        }
        Ok(())
    }

    /// A channel is a task. It may be declared again, word by word.
    fn channel(&mut self, id: u64, task: &str) -> Result<(), Malformed> {
        let tracks = &self.recording.tracks;
        match (self.channels.get(&id), tracks.iter().any(|track| track.task == task)) {
            (Some(known), _) if tracks[*known].task == task => return Ok(()),
            (Some(known), _) => {
                return malformed(format!("one channel is both {} and {task}", tracks[*known].task));
            }
            (None, true) => return malformed(format!("two channels have the name {task}")),
            (None, false) => {}
        }
        self.channels.insert(id, tracks.len());
        let mut track = Track { task: task.to_string(), ..Track::default() };
        time(&self.timing, &mut track)?;
        self.recording.tracks.push(track);
        self.orders.push(None);
        Ok(())
    }

    fn about(&mut self, name: &str, values: &BTreeMap<&str, &str>) -> Result<(), Malformed> {
        let recording = &mut self.recording;
        let text = |key: &str| values.get(key).copied().unwrap_or_default();
        match name {
            "groundstate" => {
                if recording.tick_ns > 0 {
                    return malformed("it has two heads");
                }
                recording.system = text("system").to_string();
                recording.tick_ns = text("tick_ns").parse().unwrap_or(0);
                recording.pace = text("pace").to_string();
                recording.wait_free = text("wait_free").split_whitespace().map(str::to_string).collect();
                self.timing = values.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
                // Other tools that copy a recording may put the tasks first.
                for track in &mut recording.tracks {
                    time(&self.timing, track)?;
                }
            }
            // Written before any event of a task that was asked to stop.
            "stop" | "end" => {
                let stopped_ns = text("stopped_ns").parse().ok().filter(|stopped_ns| *stopped_ns >= 0);
                if stopped_ns.is_none() || recording.stopped_ns.is_some_and(|told| Some(told) != stopped_ns) {
                    return malformed("it does not say when the tasks were asked to stop, or says it in two ways");
                }
                if self.is_told {
                    return malformed("it has two ends");
                }
                recording.stopped_ns = stopped_ns;
                if name == "end" {
                    self.is_told = true;
                    recording.bounds = bounds(values)?;
                    recording.failure = failure(values);
                    let Ok(lost) = text("lost").parse::<u64>() else {
                        return malformed("its end does not say in a number how many events were lost");
                    };
                    for (track, last) in recording.tracks.iter_mut().zip(&self.orders) {
                        let task = &track.task;
                        let Ok(all) = text(&format!("events {task}")).parse::<u64>() else {
                            return malformed(format!("its end does not say in a number how many events {task} had"));
                        };
                        if let Some(last) = last.filter(|last| *last >= all) {
                            let words =
                                format!("{task} had {all} events, and event {last} of it, counted from 0, is there");
                            return malformed(format!("its end contradicts what comes before: {words}"));
                        }
                        // The program counts what it lost; what is told of the tasks' numbers does not undo that.
                        track.lost |= lost > 0 || all != (track.events.len() + track.decisions.len()) as u64;
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn message(&mut self, cursor: &mut Cursor<'_>) -> Option<Result<(), Malformed>> {
        let channel = cursor.number::<2>()?;
        cursor.number::<4>()?;
        // An instant before the beginning is a number that no run reaches: as a signed number, it is negative.
        let time_ns = cursor.number::<8>()? as i64;
        cursor.number::<8>()?;
        let Some(index) = self.channels.get(&channel) else {
            return Some(malformed("a message has no channel"));
        };
        if self.is_told {
            return Some(malformed("an event comes behind the end of the run"));
        }
        // An event that comes before the horizon after all is lost for a reader that has gone on.
        let late = self.recording.horizon_ns.is_some_and(|horizon| time_ns < horizon);
        let track = &mut self.recording.tracks[*index];
        let Ok(said) = serde_json::from_slice::<Said<'_>>(cursor.0) else {
            return Some(malformed("a message is no event"));
        };
        // Lost events leave a gap in the numbers; none goes back.
        if let Some(last) = self.orders[*index].replace(said.order).filter(|last| said.order <= *last) {
            let (task, order) = (&track.task, said.order);
            return Some(match order == last {
                true => malformed(format!("event {order} of {task} is there twice")),
                false => malformed(format!("the events of {task} are out of order: {order} comes after {last}")),
            });
        }
        if track.lost || late || said.order != (track.events.len() + track.decisions.len()) as u64 {
            track.lost = true;
            return Some(Ok(()));
        }
        let decision = match said.kind.as_ref() {
            "gets" => Some(true),
            "decides" => Some(false),
            _ => None,
        };
        let kind = Kind::of(&said.kind);
        if kind.is_none() && decision.is_none() {
            return Some(malformed(format!("an event is of no known kind: `{}`", said.kind)));
        }
        let object = match self.objects.get(said.object.as_ref()) {
            Some(known) => Arc::clone(known),
            None => {
                let object: Arc<str> = said.object.into();
                self.objects.insert(Arc::clone(&object));
                object
            }
        };
        let Said { number, array, next, fresh, known, part, .. } = said;
        let Some(kind) = kind else {
            let is_got = decision.unwrap_or(false);
            let (Some(known), Some(fresh)) = (known, fresh.or((!is_got).then_some(false))) else {
                return Some(malformed("a message is no event"));
            };
            let events = track.events.len();
            track.decisions.push(Decision { time_ns, is_got, object, part, bits: number, known, fresh, events });
            return Some(in_order(track));
        };
        track.events.push(Event { time_ns, kind, object, number, array, next, fresh });
        Some(in_order(track))
    }
}

/// Refuses an instant that lies before the one that was recorded last.
fn in_order(track: &Track) -> Result<(), Malformed> {
    match track.disorder(track.events.len().saturating_sub(1)) {
        Some(words) => malformed(format!("time goes back: {words}")),
        None => Ok(()),
    }
}

/// Takes over what the head says of a task: its period, offset and deadline, and the data that wake it.
fn time(timing: &BTreeMap<String, String>, track: &mut Track) -> Result<(), Malformed> {
    let of = |what: &str| timing.get(&format!("{what} {}", track.task));
    let stated = [of("period_ns"), of("offset_ns"), of("deadline_ns")];
    if stated.iter().any(Option::is_some) {
        let number = |text: Option<&String>| text.and_then(|text| text.parse::<i64>().ok());
        let [Some(period_ns @ 1..), Some(offset_ns), Some(deadline_ns)] = stated.map(number) else {
            return malformed(format!("it does not say the period, offset and deadline of {} in numbers", track.task));
        };
        track.rhythm = Some(Rhythm { period_ns, offset_ns, deadline_ns });
    }
    if let Some(text) = of("awaits") {
        let Some(awaits) = Awaited::read(text) else {
            return malformed(format!("it does not say in names of channels what {} awaits", track.task));
        };
        track.awaits = Some(awaits);
    }
    Ok(())
}

/// Why the run ended early, if it did, as its end says.
fn failure(end: &BTreeMap<&str, &str>) -> Option<String> {
    let text = |key: &str| end.get(key).copied().unwrap_or_default();
    let how = match text("outcome") {
        "ended" => return None,
        "hung" => "hung",
        "faulted" => "failed",
        _ => return Some("the recording does not say that the run ended well".to_string()),
    };
    let reason = match text("reason") {
        "" => String::new(),
        reason => format!(": {reason}"),
    };
    Some(format!("task {} {how} in cycle {}{reason}", text("task"), text("cycle")))
}

#[cfg(test)]
mod tests;
