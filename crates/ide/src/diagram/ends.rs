//! The ends of channels: who writes one, who reads it, and which channel a phase reads or writes.
//!
//! In: a channel and the component that is to be at an end, or a phase and the channel that it is to be about. Out: the text with this
//! end, and with the phases that belong to it. INVARIANT: a phase that reads or writes goes with the end; a channel keeps one writer and at
//! least one reader.

use syntax::SyntaxToken;
use syntax::ast::{AstNode, Channel, Component, PhaseKind, SystemChart};

use super::arrow::words;
use super::{Section, Work};

fn is(token: Option<SyntaxToken>, name: &str) -> bool {
    token.is_some_and(|token| token.text() == name)
}

fn found(system: &SystemChart, name: &str) -> Result<Channel, String> {
    let channel = system.channels().find(|channel| is(channel.name(), name));
    channel.ok_or_else(|| format!("there is no channel `{name}`"))
}

fn component(system: &SystemChart, name: &str) -> Result<Component, String> {
    let component = system.components().find(|part| is(part.name(), name));
    component.ok_or_else(|| format!("the ends of a channel are components, and `{name}` is none"))
}

impl Work {
    fn parts(&self) -> Result<SystemChart, String> {
        match self.section()? {
            Section::System(system) => Ok(system),
            Section::Machine(_) => Err("a machine has no channels".to_string()),
        }
    }

    /// Whether an arrow is an end of a channel: the channel, the component at it, and whether that writes.
    pub(super) fn end_of(&self, from: &str, to: &str) -> Option<(String, String, bool)> {
        let system = self.parts().ok()?;
        if let Ok(channel) = found(&system, to)
            && is(channel.from(), from)
        {
            return Some((to.to_string(), from.to_string(), true));
        }
        let channel = found(&system, from).ok()?;
        let reads = channel.readers().any(|reader| reader.text() == to);
        reads.then(|| (from.to_string(), to.to_string(), false))
    }

    /// Another component at an end of a channel; its phases go along.
    pub(super) fn set_end(&mut self, name: &str, old: &str, new: &str, writes: bool) -> Result<(), String> {
        if old == new {
            return Ok(());
        }
        let system = self.parts()?;
        let channel = found(&system, name)?;
        component(&system, new)?;
        if is(channel.from(), new) {
            return Err(format!("`{new}` writes the channel `{name}`"));
        }
        if channel.readers().any(|reader| reader.text() == new) {
            return Err(format!("`{new}` reads the channel `{name}` already"));
        }
        let end = match writes {
            true => channel.from(),
            false => channel.readers().find(|reader| reader.text() == old),
        };
        let end = end.filter(|end| end.text() == old).ok_or_else(|| format!("`{old}` is no end of `{name}`"))?;
        let master = channel.kind().and_then(|kind| kind.master()).filter(|master| master.text() == old);
        // From behind, so that what comes before keeps its place.
        for token in [master, Some(end)].into_iter().flatten() {
            let range = usize::from(token.text_range().start())..usize::from(token.text_range().end());
            self.replace(range, new);
        }
        let kind = if writes { PhaseKind::Write } else { PhaseKind::Read };
        let phases = self.take_phases(old, kind, name)?;
        let word = if writes { "write" } else { "read" };
        let phase = phases.into_iter().next().unwrap_or_else(|| format!("{word} {name}"));
        if !self.has_phase(new, kind, name)? {
            self.add_phase(new, &phase, !writes)?;
        }
        self.select = vec![name.to_string()];
        Ok(())
    }

    /// Takes the phases of a component that read or write a channel away. Out: as they were written.
    fn take_phases(&mut self, name: &str, kind: PhaseKind, channel: &str) -> Result<Vec<String>, String> {
        let mut taken = Vec::new();
        loop {
            let phases = component(&self.parts()?, name)?.phases();
            let mut wanted = phases.filter(|phase| phase.kind() == Some(kind) && is(phase.subject(), channel));
            let Some(phase) = wanted.next() else { return Ok(taken) };
            let tokens = words(phase.syntax());
            let start = tokens.first().map_or(0, |token| usize::from(token.text_range().start()));
            let end = tokens.last().map_or(start, |token| usize::from(token.text_range().end()));
            taken.push(self.text[start..end].to_string());
            self.remove(phase.syntax());
        }
    }

    fn has_phase(&self, name: &str, kind: PhaseKind, channel: &str) -> Result<bool, String> {
        let mut phases = component(&self.parts()?, name)?.phases();
        Ok(phases.any(|phase| phase.kind() == Some(kind) && is(phase.subject(), channel)))
    }

    /// The phase of this number of a component is about another channel.
    pub(super) fn set_subject(&mut self, id: &str, at: usize, to: &str) -> Result<(), String> {
        let system = self.parts()?;
        let phase = component(&system, id)?.phases().nth(at);
        let phase = phase.ok_or_else(|| format!("`{id}` has no phase {}", at + 1))?;
        let (Some(kind @ (PhaseKind::Read | PhaseKind::Write)), Some(subject)) = (phase.kind(), phase.subject()) else {
            return Err("only a reading and a writing are about a channel".to_string());
        };
        let old = subject.text().to_string();
        if old == to {
            return Ok(());
        }
        let channel = found(&system, to)?;
        let writer = channel.from().map(|writer| writer.text().to_string()).unwrap_or_default();
        if kind == PhaseKind::Write && writer != id {
            return Err(format!("`{writer}` writes the channel `{to}`: change its writer first"));
        }
        if kind == PhaseKind::Read && writer == id {
            return Err(format!("`{id}` writes the channel `{to}`"));
        }
        let range = usize::from(subject.text_range().start())..usize::from(subject.text_range().end());
        self.replace(range, to);
        if kind == PhaseKind::Read {
            self.read_instead(id, &old, to)?;
        }
        self.select = vec![id.to_string()];
        Ok(())
    }

    /// A component is a reader of a channel, and of the old one only as long as a phase of it still reads that.
    fn read_instead(&mut self, id: &str, old: &str, to: &str) -> Result<(), String> {
        let channel = found(&self.parts()?, to)?;
        let readers: Vec<SyntaxToken> = channel.readers().collect();
        if !readers.iter().any(|reader| reader.text() == id) {
            let end = readers.last().map(|last| usize::from(last.text_range().end()));
            let end = end.ok_or_else(|| format!("the channel `{to}` does not say who reads it"))?;
            self.replace(end..end, &format!(", {id}"));
        }
        let system = self.parts()?;
        let Ok(left) = found(&system, old) else { return Ok(()) };
        if self.has_phase(id, PhaseKind::Read, old)? || !left.readers().any(|reader| reader.text() == id) {
            return Ok(());
        }
        if left.readers().count() < 2 {
            return Err(format!("nobody would read the channel `{old}`: delete it, or give it another reader first"));
        }
        self.leave_readers(&left, id);
        Ok(())
    }
}
