//! What parts of a system say: periods, deadlines, phases with their times, what channels are made of, ages, ticks, processors.
//!
//! In: the name of a part, a [`Property`] and its text. Out: the text with this property and no other. INVARIANT: what is given for a
//! property is that property and nothing beside it: a length of time is read alone before it is put in. Whether it makes sense (a
//! period of whole ticks) is for the faults of the chart.

use syntax::SyntaxKind::{self, *};
use syntax::ast::{AstNode, Channel, ChannelKind, Component, ComponentKind, Phase, PhaseKind, Quantity, SystemChart};
use syntax::{SyntaxNode, SyntaxToken};

use super::text::extent;
use super::value::{awaited, domain, length, name, number, read, tolerance};
use super::{Section, Work};

/// A property of a part of a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Property {
    /// Of a component: `synchronous` or `asynchronous`.
    Timing,
    /// Of a synchronous component: its period.
    Period,
    /// Of a synchronous component: how much later than its period a cycle may be released.
    Jitter,
    /// Of a synchronous component: when its first cycle begins.
    Offset,
    /// Of a synchronous component: when a cycle has to be done.
    Deadline,
    /// Of a synchronous component: how many deadlines it may miss, as in `1 of 20`.
    Misses,
    /// Of an asynchronous component: the channel whose data it awaits; `all` or `any`, and several.
    Awaits,
    /// Of a channel: `swinging buffer`, `queue` or `shared value`.
    Kind,
    /// Of a channel: the number of arrays or of messages.
    Size,
    /// Of a swinging buffer: the component that updates its indexes.
    Master,
    /// Of a channel or a device: the domain of what goes through it.
    Domain,
    /// Of the system: how long a step is.
    Tick,
    /// Of the system: how many processors the tasks share.
    Processors,
    /// Of the system: how old the data of its age bound of this number may be; without a text, the bound goes.
    Age(usize),
    /// Of a channel: the component that writes it.
    Writer,
    /// Of the phase of this number of a component: the channel that it reads or writes.
    PhaseSubject(usize),
    /// Of the phase of this number of a component: how long it takes.
    PhaseTime(usize),
    /// Of the phase of this number of a component: what it is called.
    PhaseName(usize),
    /// Of the reading of this number of a component: how often it brings something new.
    PhaseFresh(usize),
    /// Of the elaboration of this number of a component: the machine that it is done by.
    PhaseMachine(usize),
}

type Bytes = std::ops::Range<usize>;

fn range(token: &SyntaxToken) -> Bytes {
    token.text_range().into()
}

fn word(node: &SyntaxNode, kind: SyntaxKind) -> Option<SyntaxToken> {
    node.children_with_tokens().filter_map(|element| element.into_token()).find(|token| token.kind() == kind)
}

impl Work {
    fn system(&self) -> Result<SystemChart, String> {
        match self.section()? {
            Section::System(system) => Ok(system),
            Section::Machine(_) => Err("a machine has no times and no channels".to_string()),
        }
    }

    fn component(&self, id: &str) -> Result<Component, String> {
        let found = self.system()?.components().find(|part| part.name().is_some_and(|own| own.text() == id));
        found.ok_or_else(|| format!("there is no component `{id}`"))
    }

    fn timing(&self, id: &str) -> Result<ComponentKind, String> {
        self.component(id)?.kind().ok_or_else(|| format!("`{id}` is neither synchronous nor asynchronous"))
    }

    fn phase(&self, id: &str, at: usize) -> Result<Phase, String> {
        self.component(id)?.phases().nth(at).ok_or_else(|| format!("`{id}` has no phase {}", at + 1))
    }

    fn channel(&self, id: &str) -> Result<Channel, String> {
        let found = self.system()?.channels().find(|part| part.name().is_some_and(|own| own.text() == id));
        found.ok_or_else(|| format!("there is no channel `{id}`"))
    }

    fn channel_kind(&self, id: &str) -> Result<ChannelKind, String> {
        self.channel(id)?.kind().ok_or_else(|| format!("`{id}` does not say what it is made of"))
    }

    /// See [`super::Operation::Set`].
    pub(super) fn set(&mut self, id: &str, property: Property, value: Option<&str>) -> Result<(), String> {
        self.select = vec![id.to_string()];
        self.change(id, property, value)?;
        match (property, value.map(str::trim).filter(|value| !value.is_empty())) {
            (Property::Master | Property::PhaseName(_) | Property::PhaseMachine(_), Some(value))
                if self.says(id, property)?.as_deref() != Some(value) =>
            {
                Err(format!("`{value}` cannot stand here: it is a word of charts"))
            }
            _ => Ok(()),
        }
    }

