//! What the tasks do in a step: changed locations of the library of patterns → events.
//!
//! In: a machine after a step, and what the step changed. Out: [`Claim`]s, each with the number of its component, those
//! of one component in the order in which a task has them. An event follows from the one location whose change makes
//! it; its other parts follow from the state after the step. A step itself has no order: its updates are made at once.
//! The protocol has one, which the table of spec/conform.md gives: no task touches an array before it has the lock.

use machine::{Change, LocationRef, Machine, Value};
use recording::{Event, Kind};

use crate::evidence::Claim;
use crate::vocabulary::{End, Named, Vocabulary};

/// Gathers the claims of one change.
struct Claiming<'a> {
    vocabulary: &'a Vocabulary,
    machine: &'a Machine,
    change: &'a Change,
    /// Everything that the step changed.
    all: &'a [Change],
    out: &'a mut Vec<(usize, Claim)>,
}

impl Vocabulary {
    /// What a step changed of the library's functions.
    pub fn changes(&self, machine: &Machine) -> Vec<Change> {
        machine.changes_of(&|function| self.which(function).is_some())
    }

    /// The events of a step with these changes, the component's number with each.
    pub fn claims(&self, machine: &Machine, changes: &[Change]) -> Vec<(usize, Claim)> {
        let mut claims = Vec::with_capacity(4);
        for change in changes {
            if let Some(named) = self.which(change.location.function) {
                Claiming { vocabulary: self, machine, change, all: changes, out: &mut claims }.claim(named);
            }
        }
        claims.sort_by_key(|(_, claim)| turn(claim.event.kind));
        claims
    }
}

/// The turn of a task's events within a step: a phase is finished and ended before the next one begins.
fn turn(kind: Kind) -> u8 {
    match kind {
        Kind::Enters | Kind::GivesUp => 0,
        Kind::Swaps => 1,
        Kind::Releases => 2,
        Kind::Sends | Kind::Refuses | Kind::Stores => 3,
        Kind::Ends | Kind::Passes | Kind::Faults => 4,
        Kind::Meets | Kind::Misses => 5,
        Kind::Begins | Kind::Invalid => 6,
        Kind::Asks | Kind::Takes | Kind::Loads | Kind::Writes | Kind::Reads => 7,
    }
}

