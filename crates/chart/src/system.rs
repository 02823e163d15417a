//! A system as it is meant: components with phases, channels between them, devices (spec/charts.md, "Systems").
//!
//! INVARIANT: of a system without errors, every index is one into the system's lists; lengths of time are whole ticks; a
//! channel is read by a phase of its receiver and written by one of its sender, and a buffer has a master.

use syntax::Span;

use crate::link::Link;

/// A system.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    /// The name.
    pub name: String,
    /// The text shown.
    pub text: String,
    /// How long a step of the machine is, in nanoseconds.
    pub tick_ns: u64,
    /// Components in the order of the file.
    pub components: Vec<Component>,
    /// Channels in the order of the file.
    pub channels: Vec<Channel>,
    /// Sensors and actuators.
    pub devices: Vec<Device>,
    /// Physical connections, by the names of their ends.
    pub connections: Vec<(String, String)>,
    /// Where it is declared: its name.
    pub span: Span,
}

/// A control task.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// The name.
    pub name: String,
    /// The text shown.
    pub text: String,
    /// When it runs.
    pub timing: Timing,
    /// The phases of a cycle.
    pub phases: Vec<Phase>,
    /// Where it is declared: its name.
    pub span: Span,
}

/// When a component runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Timing {
    /// Periodically.
    Synchronous {
        /// From one cycle to the next, in ticks.
        period: u64,
        /// From the first step to the first cycle, in ticks.
        offset: u64,
        /// From the start of a cycle to the time at which it must be done, in ticks.
        deadline: u64,
    },
    /// When there are data; without a channel that it awaits, always.
    Asynchronous {
        /// The index of the channel whose data start a cycle.
        awaits: Option<usize>,
    },
}

impl Timing {
    /// The period in ticks; none of an asynchronous component.
    pub fn period(self) -> Option<u64> {
        match self {
            Timing::Synchronous { period, .. } => Some(period),
            Timing::Asynchronous { .. } => None,
        }
    }
}

/// What a component does for some time.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    /// The name.
    pub name: String,
    /// What is read, written or elaborated, by the word in the text.
    pub subject: String,
    /// What it does.
    pub action: Action,
    /// How long it takes, in ticks, without waiting for a lock.
    pub time: u64,
    /// Where it is declared.
    pub span: Span,
}

/// What a phase does.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Reads the channel of this index.
    Read(usize),
    /// Writes the channel of this index.
    Write(usize),
    /// Computes; by a rule of the specification that takes the scheduler.
    Elaborate(Option<Link>),
}

/// A channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// The name.
    pub name: String,
    /// The index of the component that writes.
    pub from: usize,
    /// The index of the component that reads.
    pub to: usize,
    /// What it is made of.
    pub kind: ChannelKind,
    /// Where it is declared: its name.
    pub span: Span,
}

/// What a channel is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChannelKind {
    /// A swinging buffer.
    Buffer {
        /// How many arrays.
        arrays: u64,
        /// The index of the component that updates the indexes.
        master: usize,
    },
    /// A message queue.
    Queue {
        /// How many messages it holds.
        capacity: u64,
    },
    /// One value.
    Shared,
}

/// A sensor or actuator.
#[derive(Debug, Clone, PartialEq)]
pub struct Device {
    /// The name.
    pub name: String,
    /// The text shown.
    pub text: String,
    /// A sensor; else an actuator.
    pub is_sensor: bool,
    /// Where it is declared: its name.
    pub span: Span,
}
