//! What comes: shapes, machines, parts of systems.

use std::collections::BTreeMap;

use syntax::SyntaxKind::{self, *};
use syntax::SyntaxNode;
use syntax::ast::{AstNode, Channel, Shape};

use super::arrow::words;
use super::name::{in_camel_case, is_name};
use super::text::{linked, quoted};
use super::{Fresh, FreshKind, Section, Work};

impl Work {
    /// See [`super::Operation::Add`]. Out: its name.
    pub(super) fn add(&mut self, fresh: &Fresh) -> Result<String, String> {
        let wanted = match (&fresh.name, &fresh.text) {
            (Some(name), _) => name.clone(),
            (None, Some(text)) => in_camel_case(text),
            (None, None) => String::new(),
        };
        let text = fresh.text.as_deref().map(|text| format!(" {}", quoted(text))).unwrap_or_default();
        let link = match &fresh.link {
            Some(link) => format!(" {}", linked(link)?),
            None => String::new(),
        };
        let section = self.section()?;
        let in_machine = matches!(
            fresh.kind,
            FreshKind::State | FreshKind::Composite | FreshKind::Guard | FreshKind::Action | FreshKind::Instance
        );
        let mut placed = None;
        let name = match section {
            Section::Machine(machine) if in_machine => {
                let (word, kind) = match fresh.kind {
                    FreshKind::State => ("state", CONTROL_STATE),
                    FreshKind::Composite => ("composite state", COMPOSITE_STATE),
                    FreshKind::Guard => ("guard", GUARD_SHAPE),
                    FreshKind::Action => ("action", ACTION_SHAPE),
                    _ => ("instance", PATTERN_INSTANCE),
                };
                let otherwise = match fresh.kind {
                    FreshKind::State => "waiting",
                    FreshKind::Composite => "working",
                    FreshKind::Guard => "condition",
                    FreshKind::Action => "act",
                    _ => "part",
                };
                let name = self.fresh_name(&wanted, otherwise)?;
                let mut line = format!("{word} {name}{text}{link}");
                if fresh.kind == FreshKind::Instance {
                    let of = fresh.of.as_deref().ok_or("say which pattern it is an instance of")?;
                    line = format!("instance {name} of {of}{text}{link}");
                }
                if fresh.kind == FreshKind::Composite {
                    // A frame lies around what it holds, so it holds something.
                    let inner = self.fresh_name("begun", "begun")?;
                    let inner = if inner == name { format!("{inner}1") } else { inner };
                    line = format!("{line}\n\t\tinitial state {inner}\n\tendstate");
                    placed = Some(inner);
                }
                if matches!(fresh.kind, FreshKind::State | FreshKind::Composite) {
                    let first = !machine.shapes().any(|shape| matches!(shape, Shape::State(_)));
                    if first && !machine.is_pattern() {
                        line = format!("initial {line}");
                    }
                    if first && machine.control().is_none() {
                        let control = self.fresh_name(&format!("{}State", self.drawing), "phase")?;
                        self.add_line(|_| false, &format!("control {control}"))?;
                    }
                }
                self.add_shape(kind, &line)?;
                name
            }
            Section::System(_) if !in_machine => {
                let (otherwise, kind) = match fresh.kind {
                    FreshKind::Component => ("component1", COMPONENT),
                    FreshKind::Sensor => ("sensor1", DEVICE),
                    _ => ("actuator1", DEVICE),
                };
                let name = self.fresh_name(&wanted, otherwise)?;
                let line = match fresh.kind {
                    FreshKind::Component => {
                        format!(
                            "component {name}{text} synchronous period 10 ms\n\t\telaborate work 1 ms\n\tendcomponent"
                        )
                    }
                    FreshKind::Sensor => format!("sensor {name}{text}"),
                    _ => format!("actuator {name}{text}"),
                };
                self.add_line(|node| node.kind() == kind, &line)?;
                name
            }
            Section::Machine(_) => return Err("components, sensors and actuators belong to a system".to_string()),
            Section::System(_) => return Err("states, guards and actions belong to a machine".to_string()),
        };
        self.place(&BTreeMap::from([(placed.unwrap_or_else(|| name.clone()), fresh.at)]))?;
        Ok(name)
    }

    /// Shapes of one kind stand together, before the paths.
    fn add_shape(&mut self, kind: SyntaxKind, line: &str) -> Result<(), String> {
        let section = self.section()?;
        let has = |kind: SyntaxKind| section.syntax().children().any(|node| node.kind() == kind);
        // In the order in which charts are usually written.
        let order = [CONTROL_VARIABLE, CONTROL_STATE, COMPOSITE_STATE, GUARD_SHAPE, ACTION_SHAPE, PATTERN_INSTANCE];
        let own = order.iter().position(|other| *other == kind).unwrap_or(0);
        let behind = order[..=own].iter().rev().find(|kind| has(**kind)).copied();
        match behind {
            Some(kind) => self.add_line(|node| node.kind() == kind, line),
            None => self.add_line(|_| false, line),
        }
    }

