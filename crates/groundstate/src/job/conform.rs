//! Holding a running program to its model, as a job.
//!
//! In: a loaded model, and a recording, or a [`Tail`] that gives its bytes while the program writes it. Out: how far the two agree; at the
//! end a verdict, at once where they part.

use std::io;
use std::sync::Arc;

use conform::{Malformed, Reader, Recording, Refusal, Session, Verdict, Way};
use machine::Limits;
use syntax::Sources;

use crate::Loaded;
use crate::job::{Cancel, Job};

/// A recording that is being written.
pub trait Tail {
    /// Why it cannot be read.
    type Trouble;

    /// The next bytes; waits for them where none are there yet, a moment at most.
    ///
    /// # Errors
    /// It cannot be read.
    fn next(&mut self) -> Result<Piece, Self::Trouble>;
}

/// The next bytes of a recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Piece {
    /// The bytes.
    pub bytes: Vec<u8>,
    /// More have not been written yet.
    pub is_all: bool,
}

/// For a recording that is whole: nobody writes it.
#[derive(Debug, Clone, Copy)]
pub enum NoTail {}

impl Tail for NoTail {
    type Trouble = NoTail;

    fn next(&mut self) -> Result<Piece, NoTail> {
        match *self {}
    }
}

/// What is held to the model.
#[derive(Debug)]
pub enum Events<T> {
    /// All events are there. LIMIT: such a comparison goes on to its end, also where it is cancelled.
    Whole(Recording),
    /// They come.
    Coming(T),
}

/// The comparison that is wanted.
#[derive(Debug)]
pub struct ConformRequest<T> {
    /// The ground model.
    pub loaded: Loaded,
    /// What the program did.
    pub events: Events<T>,
    /// The machine's limits.
    pub limits: Limits,
    /// Compare the order of events alone, also where the recording follows the model's ticks.
    pub by_order: bool,
}

/// What a comparison tells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ConformEvent {
    /// No event has come yet.
    Awaits,
    /// The two agree so far; how far, and who has been silent for long.
    Agrees(String),
}

/// What it came to.
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
}

/// Why there is no verdict.
#[derive(Debug)]
pub enum NotConformed<X> {
    /// The recording cannot be read.
    Unread(X),
    /// It is damaged.
    Malformed(Malformed),
    /// It cannot be held to the model.
    Refused(Refusal),
    /// It was ended before the first event came.
    NoEvents,
}

/// A comparison. One that is cancelled looks at what is there, and at no more.
pub type ConformJob<X> = Job<ConformEvent, Result<Conformed, NotConformed<X>>>;

/// Starts a comparison.
///
/// # Errors
/// The system gives no thread.
pub fn conform<T>(request: ConformRequest<T>, cancel: Cancel) -> io::Result<ConformJob<T::Trouble>>
where
    T: Tail + Send + 'static,
    T::Trouble: Send + 'static,
{
    Job::start("conform", cancel, move |port| {
        follow(request, &|| port.is_cancelled(), &mut |event| port.mention(event))
    })
}

fn follow<T: Tail>(
    request: ConformRequest<T>,
    is_cancelled: &dyn Fn() -> bool,
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
            let verdict = session.go_on(&recording, false).map_err(NotConformed::Refused)?;
            let Some(verdict) = verdict else { unreachable!("nothing more comes") };
            return Ok(Conformed { sources: session.sources().clone(), recording, verdict, way: session.way() });
        }
    };
    let mut begin = Some(begin);
    let mut reader = Reader::default();
    let mut replay: Option<Session> = None;
    loop {
        // Asked before the last look, so that what was written till then is looked at.
        let asked = is_cancelled();
        let Piece { bytes, is_all } = tail.next().map_err(NotConformed::Unread)?;
        let stops = asked && is_all;
        reader.feed(&bytes).map_err(NotConformed::Malformed)?;
        let recording = reader.recording();
        let more = !reader.has_ended() && !stops;
        // The head stands before the first event.
        if recording.events() > 0 || reader.has_ended() {
            if let Some(begin) = begin.take() {
                replay = Some(begin(recording)?);
            }
            let Some(session) = &mut replay else { unreachable!("it was begun above") };
            match session.go_on(recording, more).map_err(NotConformed::Refused)? {
                Some(verdict) => {
                    let verdict = if stops { verdict.left() } else { verdict };
                    let (sources, way) = (session.sources().clone(), session.way());
                    return Ok(Conformed { sources, recording: recording.clone(), verdict, way });
                }
                None => tell(ConformEvent::Agrees(session.progress(recording))),
            }
        } else if stops {
            return Err(NotConformed::NoEvents);
        } else {
            tell(ConformEvent::Awaits);
        }
    }
}
