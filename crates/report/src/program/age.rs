//! How old data are when they are read.
//!
//! In: a recording. Out: for each channel the [`ChannelAge`]: for every reading that finds a datum, new or seen before,
//! the time since its producer began to write it, or sent it. INVARIANT: a datum is known by channel and number.

use std::collections::BTreeMap;

use recording::{Kind, Recording};

use crate::program::{ChannelAge, length};

/// Ages by channel. Channels that no task reads have none.
pub(super) fn channels(recording: &Recording) -> Vec<ChannelAge> {
    let mut written: BTreeMap<(&str, u64), i64> = BTreeMap::new();
    let mut producers: BTreeMap<&str, &str> = BTreeMap::new();
    for track in &recording.tracks {
        for event in &track.events {
            if matches!(event.kind, Kind::Writes | Kind::Sends | Kind::Stores) {
                // If a writing begins again because the datum before was not handed over, the datum keeps its number.
                written.insert((&event.object, event.number), recording.instant_ns(event));
                producers.insert(&event.object, &track.task);
            }
        }
    }
    let mut found: Vec<ChannelAge> = Vec::new();
    for track in &recording.tracks {
        for event in &track.events {
            if event.number == 0 || !matches!(event.kind, Kind::Reads | Kind::Takes | Kind::Loads) {
                continue;
            }
            let Some(since_ns) = written.get(&(event.object.as_ref(), event.number)) else { continue };
            let at = found.iter().position(|channel| channel.name == *event.object).unwrap_or_else(|| {
                found.push(ChannelAge {
                    name: event.object.to_string(),
                    from: producers.get(event.object.as_ref()).copied().unwrap_or_default().to_owned(),
                    to: track.task.clone(),
                    ..ChannelAge::default()
                });
                found.len() - 1
            });
            let time_ns = recording.instant_ns(event);
            found[at].ages.add(length(*since_ns, time_ns), time_ns.max(0) as u64);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use recording::{Event, Track};

    use super::*;

    #[test]
    fn a_datum_ages_from_the_begin_of_its_writing() {
        let event = |time_ns, kind, number| Event { time_ns, kind, object: "c".into(), number, ..Event::default() };
        let track = |task: &str, events| Track { task: task.into(), events, ..Track::default() };
        let recording = Recording {
            tracks: vec![
                // The second one was begun twice.
                track("p", vec![event(10, Kind::Writes, 1), event(30, Kind::Writes, 2), event(34, Kind::Writes, 2)]),
                track(
                    "q",
                    vec![
                        event(5, Kind::Reads, 0),
                        event(13, Kind::Reads, 1),
                        event(25, Kind::Reads, 1),
                        event(40, Kind::Reads, 2),
                    ],
                ),
            ],
            ..Recording::default()
        };
        let channels = channels(&recording);
        assert_eq!((channels.len(), channels[0].from.as_str(), channels[0].to.as_str()), (1, "p", "q"));
        let ages: Vec<_> = channels[0].ages.counts().iter().map(|(ns, n)| (*ns, *n)).collect();
        assert_eq!(ages, [(3, 1), (6, 1), (15, 1)]);
        assert_eq!(channels[0].ages.percentile(50), Some(6));
        assert_eq!(channels[0].ages.greatest(), Some((15, 25)));
    }
}
