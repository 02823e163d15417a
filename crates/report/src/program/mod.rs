//! What a running program did, ready to be shown: its tasks' timing, the age of data, the result of a closed loop.
//!
//! In: a [`Recording`] of its events ([`ProgramRun::of`]), and data that a shell adds: the verdict on them, what the
//! controlled world did ([`ClosedLoop`]). Out: plain data, which [`render_program`](crate::render_program) shows. All
//! lengths of time are in nanoseconds and exact.

mod age;
mod gantt;
mod timing;

use recording::{Bounded, Greatest, Recording};

use crate::report::{Fact, Report};
use crate::svg::show_ns;
use crate::tally::Tally;
use crate::time::count;

/// Everything a page of a program shows: one or more runs of it, the first one in detail.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// The title.
    pub title: String,
    /// A sentence or two below it.
    pub note: String,
    /// The model that the runs are held to.
    pub model: String,
    /// The runs.
    pub runs: Vec<ProgramRun>,
    /// Versions, files.
    pub facts: Vec<Fact>,
}

/// One run.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramRun {
    /// What tells it from the others: `virtual time`.
    pub name: String,
    /// How long it was.
    pub span_ns: u64,
    /// How many events were recorded.
    pub events: u64,
    /// Events are missing from it.
    pub lossy: bool,
    /// The tasks, in the order of the system.
    pub tasks: Vec<TaskTiming>,
    /// The channels, in the order in which they are first read.
    pub channels: Vec<ChannelAge>,
    /// What the program counted of the bounds of its chart.
    pub bounds: Vec<Bounded>,
    /// What each task did at each moment, as lanes.
    pub lanes: Report,
    /// Whether its events are those of a run of the model. Added by the shell.
    pub verdict: Option<Held>,
    /// What it controlled. Added by the shell.
    pub closed_loop: Option<ClosedLoop>,
}

/// How a recording compares with the model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Held {
    /// True: it conforms. False: the two differ. None: not known.
    pub conforms: Option<bool>,
    /// In a sentence.
    pub words: String,
    /// What a run that conforms has all the same, or what was not looked at; a sentence each.
    pub beside: Vec<String>,
}

/// When a task did its cycles.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TaskTiming {
    /// Its name.
    pub name: String,
    /// Its period; none: it is asynchronous.
    pub period_ns: Option<u64>,
    /// The channel that wakes it.
    pub awaits: Option<String>,
    /// Cycles that began.
    pub activations: u64,
    /// Cycles done in time; none: it has no deadline.
    pub met: Option<u64>,
    /// Cycles done too late.
    pub missed: Option<u64>,
    /// Accesses given up by the watchdog.
    pub skips: u64,
    /// From when a cycle was due (or began, if nothing says when it was due) to its end.
    pub responses: Tally,
    /// From when a cycle was due, or its data were there while the task rested, to its beginning.
    pub wake_ups: Tally,
}

/// How old the data of a channel were when they were read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ChannelAge {
    /// Its name.
    pub name: String,
    /// Who writes.
    pub from: String,
    /// Who reads.
    pub to: String,
    /// From the beginning of a datum's writing to each of its readings.
    pub ages: Tally,
}

/// What a controller did to its world.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ClosedLoop {
    /// How it ended, in a sentence.
    pub end: String,
    /// Whether the last goal was reached, or the required reaction happened instead; none: that is not judged.
    pub reached: Option<bool>,
    /// Width and height of an image in pixels.
    pub image: (f64, f64),
    /// When each goal was sent, in seconds.
    pub goals_s: Vec<f64>,
    /// Below this error a goal is reached.
    pub bound: Option<f64>,
    /// The norm of the features' error: seconds, and the error if there is one.
    pub error: Vec<(f64, Option<f64>)>,
    /// What the camera saw.
    pub views: Vec<View>,
    /// The joints.
    pub joints: Vec<Joint>,
    /// How old the image was from which the task's data came.
    pub image_ages: Vec<(String, Tally)>,
}

/// A picture that the program drew.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct View {
    /// The bytes of a PNG.
    pub png: Vec<u8>,
    /// What it shows.
    pub caption: String,
}

/// A joint over time: seconds and radians.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Where it was to be.
    pub set: Vec<(f64, f64)>,
    /// Where it was.
    pub measured: Vec<(f64, f64)>,
}

/// The greatest value of something that is bounded, in words.
pub(crate) fn show_greatest(bound: &Bounded) -> String {
    match (bound.seen, bound.greatest) {
        (0, _) => "-".to_string(),
        (_, Greatest::Time(ns)) => show_ns(ns),
        (_, Greatest::Number(number)) => count(number),
    }
}

impl ProgramRun {
    /// The figures of a recording.
    pub fn of(name: impl Into<String>, recording: &Recording) -> ProgramRun {
        let last = recording.tracks.iter().filter_map(|track| track.events.last()).map(|event| event.time_ns).max();
        let span_ns = recording.stopped_ns.or(last).map_or(0, |ns| ns.max(0) as u64);
        let tasks: Vec<TaskTiming> = timing::tasks(recording);
        ProgramRun {
            name: name.into(),
            span_ns,
            events: recording.events() as u64,
            lossy: !recording.is_whole(),
            channels: age::channels(recording),
            bounds: recording.bounds.clone(),
            lanes: gantt::lanes(recording, &tasks, span_ns),
            tasks,
            verdict: None,
            closed_loop: None,
        }
    }

    /// What the program counted outside the bounds of its chart, in a sentence; none if nothing was.
    pub(crate) fn outside(&self) -> Option<String> {
        let outside: Vec<&Bounded> = self.bounds.iter().filter(|bound| bound.outside() > 0).collect();
        let told = outside.iter().map(|bound| {
            format!("{} {}: outside {} of {} times", bound.what, bound.limit, count(bound.outside()), count(bound.seen))
        });
        (!outside.is_empty())
            .then(|| format!("not all is within the chart's bounds: {}", told.collect::<Vec<_>>().join("; ")))
    }

    /// How long it was, in words; for a long run, without the part of a cycle that is left over at the end.
    pub(crate) fn span(&self) -> String {
        const TENTH_NS: u64 = 100_000_000;
        let exact = self.span_ns < 10 * TENTH_NS;
        show_ns(if exact { self.span_ns } else { (self.span_ns + TENTH_NS / 2) / TENTH_NS * TENTH_NS })
    }
}

impl Program {
    /// What went wrong, one sentence each; none: the runs are as they should be.
    pub fn troubles(&self) -> Vec<String> {
        let mut troubles = Vec::new();
        for run in &self.runs {
            if let Some(held) = run.verdict.as_ref().filter(|held| held.conforms == Some(false)) {
                troubles.push(format!("{}: {}", run.name, held.words));
            }
            if let Some(world) = run.closed_loop.as_ref().filter(|world| world.reached == Some(false)) {
                troubles.push(format!("{}: {}", run.name, world.end));
            }
        }
        troubles
    }
}

/// Text for a run whose recording is not whole.
pub(crate) const LOSSY: &str = "events are missing in the recording; the figures are of those before";

/// A length of time that is no negative one.
fn length(from_ns: i64, to_ns: i64) -> u64 {
    u64::try_from(to_ns.saturating_sub(from_ns)).unwrap_or(0)
}
