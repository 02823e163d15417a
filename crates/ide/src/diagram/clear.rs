//! What goes: shapes with all that hangs on them, and the lines they stand in.

use syntax::SyntaxNode;
use syntax::ast::{AstNode, Channel, PhaseKind};

use super::arrow::words;
use super::{Section, Work};

impl Work {
    /// See [`super::Operation::Delete`].
    pub(super) fn delete(&mut self, name: &str) -> Result<(), String> {
        match self.section()? {
            Section::Machine(machine) => {
                let is_it = |shape: &syntax::ast::Shape| shape.name().is_some_and(|own| own.text() == name);
                let shape = machine.shapes().find(is_it).ok_or_else(|| format!("there is no shape `{name}`"))?;
                // A composite state goes with all that it holds.
                let inner = machine.shapes().filter(|one| one.syntax().parent().as_ref() == Some(shape.syntax()));
                let inner: Vec<String> = inner.filter_map(|one| Some(one.name()?.text().to_string())).collect();
                drop((shape, machine));
                for one in inner {
                    self.delete(&one)?;
                }
                self.disconnect_all(name)?;
                self.leave_sequences(name)?;
                self.displace(name)?;
                if let Section::Machine(machine) = self.section()?
                    && let Some(shape) = machine.shapes().find(is_it)
                {
                    self.remove(shape.syntax());
                }
                Ok(())
            }
            Section::System(_) => self.delete_part(name),
        }
    }

    /// Takes a component, channel or device of a system away, and what needs it.
    fn delete_part(&mut self, name: &str) -> Result<(), String> {
        let Section::System(system) = self.section()? else { return Ok(()) };
        let is = |token: Option<syntax::SyntaxToken>| token.is_some_and(|token| token.text() == name);
        let own: Option<SyntaxNode> = system
            .components()
            .find(|component| is(component.name()))
            .map(|component| component.syntax().clone())
            .or_else(|| system.channels().find(|channel| is(channel.name())).map(|channel| channel.syntax().clone()))
            .or_else(|| system.devices().find(|device| is(device.name())).map(|device| device.syntax().clone()));
        own.ok_or_else(|| format!("there is no component, channel or device `{name}`"))?;
        while let Section::System(system) = self.section()?
            && let Some(channel) = system.channels().find(|channel| {
                channel.readers().count() > 1 && !is(channel.from()) && channel.readers().any(|one| is(Some(one)))
            })
        {
            self.leave_readers(&channel, name);
        }
        // Channels of a component first: phases of others read and write them.
        while let Section::System(system) = self.section()?
            && let Some(channel) =
                system.channels().find(|channel| is(channel.from()) || channel.readers().any(|one| is(Some(one))))
            && let Some(other) = channel.name()
        {
            let other = other.text().to_string();
            self.delete_part(&other)?;
        }
        while let Section::System(system) = self.section()?
            && let Some(connection) = system.connections().find(|line| is(line.from()) || is(line.to()))
        {
            self.remove(connection.syntax());
        }
        let is_channel =
            matches!(self.section()?, Section::System(system) if system.channels().any(|channel| is(channel.name())));
        while is_channel
            && let Section::System(system) = self.section()?
            && let Some(phase) = system
                .components()
                .flat_map(|component| component.phases())
                .find(|phase| matches!(phase.kind(), Some(PhaseKind::Read | PhaseKind::Write)) && is(phase.subject()))
        {
            self.remove(phase.syntax());
        }
        self.displace(name)?;
        let Section::System(system) = self.section()? else { return Ok(()) };
        let own = system.components().find(|part| is(part.name())).map(|part| part.syntax().clone());
        let own = own.or_else(|| system.channels().find(|part| is(part.name())).map(|part| part.syntax().clone()));
        let own = own.or_else(|| system.devices().find(|part| is(part.name())).map(|part| part.syntax().clone()));
        if let Some(own) = own {
            self.remove(&own);
        }
        Ok(())
    }

    /// Takes a component out of the several readers of a channel. What it was the master of goes with it.
    pub(super) fn leave_readers(&mut self, channel: &Channel, name: &str) {
        // From the back, so that the places before it stay.
        if let Some(master) = channel.kind().and_then(|kind| kind.master()).filter(|master| master.text() == name) {
            let end = usize::from(master.text_range().end());
            let words = words(channel.syntax());
            let before = words.iter().rev().skip_while(|word| **word != master).nth(2);
            let start = before.map_or(end, |word| usize::from(word.text_range().end()));
            self.replace(start..end, "");
        }
        let readers: Vec<_> = channel.readers().collect();
        let left: Vec<&str> = readers.iter().map(|reader| reader.text()).filter(|reader| *reader != name).collect();
        let (Some(first), Some(last)) = (readers.first(), readers.last()) else { return };
        let range = usize::from(first.text_range().start())..usize::from(last.text_range().end());
        self.replace(range, &left.join(", "));
    }

    /// Takes a shape out of what is done in sequence; one alone is no sequence.
    pub(super) fn leave_sequences(&mut self, name: &str) -> Result<(), String> {
        while let Section::Machine(machine) = self.section()?
            && let Some(sequence) = machine.sequences().find(|sequence| sequence.names().any(|own| own.text() == name))
        {
            let left: Vec<String> =
                sequence.names().map(|own| own.text().to_string()).filter(|own| own != name).collect();
            if left.len() < 2 {
                self.remove(sequence.syntax());
                continue;
            }
            let names = words(sequence.syntax());
            let (Some(first), Some(last)) = (names.get(1), names.last()) else { return Ok(()) };
            let range = usize::from(first.text_range().start())..usize::from(last.text_range().end());
            self.replace(range, &left.join(", "));
        }
        Ok(())
    }

    /// Takes the place of a shape away.
    fn displace(&mut self, name: &str) -> Result<(), String> {
        while let Some(layout) = self.layout()?
            && let Some(line) = layout.placements().find(|line| line.name().is_some_and(|own| own.text() == name))
        {
            self.remove(line.syntax());
        }
        Ok(())
    }

    /// Takes a node away; if it has its lines for itself, the lines, with a comment at their end.
    pub(super) fn remove(&mut self, node: &SyntaxNode) {
        let tokens = words(node);
        let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else { return };
        let (start, end) = (usize::from(first.text_range().start()), usize::from(last.text_range().end()));
        let begin = self.text[..start].rfind('\n').map_or(0, |at| at + 1);
        let rest = &self.text[end..];
        let line = rest.find('\n').map_or(rest.len(), |at| at + 1);
        let alone = self.text[begin..start].trim().is_empty();
        let behind = rest[..line].trim();
        if alone && (behind.is_empty() || behind.starts_with("//")) {
            self.replace(begin..end + line, "");
            return;
        }
        // The blank before it goes with it.
        let before = self.text[..start].trim_end_matches([' ', '\t']).len();
        let start = if before > begin || !alone { before } else { start };
        let needs_blank = !rest.starts_with(char::is_whitespace) && !rest.is_empty();
        self.replace(start..end, if needs_blank { " " } else { "" });
    }
}
