//! Event by event: phases last as long as they do, and one task steps at a time.
//!
//! In: the model, and any recording. The model's configuration is changed before the run; its rules are not. Phases
//! take no time, and between two phases there is a rest, so leaving the one and beginning the next are two steps. The
//! clock is set to the recorded instant; so is the time that a cycle has waited, if it matters. A step is one of the
//! model's main rule in which one task has its turn (`single`). Then there must be an order of the tasks' steps, consistent
//! with the recorded times (`order`), in which each step has the events that were recorded. Among overlapping actions,
//! every order is tried.

use std::collections::VecDeque;
use std::sync::Arc;

use machine::{Change, EngineChoice, Fault, Interrupt, Limits, Machine, Mark, Value};
use program::{ProcedureId, Slot};

use crate::Verdict;
use crate::ends::Ends;
use crate::evidence::{Claim, Parted, Recorded, conforms, interrupted, missing, objects, out_of_turn};
use crate::order::{Lane, Place, Span};
use crate::single::{Chosen, oversteps};
use crate::steps::Steps;
use crate::timed::tracks;
use crate::vocabulary::{Named, Vocabulary};
use crate::waiting::Pace;
use crate::way::Way;
use recording::{Event, Kind, Recording};

/// LIMIT: this many decisions are kept to go back to.
const KEPT: usize = 64;
/// More rests than this do not follow each other.
const RESTS: usize = 3;
/// This many of the last events are shown where the two differ.
const SHOWN: usize = 12;

/// A run of the model's tasks one by one, compared with a recording that may still be written.
///
/// While more may come, an action is looked at only when all tasks are known beyond its end. A task is known by an
/// event of its own; then a followed run takes the same decisions as one that is read when it is over. Or it is known
/// because the recording says that it had no event; then the decision may differ in a difference that a later event
/// explains.
#[derive(Debug)]
pub struct Replay {
    machine: Machine,
    vocabulary: Vocabulary,
    ends: Ends,
    step: ProcedureId,
    tick_ns: i64,
    pace: Pace,
    /// One for each component.
    lanes: Vec<Lane>,
    /// More may come.
    more: bool,
    agreed: usize,
    /// The decisions to go back to.
    stack: VecDeque<Node>,
    /// The last decision waits for more events.
    waits: bool,
    /// The latest difference.
    deepest: Option<Box<Parted>>,
}

/// A point to go back to.
#[derive(Debug)]
struct Node {
    mark: Mark,
    agreed: usize,
    /// Components that have not been tried here, the last one first.
    open: Vec<usize>,
    /// The component that stepped here, and where it was before.
    stepped: Option<(usize, Place)>,
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
    /// Starts the model, with the steps added to its program, for a recording with this head.
    ///
    /// # Errors
    /// It cannot be replayed, in words.
    pub fn new(limits: Limits, steps: &Steps, head: &Recording) -> Result<Replay, String> {
        let step = steps.step()?;
        let (mut machine, vocabulary, ends) = steps.start(Way::Untimed, limits)?;
        let wakes = vocabulary.components.iter().map(|component| vocabulary.wakes(&machine, component));
        let lanes = wakes.map(|wakes| Lane { wakes, ..Lane::default() }).collect();
        steps.loosen(&mut machine)?;
        Ok(Replay {
            machine,
            vocabulary,
            ends,
            step,
            tick_ns: head.tick_ns,
            pace: Pace::named(&head.pace),
            lanes,
            more: true,
            agreed: 0,
            stack: VecDeque::new(),
            waits: false,
            deepest: None,
        })
    }

    /// Compiles no step.
    pub fn interpret(&mut self) {
        self.machine.use_engine(EngineChoice::Interpreted);
    }

    /// How many events agree, as far as it looks.
    pub fn agreed(&self) -> usize {
        self.agreed
    }

    /// Goes on as far as the recording is known, or until interrupted; none: it agrees so far, and `more` may come.
    ///
    /// # Errors
    /// The recording is of another system, in words.
    pub fn go_on(&mut self, recording: &Recording, more: bool, asked: &Interrupt) -> Result<Option<Verdict>, String> {
        // What tasks do in order to stop is not part of a run of the model.
        let known = recording.known_until_ns().unwrap_or(i64::MAX).min(recording.stopped_ns.unwrap_or(i64::MAX));
        for (lane, events) in self.lanes.iter_mut().zip(tracks(&self.vocabulary, recording)?) {
            let own = &mut lane.events;
            own.extend_from_slice(&events[own.len().min(events.len())..]);
            if !more {
                own.truncate(own.partition_point(|event| event.time_ns < known));
            }
        }
        self.more = more;
        Ok(self.run(known, recording, asked))
    }

