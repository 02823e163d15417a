//! Event by event: where phases last as long as they last, one task steps at a time.
//!
//! In: the model, and any recording. The model's configuration is changed before the run, its rules are not: phases take no
//! time, and between two phases there is a rest, so that leaving the one and beginning the next are two steps. The clock
//! is set to the recorded instant. Then there must be an order of the tasks' steps, consistent with the recorded times,
//! in which each step has the events that were recorded. An action was taken between the event before it and the one
//! after it, where an event that is told before the action (asks, releases, sends, stores) narrows the beginning and one
//! told after it (enters, takes) the end; among actions that overlap every order is tried.

use std::sync::Arc;

use machine::{Change, Closed, Limits, Machine, Snapshot, Value};
use program::{ProcedureId, Program};

use crate::Verdict;
use crate::evidence::{Claim, Parted, Recorded, objects};
use crate::steps::Steps;
use crate::timed::tracks;
use crate::vocabulary::Vocabulary;
use recording::{Event, Recording};

/// LIMIT: so many decisions are kept to go back to.
const KEPT: usize = 64;
/// LIMIT: so many events of another task are looked at for one that may have come before.
const NEAR: usize = 64;
/// Kinds of events that no other task has to do with.
const LOCAL: &[&str] = &["begins", "ends", "passes", "meets", "misses", "invalid", "faults"];
/// The last so many events are shown where the two part.
const SHOWN: usize = 12;

/// A run of the model's tasks one by one, held against a recording that may still be written.
///
/// While more may come, an action is looked at when all tasks are known beyond its end: by an event of their own, so that a
/// run that is followed takes the same decisions as one that is read when it is over; or by the recording's word that they
/// had none, where that may differ in a parting that a later event explains.
#[derive(Debug)]
pub struct Replay {
    machine: Machine,
    vocabulary: Vocabulary,
    procedures: Vec<ProcedureId>,
    tick_ns: i64,
    /// The events of each component, as far as they are looked at.
    tracks: Vec<Vec<Event>>,
    /// More may come.
    more: bool,
    cursors: Vec<usize>,
    /// The last tick of each component: its clock does not go back.
    ticks: Vec<i64>,
    agreed: usize,
    /// The decisions to go back to.
    stack: Vec<Node>,
    /// The last decision waits for more events.
    waits: bool,
    /// The parting that comes latest.
    deepest: Option<Box<Parted>>,
}

/// A point to go back to.
#[derive(Debug)]
struct Node {
    snapshot: Snapshot,
    cursors: Vec<usize>,
    ticks: Vec<i64>,
    agreed: usize,
    /// Components that have not been tried here, the last one first.
    open: Vec<usize>,
}

/// Why a component does not go on.
enum Stop {
    Parted(Box<Parted>),
    /// Its step has more events than are known.
    Waits,
}

impl From<Box<Parted>> for Stop {
    fn from(parted: Box<Parted>) -> Stop {
        Stop::Parted(parted)
    }
}

impl Replay {
    /// Starts the model, with the steps added to its program.
    ///
    /// # Errors
    /// It cannot be replayed, in words.
    pub fn new(program: &Arc<Program>, limits: Limits, steps: &Steps, tick_ns: i64) -> Result<Replay, String> {
        let (mut machine, vocabulary) = steps.start(program, limits)?;
        let procedures: Result<Vec<_>, String> =
            vocabulary.components.iter().map(|known| steps.of(&known.name)).collect();
        steps.loosen(&mut machine)?;
        let count = vocabulary.components.len();
        Ok(Replay {
            machine,
            vocabulary,
            procedures: procedures?,
            tick_ns,
            tracks: vec![Vec::new(); count],
            more: true,
            cursors: vec![0; count],
            ticks: vec![0; count],
            agreed: 0,
            stack: Vec::new(),
            waits: false,
            deepest: None,
        })
    }

    /// How many events agree, as far as it looks.
    pub fn agreed(&self) -> usize {
        self.agreed
    }

