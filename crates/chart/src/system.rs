//! The meaning of a system: components with phases, channels between them, devices (spec/charts.md, "Systems").
//!
//! INVARIANT: in a system without errors, every index is valid; times are whole ticks; a channel is read by a phase of
//! its receiver and written by one of its sender; a buffer has a master.

use syntax::Span;

use crate::link::Link;

/// A system.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    /// The name.
    pub name: String,
    /// The text shown.
    pub text: String,
    /// The length of a machine's step, in nanoseconds.
    pub tick_ns: u64,
    /// Components in the order of the file.
    pub components: Vec<Component>,
    /// Channels in the order of the file.
    pub channels: Vec<Channel>,
    /// Sensors and actuators.
    pub devices: Vec<Device>,
    /// Physical connections, by the names of their ends.
    pub connections: Vec<(String, String)>,
    /// The place of its name.
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
        /// Time between two cycles, in ticks.
        period: u64,
        /// Time from the first step to the first cycle, in ticks.
        offset: u64,
        /// Time from the start of a cycle until it must be done, in ticks.
        deadline: u64,
    },
    /// When data arrive; without an awaited channel, always.
    Asynchronous {
        /// The index of the channel whose data start a cycle.
        awaits: Option<usize>,
    },
}

impl Timing {
    /// The period in ticks; `None` for an asynchronous component.
    pub fn period(self) -> Option<u64> {
        match self {
            Timing::Synchronous { period, .. } => Some(period),
            Timing::Asynchronous { .. } => None,
        }
    }
}

/// A phase of a component's cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    /// The name.
    pub name: String,
    /// What is read, written or elaborated, as named in the text.
    pub subject: String,
    /// What it does.
    pub action: Action,
    /// Its duration in ticks, without waiting for a lock.
    pub time: u64,
    /// Where it is declared.
    pub span: Span,
}

/// What a phase does.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Reads the channel with this index.
    Read(usize),
    /// Writes the channel with this index.
    Write(usize),
    /// Computes, by a rule of the specification that takes the scheduler.
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
    /// Its kind.
    pub kind: ChannelKind,
    /// Where it is declared: its name.
    pub span: Span,
}

/// The kinds of channels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChannelKind {
    /// A swinging buffer.
    Buffer {
        /// The number of arrays.
        arrays: u64,
        /// The index of the component that updates the indexes.
        master: usize,
    },
    /// A message queue.
    Queue {
        /// The number of messages it can hold.
        capacity: u64,
    },
    /// A single value.
    Shared,
}

/// A sensor or actuator.
#[derive(Debug, Clone, PartialEq)]
pub struct Device {
    /// The name.
    pub name: String,
    /// The text shown.
    pub text: String,
    /// Whether it is a sensor; otherwise it is an actuator.
    pub is_sensor: bool,
    /// Where it is declared: its name.
    pub span: Span,
}
