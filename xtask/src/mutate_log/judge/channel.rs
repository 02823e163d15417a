//! The state of a channel, and which events it takes.
//!
//! In: an event of one of its two ends. Out: the state after it, or none: the channel does not take it. The protocols are
//! written down from library/patterns and the table of spec/conform.md, for one producer and one consumer.

use recording::{Event, Kind};

use super::Form;

/// What a channel has come to.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Channel {
    Buffer(Buffer),
    Queue { capacity: u64, sent: u64, taken: u64 },
    Cell { stored: u64, loaded: u64 },
}

/// A swinging buffer. An end is 0, the producer, or 1, the consumer.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Buffer {
    master: usize,
    inside: Option<usize>,
    /// Who waits for the lock, first come first.
    line: Vec<usize>,
    read: u64,
    write: u64,
    numbers: Vec<u64>,
    written: u64,
    received: u64,
    /// What was written last was not handed over yet.
    pending: bool,
}

impl Channel {
    pub(super) fn new(form: Form, from: usize) -> Channel {
        match form {
            Form::Cell => Channel::Cell { stored: 0, loaded: 0 },
            Form::Queue { capacity } => Channel::Queue { capacity, sent: 0, taken: 0 },
            Form::Buffer { arrays, master } => Channel::Buffer(Buffer {
                master: usize::from(master != from),
                inside: None,
                line: Vec::new(),
                read: arrays - 1,
                write: 0,
                numbers: vec![0; arrays as usize],
                written: 0,
                received: 0,
                pending: false,
            }),
        }
    }

    /// Whether an asynchronous task that awaits the channel is woken.
    pub(super) fn wakes(&self) -> bool {
        match self {
            Channel::Cell { stored, loaded } => stored != loaded,
            Channel::Queue { sent, taken, .. } => sent != taken,
            Channel::Buffer(buffer) => {
                buffer.numbers[buffer.read as usize] != buffer.received || (buffer.pending && buffer.master == 1)
            }
        }
    }

    /// Takes an event of that end; false: it does not, and nothing is to be concluded from its state.
    pub(super) fn take(&mut self, end: usize, event: &Event) -> bool {
        match self {
            Channel::Cell { stored, loaded } => match event.kind {
                Kind::Stores => {
                    *stored += 1;
                    event.number == *stored
                }
                Kind::Loads => {
                    let fresh = *stored != std::mem::replace(loaded, *stored);
                    event.number == *stored && event.fresh == Some(fresh)
                }
                _ => false,
            },
            Channel::Queue { capacity, sent, taken } => match event.kind {
                Kind::Sends => {
                    *sent += 1;
                    event.number == *sent && *sent - *taken <= *capacity
                }
                Kind::Refuses => *sent - *taken == *capacity,
                Kind::Takes if event.number == 0 => sent == taken,
                Kind::Takes => {
                    *taken += 1;
                    event.number == *taken && *taken <= *sent
                }
                _ => false,
            },
            Channel::Buffer(buffer) => buffer.take(end, event),
        }
    }
}

impl Buffer {
    fn take(&mut self, end: usize, event: &Event) -> bool {
        let (is_master, is_inside) = (end == self.master, self.inside == Some(end));
        let is_first = self.inside.is_none() && self.line.first() == Some(&end);
        match event.kind {
            Kind::Asks => {
                let is_outside = !is_inside && !self.line.contains(&end);
                self.line.push(end);
                is_outside
            }
            Kind::Enters => {
                self.line.retain(|waiting| *waiting != end);
                self.inside = Some(end);
                is_first
            }
            Kind::GivesUp => {
                let waits = self.line.contains(&end);
                self.line.retain(|waiting| *waiting != end);
                waits && !is_first
            }
            // A master hands over what there is.
            Kind::Releases => {
                self.inside = None;
                is_inside && !(is_master && self.pending)
            }
            Kind::Swaps => {
                let was_pending = std::mem::replace(&mut self.pending, false);
                self.read = self.write;
                self.write = (self.write + 1) % self.numbers.len() as u64;
                let number = self.numbers[self.read as usize];
                let said = (event.number, event.array, event.next);
                is_master && is_inside && was_pending && said == (number, Some(self.read), Some(self.write))
            }
            Kind::Writes => {
                self.written += 1;
                self.numbers[self.write as usize] = self.written;
                self.pending = true;
                let said = (event.number, event.array);
                end == 0 && is_inside != is_master && said == (self.written, Some(self.write))
            }
            Kind::Reads => {
                let number = self.numbers[self.read as usize];
                let fresh = number != std::mem::replace(&mut self.received, number);
                let said = (event.number, event.array, event.fresh);
                end == 1 && is_inside != is_master && said == (number, Some(self.read), Some(fresh))
            }
            _ => false,
        }
    }
}