    /// The name that a property has in the text.
    fn says(&self, id: &str, property: Property) -> Result<Option<String>, String> {
        let found = match property {
            Property::Master => self.channel_kind(id)?.master(),
            Property::PhaseName(at) => {
                let phase = self.phase(id, at)?;
                phase.name().or_else(|| phase.subject())
            }
            Property::PhaseMachine(at) => self.phase(id, at)?.machine(),
            _ => None,
        };
        Ok(found.map(|token| token.text().to_string()))
    }

    fn change(&mut self, id: &str, property: Property, value: Option<&str>) -> Result<(), String> {
        let fixed = |value: &str| length(value, false);
        match property {
            Property::Timing => self.set_timing(id, value.unwrap_or_default()),
            Property::Period => {
                let value = read(value, fixed)?.ok_or("a synchronous component has a period")?;
                self.set_quantity(id, PERIOD_KW, Some(&value))
            }
            Property::Jitter => {
                let value = read(value, fixed)?;
                self.set_quantity(id, JITTER_KW, value.as_deref())
            }
            Property::Offset => {
                let value = read(value, fixed)?;
                self.set_quantity(id, OFFSET_KW, value.as_deref())
            }
            Property::Deadline => {
                let value = read(value, fixed)?;
                self.set_quantity(id, DEADLINE_KW, value.as_deref())
            }
            Property::Misses => {
                let value = read(value, tolerance)?;
                let timing = self.timing(id)?;
                if !timing.is_synchronous() {
                    return Err("an asynchronous component has no deadlines".to_string());
                }
                self.set_last(timing.tolerance().map(|one| extent(one.syntax())), extent(timing.syntax()).end, value);
                Ok(())
            }
            Property::PhaseFresh(at) => {
                let value = read(value, fixed)?.map(|value| format!("every {value} fresh"));
                let phase = self.phase(id, at)?;
                if phase.kind() != Some(PhaseKind::Read) {
                    return Err("only a reading brings something new".to_string());
                }
                let end = extent(phase.syntax()).end;
                self.set_last(phase.fresh().map(|one| extent(one.syntax())), end, value);
                Ok(())
            }
            Property::Awaits => {
                let timing = self.timing(id)?;
                if timing.is_synchronous() {
                    return Err("only an asynchronous component awaits data".to_string());
                }
                let value = read(value, awaited)?;
                let end = extent(timing.syntax()).end;
                self.set_last(timing.awaits().map(|one| extent(one.syntax())), end, value);
                Ok(())
            }
            Property::Kind => self.set_kind(id, value.unwrap_or_default()),
            Property::Size => {
                let value = read(value, number)?.ok_or("a buffer has a number of arrays, a queue one of messages")?;
                let size = self.channel_kind(id)?.size().ok_or("a shared value has no size")?;
                self.replace(range(&size), &value);
                Ok(())
            }
            Property::Master => {
                let kind = self.channel_kind(id)?;
                if !kind.is_buffer() {
                    return Err("only a swinging buffer has a master".to_string());
                }
                let value = read(value, name)?;
                self.set_behind(kind.syntax(), MASTER_KW, "master", kind.master(), value.as_deref());
                Ok(())
            }
            Property::Domain => {
                let value = read(value, domain)?;
                self.set_domain(id, value.as_deref())
            }
            Property::Tick => {
                let value = read(value, fixed)?;
                let present = self.system()?.ticks().next();
                let place = present.as_ref().and_then(|tick| tick.quantity()).map(|length| extent(length.syntax()));
                self.set_item(present.map(|tick| tick.syntax().clone()), place, "tick", value.as_deref())
            }
            Property::Processors => {
                let value = read(value, number)?;
                let present = self.system()?.processors().next();
                let place = present.as_ref().and_then(|some| some.number()).map(|number| range(&number));
                self.set_item(present.map(|some| some.syntax().clone()), place, "processors", value.as_deref())
            }
            Property::Age(at) => {
                let bound = self.system()?.age_bounds().nth(at);
                let bound = bound.ok_or_else(|| format!("there is no age bound {}", at + 1))?;
                let value = read(value, fixed)?;
                let place = bound.quantity().map(|length| extent(length.syntax()));
                self.set_item(Some(bound.syntax().clone()), place, "within", value.as_deref())
            }
            Property::Writer => {
                let value = read(value, name)?.ok_or("a channel has a writer")?;
                let old = self.channel(id)?.from().map(|token| token.text().to_string()).unwrap_or_default();
                self.set_end(id, &old, &value, true)
            }
            Property::PhaseSubject(at) => {
                let value = read(value, name)?.ok_or("a reading or a writing is about a channel")?;
                self.set_subject(id, at, &value)
            }
            Property::PhaseTime(at) => self.set_phase_time(id, at, value),
            Property::PhaseName(at) => self.set_phase_name(id, at, value),
            Property::PhaseMachine(at) => {
                let phase = self.phase(id, at)?;
                if phase.kind() != Some(PhaseKind::Elaborate) {
                    return Err("only an elaboration is done by a machine".to_string());
                }
                let value = read(value, name)?;
                match (phase.machine(), value) {
                    (None, Some(value)) => {
                        let end = phase.time().map(|time| extent(time.syntax()).end);
                        let end = end.or_else(|| phase.subject().map(|token| range(&token).end)).unwrap_or_default();
                        self.replace(end..end, &format!(" by {value}"));
                    }
                    (present, value) => self.set_behind(phase.syntax(), BY_KW, "by", present, value.as_deref()),
                }
                Ok(())
            }
        }
    }