    /// A new line behind the last part of the drawing that is of some kind; where there is none, behind the last one that is no path, or
    /// at the beginning.
    pub(super) fn add_line(&mut self, behind: impl Fn(&SyntaxNode) -> bool, line: &str) -> Result<(), String> {
        let section = self.section()?;
        self.add_line_in(section.syntax(), behind, line, "\t");
        Ok(())
    }

    /// The same in a part of the text; `inner` are the blanks of lines at its beginning.
    pub(super) fn add_line_in(
        &mut self,
        section: &SyntaxNode,
        behind: impl Fn(&SyntaxNode) -> bool,
        line: &str,
        inner: &str,
    ) {
        let parts: Vec<SyntaxNode> = section.children().filter(|node| is_item(node.kind())).collect();
        let found = parts.iter().rfind(|node| behind(node));
        let is_path = line.contains(" -> ");
        let found = found.or_else(|| if is_path { parts.last() } else { None });
        if let Some(node) = found {
            let indent = self.indent_of(node);
            let end = words(node).last().map_or(0, |token| usize::from(token.text_range().end()));
            let rest = &self.text[end..];
            let to_line = rest.find('\n').unwrap_or(rest.len());
            let only_comment = rest[..to_line].trim().is_empty() || rest[..to_line].trim().starts_with("//");
            let at = if only_comment { end + rest[..to_line].trim_end().len() } else { end };
            let behind = if only_comment { "" } else { "\n\t" };
            self.replace(at..at, &format!("\n{indent}{line}{behind}"));
            return;
        }
        // Behind the head: the name, parameters, text and link.
        let head: Vec<_> = section.children_with_tokens().collect();
        let end = head
            .iter()
            .take_while(|element| match element {
                element if element.as_node().is_some_and(|node| is_item(node.kind())) => false,
                element => !element.as_token().is_some_and(|token| {
                    matches!(token.kind(), ENDMACHINE_KW | ENDPATTERN_KW | ENDSYSTEM_KW | ENDSTATE_KW)
                }),
            })
            .filter(|element| !element.kind().is_trivia())
            .last()
            .map_or(0, |element| usize::from(element.text_range().end()));
        let rest = &self.text[end..];
        let to_line = rest.find('\n').unwrap_or(rest.len());
        let behind = rest[..to_line].trim();
        // A comment at the end of the head's line stays there.
        let alone = behind.is_empty() || behind.starts_with("//");
        let at = if alone { end + rest[..to_line].trim_end().len() } else { end };
        self.replace(at..at, &format!("\n{inner}{line}{}", if alone { String::new() } else { format!("\n{inner}") }));
    }

    /// The blanks that the line of a node begins with.
    pub(super) fn indent_of(&self, node: &SyntaxNode) -> String {
        let start = words(node).first().map_or(0, |token| usize::from(token.text_range().start()));
        let line = self.text[..start].rfind('\n').map_or(0, |at| at + 1);
        let own = &self.text[line..start];
        let blanks: String = own.chars().take_while(|c| matches!(c, ' ' | '\t')).collect();
        if blanks.len() == own.len() && !blanks.is_empty() { blanks } else { "\t".to_string() }
    }

    /// See [`super::Operation::Machine`].
    pub(super) fn add_machine(&mut self, name: &str, is_pattern: bool, title: &str) -> Result<(), String> {
        if !is_name(name) {
            return Err(format!("`{name}` is no name: a letter first, then letters, digits and _"));
        }
        let file = self.file()?;
        let machines = file.machines().filter_map(|machine| machine.name());
        let mut taken = machines.chain(file.systems().filter_map(|system| system.name()));
        if taken.any(|token| token.text() == name) {
            return Err(format!("`{name}` is there already"));
        }
        let title = if title.is_empty() { String::new() } else { format!(" {}", quoted(title)) };
        let section = match is_pattern {
            true => format!("pattern {name}{title}\nendpattern\n"),
            false => {
                format!("machine {name}{title}\n\tcontrol {name}State\n\tinitial state idle \"Idle\"\nendmachine\n")
            }
        };
        // Before the layouts, which stand at the end.
        let first = file.layouts().next();
        let before = first.and_then(|layout| words(layout.syntax()).first().map(|token| token.text_range().start()));
        match before.map(usize::from) {
            Some(at) if self.text[..at].ends_with('\n') => self.replace(at..at, &format!("{section}\n")),
            _ => {
                let end = self.text.len();
                let gap = if self.text.ends_with('\n') { "\n" } else { "\n\n" };
                self.replace(end..end, &format!("{gap}{section}"));
            }
        }
        self.select = vec![name.to_string()];
        Ok(())
    }