impl Claiming<'_> {
    fn claim(&mut self, named: Named) {
        let Change { location, before, after, .. } = self.change;
        let (vocabulary, arguments) = (self.vocabulary, location.arguments.as_slice());
        match named {
            Named::CurrentPhase => self.phases(&arguments[0], before, after),
            Named::LockState => {
                let literals = &vocabulary.literals;
                let kind = match (before, after) {
                    (before, after) if *before == literals.ready && *after == literals.waiting => Kind::Asks,
                    (before, after) if *before == literals.waiting && *after == literals.execution => Kind::Enters,
                    (before, after) if *before == literals.waiting && *after == literals.ready => Kind::GivesUp,
                    _ => Kind::Releases,
                };
                let Some(channel) = vocabulary.locks.get(&arguments[0]) else { return };
                self.event(vocabulary.of_task(&arguments[1]), kind, channel, |_| {});
            }
            Named::Written => {
                let array = self.number(Named::WritingArray, arguments);
                self.at_end(End::Writes, Kind::Writes, |event| {
                    (event.number, event.array) = (whole(after), Some(array));
                });
            }
            Named::IndexRead => {
                let number = self.number(Named::Sequence, &[arguments[0].clone(), after.clone()]);
                let next = self.number(Named::IndexWrite, arguments);
                self.at_end(End::Manages, Kind::Swaps, |event| {
                    (event.number, event.array, event.next) = (number, Some(whole(after)), Some(next));
                });
            }
            Named::ReadingArray if !after.is_undef() => {
                let number = self.number(Named::Sequence, &[arguments[0].clone(), after.clone()]);
                let fresh = self.get(Named::BufferFresh, arguments) == Value::Boolean(true);
                self.at_end(End::Reads, Kind::Reads, |event| {
                    (event.number, event.array, event.fresh) = (number, Some(whole(after)), Some(fresh));
                });
            }
            Named::Sent => self.at_end(End::Writes, Kind::Sends, |event| event.number = whole(after)),
            Named::ValueSequence => self.at_end(End::Writes, Kind::Stores, |event| event.number = whole(after)),
            Named::Refused => self.at_end(End::Writes, Kind::Refuses, |_| {}),
            Named::DeadlinesMet | Named::DeadlinesMissed => {
                let kind = if named == Named::DeadlinesMet { Kind::Meets } else { Kind::Misses };
                let index = vocabulary.of_task(&arguments[0]);
                let cycles = self.number(Named::Cycles, arguments);
                let scheduler = &vocabulary.components[index].scheduler;
                self.event(index, kind, scheduler, |event| event.number = cycles.saturating_sub(1));
            }
            _ => {}
        }
    }

    /// One phase ended, another one began.
    fn phases(&mut self, scheduler: &Value, before: &Value, after: &Value) {
        let components = &self.vocabulary.components;
        let Some(index) = components.iter().position(|known| known.scheduler == *scheduler) else { return };
        let component = &components[index];
        let task = std::slice::from_ref(&component.task);
        let now = self.number(Named::Cycles, task);
        let was = self.changed(Named::Cycles, task).map_or(now, |change| whole(&change.before));
        if component.phases.contains(before) {
            self.event(index, Kind::Ends, before, |event| event.number = was);
        }
        if component.phases.contains(after) {
            self.event(index, Kind::Begins, after, |event| event.number = now);
            self.begun(index, after);
        }
    }

    /// What a phase takes as it begins: a message, a value.
    fn begun(&mut self, index: usize, phase: &Value) {
        let phase = std::slice::from_ref(phase);
        let action = self.get(Named::Action, phase);
        if action == self.vocabulary.literals.receiving {
            let queue = self.get(Named::MessageQueue, phase);
            let taken = self.changed(Named::Taken, std::slice::from_ref(&queue));
            let number = taken.map_or(0, |change| whole(&change.after));
            self.event(index, Kind::Takes, &queue, |event| event.number = number);
        } else if action == self.vocabulary.literals.loading {
            let cell = self.get(Named::SharedValue, phase);
            let cells = std::slice::from_ref(&cell);
            let number = self.number(Named::ReceivedSequence, cells);
            let fresh = self.get(Named::ValueFresh, cells) == Value::Boolean(true);
            self.event(index, Kind::Loads, &cell, |event| (event.number, event.fresh) = (number, Some(fresh)));
        }
    }

    /// An event of the component at that end of the channel whose location changed.
    fn at_end(&mut self, end: End, kind: Kind, say: impl FnOnce(&mut Event)) {
        let channel = &self.change.location.arguments[0];
        if let Some(index) = self.vocabulary.end(channel, end) {
            self.event(index, kind, channel, say);
        }
    }

    fn event(&mut self, component: usize, kind: Kind, object: &Value, say: impl FnOnce(&mut Event)) {
        let object = self.vocabulary.object(self.machine, object);
        let mut event = Event { time_ns: 0, kind, object, number: 0, array: None, next: None, fresh: None };
        say(&mut event);
        self.out.push((component, Claim { event, span: self.change.span }));
    }

    fn changed(&self, named: Named, arguments: &[Value]) -> Option<&Change> {
        let location = LocationRef { function: self.vocabulary.function(named), arguments };
        self.all.iter().find(|change| change.location.borrowed() == location)
    }

    fn get(&self, named: Named, arguments: &[Value]) -> Value {
        self.vocabulary.get(self.machine, named, arguments)
    }

    fn number(&self, named: Named, arguments: &[Value]) -> u64 {
        whole(&self.get(named, arguments))
    }
}

fn whole(value: &Value) -> u64 {
    match value {
        Value::Integer(number) => u64::try_from(*number).unwrap_or(0),
        _ => 0,
    }
}