    fn run(&mut self, known: i64, recording: &Recording, asked: &Interrupt) -> Option<Verdict> {
        loop {
            if !std::mem::take(&mut self.waits) {
                let (first_ns, open) = self.candidates();
                if self.more && first_ns >= known {
                    return None;
                }
                if open.is_empty() {
                    break;
                }
                self.decide(open);
            }
            if let Some(verdict) = self.go_one_way(asked) {
                return Some(verdict);
            }
            if self.waits {
                return None;
            }
        }
        if let Some(parted) = self.still_waiting(known) {
            return Some(Verdict::Parts(parted));
        }
        let unknown = |reason: String| Some(Verdict::Unknown { events: self.agreed, reason });
        // If time goes on in every lane, one of them can always go on.
        if self.lanes.iter().any(|lane| lane.next().is_some()) {
            return unknown("an event was not come to".to_string());
        }
        if !recording.is_whole() {
            return unknown(missing(recording));
        }
        let failed = |lane: &Lane| lane.last().is_some_and(|event| event.kind == Kind::Faults);
        if let Some(component) = self.lanes.iter().position(failed) {
            return unknown(format!("{} failed", self.vocabulary.components[component].name));
        }
        Some(conforms(recording, self.agreed, self.machine.steps()))
    }

    /// A decision among these components, to which the search can go back.
    fn decide(&mut self, open: Vec<usize>) {
        let mark = self.machine.mark();
        self.stack.push_back(Node { mark, agreed: self.agreed, open, stepped: None });
        if self.stack.len() > KEPT {
            self.stack.pop_front();
            self.machine.forget_before(&self.stack[0].mark);
        }
    }

    /// Takes the first possible way on; if there is none, goes back to the last decision that has another.
    fn go_one_way(&mut self, asked: &Interrupt) -> Option<Verdict> {
        loop {
            if asked.is_raised() {
                return Some(interrupted(self.agreed));
            }
            let Some(mut node) = self.stack.pop_back() else {
                let parted = self.deepest.take().unwrap_or_else(|| unreachable!("a way was tried"));
                return Some(Verdict::Parts(parted));
            };
            if let Some((component, place)) = node.stepped.take() {
                self.lanes[component].place = place;
                self.machine.go_back(&node.mark);
                self.agreed = node.agreed;
            }
            let Some(component) = node.open.pop() else { continue };
            // Other orders matter only among actions on one channel.
            let rivals = if node.open.is_empty() { Vec::new() } else { self.rivals(component) };
            node.stepped = Some((component, self.lanes[component].place));
            match self.advance(component) {
                Ok(()) => {
                    node.open.retain(|other| rivals.contains(other));
                    self.stack.push_back(node);
                    return None;
                }
                Err(Stop::Waits) => {
                    node.open.push(component);
                    self.stack.push_back(node);
                    self.waits = true;
                    return None;
                }
                Err(Stop::Parted(parted)) => {
                    if self.deepest.as_ref().is_none_or(|deepest| deepest.agreed < parted.agreed) {
                        self.deepest = Some(parted);
                    }
                    self.stack.push_back(node);
                }
            }
        }
    }

    /// Components that may act next, the first one last: those whose action cannot have come after another one's. Also
    /// the latest instant at which the first one has acted.
    fn candidates(&self) -> (i64, Vec<usize>) {
        let spans = || self.lanes.iter().map(|lane| lane.span(self.more)).enumerate();
        let first_ns = spans().filter_map(|(_, span)| Some(span?.to_ns)).min().unwrap_or(i64::MAX);
        let may = |(index, span): (usize, Option<Span>)| {
            let Span { from_ns, to_ns } = span?;
            (from_ns <= first_ns).then_some((to_ns, index))
        };
        let mut open: Vec<(i64, usize)> = spans().filter_map(may).collect();
        open.sort_unstable_by(|left, right| right.cmp(left));
        (first_ns, open.into_iter().map(|(_, index)| index).collect())
    }

