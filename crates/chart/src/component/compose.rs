//! The parts of the ground model in which components compute: their machines, the data of the channels, the ends of elaborations.
//!
//! In: a system and its machines, whose functions are all fed and taken. Out: [`Computing`]. The patterns carry the number of each datum;
//! what it says is in a table of the channel, `CHANNEL_value`, by this number. An elaboration that ends makes one step of its machine
//! and, after that in the same step, enters what was decided under the number that the next writing gets. Until it is written, a later
//! elaboration replaces it: so a datum that was dropped is lost with its value. A channel that is drawn to several readers is one for each
//! here, each with its own numbers and table; what is decided or computed for it is one value for all.

use std::collections::{BTreeMap, BTreeSet};

use syntax::ast::{self, AstNode};
use syntax::{Span, SyntaxKind};

use super::carry;
use super::found::stem;
use super::own::{Names, declared};
use super::roles::{own, place, prepares};
use crate::computing::{ComponentMachine, Computing, Content, Feed, Made, Take};
use crate::system::{Action, Channel, ChannelKind, Component, System};

/// How the values of data go through the channels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Carrying {
    /// In a table by the numbers of the data, which grows for ever.
    ByNumber,
    /// Where the data lie: at the writer, in each place of the channel, at the reader. See `carry`.
    ByPlace,
}

/// Composes what the components of a system compute.
pub(crate) fn compose(
    system: &System,
    machines: Vec<ComponentMachine>,
    contents: BTreeMap<String, Content>,
    carrying: Carrying,
) -> Computing {
    let mut computing = Computing { contents, ..Computing::default() };
    match carrying {
        Carrying::ByNumber => channels(system, &mut computing),
        Carrying::ByPlace => carry::channels(system, &mut computing),
    }
    let mut sensors = BTreeSet::new();
    for machine in &machines {
        imports(machine, &mut computing);
        devices(system, machine, &mut sensors, &mut computing);
        component(system, machine, carrying, &mut computing);
    }
    for (index, component) in system.components.iter().enumerate() {
        if !machines.iter().any(|machine| machine.component == index) {
            given(system, component, carrying, &mut computing);
        }
    }
    computing.machines = machines;
    computing
}

/// The table of a channel's values.
fn value(channel: &str) -> String {
    format!("{channel}_value")
}

/// The number of the datum that the reader of a channel has.
fn read_number(system: &System, channel: usize) -> String {
    let name = &system.channels[channel].name;
    match system.channels[channel].kind {
        ChannelKind::Buffer { .. } => format!("sb_receivedSequence({name})"),
        ChannelKind::Queue { .. } => format!("mq_taken({name})"),
        ChannelKind::Shared => format!("sv_receivedSequence({name})"),
    }
}

/// The number of the datum that is written next.
fn next_number(system: &System, channel: usize) -> String {
    let name = &system.channels[channel].name;
    match system.channels[channel].kind {
        ChannelKind::Buffer { .. } => format!("sb_written({name}) + 1"),
        ChannelKind::Queue { .. } => format!("mq_sent({name}) + 1"),
        ChannelKind::Shared => format!("sv_sequence({name}) + 1"),
    }
}

/// The function of a component that says what it got from a channel, or decided for it, where the machine's own function has not the
/// channel's name: one that is drawn to several readers. `conform` looks for it by that name.
fn copy(component: &Component, channel: &Channel) -> Option<String> {
    (channel.name != channel.drawn).then(|| format!("{}_{}", component.name, channel.name))
}

/// The value of the datum that the reader of a channel has.
fn read(system: &System, channel: usize, carrying: Carrying) -> String {
    let name = &system.channels[channel].name;
    match carrying {
        Carrying::ByNumber => format!("{}({})", value(name), read_number(system, channel)),
        Carrying::ByPlace => carry::received(name),
    }
}

/// The location of the value of the datum that is written next.
fn next(system: &System, channel: usize, carrying: Carrying) -> String {
    let name = &system.channels[channel].name;
    match carrying {
        Carrying::ByNumber => format!("{}({})", value(name), next_number(system, channel)),
        Carrying::ByPlace => carry::staged(name),
    }
}

