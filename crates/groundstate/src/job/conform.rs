//! Compares a running program with its model, as a job.
//!
//! In: a loaded model, and a recording, or a [`Tail`] that reads it while the program writes it. Out: progress; at the
//! end a verdict, and a verdict at once where the two differ.

use std::io;
use std::sync::Arc;

use conform::{Access, Event, Kind, Malformed, Open, Reader, Recording, Refusal, Session, Track, Verdict, Way};
use machine::Limits;
use syntax::Sources;

use crate::Loaded;
use crate::job::{Cancel, Job};

/// A recording that is still being written.
pub trait Tail {
    /// Why it cannot be read.
    type Trouble;

    /// The next bytes. If there are none yet, waits a moment at most.
    ///
    /// # Errors
    /// The recording cannot be read.
    fn next(&mut self) -> Result<Piece, Self::Trouble>;
}

/// The next bytes of a recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Piece {
    /// The bytes.
    pub bytes: Vec<u8>,
    /// The program has not written more yet.
    pub is_all: bool,
}

/// For a complete recording, which nobody writes to.
#[derive(Debug, Clone, Copy)]
pub enum NoTail {}

impl Tail for NoTail {
    type Trouble = NoTail;

    fn next(&mut self) -> Result<Piece, NoTail> {
        match *self {}
    }
}

/// The events to compare with the model.
#[derive(Debug)]
pub enum Events<T> {
    /// All events are there. If cancelled, the verdict is unknown from some event on.
    Whole(Recording),
    /// More events are still coming.
    Coming(T),
}

/// A comparison to make.
#[derive(Debug)]
pub struct ConformRequest<T> {
    /// The ground model.
    pub loaded: Loaded,
    /// What the program did.
    pub events: Events<T>,
    /// The machine's limits.
    pub limits: Limits,
    /// Compare only the order of events, even if the recording follows the model's ticks.
    pub by_order: bool,
}

/// The progress of a comparison.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ConformEvent {
    /// No event has come yet.
    Awaits,
    /// Program and model agree so far.
    Agrees(Agreed),
}

/// How far program and model agree, and what the program does now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Agreed {
    /// How far, and which tasks have been silent for long.
    pub words: String,
    /// How many events agree.
    pub events: usize,
    /// The instant of the newest event that was read; it may not have been compared yet.
    pub time_ns: i64,
    /// What each task did last, as it was recorded.
    pub tasks: Vec<LastPhase>,
}

/// The phase that a task began last.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LastPhase {
    /// The task.
    pub task: String,
    /// The phase; none if it has begun none.
    pub phase: Option<String>,
    /// When it began.
    pub began_ns: i64,
    /// It has ended.
    pub is_over: bool,
}

impl LastPhase {
    fn of(track: &Track) -> LastPhase {
        let event = |kind| track.events.iter().rposition(|event: &Event| event.kind == kind);
        let (begins, ends) = (event(Kind::Begins), event(Kind::Ends));
        let began = begins.map(|at| &track.events[at]);
        LastPhase {
            task: track.task.clone(),
            phase: began.map(|event| event.object.to_string()),
            began_ns: began.map_or(0, |event| event.time_ns),
            is_over: begins < ends,
        }
    }
}

impl Agreed {
    fn new(session: &Session, recording: &Recording) -> Agreed {
        let newest = recording.tracks.iter().filter_map(|track| track.events.last());
        Agreed {
            words: session.progress(recording),
            events: session.agreed(),
            time_ns: newest.map(|event| event.time_ns).max().unwrap_or(0),
            tasks: recording.tracks.iter().map(LastPhase::of).collect(),
        }
    }
}

/// The result of a comparison.
#[derive(Debug)]
pub struct Conformed {
    /// The texts that places of the verdict point into.
    pub sources: Sources,
    /// All that was recorded.
    pub recording: Recording,
    /// The verdict.
    pub verdict: Verdict,
    /// How the two were compared.
    pub way: Way,
    /// How many decisions of components' machines agree; none if no component has one.
    pub decisions: Option<usize>,
    /// How often each task accessed its channels, and how often it did not.
    pub accesses: Vec<Access>,
    /// What was not compared of the bounds that the chart states.
    pub bounds: Open,
    /// What the model says of its tasks and the recording does not, each as a phrase.
    pub unsaid: Vec<String>,
}