    /// What stands at the end of a node: set, changed or taken away.
    fn set_last(&mut self, present: Option<Bytes>, end: usize, value: Option<String>) {
        match (present, value) {
            (Some(bytes), Some(value)) => self.replace(bytes, &value),
            (Some(bytes), None) => self.take_away(bytes),
            (None, Some(value)) => self.replace(end..end, &format!(" {value}")),
            (None, None) => {}
        }
    }

    /// Takes bytes away, with the blanks before them.
    fn take_away(&mut self, bytes: Bytes) {
        let start = self.text[..bytes.start].trim_end_matches([' ', '\t']).len();
        self.replace(start..bytes.end, "");
    }

    /// A word and a name at the end of a node: set, changed or taken away.
    fn set_behind(
        &mut self,
        node: &SyntaxNode,
        kind: SyntaxKind,
        spelled: &str,
        present: Option<SyntaxToken>,
        value: Option<&str>,
    ) {
        match (present, value) {
            (Some(token), Some(value)) => self.replace(range(&token), value),
            (Some(token), None) => {
                let start = word(node, kind).map_or(range(&token).start, |word| range(&word).start);
                self.take_away(start..range(&token).end);
            }
            (None, Some(value)) => {
                let end = extent(node).end;
                self.replace(end..end, &format!(" {spelled} {value}"));
            }
            (None, None) => {}
        }
    }

    /// `synchronous` or `asynchronous`; a period that is not said yet is ten milliseconds.
    fn set_timing(&mut self, id: &str, value: &str) -> Result<(), String> {
        let timing = self.timing(id)?;
        let node = timing.syntax();
        let awaits = timing.awaits().map(|one| extent(one.syntax()));
        let quantity = |kind| {
            let (word, length) = (word(node, kind)?, timing.quantity(kind)?);
            Some(range(&word).start..extent(length.syntax()).end)
        };
        let (first, word, goes) = match (value, timing.is_synchronous()) {
            ("synchronous", true) | ("asynchronous", false) => return Ok(()),
            ("asynchronous", true) => {
                let lengths = [PERIOD_KW, JITTER_KW, OFFSET_KW, DEADLINE_KW].into_iter().filter_map(quantity);
                let goes: Vec<Bytes> = lengths.chain(timing.tolerance().map(|one| extent(one.syntax()))).collect();
                (word(node, SYNCHRONOUS_KW), "asynchronous", goes)
            }
            ("synchronous", false) => {
                (word(node, ASYNCHRONOUS_KW), "synchronous period 10 ms", awaits.into_iter().collect())
            }
            _ => return Err("a component is synchronous or asynchronous".to_string()),
        };
        // From behind, so that what comes before keeps its place.
        goes.into_iter().rev().for_each(|bytes| self.take_away(bytes));
        if let Some(first) = first {
            self.replace(range(&first), word);
        }
        Ok(())
    }

