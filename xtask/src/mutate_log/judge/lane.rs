//! A task's own events: are they those of its cycles, at instants at which they may be?
//!
//! In: the events of one task up to the stop. Out: nothing, or what is wrong. The grammar of a cycle is read off the chart's
//! phases; which of two ways a lock or a queue goes is taken from the events, and judged with the other tasks (`order`).

use chart::system::{Action, Timing};
use recording::{Event, Kind};

use super::{Form, Plan};

/// `LIMIT` of spec/conform.md: in real time a task is interrupted for no longer.
const INTERRUPTED_NS: i64 = 1_000_000_000;

/// A task's events on the way through them.
pub(super) struct Lane<'a> {
    plan: &'a Plan<'a>,
    index: usize,
    events: &'a [Event],
    stopped_ns: i64,
    at: usize,
    /// What the present cycle has waited for locks that it then had.
    waited_ns: i64,
    /// With what it waited in vain and for room.
    waited_in_all_ns: i64,
}

/// The events end here, and all is well.
struct End;

type Step<T> = Result<Result<T, End>, String>;

/// Goes on with the value, or returns.
macro_rules! next {
    ($step:expr) => {
        match $step? {
            Ok(value) => value,
            Err(End) => return Ok(Err(End)),
        }
    };
}

impl<'a> Lane<'a> {
    pub(super) fn new(plan: &'a Plan<'a>, index: usize, events: &'a [Event], stopped_ns: i64) -> Lane<'a> {
        Lane { plan, index, events, stopped_ns, at: 0, waited_ns: 0, waited_in_all_ns: 0 }
    }

    pub(super) fn check(mut self) -> Result<(), String> {
        let name = &self.plan.system.components[self.index].name;
        for cycle in 0.. {
            match self.cycle(cycle).map_err(|reason| format!("{name}, event {}: {reason}", self.at))? {
                Ok(()) => {}
                Err(End) => break,
            }
        }
        match self.at == self.events.len() {
            true => Ok(()),
            false => Err(format!("{name} has more events")),
        }
    }

    fn cycle(&mut self, cycle: u64) -> Step<()> {
        let component = &self.plan.system.components[self.index];
        (self.waited_ns, self.waited_in_all_ns) = (0, 0);
        for (number, phase) in component.phases.iter().enumerate() {
            if let Action::Write(channel) = phase.action {
                let withheld = self.takes(Kind::Invalid, &self.plan.system.channels[channel].name).is_some();
                if withheld || self.peek().is_some_and(|event| event.kind == Kind::Passes) {
                    let event = next!(self.expect(Kind::Passes, &phase.name));
                    self.is_cycle(event, cycle)?;
                    continue;
                }
            }
            let begins = next!(self.expect(Kind::Begins, &phase.name));
            self.is_cycle(begins, cycle)?;
            if let (0, &Timing::Synchronous { period, offset, .. }) = (number, &component.timing) {
                let due_ns = (offset + cycle * period) as i64 * self.plan.tick_ns;
                if begins.time_ns < due_ns {
                    return Err("its cycle begins before it is due".to_string());
                }
            }
            match phase.action {
                Action::Elaborate(_) => {}
                Action::Read(channel) => next!(self.reads(channel)),
                Action::Write(channel) => next!(self.writes(channel, begins)),
            }
            let ends = next!(self.expect(Kind::Ends, &phase.name));
            self.is_cycle(ends, cycle)?;
        }
        match component.timing {
            Timing::Synchronous { .. } => self.completes(cycle),
            Timing::Asynchronous { .. } => Ok(Ok(())),
        }
    }

    fn completes(&mut self, cycle: u64) -> Step<()> {
        let component = &self.plan.system.components[self.index];
        let Timing::Synchronous { period, offset, deadline, .. } = component.timing else { return Ok(Ok(())) };
        let Some(event) = self.peek() else { return Ok(Err(End)) };
        // Deadlines are whole ticks, instants are not: within the tick of its deadline a cycle may be either.
        let due_ns = (offset + cycle * period + deadline) as i64 * self.plan.tick_ns;
        let fits = match event.kind {
            Kind::Meets => event.time_ns < due_ns + self.plan.tick_ns,
            Kind::Misses => event.time_ns > due_ns,
            _ => false,
        };
        if !fits || *event.object != *component.name || event.number != cycle {
            return Err("its cycle is not done like this".to_string());
        }
        self.at += 1;
        Ok(Ok(()))
    }

    fn reads(&mut self, channel: usize) -> Step<()> {
        let name = self.plan.system.channels[channel].name.as_str();
        match self.plan.form(channel) {
            Form::Cell => next!(self.expect(Kind::Loads, name)),
            Form::Queue { .. } => next!(self.expect(Kind::Takes, name)),
            Form::Buffer { master, .. } if master == self.index => {
                next!(self.manages(name));
                next!(self.expect(Kind::Reads, name))
            }
            Form::Buffer { .. } => {
                if next!(self.waits(name)) {
                    next!(self.expect(Kind::Reads, name));
                    next!(self.expect(Kind::Releases, name));
                }
                return Ok(Ok(()));
            }
        };
        Ok(Ok(()))
    }

    fn writes(&mut self, channel: usize, begins: &Event) -> Step<()> {
        let name = self.plan.system.channels[channel].name.as_str();
        match self.plan.form(channel) {
            Form::Cell => _ = next!(self.expect(Kind::Stores, name)),
            Form::Queue { .. } => {
                let Some(event) = self.peek() else { return Ok(Err(End)) };
                let kind = if event.kind == Kind::Refuses { Kind::Refuses } else { Kind::Sends };
                let event = next!(self.expect(kind, name));
                self.waited_in_all_ns += event.time_ns - begins.time_ns;
                if kind == Kind::Refuses {
                    self.may_give_up()?;
                }
            }
            Form::Buffer { master, .. } if master == self.index => {
                next!(self.expect(Kind::Writes, name));
                next!(self.manages(name));
            }
            Form::Buffer { .. } => {
                if next!(self.waits(name)) {
                    next!(self.expect(Kind::Writes, name));
                    next!(self.expect(Kind::Releases, name));
                }
            }
        }
        Ok(Ok(()))
    }

    /// A master's way through the lock.
    fn manages(&mut self, name: &str) -> Step<()> {
        if next!(self.waits(name)) {
            self.takes(Kind::Swaps, name);
            next!(self.expect(Kind::Releases, name));
        }
        Ok(Ok(()))
    }

    /// Asks for a lock; whether it came.
    fn waits(&mut self, name: &str) -> Step<bool> {
        let asks = next!(self.expect(Kind::Asks, name));
        let Some(event) = self.peek() else {
            self.waited_ns += self.beyond_doubt(self.stopped_ns - asks.time_ns);
            self.has_time()?;
            return Ok(Err(End));
        };
        let span_ns = event.time_ns - asks.time_ns;
        self.waited_in_all_ns += span_ns;
        if self.takes(Kind::GivesUp, name).is_some() {
            self.may_give_up()?;
            return Ok(Ok(false));
        }
        next!(self.expect(Kind::Enters, name));
        self.waited_ns += self.beyond_doubt(span_ns);
        self.has_time()?;
        Ok(Ok(true))
    }

    fn beyond_doubt(&self, span_ns: i64) -> i64 {
        if self.plan.real { (span_ns - INTERRUPTED_NS).max(0) } else { span_ns }
    }

    fn has_time(&self) -> Result<(), String> {
        match self.plan.budget(self.index) {
            Some(budget) if self.waited_ns > 0 && self.waited_ns > budget * self.plan.tick_ns => {
                Err("it waits for longer than its watchdog lets it".to_string())
            }
            _ => Ok(()),
        }
    }

    fn may_give_up(&self) -> Result<(), String> {
        match self.plan.budget(self.index) {
            Some(budget) if self.waited_in_all_ns / self.plan.tick_ns >= budget => Ok(()),
            _ => Err("its watchdog gives up too early".to_string()),
        }
    }

    fn is_cycle(&self, event: &Event, cycle: u64) -> Result<(), String> {
        if event.number == cycle { Ok(()) } else { Err(format!("it is in cycle {cycle}")) }
    }

    fn peek(&self) -> Option<&'a Event> {
        self.events.get(self.at)
    }

    fn takes(&mut self, kind: Kind, object: &str) -> Option<&'a Event> {
        let event = self.peek().filter(|event| event.kind == kind && *event.object == *object)?;
        let has_no_number =
            matches!(kind, Kind::Asks | Kind::Enters | Kind::GivesUp | Kind::Releases | Kind::Refuses | Kind::Invalid);
        if has_no_number && event.number != 0 {
            return None;
        }
        self.at += 1;
        Some(event)
    }

    fn expect(&mut self, kind: Kind, object: &str) -> Step<&'a Event> {
        match (self.peek(), self.takes(kind, object)) {
            (None, _) => Ok(Err(End)),
            (Some(_), Some(event)) => Ok(Ok(event)),
            (Some(found), None) => Err(format!("{} instead of {kind} {object}", found.words())),
        }
    }
}