impl Conformed {
    fn new(session: &Session, recording: Recording, verdict: Verdict) -> Result<Conformed, Refusal> {
        Ok(Conformed {
            sources: session.sources().clone(),
            way: session.way(),
            decisions: session.decisions(),
            accesses: session.accesses(&recording),
            bounds: session.bounds(&recording)?,
            unsaid: session.unsaid(&recording),
            recording,
            verdict,
        })
    }
}

/// Why there is no verdict.
#[derive(Debug)]
pub enum NotConformed<X> {
    /// The recording cannot be read.
    Unread(X),
    /// It is damaged.
    Malformed(Malformed),
    /// It cannot be compared with the model.
    Refused(Refusal),
    /// The job was cancelled before the first event came.
    NoEvents,
}

/// A comparison. After it is cancelled, one that reads along compares what has been written so far, then ends.
pub type ConformJob<X> = Job<ConformEvent, Result<Conformed, NotConformed<X>>>;

/// Starts a comparison.
///
/// # Errors
/// The system cannot start a thread.
pub fn conform<T>(request: ConformRequest<T>, cancel: Cancel) -> io::Result<ConformJob<T::Trouble>>
where
    T: Tail + Send + 'static,
    T::Trouble: Send + 'static,
{
    let asked = cancel.clone();
    Job::start("conform", cancel, move |port| follow(request, &asked, &mut |event| port.mention(event)))
}

fn follow<T: Tail>(
    request: ConformRequest<T>,
    cancel: &Cancel,
    tell: &mut dyn FnMut(ConformEvent),
) -> Result<Conformed, NotConformed<T::Trouble>> {
    let ConformRequest { loaded: Loaded { sources, model, program, .. }, events, limits, by_order } = request;
    let (model, program) = (Arc::unwrap_or_clone(model), Arc::unwrap_or_clone(program));
    let begin =
        |head: &Recording| Session::new(sources, model, program, limits, head, by_order).map_err(NotConformed::Refused);
    let mut tail = match events {
        Events::Coming(tail) => tail,
        Events::Whole(recording) => {
            let mut session = begin(&recording)?;
            session.heed(cancel.interrupt().clone());
            let verdict = session.go_on(&recording, false).map_err(NotConformed::Refused)?;
            let Some(verdict) = verdict else { unreachable!("nothing more comes") };
            return Conformed::new(&session, recording, verdict).map_err(NotConformed::Refused);
        }
    };
    let mut begin = Some(begin);
    let mut reader = Reader::default();
    let mut replay: Option<Session> = None;
    loop {
        // Cancellation is read before the last look, so that everything written until then is compared.
        let asked = cancel.is_cancelled();
        let Piece { bytes, is_all } = tail.next().map_err(NotConformed::Unread)?;
        let stops = asked && is_all;
        reader.feed(&bytes).map_err(NotConformed::Malformed)?;
        let recording = reader.recording();
        let more = !reader.has_ended() && !stops;
        // The recording's head is complete once the first event is there.
        if recording.events() > 0 || reader.has_ended() {
            if let Some(begin) = begin.take() {
                replay = Some(begin(recording)?);
            }
            let Some(session) = &mut replay else { unreachable!("it was begun above") };
            match session.go_on(recording, more).map_err(NotConformed::Refused)? {
                Some(verdict) => {
                    let verdict = if stops { verdict.left() } else { verdict };
                    return Conformed::new(session, recording.clone(), verdict).map_err(NotConformed::Refused);
                }
                None => tell(ConformEvent::Agrees(Agreed::new(session, recording))),
            }
        } else if stops {
            return Err(NotConformed::NoEvents);
        } else {
            tell(ConformEvent::Awaits);
        }
    }
}
