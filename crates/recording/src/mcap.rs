//! MCAP bytes → events, task by task.
//!
//! Reads what `cpp/include/groundstate/recorder.hpp` writes: records and uncompressed chunks, from the front, so that a
//! file that ends early gives all that came before. INVARIANT: the events of a track are in the task's order without a
//! gap; what comes after a lost event is left out, and the track says so.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::Deserialize;

use crate::{Event, Kind, Recording, Rhythm, Track};

/// What is wrong with a file that is no recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Malformed(pub String);

const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// Reads numbers and texts of a record; none behind its end.
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
    #[serde(default)]
    number: u64,
    array: Option<u64>,
    next: Option<u64>,
    fresh: Option<bool>,
}

/// Reads a file that may still be written: whatever comes, in pieces of any size.
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
    began: bool,
    ended: bool,
}

impl Recording {
    /// Reads the bytes of an MCAP file.
    ///
    /// # Errors
    /// It is none, or none of a generated program.
    pub fn read(bytes: &[u8]) -> Result<Recording, Malformed> {
        let mut reader = Reader::default();
        reader.feed(bytes)?;
        if !reader.began {
            return Err(Malformed("it is no MCAP file".to_string()));
        }
        if reader.recording.tick_ns <= 0 {
            return Err(Malformed("it is not the recording of a generated program".to_string()));
        }
        Ok(reader.recording)
    }
}

impl Reader {
    /// Reads on.
    ///
    /// # Errors
    /// It is no MCAP file, or none of a generated program.
    pub fn feed(&mut self, bytes: &[u8]) -> Result<(), Malformed> {
        // A file that is read whole is not copied.
        let mut all = Cow::Borrowed(bytes);
        if !self.rest.is_empty() {
            let mut begun = std::mem::take(&mut self.rest);
            begun.extend_from_slice(bytes);
            all = Cow::Owned(begun);
        }
        let mut cursor = Cursor(&all);
        if !self.began {
            if all.len() < MAGIC.len() && MAGIC.starts_with(&all) {
                self.rest = all.into_owned();
                return Ok(());
            }
            cursor = Cursor(all.strip_prefix(MAGIC).ok_or(Malformed("it is no MCAP file".to_string()))?);
            self.began = true;
        }
        // Behind the end of the data everything is said again.
        while !self.ended
            && let Some((code, content)) = cursor.record()
        {
            if code == 0x0f {
                self.ended = true;
            } else {
                self.record(code, content)?;
            }
        }
        if !self.ended {
            self.rest = cursor.0.to_vec();
        }
        Ok(())
    }

    /// What has come so far: the run's head first, then its events.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Whether the end of the data has come, behind which is nothing new.
    pub fn has_ended(&self) -> bool {
        self.ended
    }

    fn record(&mut self, code: u8, content: &[u8]) -> Result<(), Malformed> {
        let short = || Malformed("a record is shorter than it says".to_string());
        let mut cursor = Cursor(content);
        match code {
            0x04 => {
                let id = cursor.number::<2>().ok_or_else(short)?;
                cursor.number::<2>();
                let topic = cursor.text().ok_or_else(short)?;
                self.channels.insert(id, self.recording.tracks.len());
                let task = topic.trim_start_matches('/').to_string();
                let (rhythm, awaits) = (self.rhythm(&task), self.timing.get(&format!("awaits {task}")).cloned());
                self.recording.tracks.push(Track { task, rhythm, awaits, ..Track::default() });
            }
            0x05 => self.message(&mut cursor).ok_or_else(short)??,
            0x06 => {
                cursor.bytes(28);
                if !cursor.text().ok_or_else(short)?.is_empty() {
                    return Err(Malformed("its chunks are compressed; `mcap` can write them anew without".to_string()));
                }
                cursor.number::<8>();
                // A chunk holds no chunks.
                while let Some((code, content)) = cursor.record().filter(|(code, _)| *code != 0x06) {
                    self.record(code, content)?;
                }
            }
            0x0c => {
                let name = cursor.text().ok_or_else(short)?;
                let mut map = Cursor(cursor.text().ok_or_else(short)?.as_bytes());
                let mut values = BTreeMap::new();
                while let (Some(key), Some(value)) = (map.text(), map.text()) {
                    values.insert(key, value);
                }
                self.about(name, &values);
            }
            0x80 => self.recording.horizon_ns = Some(cursor.number::<8>().ok_or_else(short)? as i64),
            _ => {}
        }
        Ok(())
    }

    fn rhythm(&self, task: &str) -> Option<Rhythm> {
        let number = |what: &str| self.timing.get(&format!("{what} {task}")).and_then(|text| text.parse().ok());
        let (period_ns, offset_ns) = (number("period_ns").filter(|period| *period > 0)?, number("offset_ns")?);
        Some(Rhythm { period_ns, offset_ns, deadline_ns: number("deadline_ns")? })
    }

