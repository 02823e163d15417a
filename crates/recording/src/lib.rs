//! What a running program recorded: the events of its tasks, and when their cycles were due.
//!
//! In: the bytes of an MCAP file, whole ([`Recording::read`]) or as they are written ([`Reader`]). Out: a
//! [`Recording`], with a track of events for each task, as spec/conform.md lists them. It must not know what the events
//! are compared with, nor how they are shown.

mod checksum;
mod event;
mod mcap;

pub use event::{Decision, Event, Kind};
pub use mcap::{Malformed, Reader};

/// When the cycles of a synchronous task are due: at the offset, and a period after another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rhythm {
    /// From one cycle to the next.
    pub period_ns: i64,
    /// Of the first one, from the origin of the run.
    pub offset_ns: i64,
    /// The time from when a cycle is due to when it must be done.
    pub deadline_ns: i64,
}

/// The data that wake an asynchronous task.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Awaited {
    /// The channels.
    pub channels: Vec<String>,
    /// Whether a cycle needs something new on each of them; otherwise on one.
    pub all: bool,
}

impl Awaited {
    /// As a recording says it: the name of a channel, or `all` or `any` before several.
    pub fn read(text: &str) -> Option<Awaited> {
        let (quantifier, names) = match text.split_once(' ') {
            Some((quantifier @ ("all" | "any"), names)) => (quantifier, names),
            _ => ("all", text),
        };
        let channels: Vec<String> = names.split(',').map(|name| name.trim().to_string()).collect();
        let are_names = channels.iter().all(|name| !name.is_empty() && !name.contains(' '));
        (are_names && (channels.len() > 1) == (names != text)).then(|| Awaited { channels, all: quantifier == "all" })
    }
}

impl std::fmt::Display for Awaited {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let quantifier = match (self.channels.len(), self.all) {
            (..=1, _) => "",
            (_, true) => "all ",
            (_, false) => "any ",
        };
        write!(f, "{quantifier}{}", self.channels.join(", "))
    }
}

/// The events of one task.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Track {
    /// The component.
    pub task: String,
    /// For a synchronous task, if the recording gives it.
    pub rhythm: Option<Rhythm>,
    /// What wakes an asynchronous task; none: it awaits nothing, or the recording does not say.
    pub awaits: Option<Awaited>,
    /// Its events, in order.
    pub events: Vec<Event>,
    /// What its machine got and decided, in order: apart from the events, since neither has an instant in the model.
    pub decisions: Vec<Decision>,
    /// An event after these was lost.
    pub lost: bool,
}

impl Track {
    /// What of the order of these events, from that one on, and of the decisions among them no run can have: an instant before the run
    /// began, or before the one of the event or the decision before.
    pub fn disorder(&self, from: usize) -> Option<String> {
        let from = from.min(self.events.len());
        let mut decisions =
            self.decisions[self.decisions.partition_point(|decision| decision.events < from)..].iter().peekable();
        let mut before_ns = self.events[..from].last().map(|event| event.time_ns);
        let mut goes_back = |what: &dyn Fn() -> String, time_ns: i64| {
            let ms = |time_ns: i64| format!("{:.4} ms", time_ns as f64 / 1e6);
            match before_ns.replace(time_ns) {
                Some(last_ns) if time_ns < last_ns => {
                    Some(format!("{} is at {}, the event before it at {}", what(), ms(time_ns), ms(last_ns)))
                }
                None if time_ns < 0 => Some(format!("{} is at {}, before the run began", what(), ms(time_ns))),
                _ => None,
            }
        };
        for order in from..=self.events.len() {
            while let Some(decision) = decisions.next_if(|decision| decision.events <= order) {
                let words = goes_back(&|| format!("what {} {}", self.task, decision.words()), decision.time_ns);
                if words.is_some() {
                    return words;
                }
            }
            if let Some(event) = self.events.get(order) {
                let words = goes_back(&|| format!("event {order} of {} ({})", self.task, event.words()), event.time_ns);
                if words.is_some() {
                    return words;
                }
            }
        }
        None
    }
}

/// What a program counted of a bound that its chart states.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Bounded {
    /// What is bounded, in words.
    pub what: String,
    /// The bound, as the chart has it.
    pub limit: String,
    /// How often it was looked at.
    pub seen: u64,
    /// Values below the least one.
    pub below: u64,
    /// Values beyond the greatest one.
    pub beyond: u64,
    /// The greatest value.
    pub greatest: Greatest,
}

impl Bounded {
    /// How often it was not kept.
    pub fn outside(&self) -> u64 {
        self.below.saturating_add(self.beyond)
    }
}

/// The greatest value of something that is bounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Greatest {
    /// A length of time, in nanoseconds.
    Time(u64),
    /// How many.
    Number(u64),
}

impl Default for Greatest {
    fn default() -> Greatest {
        Greatest::Number(0)
    }
}

/// The events of a run.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Recording {
    /// One a task.
    pub tracks: Vec<Track>,
    /// The system's name.
    pub system: String,
    /// The length of a tick of the model.
    pub tick_ns: i64,
    /// `modelled`, `drawn` or `real`.
    pub pace: String,
    /// Channels that do not follow the model's protocol.
    pub wait_free: Vec<String>,
    /// When the tasks were asked to stop; none if the log ends before.
    pub stopped_ns: Option<i64>,
    /// What the program counted of the bounds of its chart; known once the log is written to its end.
    pub bounds: Vec<Bounded>,
    /// Why the run ended early, in words, if a task failed or hung; known once the log is written to its end.
    pub failure: Option<String>,
    /// The file is there to its end, and says there how the run ended.
    pub ended: bool,
    /// All events before this instant have been read.
    pub horizon_ns: Option<i64>,
}

impl Recording {
    /// Whether all that happened was recorded.
    pub fn is_whole(&self) -> bool {
        self.ended && self.stopped_ns.is_some() && self.tracks.iter().all(|track| !track.lost)
    }

    /// How many events there are.
    pub fn events(&self) -> usize {
        self.tracks.iter().map(|track| track.events.len()).sum()
    }

    /// When something happened, as far as that means anything: if the pace is the model's, what happens within a tick
    /// has no order, and parts of it tell nothing.
    pub fn instant_ns(&self, event: &Event) -> i64 {
        match self.pace == "modelled" && self.tick_ns > 0 {
            true => event.time_ns - event.time_ns.rem_euclid(self.tick_ns),
            false => event.time_ns,
        }
    }

    /// The instant from which on something is missing, or is still to come.
    pub fn known_until_ns(&self) -> Option<i64> {
        if self.is_whole() {
            return None;
        }
        let last = |track: &Track| track.events.last().map_or(0, |event| event.time_ns);
        let lost = self.tracks.iter().filter(|track| track.lost).map(last).min();
        lost.or(self.covered_until_ns().max(self.horizon_ns))
    }

    /// Up to when each task is known by an event of its own: the writer goes from task to task, so what it had of all may
    /// end earlier than the last.
    pub fn covered_until_ns(&self) -> Option<i64> {
        self.tracks.iter().map(|track| track.events.last().map_or(0, |event| event.time_ns)).min()
    }
}