    fn set_quantity(&mut self, id: &str, kind: SyntaxKind, value: Option<&str>) -> Result<(), String> {
        let timing = self.timing(id)?;
        if !timing.is_synchronous() {
            return Err("an asynchronous component has no period".to_string());
        }
        let place = |quantity: Option<Quantity>| quantity.map(|quantity| extent(quantity.syntax()));
        let spelled = match kind {
            PERIOD_KW => "period",
            JITTER_KW => "jitter",
            OFFSET_KW => "offset",
            _ => "deadline",
        };
        match (place(timing.quantity(kind)), value) {
            (Some(bytes), Some(value)) => self.replace(bytes, value),
            (Some(bytes), None) => {
                let start = word(timing.syntax(), kind).map_or(bytes.start, |word| range(&word).start);
                self.take_away(start..bytes.end);
            }
            (None, Some(value)) => {
                // Jitter, offset and deadline stand behind the period in this order, and before what may be missed.
                let before: &[SyntaxKind] = match kind {
                    JITTER_KW => &[PERIOD_KW],
                    OFFSET_KW => &[JITTER_KW, PERIOD_KW],
                    _ => &[OFFSET_KW, JITTER_KW, PERIOD_KW],
                };
                let end = before.iter().find_map(|word| place(timing.quantity(*word))).map(|bytes| bytes.end);
                let end = end.unwrap_or_else(|| extent(timing.syntax()).end);
                self.replace(end..end, &format!(" {spelled} {value}"));
            }
            (None, None) => {}
        }
        Ok(())
    }

    /// What a channel is made of. What is as large as before keeps its size.
    fn set_kind(&mut self, id: &str, value: &str) -> Result<(), String> {
        let kind = self.channel_kind(id)?;
        let size = kind.size().map(|size| size.text().to_string());
        let is_value = !kind.is_buffer() && !kind.is_queue();
        let text = match value {
            "swinging buffer" if kind.is_buffer() => return Ok(()),
            "queue" if kind.is_queue() => return Ok(()),
            "shared value" if is_value => return Ok(()),
            "swinging buffer" => "swinging buffer 2".to_string(),
            "queue" => format!("queue {}", size.unwrap_or_else(|| "4".to_string())),
            "shared value" => "shared value".to_string(),
            _ => return Err("a channel is a swinging buffer, a queue or a shared value".to_string()),
        };
        let bytes = extent(kind.syntax());
        let old = &self.text[bytes.clone()];
        if old.contains("//") || old.contains("/*") {
            return Err("there is a comment within: change it in the text".to_string());
        }
        self.replace(bytes, &text);
        Ok(())
    }

    fn set_domain(&mut self, id: &str, value: Option<&str>) -> Result<(), String> {
        let system = self.system()?;
        let is = |token: Option<SyntaxToken>| token.is_some_and(|token| token.text() == id);
        let device = system.devices().find(|part| is(part.name()));
        let channel = system.channels().find(|part| is(part.name()));
        let (node, own, message) = match (device, channel) {
            (Some(part), _) => (part.syntax().clone(), part.name(), part.message()),
            (None, Some(part)) => (part.syntax().clone(), part.name(), part.message()),
            (None, None) => return Err(format!("there is no channel or device `{id}`")),
        };
        let bytes = message.map(|message| extent(message.syntax()));
        match (bytes, value, own) {
            (Some(bytes), Some(value), _) => self.replace(bytes, value),
            (Some(bytes), None, _) => {
                let start = word(&node, COLON).map_or(bytes.start, |colon| range(&colon).start);
                self.take_away(start..bytes.end);
            }
            (None, Some(value), Some(own)) => {
                let end = range(&own).end;
                self.replace(end..end, &format!(" : {value}"));
            }
            (None, _, _) => {}
        }
        Ok(())
    }

    /// A line of its own in a system.
    fn set_item(
        &mut self,
        present: Option<SyntaxNode>,
        place: Option<Bytes>,
        spelled: &str,
        value: Option<&str>,
    ) -> Result<(), String> {
        match (present, place, value) {
            (Some(node), _, None) => self.remove(&node),
            (Some(_), Some(bytes), Some(value)) => self.replace(bytes, value),
            (Some(_), None, Some(_)) => return Err(format!("`{spelled}` cannot be read: change it in the text")),
            (None, _, Some(value)) => self.add_line(|_| false, &format!("{spelled} {value}"))?,
            (None, _, None) => {}
        }
        Ok(())
    }