    fn about(&mut self, name: &str, values: &BTreeMap<&str, &str>) {
        let recording = &mut self.recording;
        let text = |key: &str| values.get(key).copied().unwrap_or_default();
        match name {
            "groundstate" => {
                recording.system = text("system").to_string();
                recording.tick_ns = text("tick_ns").parse().unwrap_or(0);
                recording.pace = text("pace").to_string();
                recording.wait_free = text("wait_free").split_whitespace().map(str::to_string).collect();
                self.timing = values.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
            }
            // Told before any event of a task that was asked to stop.
            "stop" => recording.stopped_ns = text("stopped_ns").parse().ok(),
            "end" => {
                recording.stopped_ns = text("stopped_ns").parse().ok();
                recording.ended = true;
                for track in &mut recording.tracks {
                    let all: usize = text(&format!("events {}", track.task)).parse().unwrap_or(usize::MAX);
                    track.lost |= all != track.events.len();
                }
            }
            _ => {}
        }
    }

    fn message(&mut self, cursor: &mut Cursor<'_>) -> Option<Result<(), Malformed>> {
        let channel = cursor.number::<2>()?;
        cursor.number::<4>()?;
        let time_ns = cursor.number::<8>()? as i64;
        cursor.number::<8>()?;
        let Some(track) = self.channels.get(&channel) else {
            return Some(Err(Malformed("a message has no channel".to_string())));
        };
        // What comes behind the horizon after all is lost for who has gone on.
        let late = self.recording.horizon_ns.is_some_and(|horizon| time_ns < horizon);
        let track = &mut self.recording.tracks[*track];
        let Ok(said) = serde_json::from_slice::<Said<'_>>(cursor.0) else {
            return Some(Err(Malformed("a message is no event".to_string())));
        };
        if track.lost || late || said.order != track.events.len() as u64 {
            track.lost = true;
            return Some(Ok(()));
        }
        let Some(kind) = Kind::of(&said.kind) else {
            return Some(Err(Malformed(format!("an event is of no known kind: `{}`", said.kind))));
        };
        let object = match self.objects.get(said.object.as_ref()) {
            Some(known) => Arc::clone(known),
            None => {
                let object: Arc<str> = said.object.into();
                self.objects.insert(Arc::clone(&object));
                object
            }
        };
        let Said { number, array, next, fresh, .. } = said;
        track.events.push(Event { time_ns, kind, object, number, array, next, fresh });
        Some(Ok(()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_recording_is_told() {
        let check = |bytes: &[u8], expect: &str| {
            assert_eq!(Recording::read(bytes), Err(Malformed(expect.to_string())));
        };
        check(b"", "it is no MCAP file");
        check(MAGIC, "it is not the recording of a generated program");
        check(b"\x89MCAP0\r\n\x05\x02\x00\x00\x00\x00\x00\x00\x00\x00\x00", "a record is shorter than it says");
    }

    #[test]
    fn pieces_of_any_size_say_what_the_whole_says() {
        let text = |text: &str| [&(text.len() as u32).to_le_bytes()[..], text.as_bytes()].concat();
        let record = |code: u8, content: &[u8]| [&[code][..], &(content.len() as u64).to_le_bytes(), content].concat();
        let map = |pairs: &[(&str, &str)]| {
            text(
                &pairs
                    .iter()
                    .map(|(key, value)| String::from_utf8([text(key), text(value)].concat()).expect("text"))
                    .collect::<String>(),
            )
        };
        let about = |name: &str, pairs: &[(&str, &str)]| record(0x0c, &[text(name), map(pairs)].concat());
        let channel = record(0x04, &[&[0; 4][..], &text("/task"), &text("json"), &[0; 4]].concat());
        let event = |order: u32, time_ns: u64| {
            let fields = format!("{{\"order\":{order},\"kind\":\"begins\",\"object\":\"p\",\"number\":1}}");
            record(0x05, &[&[0; 6][..], &time_ns.to_le_bytes(), &[0; 8], fields.as_bytes()].concat())
        };
        let inner = [event(0, 5), event(1, 9)].concat();
        let length = (inner.len() as u64).to_le_bytes();
        let chunk = record(0x06, &[&[0; 28][..], &text(""), &length, &inner].concat());
        let whole = [
            MAGIC,
            &about("groundstate", &[("tick_ns", "1000"), ("pace", "real")]),
            &channel,
            &chunk,
            &about("stop", &[("stopped_ns", "7")]),
            &about("end", &[("stopped_ns", "7"), ("events task", "2")]),
            &record(0x0f, &[0; 4]),
            &channel,
        ]
        .concat();
        let read = Recording::read(&whole).expect("a recording");
        assert_eq!((read.tracks[0].events.len(), read.stopped_ns, read.is_whole()), (2, Some(7), true));
        for size in [1, 7, 64] {
            let mut reader = Reader::default();
            for piece in whole.chunks(size) {
                assert!(!reader.recording().is_whole() || reader.recording() == &read);
                reader.feed(piece).expect("a piece");
            }
            assert!(reader.has_ended());
            assert_eq!(reader.recording(), &read);
        }
    }

    #[test]
    fn a_gap_in_the_order_ends_a_track() {
        let mut reader = Reader::default();
        reader.channels.insert(0, 0);
        reader.recording.tracks.push(Track::default());
        for order in [0, 1, 3, 4] {
            let mut content = vec![0; 22];
            content.extend(format!("{{\"order\":{order},\"kind\":\"begins\",\"object\":\"p\",\"number\":0}}").bytes());
            reader.record(0x05, &content).expect("a message");
        }
        assert_eq!((reader.recording.tracks[0].events.len(), reader.recording.tracks[0].lost), (2, true));
        assert!(!reader.recording.is_whole());
    }
}