    /// An arrow of a system: a connection with a device, a channel between components, or another reader of a channel.
    pub(super) fn connect_parts(&mut self, from: &str, to: &str) -> Result<(), String> {
        let Section::System(system) = self.section()? else { return Ok(()) };
        let of = |token: Option<syntax::SyntaxToken>| token.map(|token| token.text().to_string());
        let is_component =
            |name: &str| system.components().any(|component| of(component.name()).as_deref() == Some(name));
        let is_device = |name: &str| system.devices().any(|device| of(device.name()).as_deref() == Some(name));
        if from == to {
            return Err("a component needs no channel to itself".to_string());
        }
        if let Some(channel) = system.channels().find(|channel| of(channel.name()).as_deref() == Some(from)) {
            return self.add_reader(&channel, from, to, is_component(to));
        }
        let known = |name: &str| match is_component(name) || is_device(name) {
            true => Ok(()),
            false => Err(format!("there is no component or device `{name}`")),
        };
        known(from)?;
        known(to)?;
        if !(is_component(from) && is_component(to)) {
            let there = system
                .connections()
                .any(|line| of(line.from()).as_deref() == Some(from) && of(line.to()).as_deref() == Some(to));
            if there {
                return Ok(());
            }
            return self.add_line(|node| node.kind() == CONNECTION, &format!("{from} -> {to}"));
        }
        let capital = to[..1].to_ascii_uppercase() + &to[1..];
        let name = self.fresh_name(&format!("{from}To{capital}"), "channel1")?;
        self.add_phase(from, &format!("write {name}"), false)?;
        self.add_phase(to, &format!("read {name}"), true)?;
        self.add_line(
            |node| node.kind() == CHANNEL,
            &format!("channel {name} from {from} to {to} swinging buffer 2 master {from}"),
        )?;
        self.select = vec![name];
        Ok(())
    }

    /// One more component that reads a channel.
    fn add_reader(&mut self, channel: &Channel, name: &str, to: &str, is_component: bool) -> Result<(), String> {
        let readers: Vec<_> = channel.readers().collect();
        let Some(last) = readers.last().filter(|_| is_component) else {
            return Err(format!("the readers of the channel `{name}` are components"));
        };
        if channel.from().is_some_and(|writer| writer.text() == to) {
            return Err(format!("`{to}` writes the channel `{name}`"));
        }
        if readers.iter().any(|reader| reader.text() == to) {
            return Ok(());
        }
        let at = usize::from(last.text_range().end());
        self.replace(at..at, &format!(", {to}"));
        self.add_phase(to, &format!("read {name}"), true)
    }

    /// A phase of a component, at the beginning or the end of its cycle.
    pub(super) fn add_phase(&mut self, component: &str, line: &str, is_first: bool) -> Result<(), String> {
        let Section::System(system) = self.section()? else { return Ok(()) };
        let found = system.components().find(|part| part.name().is_some_and(|name| name.text() == component));
        let Some(found) = found else { return Ok(()) };
        let phases: Vec<_> = found.phases().collect();
        match (if is_first { phases.first() } else { phases.last() }, found.kind()) {
            (Some(phase), _) => {
                let indent = self.indent_of(phase.syntax());
                let tokens = words(phase.syntax());
                let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else { return Ok(()) };
                match is_first {
                    true => {
                        let at = usize::from(first.text_range().start());
                        self.replace(at..at, &format!("{line}\n{indent}"));
                    }
                    false => {
                        let at = usize::from(last.text_range().end());
                        self.replace(at..at, &format!("\n{indent}{line}"));
                    }
                }
            }
            (None, Some(kind)) => {
                let at = words(kind.syntax()).last().map_or(0, |token| usize::from(token.text_range().end()));
                self.replace(at..at, &format!("\n\t\t{line}"));
            }
            (None, None) => {}
        }
        Ok(())
    }
}

/// Whether a node is a part of a drawing that stands in lines of its own.
fn is_item(kind: SyntaxKind) -> bool {
    matches!(
        kind,
        CONTROL_VARIABLE
            | CONTROL_STATE
            | COMPOSITE_STATE
            | GUARD_SHAPE
            | ACTION_SHAPE
            | ABORT_ACTION
            | PATTERN_INSTANCE
            | SEQUENCE
            | CHART_PATH
            | HISTORY
            | ENTRY_ACTION
            | EXIT_ACTION
            | TICK
            | PROCESSORS
            | AGE_BOUND
            | COMPONENT
            | CHANNEL
            | DEVICE
            | CONNECTION
    )
}
