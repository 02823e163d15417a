//! The meaning of a system: components with phases, channels between them, devices (spec/charts.md, "Systems").
//!
//! A channel that the chart draws to several readers is a channel for each of them here, with its own buffer, queue or value; what writes
//! it is a phase for each, one after the other. INVARIANT: in a system without errors, every index is valid; times are whole ticks; a
//! channel is read by a phase of its receiver and written by one of its sender; a buffer has a master.

use syntax::Span;

use crate::computing::Computing;
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
    /// How many processors the tasks share, and where the chart says it.
    pub processors: Option<(u64, Span)>,
    /// How old data may be, in the order of the file.
    pub bounds: Vec<AgeBound>,
    /// Components in the order of the file.
    pub components: Vec<Component>,
    /// Channels in the order of the file.
    pub channels: Vec<Channel>,
    /// Sensors and actuators.
    pub devices: Vec<Device>,
    /// Physical connections, by the names of their ends.
    pub connections: Vec<(String, String)>,
    /// What its components compute, if machines say so.
    pub computing: Computing,
    /// The place of its name.
    pub span: Span,
}

/// How old data may be that come from one place to another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AgeBound {
    /// Its number in the chart, the first one 0.
    pub number: usize,
    /// The greatest age, in ticks.
    pub limit: u64,
    /// The component or sensor that they come from.
    pub from: Named,
    /// The component or actuator that gets what rests on them.
    pub to: Named,
    /// The one of its ways that it is about, by its number; otherwise it is about all.
    pub way: Option<usize>,
    /// Where it is stated.
    pub span: Span,
}

impl AgeBound {
    /// The name of the invariant that says so.
    pub fn invariant(&self) -> String {
        format!("inv_age{}_{}_to_{}", self.number + 1, self.from.text, self.to.text)
    }
}

/// How many deadlines a task may miss: at most so many of any successive cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tolerance {
    /// How many.
    pub missed: u64,
    /// Of how many cycles.
    pub cycles: u64,
    /// Where it is stated.
    pub span: Span,
}

/// How often a reading brings something new.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FreshBound {
    /// The longest time between two such readings, in ticks.
    pub limit: u64,
    /// Where it is stated.
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
    /// How many deadlines it may miss; none: no one.
    pub tolerance: Option<Tolerance>,
    /// The phases of a cycle.
    pub phases: Vec<Phase>,
    /// Where it is declared: its name.
    pub span: Span,
}

/// When a component runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Timing {
    /// Periodically.
    Synchronous {
        /// Time between two cycles, in ticks.
        period: u64,
        /// How much later than its period a cycle may be released, in ticks.
        jitter: u64,
        /// Time from the first step to the first period, in ticks.
        offset: u64,
        /// Time from the start of a period until its cycle must be done, in ticks.
        deadline: u64,
    },
    /// When data arrive; if it awaits none, always.
    Asynchronous {
        /// The data that start a cycle.
        awaits: Awaited,
    },
}

/// What an asynchronous component awaits.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Awaited {
    /// The indices of the channels, in the order of the text; each is read by the component.
    pub channels: Vec<usize>,
    /// Whether a cycle needs something new on all of them, or on one. It says nothing where there are fewer than two.
    pub needs: Needs,
}

/// Of how many awaited channels a cycle needs something new.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Needs {
    /// Of all.
    #[default]
    All,
    /// Of one.
    Any,
}

impl Awaited {
    /// Whether it needs data on several channels before a cycle begins.
    pub fn gathers(&self) -> bool {
        self.channels.len() > 1 && self.needs == Needs::All
    }

    /// As a chart says it: `awaits frames`, `awaits all frames, poses`; none if it awaits nothing.
    pub fn said<'n>(&self, name: impl Fn(usize) -> &'n str) -> Option<String> {
        let names: Vec<&str> = self.channels.iter().map(|channel| name(*channel)).collect();
        let all = names.join(", ");
        match (names.len(), self.needs) {
            (0, _) => None,
            (1, _) => Some(format!("awaits {all}")),
            (_, Needs::All) => Some(format!("awaits all {all}")),
            (_, Needs::Any) => Some(format!("awaits any {all}")),
        }
    }
}

impl System {
    /// The channels, those together that are drawn as one.
    pub fn drawn_channels(&self) -> impl Iterator<Item = &[Channel]> {
        // One declaration makes them, one after the other.
        self.channels.chunk_by(|one, next| one.drawn == next.drawn)
    }

    /// Whether cycles of some component may be released later than their periods start.
    pub fn has_jitter(&self) -> bool {
        self.components.iter().any(|component| component.timing.jitter() > 0)
    }

    /// Whether it bounds the time until readers get something new.
    pub fn has_fresh_bounds(&self) -> bool {
        self.components.iter().flat_map(|component| &component.phases).any(|phase| phase.fresh.is_some())
    }