    /// Goes on as far as the recording is known; none: it agrees so far, and `more` may come.
    ///
    /// # Errors
    /// The recording is of another system, in words.
    pub fn go_on(&mut self, recording: &Recording, more: bool) -> Result<Option<Verdict>, String> {
        // What tasks do to come to an end is no run of the model.
        let known = recording.known_until_ns().unwrap_or(i64::MAX).min(recording.stopped_ns.unwrap_or(i64::MAX));
        for (own, events) in self.tracks.iter_mut().zip(tracks(&self.vocabulary, recording)?) {
            own.extend_from_slice(&events[own.len().min(events.len())..]);
            if !more {
                own.truncate(own.partition_point(|event| event.time_ns < known));
            }
        }
        self.more = more;
        Ok(self.run(known, recording.is_whole()))
    }

    fn run(&mut self, known: i64, is_whole: bool) -> Option<Verdict> {
        loop {
            if !std::mem::take(&mut self.waits) {
                let open = self.candidates();
                let first = open.last().and_then(|first| self.span(*first)).map_or(i64::MAX, |(_, to)| to);
                if self.more && first >= known {
                    return None;
                }
                if open.is_empty() {
                    break;
                }
                self.stack.push(Node {
                    snapshot: self.machine.snapshot(),
                    cursors: self.cursors.clone(),
                    ticks: self.ticks.clone(),
                    agreed: self.agreed,
                    open,
                });
                if self.stack.len() > KEPT {
                    self.stack.remove(0);
                }
            }
            // The first way on that is possible; where there is none, back to the last decision that has another.
            loop {
                let Some(mut node) = self.stack.pop() else {
                    let parted = self.deepest.take().unwrap_or_else(|| unreachable!("a way was tried"));
                    return Some(Verdict::Parts(parted));
                };
                let Some(component) = node.open.pop() else { continue };
                self.machine.restore(&node.snapshot);
                self.cursors.clone_from(&node.cursors);
                self.ticks.clone_from(&node.ticks);
                self.agreed = node.agreed;
                let rivals = self.rivals(component);
                match self.advance(component) {
                    // Other orders matter only among actions on one channel.
                    Ok(()) => {
                        node.open.retain(|other| rivals.contains(other));
                        self.stack.push(node);
                        break;
                    }
                    Err(Stop::Waits) => {
                        node.open.push(component);
                        self.stack.push(node);
                        self.waits = true;
                        return None;
                    }
                    Err(Stop::Parted(parted)) => {
                        if self.deepest.as_ref().is_none_or(|deepest| deepest.agreed < parted.agreed) {
                            self.deepest = Some(parted);
                        }
                        self.stack.push(node);
                    }
                }
            }
        }
        Some(if is_whole {
            Verdict::Conforms { events: self.agreed, steps: self.machine.steps() }
        } else {
            Verdict::Unknown { events: self.agreed, reason: "the recording has a gap, or ends early".to_string() }
        })
    }

    /// Components that may act next, the first one last: those whose action cannot have come after another one's.
    fn candidates(&self) -> Vec<usize> {
        let spans: Vec<(usize, i64, i64)> =
            (0..self.tracks.len()).filter_map(|index| self.span(index).map(|(from, to)| (index, from, to))).collect();
        let first = spans.iter().map(|(_, _, to)| *to).min().unwrap_or(i64::MAX);
        let mut open: Vec<(i64, usize)> =
            spans.iter().filter(|(_, from, _)| *from <= first).map(|(index, _, to)| (*to, *index)).collect();
        open.sort_unstable_by(|left, right| right.cmp(left));
        open.into_iter().map(|(_, index)| index).collect()
    }

    /// The components that act on the channel of this one's next action, perhaps before it.
    fn rivals(&self, component: usize) -> Vec<usize> {
        let at = self.acts(component);
        let Some(event) = self.tracks[component].get(at).filter(|event| !LOCAL.contains(&event.kind.as_str())) else {
            return Vec::new();
        };
        let until = self.span(component).map_or(i64::MIN, |(_, to)| to);
        let meets = |other: &usize| {
            let events = self.tracks[*other][self.cursors[*other]..].iter();
            // An action is recorded at the latest by the event after it.
            let near = events.take(NEAR).take_while(|other| other.time_ns <= until);
            *other != component && near.into_iter().any(|other| other.object == event.object)
        };
        (0..self.tracks.len()).filter(meets).collect()
    }