    /// The components that act on the channel of this one's next action, perhaps before it.
    fn rivals(&self, component: usize) -> Vec<usize> {
        let lane = &self.lanes[component];
        let (channels, Some(span)) = (lane.channels(), lane.span(self.more)) else { return Vec::new() };
        let acts = |other: usize| channels.iter().any(|channel| self.lanes[other].may_act_on(channel, span.to_ns));
        let meets = |other: &usize| *other != component && acts(*other);
        (0..self.lanes.len()).filter(meets).collect()
    }

    /// Makes the steps of the component's next events.
    fn advance(&mut self, component: usize) -> Result<(), Stop> {
        let lane = &self.lanes[component];
        let Some(Event { time_ns, kind, .. }) = lane.next() else { unreachable!("a candidate has an event") };
        let (time_ns, kind) = (*time_ns, *kind);
        if lane.awaits().is_some() {
            return Ok(self.wake(component)?);
        }
        match kind {
            Kind::Invalid => return self.withhold(component),
            Kind::Passes => return Ok(self.pass(component)?),
            Kind::Faults => return Ok(self.fail(component)?),
            _ => {}
        }
        let tick = time_ns.div_euclid(self.tick_ns).max(lane.place.tick);
        // At the end of a cycle the exact instant decides: in time, or too late within the tick.
        if !matches!(kind, Kind::Meets | Kind::Misses) || time_ns.rem_euclid(self.tick_ns) == 0 {
            return self.advance_at(component, tick);
        }
        let start = self.machine.mark();
        let Err(Stop::Parted(parted)) = self.advance_at(component, tick) else { return Ok(()) };
        self.machine.go_back(&start);
        match self.advance_at(component, tick + 1) {
            Err(Stop::Parted(_)) => Err(parted.into()),
            other => other,
        }
    }

    fn advance_at(&mut self, component: usize, tick: i64) -> Result<(), Stop> {
        let lane = &self.lanes[component];
        let kind = lane.next().map(|event| event.kind);
        let gives_up = matches!(kind, Some(Kind::GivesUp | Kind::Refuses));
        let ends = matches!(kind, Some(Kind::Meets | Kind::Misses));
        if gives_up {
            self.set_waited(component)?;
        }
        // Between phases it rests for a step.
        for _ in 0..RESTS {
            let changes =
                self.step(component, tick, ends).map_err(|fault| self.parted(component, Vec::new(), fault))?;
            let claims = self.vocabulary.claims(&self.machine, &changes);
            self.is_its_own(component, tick, &claims, &changes)?;
            if claims.is_empty() {
                if self.rests(&changes) {
                    continue;
                }
                let reason = match gives_up {
                    true => "the model's task would still wait",
                    false => "the model's task cannot go on here",
                };
                return Err(self.parted(component, Vec::new(), reason.to_string()).into());
            }
            return self.compare(component, tick, claims);
        }
        Err(self.parted(component, Vec::new(), "the model's task does not come to an action".to_string()).into())
    }

    /// A step is that of the one component, for a tick, and ends its elaborations as they end in the model.
    fn is_its_own(
        &mut self,
        component: usize,
        tick: i64,
        claims: &[(usize, Claim)],
        changes: &[Change],
    ) -> Result<(), Box<Parted>> {
        if let Some((claim, reason)) = oversteps(&self.vocabulary, &self.machine, component, tick, claims, changes) {
            return Err(self.parted(component, claim.into_iter().collect(), reason));
        }
        match self.ends.unlike(&mut self.machine, claims) {
            Ok(None) => Ok(()),
            Ok(Some((component, claim, reason))) => Err(self.parted(component, claim.into_iter().collect(), reason)),
            Err(fault) => Err(self.parted(component, Vec::new(), fault.show(self.machine.program()).to_string())),
        }
    }