fn channels(system: &System, computing: &mut Computing) {
    for channel in &system.channels {
        let Some(message) = &channel.message else { continue };
        let name = value(&channel.name);
        let text = format!(
            "// what the data of {} say, by their numbers\ncontrolled {name}: Integer -> {}\n",
            channel.name, message.text
        );
        computing.declarations.push(Made { name, text, span: channel.span });
    }
}

/// The modules that a machine imports, as paths from the chart.
fn imports(machine: &ComponentMachine, computing: &mut Computing) {
    let root = machine.model().root;
    let text = &machine.checked.sources.file(root).text;
    let Some(tree) = ast::SourceFile::cast(syntax::parse_asmetal(root, text).syntax()) else { return };
    for path in tree.imports().filter_map(|import| import.path()) {
        let path = if model::library(&path).is_some() {
            stem(&path).to_string()
        } else {
            tidied(&format!("{}{path}", machine.folder))
        };
        if !computing.imports.contains(&path) {
            computing.imports.push(path);
        }
    }
}

/// A path with `.` and `..` resolved.
fn tidied(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.trim_end_matches(".asm").split(['/', '\\']) {
        match part {
            "." => {}
            ".." if parts.last().is_some_and(|last| *last != ".." && !last.is_empty()) => _ = parts.pop(),
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

/// The functions of the sensors and actuators that a machine uses.
fn devices(system: &System, machine: &ComponentMachine, sensors: &mut BTreeSet<usize>, computing: &mut Computing) {
    let mut add = |device: usize, kind: &str| {
        let device = &system.devices[device];
        let Some(message) = &device.message else { return };
        let text = format!("// {}\n{kind} {}: {}\n", device.text.replace('\n', " "), device.name, message.text);
        computing.declarations.push(Made { name: device.name.clone(), text, span: device.span });
    };
    for (_, feed) in &machine.feeds {
        if let Feed::Sensor(sensor) = feed
            && sensors.insert(*sensor)
        {
            add(*sensor, "monitored");
        }
    }
    for (_, take) in &machine.takes {
        if let Take::Actuator(actuator) = take {
            add(*actuator, "out");
        }
    }
}

/// A machine as a part of its component, and the end of its elaboration.
fn component(system: &System, machine: &ComponentMachine, carrying: Carrying, computing: &mut Computing) {
    let component = &system.components[machine.component];
    let sensed = machine.feeds.iter().filter(|(_, feed)| matches!(feed, Feed::Sensor(_))).map(|(name, _)| name);
    let set = machine.takes.iter().filter(|(_, take)| matches!(take, Take::Actuator(_))).map(|(name, _)| name);
    let devices = sensed.chain(set).map(|name| (name.clone(), name.clone())).collect();
    let names = Names::new(machine, &component.name, devices);
    let Some(tree) = names.tree() else { return };
    signature(machine, &names, &tree, computing);
    let span = |node: &syntax::SyntaxNode| place(machine, Span::new(machine.model().root, ast::trimmed_range(node)));
    if let Some(definitions) = tree.definitions() {
        for node in definitions.syntax().children() {
            let Some(name) = declared(&node) else { continue };
            let name = match node.kind() {
                SyntaxKind::RULE_DECL => names.rule(name.text()),
                SyntaxKind::FUNCTION_DEF if names.is_free(name.text()) => continue,
                SyntaxKind::FUNCTION_DEF => names.function(name.text()),
                SyntaxKind::DOMAIN_DEF => names.domain(name.text()),
                // What a machine has to keep is about the machine alone.
                _ => continue,
            };
            computing.definitions.push(Made { name, text: format!("{}\n", names.text(&node)), span: span(&node) });
        }
    }
    let mut step = String::new();
    if let Some(rule) = tree.main_rule().and_then(|main| main.rule()) {
        let name = rule.name().map(|name| name.text().to_string()).unwrap_or_default();
        step = names.rule(&name);
        let text = format!(
            "// a step of {}, the machine of {}\n{}\n",
            machine.model().name,
            component.name,
            names.text(rule.syntax())
        );
        computing.definitions.push(Made { name: step.clone(), text, span: span(rule.syntax()) });
    }
    for init in tree.inits().filter(ast::Init::is_default) {
        for node in init
            .syntax()
            .children()
            .filter(|node| matches!(node.kind(), SyntaxKind::FUNCTION_DEF | SyntaxKind::DOMAIN_DEF))
        {
            let about = declared(&node).map(|name| name.text().to_string()).unwrap_or_default();
            // What is fed has the value of what feeds it.
            if !machine.feeds.iter().any(|(name, _)| *name == about) && !names.is_free(&about) {
                computing.initial.push(format!("{}\n", names.text(&node)));
            }
        }
    }
    let mut after = Vec::new();
    for (name, take) in &machine.takes {
        if let Take::Channel(channel) = take
            && system.channels[*channel].message.is_some()
        {
            after.push(format!("{} := {}", next(system, *channel, carrying), names.function(name)));
            let (drawn, message) = (&system.channels[*channel], &system.channels[*channel].message);
            if let (Some(copy), Some(message)) = (copy(component, drawn), message) {
                let text = format!(
                    "// what it decided for the reader {}\ncontrolled {copy}: {}\n",
                    system.components[drawn.to].name, message.text
                );
                computing.declarations.push(Made { name: copy.clone(), text, span: drawn.span });
                after.push(format!("{copy} := {}", names.function(name)));
            }
        }
    }
    for (name, feed) in &machine.feeds {
        let (text, definition) = match feed {
            Feed::Sensor(_) => continue,
            Feed::Channel(channel) => {
                (format!("what was read from {}", system.channels[*channel].name), read(system, *channel, carrying))
            }
            Feed::IsNew(channel) => {
                let channel_name = &system.channels[*channel].name;
                let definition = match system.channels[*channel].kind {
                    ChannelKind::Buffer { .. } => format!("sb_fresh({channel_name})"),
                    ChannelKind::Shared => format!("sv_fresh({channel_name})"),
                    ChannelKind::Queue { .. } if carrying == Carrying::ByPlace => {
                        let is_new = carry::is_new(channel_name);
                        after.push(format!("{is_new} := false"));
                        is_new
                    }
                    ChannelKind::Queue { .. } => {
                        let seen = format!("{}_taken_{channel_name}", component.name);
                        let text = format!(
                            "// how many messages of {channel_name} its elaborations have seen\ncontrolled {seen}: Integer\n"
                        );
                        computing.declarations.push(Made { name: seen.clone(), text, span: component.span });
                        computing.initial.push(format!("function {seen} = 0\n"));
                        after.push(format!("{seen} := mq_taken({channel_name})"));
                        format!("mq_taken({channel_name}) != {seen}")
                    }
                };
                (format!("it was not there in the elaboration before: {channel_name}"), definition)
            }
        };
        let name = names.function(name);
        if let Feed::Channel(channel) = feed
            && let (Some(copy), Some(message)) =
                (copy(component, &system.channels[*channel]), &system.channels[*channel].message)
        {
            let declaration = format!("// the same\nderived {copy}: {}\n", message.text);
            computing.declarations.push(Made { name: copy.clone(), text: declaration, span: component.span });
            let text = format!("function {copy} = {name}\n");
            computing.definitions.push(Made { name: copy, text, span: component.span });
        }
        let text = format!("// {text}\nfunction {name} = {definition}\n");
        computing.definitions.push(Made { name, text, span: component.span });
    }
    let call = format!("{step}[]");
    let body = match &after[..] {
        [] => call,
        [one] => format!("seq\n{call}\n{one}\nendseq"),
        several => format!("seq\n{call}\npar\n{}\nendpar\nendseq", several.join("\n")),
    };
    end(component, machine.phase, &body, computing);
}

/// The declarations of a machine: what is fed becomes derived, what a channel takes becomes controlled.
fn signature(machine: &ComponentMachine, names: &Names<'_>, tree: &ast::SourceFile, computing: &mut Computing) {
    let span = |node: &syntax::SyntaxNode| place(machine, Span::new(machine.model().root, ast::trimmed_range(node)));
    let Some(signature) = tree.signature() else { return };
    for node in signature.syntax().children() {
        let Some(name) = declared(&node) else { continue };
        let function = own(machine)
            .find(|function| function.name == name.text())
            .filter(|_| node.kind() == SyntaxKind::FUNCTION_DECL);
        let Some(function) = function else {
            let text = names.text(&node);
            let made = declared_in(&text).unwrap_or_else(|| name.text().to_string());
            computing.declarations.push(Made { name: made, text: format!("{text}\n"), span: span(&node) });
            continue;
        };
        let feed = machine.feeds.iter().find(|(name, _)| *name == function.name).map(|(_, feed)| feed);
        let take = machine.takes.iter().find(|(name, _)| *name == function.name).map(|(_, take)| take);
        let kind = match (feed, take) {
            _ if names.is_free(&function.name) => Some("monitored"),
            (Some(Feed::Sensor(_)), _) | (_, Some(Take::Actuator(_))) => continue,
            (Some(Feed::Channel(_) | Feed::IsNew(_)), _) => Some("derived"),
            (_, Some(Take::Channel(_))) => Some("controlled"),
            (None, None) => None,
        };
        let text = names.text(&node);
        let text = match (kind, text.split_once(char::is_whitespace)) {
            (Some(kind), Some((_, rest))) => format!("{kind} {}", rest.trim_start()),
            _ => text,
        };
        computing.declarations.push(Made {
            name: names.function(&function.name),
            text: format!("{text}\n"),
            span: span(&node),
        });
    }
}

/// The first name in the text of a declaration.
fn declared_in(text: &str) -> Option<String> {
    let parse = syntax::parse_asmetal(syntax::FileId(0), &format!("module M signature: {text} definitions:"));
    let signature = parse.syntax().children().find(|node| node.kind() == SyntaxKind::SIGNATURE)?;
    declared(&signature).map(|name| name.text().to_string())
}

/// The data of a component without a machine are inputs.
fn given(system: &System, component: &Component, carrying: Carrying, computing: &mut Computing) {
    let mut by_phase: BTreeMap<usize, Vec<String>> = BTreeMap::new();
    for (at, phase) in component.phases.iter().enumerate() {
        let Action::Write(channel) = phase.action else { continue };
        let drawn = &system.channels[channel];
        let (Some(message), Some(prepared)) = (&drawn.message, prepares(component, at)) else { continue };
        let name = format!("{}_{}", component.name, drawn.drawn);
        // All readers of a channel get one datum.
        if !computing.declarations.iter().any(|made| made.name == name && made.span == drawn.span) {
            let text = format!(
                "// what {} computes for {}\nmonitored {name}: {}\n",
                component.name, drawn.drawn, message.text
            );
            computing.declarations.push(Made { name: name.clone(), text, span: drawn.span });
        }
        let update = format!("{} := {name}", next(system, channel, carrying));
        by_phase.entry(prepared).or_default().push(update);
    }
    for (phase, updates) in by_phase {
        let body = match &updates[..] {
            [one] => one.clone(),
            several => format!("par\n{}\nendpar", several.join("\n")),
        };
        end(component, phase, &body, computing);
    }
}

/// The rule of the end of an elaboration.
fn end(component: &Component, phase: usize, body: &str, computing: &mut Computing) {
    let phase = &component.phases[phase];
    let name = format!("r_end_{}", phase.name);
    let text = format!("// the end of {}\nrule {name} =\n{body}\n", phase.name);
    computing.definitions.push(Made { name: name.clone(), text, span: phase.span });
    computing.ends.push((phase.name.clone(), name));
}
