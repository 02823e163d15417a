//! Compares a recording with a model, from its head to its end, in the way that suits it.
//!
//! In: a checked model with its program, and a recording as far as it has come. Out: a [`Verdict`], at once if the run
//! is over, otherwise as soon as the two differ or the run ends. This module decides between the two ways, tick by tick
//! or by the order of events. It takes the first if the run follows the model's ticks, as long as no event comes that
//! is a matter of order alone.

use std::sync::Arc;

use machine::{Interrupt, Limits, Machine};
use model::Model;
use program::Program;
use syntax::Sources;

use crate::Verdict;
use crate::accesses::{self, Access};
use crate::bounds::{self, Modelled};
use crate::functions::Functions;
use crate::head::{contradiction, unsaid};
use crate::refusal::Refusal;
use crate::steps::Steps;
use crate::vocabulary::Vocabulary;
use crate::way::Way;
use crate::{timed, untimed};
use recording::{Kind, Recording, Track};

/// A replay on its way.
#[derive(Debug)]
pub struct Session {
    sources: Sources,
    steps: Steps,
    limits: Limits,
    replay: Replay,
    functions: Functions,
    /// The model as it is, in its initial state, and what is known of it.
    initial: (Machine, Vocabulary),
    /// The bounds that the model has.
    bounds: Vec<Modelled>,
    /// A difference that is reported once everything is known up to this instant.
    suspected_ns: Option<i64>,
    /// For each track, how many events are known not to go back in time.
    in_order: Vec<usize>,
    interrupt: Interrupt,
}

/// The event of an action may get its instant this long after the action: the task may be interrupted between the two.
const GRACE_NS: i64 = 1_000_000_000;

#[derive(Debug)]
enum Replay {
    Timed(Box<timed::Replay>),
    Untimed(Box<untimed::Replay>),
}

impl Replay {
    fn begin(limits: Limits, steps: &Steps, head: &Recording, by_order: bool) -> Result<Replay, String> {
        match head.pace.as_str() {
            "modelled" if !by_order => Ok(Replay::Timed(Box::new(timed::Replay::new(limits, steps)?))),
            "modelled" | "drawn" | "real" => Ok(Replay::Untimed(Box::new(untimed::Replay::new(limits, steps, head)?))),
            other => Err(format!("the recording is of no known pace: `{other}`")),
        }
    }
}

impl Session {
    /// Starts a replay for a recording whose head, its tasks and its pace, has come.
    ///
    /// # Errors
    /// The model cannot be replayed, or the recording is of another system.
    pub fn new(
        mut sources: Sources,
        mut model: Model,
        program: Program,
        limits: Limits,
        head: &Recording,
        by_order: bool,
    ) -> Result<Session, Refusal> {
        if head.tick_ns <= 0 {
            return Err("the recording does not say how long a tick is".to_string().into());
        }
        let mut machine = Machine::new(Arc::new(program.clone()), limits.clone());
        machine.start(&mut machine::Closed).map_err(|fault| fault.show(&program).to_string())?;
        let vocabulary = Vocabulary::new(&program, &machine)?;
        let is_none = |name: &&String| vocabulary.phases_on(&machine, name).is_empty();
        if let Some(name) = head.wait_free.iter().find(is_none) {
            let words = format!("the model has no channel {name}, which was generated wait-free");
            return Err(words.into());
        }
        if let Some(words) = contradiction(head, &machine, &vocabulary) {
            return Err(format!("the recording is of another system: {words}").into());
        }
        let bounds = bounds::modelled(&program, &machine, &vocabulary, head.tick_ns);
        let steps = Steps::new(&head.wait_free, &mut sources, &mut model, &vocabulary)?;
        let replay = Replay::begin(limits.clone(), &steps, head, by_order)?;
        let functions = Functions::new(limits.clone(), &steps)?;
        Ok(Session {
            sources,
            steps,
            limits,
            replay,
            functions,
            initial: (machine, vocabulary),
            bounds,
            suspected_ns: None,
            in_order: Vec::new(),
            interrupt: Interrupt::default(),
        })
    }

    /// How many decisions of components' machines agree; none if no component has one.
    pub fn decisions(&self) -> Option<usize> {
        self.steps.decisions().map(|_| self.functions.agreed())
    }

    /// How often each task accessed its channels in the recording, and how often it did not.
    pub fn accesses(&self, recording: &Recording) -> Vec<Access> {
        accesses::accesses(recording, &self.initial.0, &self.initial.1)
    }

    /// What the model says of its tasks, such as what one awaits, and the recording does not; each as a phrase.
    pub fn unsaid(&self, recording: &Recording) -> Vec<String> {
        unsaid(recording, &self.initial.0, &self.initial.1)
    }

    /// What was not compared of the bounds that recording and model state. The recording states its own at its end.
    ///
    /// # Errors
    /// The two have another bound: the recording is of another system. Or it says of one what cannot have been counted.
    pub fn bounds(&self, recording: &Recording) -> Result<bounds::Open, Refusal> {
        let compared = bounds::compare(recording, &self.bounds, &self.initial.1);
        let open = compared.map_err(|words| format!("the recording is of another system: {words}"))?;
        match bounds::contradiction(recording) {
            Some(words) => Err(format!("the end of the recording contradicts itself: {words}").into()),
            None => Ok(open),
        }
    }