    /// Compares the events of a step with the recorded ones.
    fn compare(&mut self, component: usize, tick: i64, claims: Vec<(usize, Claim)>) -> Result<(), Stop> {
        let lane = &self.lanes[component];
        let next = &lane.events[lane.place.cursor..];
        let recorded = &next[..claims.len().min(next.len())];
        // A task that fails leaves its step where it is.
        let fails = recorded.iter().position(|event| event.kind == Kind::Faults).unwrap_or(recorded.len());
        let recorded = &recorded[..fails];
        let agree = recorded.iter().zip(&claims).take_while(|(event, (_, claim))| claim.event.same(event)).count();
        if agree < recorded.len() || (fails == 0 && !next.is_empty()) {
            let event = next.get(agree).cloned();
            let claims: Vec<Claim> = claims.into_iter().skip(agree).map(|(_, claim)| claim).collect();
            let reason = out_of_turn(event.as_ref(), &claims);
            let parted = self.parted(component, claims, String::new());
            return Err(Box::new(Parted { event, reason, ..*parted }).into());
        }
        if self.more && recorded.len() == next.len() && recorded.len() < claims.len() {
            return Err(Stop::Waits);
        }
        // The recording may end within a step.
        let count = recorded.len();
        let enters = recorded.iter().any(|event| event.kind == Kind::Enters);
        self.lanes[component].place.tick = tick;
        self.agree(component, count);
        if enters { Ok(self.is_in_time(component, count)?) } else { Ok(()) }
    }

    /// This many events agree.
    fn agree(&mut self, component: usize, count: usize) {
        let Lane { events, place, .. } = &mut self.lanes[component];
        for _ in 0..count {
            let before = place.cursor.checked_sub(1).map(|before| &events[before]);
            place.waited = place.waited.with(before, &events[place.cursor], self.pace, self.tick_ns);
            place.cursor += 1;
            place.woken = false;
        }
        self.agreed += count;
    }

    /// A lock came within the time that the model's task would have waited, according to the last events that agreed.
    fn is_in_time(&mut self, component: usize, count: usize) -> Result<(), Box<Parted>> {
        let waited_ns = self.lanes[component].place.waited.at_least_ns;
        if self.would_wait(component, waited_ns)? {
            return Ok(());
        }
        self.lanes[component].place.cursor -= count;
        self.agreed -= count;
        Err(self.gave_up(component, waited_ns))
    }

    /// A task that waits for a lock when the recording ends, although the model's task would have given it up by then.
    fn still_waiting(&mut self, until_ns: i64) -> Option<Box<Parted>> {
        for component in 0..self.lanes.len() {
            let lane = &self.lanes[component];
            let Some(asks) = lane.last().filter(|event| event.kind == Kind::Asks && until_ns < i64::MAX) else {
                continue;
            };
            let now = Event { time_ns: until_ns, kind: Kind::Enters, ..asks.clone() };
            let waited = lane.place.waited.with(Some(asks), &now, self.pace, self.tick_ns);
            match self.would_wait(component, waited.at_least_ns) {
                Ok(true) => {}
                Ok(false) => return Some(self.gave_up(component, waited.at_least_ns)),
                Err(parted) => return Some(parted),
            }
        }
        None
    }

    /// Whether the model's task waits this long in a cycle: a tick before, it still had time.
    fn would_wait(&mut self, component: usize, waited_ns: i64) -> Result<bool, Box<Parted>> {
        if waited_ns <= 0 {
            return Ok(true);
        }
        let ticks = (waited_ns + self.tick_ns - 1) / self.tick_ns;
        let task = self.vocabulary.components[component].task.clone();
        let location = self.vocabulary.location(Named::TimeInWait, std::slice::from_ref(&task));
        let former = self.machine.value(&location);
        let program = Arc::clone(self.machine.program());
        let asked = || -> Result<Value, Fault> {
            self.machine.set(&location, Value::Integer(ticks - 1))?;
            let asked = self.ask(Named::ThereIsTime, task);
            self.machine.set(&location, former)?;
            asked
        };
        let asked = asked().map_err(|fault| self.parted(component, Vec::new(), fault.show(&program).to_string()))?;
        Ok(asked != Value::Boolean(false))
    }

    /// The value of a derived function of the library for an element.
    fn ask(&mut self, named: Named, element: Value) -> Result<Value, Fault> {
        let program = Arc::clone(self.machine.program());
        match &program.function(self.vocabulary.function(named)).definition {
            Some(defined) => {
                let bound = [(Slot(0), element)];
                self.machine.evaluate_with(defined.body, defined.frame, &bound, &mut machine::Closed)
            }
            None => Ok(Value::Undef),
        }
    }