    fn set_phase_time(&mut self, id: &str, at: usize, value: Option<&str>) -> Result<(), String> {
        let phase = self.phase(id, at)?;
        let varies = phase.kind() == Some(PhaseKind::Elaborate);
        let value = read(value, |value| length(value, varies))?;
        match (phase.time().map(|time| extent(time.syntax())), value) {
            (Some(bytes), Some(value)) => self.replace(bytes, &value),
            (Some(bytes), None) => self.take_away(bytes),
            (None, Some(value)) => {
                let end = phase.name().or_else(|| phase.subject()).map_or(0, |token| range(&token).end);
                self.replace(end..end, &format!(" {value}"));
            }
            (None, None) => {}
        }
        Ok(())
    }

    fn set_phase_name(&mut self, id: &str, at: usize, value: Option<&str>) -> Result<(), String> {
        let phase = self.phase(id, at)?;
        let value = read(value, name)?;
        let subject = phase.subject().ok_or("the phase cannot be read: change it in the text")?;
        if phase.kind() == Some(PhaseKind::Elaborate) && phase.name().is_none() {
            let value = value.ok_or("an elaboration has a name")?;
            self.replace(range(&subject), &value);
            return Ok(());
        }
        match (phase.name(), value) {
            (None, Some(value)) => {
                let end = range(&subject).end;
                self.replace(end..end, &format!(" as {value}"));
            }
            (present, value) => self.set_behind(phase.syntax(), AS_KW, "as", present, value.as_deref()),
        }
        Ok(())
    }

    /// See [`super::Operation::AddPhase`].
    pub(super) fn add_phase_of(&mut self, id: &str, kind: PhaseKind, subject: &str) -> Result<(), String> {
        self.component(id)?;
        let subject = name(subject)?;
        let line = match kind {
            PhaseKind::Read => format!("read {subject}"),
            PhaseKind::Write => format!("write {subject}"),
            PhaseKind::Elaborate => format!("elaborate {subject}"),
        };
        self.select = vec![id.to_string()];
        let before = self.component(id)?.phases().count();
        self.add_phase(id, &line, kind == PhaseKind::Read)?;
        let phases = self.component(id)?.phases();
        let is_there = phases.clone().any(|phase| phase.subject().is_some_and(|own| own.text() == subject));
        match phases.count() == before + 1 && is_there {
            true => Ok(()),
            false => Err(format!("`{subject}` cannot stand here: it is a word of charts")),
        }
    }

    /// See [`super::Operation::RemovePhase`].
    pub(super) fn remove_phase(&mut self, id: &str, at: usize) -> Result<(), String> {
        let phase = self.phase(id, at)?;
        self.select = vec![id.to_string()];
        self.remove(phase.syntax());
        Ok(())
    }

    /// See [`super::Operation::MovePhase`]. What stands behind a phase in its line goes with it.
    pub(super) fn move_phase(&mut self, id: &str, at: usize, to: usize) -> Result<(), String> {
        self.select = vec![id.to_string()];
        self.phase(id, at)?;
        self.phase(id, to)?;
        let mut at = at;
        while at != to {
            let next = if at < to { at + 1 } else { at - 1 };
            let (upper, lower) = (at.min(next), at.max(next));
            let (one, other) = (self.line_of(&self.phase(id, upper)?), self.line_of(&self.phase(id, lower)?));
            if one.end > other.start {
                return Err("the phases stand in one line: move them in the text".to_string());
            }
            let (first, second) = (self.text[one.clone()].to_string(), self.text[other.clone()].to_string());
            self.replace(other, &first);
            self.replace(one, &second);
            at = next;
        }
        Ok(())
    }

    /// From the first word of a phase to its last one, or to the end of a comment behind it.
    fn line_of(&self, phase: &Phase) -> Bytes {
        let bytes = extent(phase.syntax());
        let rest = &self.text[bytes.end..];
        let line = rest.find('\n').unwrap_or(rest.len());
        let behind = rest[..line].trim();
        let end = if behind.starts_with("//") { bytes.end + rest[..line].trim_end().len() } else { bytes.end };
        bytes.start..end
    }

    /// See [`super::Operation::AddAge`].
    pub(super) fn add_age(&mut self, from: &str, to: &str, limit: &str) -> Result<(), String> {
        let (from, to, limit) = (name(from)?, name(to)?, length(limit, false)?);
        let has = self.system()?.age_bounds().next().is_some();
        self.add_line(|node| !has || node.kind() == AGE_BOUND, &format!("within {limit} from {from} to {to}"))
    }
}