    /// From now on, an interrupt ends the comparison within [`Session::go_on`]; the verdict is then unknown.
    pub fn heed(&mut self, interrupt: Interrupt) {
        self.interrupt = interrupt;
    }

    /// Begins anew, for another recording of the same system. Such recordings are short, so their steps are
    /// interpreted: compiling them would take longer.
    ///
    /// # Errors
    /// It cannot be replayed.
    pub fn begin_again(&mut self, head: &Recording, by_order: bool) -> Result<(), Refusal> {
        self.replay = Replay::begin(self.limits.clone(), &self.steps, head, by_order)?;
        self.functions = Functions::new(self.limits.clone(), &self.steps)?;
        match &mut self.replay {
            Replay::Timed(replay) => replay.interpret(),
            Replay::Untimed(replay) => replay.interpret(),
        }
        (self.suspected_ns, self.in_order) = (None, Vec::new());
        Ok(())
    }

    /// Goes on as far as the recording is known; none: it agrees so far, and `more` may come.
    ///
    /// # Errors
    /// The recording is of another system, or no run has its instants.
    pub fn go_on(&mut self, recording: &Recording, more: bool) -> Result<Option<Verdict>, Refusal> {
        self.in_order.resize(recording.tracks.len(), 0);
        for (track, known) in recording.tracks.iter().zip(&mut self.in_order) {
            if let Some(words) = track.disorder(*known) {
                return Err(format!("time goes back: {words}").into());
            }
            *known = track.events.len();
        }
        if recording.ended {
            self.bounds(recording)?;
        }
        // Nothing is known after a lost event.
        let more = more && recording.tracks.iter().all(|track| !track.lost);
        if let Some(parted) = self.functions.go_on(recording, more) {
            return Ok(Some(Verdict::Parts(Box::new(parted))));
        }
        let verdict = match &mut self.replay {
            Replay::Timed(replay) => replay.go_on(recording, more, &self.interrupt)?,
            Replay::Untimed(_) => return self.by_order(recording, more),
        };
        // An event for which the model has no word is a matter of order alone.
        let passed = |recording: &Recording| {
            recording.tracks.iter().flat_map(|track| &track.events).any(|event| event.kind == Kind::Passes)
        };
        let is_unknown = matches!(verdict, Some(Verdict::Unknown { .. })) && !self.interrupt.is_raised();
        if !(is_unknown && passed(recording)) {
            return Ok(verdict);
        }
        self.begin_by_order(recording)?;
        self.by_order(recording, more)
    }

    fn begin_by_order(&mut self, recording: &Recording) -> Result<(), Refusal> {
        let replay = untimed::Replay::new(self.limits.clone(), &self.steps, recording)?;
        self.replay = Replay::Untimed(Box::new(replay));
        Ok(())
    }

    /// A task without events may have acted and record it later; the replay went on without it. So a difference is
    /// checked again, with everything that came since, before it is reported.
    fn by_order(&mut self, recording: &Recording, more: bool) -> Result<Option<Verdict>, Refusal> {
        if let Some(instant_ns) = self.suspected_ns {
            let covered = recording.covered_until_ns().is_some_and(|covered| covered > instant_ns);
            let known = recording.known_until_ns().is_none_or(|known| known > instant_ns.saturating_add(GRACE_NS));
            if more && !covered && !known {
                return Ok(None);
            }
            self.begin_by_order(recording)?;
        }
        let suspected = self.suspected_ns.take();
        let Replay::Untimed(replay) = &mut self.replay else { unreachable!("it was begun") };
        let verdict = replay.go_on(recording, more, &self.interrupt)?;
        let Some(Verdict::Parts(parted)) = &verdict else { return Ok(verdict) };
        let instant_ns = parted.event.as_ref().map_or(0, |event| event.time_ns);
        if !more || suspected == Some(instant_ns) {
            return Ok(verdict);
        }
        self.suspected_ns = Some(instant_ns);
        Ok(None)
    }

    /// How it is compared now.
    pub fn way(&self) -> Way {
        match &self.replay {
            Replay::Timed(_) => Way::Timed,
            Replay::Untimed(_) => Way::Untimed,
        }
    }

    /// How many events agree so far.
    pub fn agreed(&self) -> usize {
        match &self.replay {
            Replay::Timed(replay) => replay.agreed(),
            Replay::Untimed(replay) => replay.agreed(),
        }
    }

    /// How far the two agree, and what is waited for where a task is silent.
    pub fn progress(&self, recording: &Recording) -> String {
        let seconds = |ns: i64| ns as f64 / 1e9;
        let last = |track: &&Track| track.events.last().map_or(0, |event| event.time_ns);
        let newest = recording.tracks.iter().map(|track| last(&track)).max().unwrap_or(0);
        let behind = recording.tracks.iter().min_by_key(last);
        let silent = match behind {
            Some(track) if newest - last(&track) > GRACE_NS => {
                format!("; {} has been silent since {:.1} s", track.task, seconds(last(&track)))
            }
            _ => String::new(),
        };
        format!("{} events agree, the run is at {:.1} s{silent}", self.agreed(), seconds(newest))
    }

    /// The texts that places of a verdict point into.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }
}

#[cfg(test)]
mod by_order;
#[cfg(test)]
mod damaged;
#[cfg(test)]
mod halves;
#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) use tests::model_named;