    /// The data are there that the task awaits.
    fn wake(&mut self, component: usize) -> Result<(), Box<Parted>> {
        let waiting = self.vocabulary.components[component].waiting.clone();
        let reason = match self.ask(Named::DataAvailable, waiting) {
            Ok(Value::Boolean(true)) => {
                self.lanes[component].place.woken = true;
                return Ok(());
            }
            Ok(_) => "the model's task still waits for data".to_string(),
            Err(fault) => fault.show(self.machine.program()).to_string(),
        };
        Err(self.parted(component, Vec::new(), reason))
    }

    /// The difference of a task that went on waiting where the model's task gives up.
    fn gave_up(&self, component: usize, waited_ns: i64) -> Box<Parted> {
        let lane = &self.lanes[component];
        let object = lane.next().or(lane.last()).map_or_else(Default::default, |event| Arc::clone(&event.object));
        let span = self.machine.program().function(self.vocabulary.function(Named::ThereIsTime)).span;
        let claim = Claim { event: Event { kind: Kind::GivesUp, object, ..Event::default() }, span };
        let waited = format!("its cycle has waited {:.4} ms for locks by then", waited_ns as f64 / 1e6);
        let reason = match self.pace {
            Pace::Real => format!("{waited}, interruptions left out"),
            Pace::Modelled | Pace::Drawn => waited,
        };
        self.parted(component, vec![claim], reason)
    }

    /// The model counts each tick that a task waits; here the waiting lasts as long as recorded.
    fn set_waited(&mut self, component: usize) -> Result<(), Box<Parted>> {
        let lane = &self.lanes[component];
        let Some(event) = lane.next() else { return Ok(()) };
        let waited = lane.place.waited.with(lane.last(), event, self.pace, self.tick_ns);
        let task = std::slice::from_ref(&self.vocabulary.components[component].task);
        let location = self.vocabulary.location(Named::TimeInWait, task);
        let due = self.machine.value(&self.vocabulary.location(Named::PeriodStart, task));
        let due_ns = if let Value::Integer(tick) = due { tick.checked_mul(self.tick_ns) } else { None };
        let spent_ns = waited.spent_ns(due_ns, self.pace);
        let set = self.machine.set(&location, Value::Integer(spent_ns / self.tick_ns));
        set.map_err(|fault| self.parted(component, Vec::new(), fault.show(self.machine.program()).to_string()))
    }

    /// The step led from one phase to the next, or to the waiting one.
    fn rests(&self, changes: &[Change]) -> bool {
        let moved = self.vocabulary.function(Named::CurrentPhase);
        changes.iter().any(|change| change.location.function == moved)
    }

    /// A step of a component. When a cycle `ends` late, the model begins the next one in the same step, while the
    /// program begins it later. So the step is made with no end of the period in sight: then the model waits first.
    fn step(&mut self, component: usize, tick: i64, ends: bool) -> Result<Vec<Change>, String> {
        let known = &self.vocabulary.components[component];
        let clock = self.vocabulary.location(Named::Clock, &[]);
        let period = ends.then(|| self.vocabulary.location(Named::Period, std::slice::from_ref(&known.task)));
        let mut chosen = Chosen::new(&known.scheduler);
        let (machine, step) = (&mut self.machine, self.step);
        let mut make = || -> Result<Vec<Change>, Fault> {
            if machine.value(&clock) != Value::Integer(tick) {
                machine.set(&clock, Value::Integer(tick))?;
            }
            let length = period.as_ref().map(|period| machine.value(period));
            if let Some(period) = &period {
                machine.set(period, Value::Integer(i64::MAX / 2))?;
            }
            machine.prepare_procedure(step, &mut chosen)?;
            machine.commit();
            let changes = self.vocabulary.changes(machine);
            if let (Some(period), Some(length)) = (&period, length) {
                machine.set(period, length)?;
            }
            Ok(changes)
        };
        make().map_err(|fault| fault.show(self.machine.program()).to_string())
    }

    /// The phase that comes next, if its task writes in it, and the channel that it writes to.
    fn next_writing(&self, component: usize) -> Option<(Value, Value)> {
        let scheduler = &self.vocabulary.components[component].scheduler;
        let current = self.vocabulary.get(&self.machine, Named::CurrentPhase, std::slice::from_ref(scheduler));
        let phase = self.vocabulary.get(&self.machine, Named::NextPhase, &[current]);
        let channel = self.vocabulary.written(&self.machine, &phase)?;
        Some((phase, channel))
    }