    /// The event by which a component acts next: what comes with a beginning, or else the next one.
    fn acts(&self, index: usize) -> usize {
        let (events, at) = (&self.tracks[index], self.cursors[index]);
        match (events.get(at), events.get(at + 1)) {
            (Some(event), Some(next))
                if event.kind == "begins" && ["asks", "takes", "loads", "writes"].contains(&next.kind.as_str()) =>
            {
                at + 1
            }
            _ => at,
        }
    }

    /// Between which instants the next action of a component was taken.
    fn span(&self, index: usize) -> Option<(i64, i64)> {
        let events = &self.tracks[index];
        let at = self.cursors[index];
        let event = events.get(at)?;
        let before = at.checked_sub(1).map_or(i64::MIN, |before| events[before].time_ns);
        let acts = self.acts(index);
        // With what a beginning comes is not known yet.
        let is_last = self.more && at + 1 == events.len();
        let told_before = ["asks", "releases", "sends", "stores", "refuses"].contains(&events[acts].kind.as_str());
        let from = if told_before || acts > at || is_last { event.time_ns } else { before };
        let to =
            if told_before { events.get(acts + 1).map_or(i64::MAX, |next| next.time_ns) } else { events[acts].time_ns };
        Some((from, to))
    }

    /// Makes the steps that the component's next events are of.
    fn advance(&mut self, component: usize) -> Result<(), Stop> {
        let event = self.tracks[component][self.cursors[component]].clone();
        match event.kind.as_str() {
            "invalid" | "faults" => {
                self.cursors[component] += 1;
                self.agreed += 1;
                return Ok(());
            }
            "passes" => return Ok(self.pass(component, &event)?),
            _ => {}
        }
        let tick = event.time_ns.div_euclid(self.tick_ns).max(self.ticks[component]);
        // At the end of a cycle the exact instant decides: in time, or within the tick too late.
        let ticks = match event.kind.as_str() {
            "meets" | "misses" => vec![tick, tick + i64::from(event.time_ns.rem_euclid(self.tick_ns) > 0)],
            _ => vec![tick],
        };
        let start = self.machine.snapshot();
        let mut parted = None;
        for tick in ticks {
            self.machine.restore(&start);
            match self.advance_at(component, tick) {
                Err(Stop::Parted(found)) => _ = parted.get_or_insert(found),
                other => return other,
            }
        }
        Err(parted.unwrap_or_else(|| self.parted(component, Vec::new(), "no step is possible".to_string())).into())
    }

    fn advance_at(&mut self, component: usize, tick: i64) -> Result<(), Stop> {
        let at = self.cursors[component];
        let next = &self.tracks[component][at];
        let gives_up = ["gives_up", "refuses"].contains(&next.kind.as_str());
        let ends = ["meets", "misses"].contains(&next.kind.as_str());
        // Before giving up a lock the model counts each tick that it waits; between phases it rests for a step.
        let waited = match at.checked_sub(1) {
            Some(before) if gives_up => {
                let asked = self.tracks[component][before].time_ns;
                ((next.time_ns - asked) / self.tick_ns).max(0)
            }
            _ => 0,
        };
        for _ in 0..waited + 3 {
            let changes =
                self.step(component, tick, ends).map_err(|fault| self.parted(component, Vec::new(), fault))?;
            let claims = self.vocabulary.claims(&self.machine, &changes);
            let (own, others): (Vec<_>, Vec<_>) = claims.into_iter().partition(|(of, _)| *of == component);
            debug_assert!(others.is_empty(), "one task steps");
            let own: Vec<Claim> = own.into_iter().map(|(_, claim)| claim).collect();
            if own.is_empty() {
                if !changes.is_empty() && (gives_up || self.rests(&changes)) {
                    continue;
                }
                return Err(self.parted(component, own, "the model's task cannot go on here".to_string()).into());
            }
            let next = &self.tracks[component][at..];
            let recorded = &next[..own.len().min(next.len())];
            let mut open: Vec<&Claim> = own.iter().collect();
            for event in recorded {
                match open.iter().position(|claim| claim.event.same(event)) {
                    Some(at) => _ = open.swap_remove(at),
                    None => {
                        let mut parted = self.parted(component, own.clone(), String::new());
                        parted.event = Some(event.clone());
                        parted.reason = None;
                        return Err(parted.into());
                    }
                }
            }
            if self.more && recorded.len() < own.len() {
                return Err(Stop::Waits);
            }
            // The recording may end within a step.
            let count = recorded.len();
            self.ticks[component] = tick;
            self.cursors[component] += count;
            self.agreed += count;
            return Ok(());
        }
        Err(self.parted(component, Vec::new(), "the model's task would still wait for the lock".to_string()).into())
    }

