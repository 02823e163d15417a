//! Views of systems: components, phases, channels, devices and connections (spec/charts.md).

use super::chart::text_of;
use super::{AstNode, Children, Domain, Link, child, children, nodes, token, tokens};
use crate::{SyntaxKind, SyntaxKind::*, SyntaxToken};

nodes! {
    /// `system NAME "text" … endsystem`
    SystemChart = SYSTEM_CHART,
    /// `tick Q`: how long a step of the machine is.
    Tick = TICK,
    /// `processors N`: how many the tasks share.
    Processors = PROCESSORS,
    /// `component NAME "text" KIND … endcomponent`
    Component = COMPONENT,
    /// `synchronous period Q jitter Q offset Q deadline Q misses N of N`, `asynchronous awaits all NAME, NAME`
    ComponentKind = COMPONENT_KIND,
    /// `awaits NAME`, `awaits all NAME, NAME`, `awaits any NAME, NAME`
    Awaits = AWAITS,
    /// `misses N of N`: how many deadlines a task may miss.
    Tolerance = TOLERANCE,
    /// `every Q fresh`: how often a reading brings something new.
    FreshBound = FRESH_BOUND,
    /// `read CHANNEL as NAME Q every Q fresh`, `elaborate NAME Q by NAME {rule}`, `write CHANNEL as NAME Q`
    Phase = PHASE,
    /// `channel NAME : DOMAIN from NAME to NAME, NAME KIND`
    Channel = CHANNEL,
    /// `swinging buffer N master NAME`, `queue N`, `shared value`
    ChannelKind = CHANNEL_KIND,
    /// `sensor NAME : DOMAIN "text"`, `actuator NAME : DOMAIN "text"`
    Device = DEVICE,
    /// `within Q from NAME to NAME`: how old data may be.
    AgeBound = AGE_BOUND,
    /// `NAME -> NAME`
    Connection = CONNECTION,
    /// `NUMBER UNIT`
    Quantity = QUANTITY,
}

fn names(node: &crate::SyntaxNode) -> impl Iterator<Item = SyntaxToken> {
    tokens(node).filter(|token| token.kind() == GENERIC_ID)
}

impl SystemChart {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The text shown.
    pub fn text(&self) -> Option<String> {
        text_of(self.syntax())
    }
    /// How long a step is; more than one is a fault.
    pub fn ticks(&self) -> Children<Tick> {
        children(self.syntax())
    }
    /// How many processors the tasks share; more than one is a fault.
    pub fn processors(&self) -> Children<Processors> {
        children(self.syntax())
    }
    /// How old data may be.
    pub fn age_bounds(&self) -> Children<AgeBound> {
        children(self.syntax())
    }
    /// The components.
    pub fn components(&self) -> Children<Component> {
        children(self.syntax())
    }
    /// The channels.
    pub fn channels(&self) -> Children<Channel> {
        children(self.syntax())
    }
    /// Sensors and actuators.
    pub fn devices(&self) -> Children<Device> {
        children(self.syntax())
    }
    /// Physical connections.
    pub fn connections(&self) -> Children<Connection> {
        children(self.syntax())
    }
}

impl Tick {
    /// The length.
    pub fn quantity(&self) -> Option<Quantity> {
        child(self.syntax())
    }
}

impl Processors {
    /// The number.
    pub fn number(&self) -> Option<SyntaxToken> {
        token(self.syntax(), INTEGER)
    }
}

impl AgeBound {
    /// The greatest age.
    pub fn quantity(&self) -> Option<Quantity> {
        child(self.syntax())
    }
    /// The component or sensor that the data come from.
    pub fn from(&self) -> Option<SyntaxToken> {
        names(self.syntax()).next()
    }
    /// The component or actuator that gets what rests on them.
    pub fn to(&self) -> Option<SyntaxToken> {
        names(self.syntax()).nth(1)
    }
}

impl Component {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The text shown.
    pub fn text(&self) -> Option<String> {
        text_of(self.syntax())
    }
    /// Synchronous or asynchronous.
    pub fn kind(&self) -> Option<ComponentKind> {
        child(self.syntax())
    }
    /// The phases of a cycle, in order.
    pub fn phases(&self) -> Children<Phase> {
        children(self.syntax())
    }
}

impl ComponentKind {
    /// It is synchronous.
    pub fn is_synchronous(&self) -> bool {
        token(self.syntax(), SYNCHRONOUS_KW).is_some()
    }
    /// What an asynchronous component awaits.
    pub fn awaits(&self) -> Option<Awaits> {
        child(self.syntax())
    }
    /// How many deadlines it may miss.
    pub fn tolerance(&self) -> Option<Tolerance> {
        child(self.syntax())
    }
    /// The quantity after `period`, `jitter`, `offset` or `deadline`.
    pub fn quantity(&self, word: SyntaxKind) -> Option<Quantity> {
        let word = token(self.syntax(), word)?;
        let mut next = word.next_sibling_or_token();
        while let Some(element) = next.filter(|element| element.as_token().is_none_or(|t| t.kind().is_trivia())) {
            if let Some(node) = element.as_node() {
                return Quantity::cast(node.clone());
            }
            next = element.next_sibling_or_token();
        }
        None
    }
}

