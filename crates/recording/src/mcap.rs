//! MCAP bytes → events, task by task.
//!
//! Reads what `cpp/include/groundstate/recorder.hpp` writes: records and uncompressed chunks, from the front, so that a
//! file that ends early gives all that came before. INVARIANT: the events of a track are in the task's order without a
//! gap; what comes after a lost event is left out, and the track says so.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::{Event, Recording, Rhythm, Track};

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

/// A recording on its way.
#[derive(Default)]
struct Reader {
    recording: Recording,
    channels: BTreeMap<u64, usize>,
    /// What is said of the tasks before they are named.
    timing: BTreeMap<String, String>,
}

impl Recording {
    /// Reads the bytes of an MCAP file.
    ///
    /// # Errors
    /// It is none, or none of a generated program.
    pub fn read(bytes: &[u8]) -> Result<Recording, Malformed> {
        let mut cursor = Cursor(bytes.strip_prefix(MAGIC).ok_or(Malformed("it is no MCAP file".to_string()))?);
        let mut reader = Reader::default();
        while let Some((code, content)) = cursor.record() {
            // Behind the end of the data everything is said again.
            if code == 0x0f {
                break;
            }
            reader.record(code, content)?;
        }
        let Reader { recording, .. } = reader;
        if recording.tick_ns <= 0 {
            return Err(Malformed("it is not the recording of a generated program".to_string()));
        }
        Ok(recording)
    }
}

impl Reader {
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
                while let Some((code, content)) = cursor.record() {
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
            "end" => {
                recording.stopped_ns = text("stopped_ns").parse().ok();
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
        let track = &mut self.recording.tracks[*track];
        let Ok(Value::Object(fields)) = serde_json::from_slice::<Value>(cursor.0) else {
            return Some(Err(Malformed("a message is no JSON object".to_string())));
        };
        let number = |key: &str| fields.get(key).and_then(Value::as_u64);
        let text = |key: &str| fields.get(key).and_then(Value::as_str).unwrap_or_default().to_string();
        if track.lost || number("order") != Some(track.events.len() as u64) {
            track.lost = true;
            return Some(Ok(()));
        }
        track.events.push(Event {
            time_ns,
            kind: text("kind"),
            object: text("object"),
            number: number("number").unwrap_or(0),
            array: number("array"),
            next: number("next"),
            fresh: fields.get("fresh").and_then(Value::as_bool),
        });
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