    /// The step led from one phase to the next, or to the waiting one.
    fn rests(&self, changes: &[Change]) -> bool {
        let moved = self.vocabulary.location("scheduler_currentPhase", &[]).function;
        changes.iter().any(|change| change.location.function == moved)
    }

    /// A step of a component. When a cycle `ends` late the model begins the next one in the same step, where the program
    /// comes to it later; with no end of the period in sight it waits first.
    fn step(&mut self, component: usize, tick: i64, ends: bool) -> Result<Vec<Change>, String> {
        let program = Arc::clone(self.machine.program());
        let fault = |fault: machine::Fault| fault.show(&program).to_string();
        let clock = self.vocabulary.location("clock", &[]);
        let task = self.vocabulary.components[component].task.clone();
        let period = self.vocabulary.location("task_period", &[task]);
        let length = self.machine.value(&period);
        self.machine.set(&clock, Value::Integer(tick)).map_err(fault)?;
        if ends {
            self.machine.set(&period, Value::Integer(i64::MAX / 2)).map_err(fault)?;
        }
        self.machine.prepare_procedure(self.procedures[component], &mut Closed).map_err(fault)?;
        self.machine.commit();
        let changes = self.machine.changes();
        if ends {
            self.machine.set(&period, length).map_err(fault)?;
        }
        Ok(changes)
    }

    /// There was nothing to hand over: the writing phase is passed over, which the program alone decides.
    fn pass(&mut self, component: usize, event: &Event) -> Result<(), Box<Parted>> {
        let scheduler = self.vocabulary.components[component].scheduler.clone();
        let current = self.vocabulary.location("scheduler_currentPhase", &[scheduler]);
        let phase = self.vocabulary.get(&self.machine, "nextPhase", &[self.machine.value(&current)]);
        if self.vocabulary.phase_named(&self.machine, component, &event.object) != Some(phase.clone()) {
            return Err(self.parted(component, Vec::new(), "the model's task is not before this phase".to_string()));
        }
        let rest = self.vocabulary.get(&self.machine, "nextPhase", &[phase]);
        let set = self.machine.set(&current, rest);
        set.map_err(|_| self.parted(component, Vec::new(), "the phase cannot be passed over".to_string()))?;
        self.cursors[component] += 1;
        self.agreed += 1;
        Ok(())
    }

    fn parted(&self, component: usize, claims: Vec<Claim>, reason: String) -> Box<Parted> {
        let event = self.tracks[component].get(self.cursors[component]).cloned();
        let named = self.vocabulary.components.iter().zip(&self.tracks).zip(&self.cursors);
        let mut before: Vec<Recorded> = named
            .flat_map(|((known, events), cursor)| {
                let recorded = |event: &Event| Recorded { task: known.name.clone(), event: event.clone() };
                events[cursor.saturating_sub(SHOWN)..*cursor].iter().map(recorded).collect::<Vec<_>>()
            })
            .collect();
        before.sort_by_key(|recorded| recorded.event.time_ns);
        let state = self.vocabulary.state(&self.machine, component, &objects(event.as_ref(), &claims));
        Box::new(Parted {
            tick: event.as_ref().map_or(0, |event| event.time_ns.div_euclid(self.tick_ns)),
            task: self.vocabulary.components[component].name.clone(),
            event,
            claims,
            reason: Some(reason),
            agreed: self.agreed,
            before: before.split_off(before.len().saturating_sub(SHOWN)),
            state,
        })
    }
}