    /// The number of the present cycle.
    fn cycle(&self, component: usize) -> u64 {
        let task = std::slice::from_ref(&self.vocabulary.components[component].task);
        match self.vocabulary.get(&self.machine, Named::Cycles, task) {
            Value::Integer(cycles) => u64::try_from(cycles).unwrap_or(0),
            _ => 0,
        }
    }

    /// There was nothing to hand over: the writing phase is skipped. Only the program decides that.
    fn pass(&mut self, component: usize) -> Result<(), Box<Parted>> {
        let lane = &self.lanes[component];
        let Some(event) = lane.next() else { return Ok(()) };
        let named = self.vocabulary.phase_named(&self.machine, component, &event.object);
        let next = self.next_writing(component).map(|(phase, _)| phase);
        let Some(phase) =
            next.filter(|_| event.number == self.cycle(component)).filter(|next| named.as_ref() == Some(next))
        else {
            return Err(self.parted(component, Vec::new(), "the model's task is not before this phase".to_string()));
        };
        let scheduler = self.vocabulary.components[component].scheduler.clone();
        let current = self.vocabulary.location(Named::CurrentPhase, &[scheduler]);
        let rest = self.vocabulary.get(&self.machine, Named::NextPhase, &[phase]);
        let set = self.machine.set(&current, rest);
        set.map_err(|_| self.parted(component, Vec::new(), "the phase cannot be passed over".to_string()))?;
        self.agree(component, 1);
        Ok(())
    }

    /// The datum is not valid, so its writing is skipped next.
    fn withhold(&mut self, component: usize) -> Result<(), Stop> {
        let lane = &self.lanes[component];
        let at = lane.place.cursor;
        let Some(event) = lane.next() else { return Ok(()) };
        let channel = self.next_writing(component).map(|(_, channel)| self.vocabulary.object(&self.machine, &channel));
        if channel.as_ref() != Some(&event.object) {
            let reason = "the model's task is not before a writing to this channel".to_string();
            return Err(self.parted(component, Vec::new(), reason).into());
        }
        match lane.events.get(at + 1) {
            None if self.more => return Err(Stop::Waits),
            Some(next) if next.kind != Kind::Passes => {
                let reason = "what is not handed over is passed over next".to_string();
                return Err(self.parted(component, Vec::new(), reason).into());
            }
            _ => {}
        }
        self.agree(component, 1);
        Ok(())
    }

    /// The task failed in its present phase, and does nothing more.
    fn fail(&mut self, component: usize) -> Result<(), Box<Parted>> {
        let lane = &self.lanes[component];
        let Some(event) = lane.next() else { return Ok(()) };
        let is_last = lane.place.cursor + 1 == lane.events.len();
        if !is_last || event.number != self.cycle(component) {
            let reason = "a task that failed does nothing more, and tells in which cycle".to_string();
            return Err(self.parted(component, Vec::new(), reason));
        }
        self.agree(component, 1);
        Ok(())
    }

    fn parted(&self, component: usize, claims: Vec<Claim>, reason: String) -> Box<Parted> {
        let event = self.lanes[component].next().cloned();
        let named = self.vocabulary.components.iter().zip(&self.lanes);
        let mut before: Vec<Recorded> = named
            .flat_map(|(known, Lane { events, place, .. })| {
                let recorded = |event: &Event| Recorded { task: known.name.clone(), event: event.clone() };
                events[place.cursor.saturating_sub(SHOWN)..place.cursor].iter().map(recorded).collect::<Vec<_>>()
            })
            .collect();
        before.sort_by_key(|recorded| recorded.event.time_ns);
        let state = self.vocabulary.state(&self.machine, component, &objects(event.as_ref(), &claims));
        Box::new(Parted {
            tick: event.as_ref().map_or(0, |event| event.time_ns.div_euclid(self.tick_ns)),
            task: self.vocabulary.components[component].name.clone(),
            event,
            claims,
            decides: false,
            reason: Some(reason),
            agreed: self.agreed,
            before: before.split_off(before.len().saturating_sub(SHOWN)),
            state,
        })
    }
}