    /// Of channels with these indices, one of each that is drawn.
    pub fn one_of_each_drawn(&self, channels: impl IntoIterator<Item = usize>) -> Vec<usize> {
        let mut found: Vec<usize> = Vec::new();
        for channel in channels {
            if !found.iter().any(|first| self.channels[*first].drawn == self.channels[channel].drawn) {
                found.push(channel);
            }
        }
        found
    }
}

impl Timing {
    /// The period in ticks; `None` for an asynchronous component.
    pub fn period(&self) -> Option<u64> {
        match self {
            Timing::Synchronous { period, .. } => Some(*period),
            Timing::Asynchronous { .. } => None,
        }
    }

    /// How much later than its period a cycle may be released, in ticks; 0 for an asynchronous component.
    pub fn jitter(&self) -> u64 {
        match self {
            Timing::Synchronous { jitter, .. } => *jitter,
            Timing::Asynchronous { .. } => 0,
        }
    }

    /// The indices of the channels whose data start a cycle.
    pub fn awaited(&self) -> &[usize] {
        match self {
            Timing::Synchronous { .. } => &[],
            Timing::Asynchronous { awaits } => &awaits.channels,
        }
    }
}

impl Component {
    /// The ticks from the start of a period until its cycle must be done: those until the deadline; a task of a single phase also waits for a
    /// tick before its next cycle. `None` for an asynchronous component.
    pub fn available(&self) -> Option<u64> {
        match self.timing {
            Timing::Synchronous { period, deadline, .. } => {
                Some(deadline.min(period.saturating_sub(u64::from(self.phases.len() == 1))))
            }
            Timing::Asynchronous { .. } => None,
        }
    }
}

/// A phase of a component's cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    /// The name.
    pub name: String,
    /// The name of the phase as it is drawn: another one only if it writes to one of several readers.
    pub drawn: String,
    /// What is read, written or elaborated, as named in the text.
    pub subject: String,
    /// What it does.
    pub action: Action,
    /// Its duration in ticks, without waiting for a lock; the longest if it varies.
    pub time: u64,
    /// The shortest duration; equal to `time` unless it varies.
    pub least: u64,
    /// Of a reading: how often it brings something new.
    pub fresh: Option<FreshBound>,
    /// The machine that says what an elaboration computes.
    pub machine: Option<Named>,
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
    /// The name of the channel as it is drawn, and as machines know it: another one only if the drawn channel has several readers.
    pub drawn: String,
    /// The index of the component that writes.
    pub from: usize,
    /// The index of the component that reads.
    pub to: usize,
    /// Its kind.
    pub kind: ChannelKind,
    /// The domain of its data, if the chart says it.
    pub message: Option<Named>,
    /// Where it is declared: its name.
    pub span: Span,
}

/// A name of something outside the chart: a machine, or a domain as it is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    /// Its text.
    pub text: String,
    /// Where it stands.
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
    /// The domain of what it senses or sets, if the chart says it.
    pub message: Option<Named>,
    /// Where it is declared: its name.
    pub span: Span,
}

/// A number of ticks, in the largest unit that makes it a short number.
pub fn length(ticks: i64, tick_ns: u64) -> String {
    let nanoseconds = i128::from(ticks) * i128::from(tick_ns);
    let units = [("s", 1_000_000_000_i128), ("ms", 1_000_000), ("us", 1_000), ("ns", 1)];
    // Three decimals are enough for a time written by hand; otherwise a smaller unit is used.
    let unit = units.into_iter().find(|(_, size)| nanoseconds.abs() >= *size && nanoseconds * 1_000 % size == 0);
    let (name, size) = unit.unwrap_or(("ms", 1_000_000));
    let thousandths = nanoseconds * 1_000 / size;
    let sign = if thousandths < 0 { "-" } else { "" };
    let (whole, rest) = (thousandths.abs() / 1_000, thousandths.abs() % 1_000);
    let digits = format!("{rest:03}");
    let digits = digits.trim_end_matches('0');
    let point = if digits.is_empty() { "" } else { "." };
    format!("{sign}{whole}{point}{digits} {name}")
}

#[cfg(test)]
mod tests {
    use super::length;

    #[test]
    fn lengths_of_time() {
        let shown = |ticks, tick_ns| length(ticks, tick_ns);
        assert_eq!(shown(100, 100_000), "10 ms");
        assert_eq!(shown(62, 100_000), "6.2 ms");
        assert_eq!(shown(-50, 100_000), "-5 ms");
        assert_eq!(shown(3, 100), "300 ns");
        assert_eq!(shown(1_234_567, 1_000), "1234.567 ms");
        assert_eq!(shown(0, 1_000), "0 ms");
        assert_eq!(shown(2_500, 1_000_000), "2.5 s");
    }
}