impl Awaits {
    /// `all` or `any`, before several channels.
    pub fn quantifier(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).find(|token| matches!(token.kind(), ALL_KW | ANY_KW))
    }
    /// The channels whose data start a cycle.
    pub fn channels(&self) -> impl Iterator<Item = SyntaxToken> {
        names(self.syntax())
    }
}

/// What a phase does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PhaseKind {
    /// Reads from a channel.
    Read,
    /// Computes.
    Elaborate,
    /// Writes to a channel.
    Write,
}

impl Phase {
    /// What it does.
    pub fn kind(&self) -> Option<PhaseKind> {
        tokens(self.syntax()).find_map(|token| match token.kind() {
            READ_KW => Some(PhaseKind::Read),
            ELABORATE_KW => Some(PhaseKind::Elaborate),
            WRITE_KW => Some(PhaseKind::Write),
            _ => None,
        })
    }
    /// The channel read or written, or the name of the elaboration.
    pub fn subject(&self) -> Option<SyntaxToken> {
        names(self.syntax()).next()
    }
    /// The name after `as`.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), AS_KW)?;
        names(self.syntax()).nth(1)
    }
    /// How long it takes.
    pub fn time(&self) -> Option<Quantity> {
        child(self.syntax())
    }
    /// How often a reading brings something new.
    pub fn fresh(&self) -> Option<FreshBound> {
        child(self.syntax())
    }
    /// The machine after `by`.
    pub fn machine(&self) -> Option<SyntaxToken> {
        let by = token(self.syntax(), BY_KW)?;
        names(self.syntax()).find(|name| name.text_range().start() > by.text_range().start())
    }
    /// The rule of an elaboration.
    pub fn link(&self) -> Option<Link> {
        child(self.syntax())
    }
}

impl Tolerance {
    /// How many deadlines may be missed.
    pub fn missed(&self) -> Option<SyntaxToken> {
        token(self.syntax(), INTEGER)
    }
    /// Of how many successive cycles.
    pub fn cycles(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).filter(|token| token.kind() == INTEGER).nth(1)
    }
}

impl FreshBound {
    /// The longest time between two readings that bring something new.
    pub fn quantity(&self) -> Option<Quantity> {
        child(self.syntax())
    }
}

impl Channel {
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        names(self.syntax()).next()
    }
    /// The domain of what goes through it.
    pub fn message(&self) -> Option<Domain> {
        child(self.syntax())
    }
    /// The component that writes.
    pub fn from(&self) -> Option<SyntaxToken> {
        names(self.syntax()).nth(1)
    }
    /// The components that read.
    pub fn readers(&self) -> impl Iterator<Item = SyntaxToken> {
        names(self.syntax()).skip(2)
    }
    /// What it is made of.
    pub fn kind(&self) -> Option<ChannelKind> {
        child(self.syntax())
    }
}

impl ChannelKind {
    /// How many arrays a swinging buffer may have.
    pub const ARRAYS: std::ops::RangeInclusive<u64> = 2..=8;

    /// It is a swinging buffer.
    pub fn is_buffer(&self) -> bool {
        token(self.syntax(), SWINGING_KW).is_some()
    }
    /// It is a message queue.
    pub fn is_queue(&self) -> bool {
        token(self.syntax(), QUEUE_KW).is_some()
    }
    /// It is a value without a lock.
    pub fn is_shared(&self) -> bool {
        token(self.syntax(), SHARED_KW).is_some()
    }
    /// The number of arrays or of messages.
    pub fn size(&self) -> Option<SyntaxToken> {
        token(self.syntax(), INTEGER)
    }
    /// The component after `master`.
    pub fn master(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
}

impl Device {
    /// It is a sensor; otherwise it is an actuator.
    pub fn is_sensor(&self) -> bool {
        token(self.syntax(), SENSOR_KW).is_some()
    }
    /// The name.
    pub fn name(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The text shown.
    pub fn text(&self) -> Option<String> {
        text_of(self.syntax())
    }
    /// The domain of what is sensed or set.
    pub fn message(&self) -> Option<Domain> {
        child(self.syntax())
    }
}

impl Connection {
    /// Where it starts.
    pub fn from(&self) -> Option<SyntaxToken> {
        names(self.syntax()).next()
    }
    /// Where it ends.
    pub fn to(&self) -> Option<SyntaxToken> {
        names(self.syntax()).nth(1)
    }
}

impl Quantity {
    /// The number as it is written; of `3..9 ms`, the first one.
    pub fn number(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).find(|token| matches!(token.kind(), INTEGER | REAL))
    }
    /// The second number of `3..9 ms`.
    pub fn most(&self) -> Option<SyntaxToken> {
        tokens(self.syntax()).filter(|token| matches!(token.kind(), INTEGER | REAL)).nth(1)
    }
    /// The unit.
    pub fn unit(&self) -> Option<SyntaxToken> {
        token(self.syntax(), GENERIC_ID)
    }
    /// The unit in nanoseconds; none if there is no such unit.
    pub fn unit_ns(&self) -> Option<u64> {
        Some(match self.unit()?.text() {
            "ns" => 1,
            "us" => 1_000,
            "ms" => 1_000_000,
            "s" => 1_000_000_000,
            _ => return None,
        })
    }
}
