//! A part of a system that is enough for some properties, whatever the rest does.
//!
//! In: a system, and what is asked about. Out: [`Reduction`]s, each wider than the one before, and the system that each of them means.
//! Functions that are not kept may have any value in each step; components of which nothing is kept are taken out, and what
//! stands in their place may bring any datum and hold a lock for as long as they could. INVARIANT: to each run of the whole system, as long as
//! its machines make their steps, belongs a run of the part in which all that is kept is the same, tick by tick. So what holds in every
//! run of the part holds in every run of the system; what is violated in the part need not be violated in the system.
//!
//! That is so because (a) a function that is free is one that no rule updates and no definition fixes, but that may be anything, undef
//! too, and in a machine in which nothing is read after it was updated within the step; (b) an access to a channel whose other end is taken out lasts
//! from its time without waiting to that with the longest section of the other end; (c) no kept task may ever give up waiting, which is asked
//! of its times ([`is_patient`]); (d) writers that tasks await, and both ends of a queue, in which a sender waits for room, are kept together.

use std::collections::{BTreeMap, BTreeSet};

use model::FunctionKind;
use syntax::SyntaxNode;

use super::compose::{Carrying, compose};
use super::own::Names;
use super::reads;
use super::roles::own;
use crate::build::{busy, taken};
use crate::computing::{ComponentMachine, Computing, Feed, Take};
use crate::system::{Action, Awaited, Channel, ChannelKind, Component, Phase, System, Timing};
use crate::times::section;

/// A function of a component's machine: the index of the component, the function's name in its machine.
type Node = (usize, String);

/// See the module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Reduction {
    functions: BTreeSet<Node>,
    components: BTreeSet<usize>,
}

/// The part of a system that a reduction means.
#[derive(Debug)]
pub(crate) struct Cut {
    pub(crate) system: System,
    /// The inputs that stand for what was left free.
    pub(crate) free: Vec<String>,
    /// Those of them that may be undef: all but whether a datum is new.
    pub(crate) undefined: Vec<String>,
}

impl Reduction {
    /// The least one for what is asked about; none if nothing can be left out.
    pub(crate) fn of(system: &System, asks_about: &dyn Fn(&str) -> bool) -> Option<Reduction> {
        let mut functions = BTreeSet::new();
        for machine in &system.computing.machines {
            let asked = variables(machine).filter(|name| asks_about(&composed(system, machine, name)));
            functions.extend(asked.map(|name| (machine.component, name)));
        }
        if functions.is_empty() {
            return None;
        }
        closed(system, functions).filter(|reduction| reduction.is_real(system))
    }

    /// This one with what the functions of one more component read, of one to which the others bring data rather than of one that brings
    /// them; none if that is nothing more, or if nothing is left out then.
    pub(crate) fn widened(&self, system: &System) -> Option<Reduction> {
        for component in self.readers_first(system) {
            let machine = machine_of(system, component)?;
            let tree = tree(system, machine)?;
            let own: BTreeSet<String> = variables(machine).collect();
            let mut functions = self.functions.clone();
            for (_, function) in self.functions.iter().filter(|(of, _)| *of == component) {
                let read = reads::read_for(&tree, function).into_iter().filter(|name| own.contains(name));
                functions.extend(read.map(|name| (component, name)));
            }
            let wider = closed(system, functions)?;
            if wider != *self {
                return Some(wider).filter(|wider| wider.is_real(system));
            }
        }
        None
    }

    /// The components whose machines are a part, those first from which no other one of them reads.
    fn readers_first(&self, system: &System) -> Vec<usize> {
        let mut open: Vec<usize> = (0..system.components.len()).filter(|component| self.decides(*component)).collect();
        let mut ordered = Vec::new();
        while !open.is_empty() {
            let is_read = |writer: usize| {
                system.channels.iter().any(|one| one.from == writer && one.to != writer && open.contains(&one.to))
            };
            // Where they read from each other, any order is as good.
            let next = open.iter().position(|component| !is_read(*component)).unwrap_or(0);
            ordered.push(open.remove(next));
        }
        ordered
    }

    /// Whether something is left out, and no kept task ever gives up waiting.
    fn is_real(&self, system: &System) -> bool {
        let all: usize = system.computing.machines.iter().map(|machine| variables(machine).count()).sum();
        let is_part = self.components.len() < system.components.len() || self.functions.len() < all;
        is_part && self.components.iter().all(|component| is_patient(system, *component))
    }

    /// The names of the components whose machines are a part.
    pub(crate) fn names<'s>(&self, system: &'s System) -> Vec<&'s str> {
        let deciding: BTreeSet<usize> = self.functions.iter().map(|(component, _)| *component).collect();
        deciding.into_iter().map(|component| system.components[component].name.as_str()).collect()
    }

    /// The system that it means.
    pub(crate) fn cut(&self, system: &System) -> Cut {
        let new_component: BTreeMap<usize, usize> = self.components.iter().copied().zip(0..).collect();
        let is_kept =
            |channel: &Channel| new_component.contains_key(&channel.from) && new_component.contains_key(&channel.to);
        let kept = (0..system.channels.len()).filter(|channel| is_kept(&system.channels[*channel]));
        let new_channel: BTreeMap<usize, usize> = kept.zip(0..).collect();
        let (mut free, mut undefined) = (Vec::new(), Vec::new());
        let mut machines = Vec::new();
        let mut carried = BTreeSet::new();
        for machine in system.computing.machines.iter().filter(|machine| self.decides(machine.component)) {
            let mut part = machine.clone();
            part.component = new_component[&machine.component];
            let keeps = |name: &str| self.functions.contains(&(machine.component, name.to_string()));
            part.feeds.retain(|(name, feed)| matches!(feed, Feed::Sensor(_)) || keeps(name));
            part.takes.retain(|(name, take)| {
                keeps(name) && !matches!(take, Take::Channel(channel) if !new_channel.contains_key(channel))
            });
            for (_, feed) in &mut part.feeds {
                match feed {
                    Feed::Channel(channel) => {
                        carried.insert(*channel);
                        *channel = new_channel[channel];
                    }
                    Feed::IsNew(channel) => *channel = new_channel[channel],
                    Feed::Sensor(_) => {}
                }
            }
            for (_, take) in &mut part.takes {
                if let Take::Channel(channel) = take {
                    *channel = new_channel[channel];
                }
            }
            part.freed = variables(machine).filter(|name| !keeps(name)).collect();
            let component = &system.components[machine.component].name;
            let is_new =
                |name: &&String| machine.feeds.iter().any(|(fed, feed)| fed == *name && matches!(feed, Feed::IsNew(_)));
            let named = |name: &String| format!("{component}_{name}");
            free.extend(part.freed.iter().map(named));
            undefined.extend(part.freed.iter().filter(|name| !is_new(name)).map(named));
            machines.push(part);
        }
        let channel = |(old, channel): (usize, &Channel)| Channel {
            from: new_component[&channel.from],
            to: new_component[&channel.to],
            kind: match channel.kind {
                ChannelKind::Buffer { arrays, master } => {
                    ChannelKind::Buffer { arrays, master: new_component[&master] }
                }
                other => other,
            },
            message: channel.message.clone().filter(|_| carried.contains(&old)),
            ..channel.clone()
        };
        let channels = system.channels.iter().enumerate().filter(|(old, _)| new_channel.contains_key(old)).map(channel);
        let components = self.components.iter().map(|index| component(system, *index, &new_channel));
        let mut part = System {
            components: components.collect(),
            channels: channels.collect(),
            bounds: Vec::new(),
            computing: Computing::default(),
            ..system.clone()
        };
        let names: BTreeSet<&String> = part.components.iter().map(|component| &component.name).collect();
        let is_there = |end: &String| names.contains(end) || system.devices.iter().any(|device| device.name == *end);
        part.connections.retain(|(from, to)| is_there(from) && is_there(to));
        part.computing = compose(&part, machines, system.computing.contents.clone(), Carrying::ByNumber);
        Cut { system: part, free, undefined }
    }

    fn decides(&self, component: usize) -> bool {
        self.functions.iter().any(|(of, _)| *of == component)
    }
}

fn machine_of(system: &System, component: usize) -> Option<&ComponentMachine> {
    system.computing.machines.iter().find(|machine| machine.component == component)
}

fn tree(system: &System, machine: &ComponentMachine) -> Option<SyntaxNode> {
    let names = Names::new(machine, &system.components[machine.component].name, BTreeMap::new());
    names.tree().map(|tree| syntax::ast::AstNode::syntax(&tree).clone())
}

/// The functions of a machine that are no inputs from sensors and may change.
fn variables(machine: &ComponentMachine) -> impl Iterator<Item = String> {
    let sensed = |name: &str| machine.feeds.iter().any(|(fed, feed)| fed == name && matches!(feed, Feed::Sensor(_)));
    let changing = own(machine).filter(move |one| one.kind != FunctionKind::Static && !sensed(&one.name));
    changing.map(|function| function.name.clone())
}

/// The name that a function has in the built model.
fn composed(system: &System, machine: &ComponentMachine, name: &str) -> String {
    let sets = machine.takes.iter().any(|(set, take)| set == name && matches!(take, Take::Actuator(_)));
    if sets { name.to_string() } else { format!("{}_{name}", system.components[machine.component].name) }
}

/// A reduction with all that it cannot be without.
fn closed(system: &System, mut functions: BTreeSet<Node>) -> Option<Reduction> {
    let mut components: BTreeSet<usize> = functions.iter().map(|(component, _)| *component).collect();
    loop {
        let before = (functions.len(), components.len());
        for (component, function) in functions.clone() {
            let machine = machine_of(system, component)?;
            let tree = tree(system, machine)?;
            if !reads::is_plain(&tree) || own(machine).any(|one| one.kind == FunctionKind::Shared) {
                functions.extend(variables(machine).map(|name| (component, name)));
            }
            for (_, feed) in machine.feeds.iter().filter(|(name, _)| *name == function) {
                match feed {
                    Feed::Channel(channel) => {
                        let writer = system.channels[*channel].from;
                        components.insert(writer);
                        let takes = machine_of(system, writer).into_iter().flat_map(|machine| &machine.takes);
                        let written = takes.filter(|(_, take)| *take == Take::Channel(*channel));
                        functions.extend(written.map(|(name, _)| (writer, name.clone())));
                    }
                    Feed::IsNew(channel) => _ = components.insert(system.channels[*channel].from),
                    Feed::Sensor(_) => {}
                }
            }
        }
        for component in components.clone() {
            components.extend(
                system.components[component].timing.awaited().iter().map(|channel| system.channels[*channel].from),
            );
        }
        let queues = system.channels.iter().filter(|channel| matches!(channel.kind, ChannelKind::Queue { .. }));
        for channel in queues {
            if components.contains(&channel.from) || components.contains(&channel.to) {
                components.extend([channel.from, channel.to]);
            }
        }
        if before == (functions.len(), components.len()) {
            return Some(Reduction { functions, components });
        }
    }
}

/// Whether a task never gives up waiting for a lock: it has time for its cycle, with the longest section of each other end.
fn is_patient(system: &System, index: usize) -> bool {
    let component = &system.components[index];
    let Some(available) = component.available() else { return true };
    let waits: u64 = component.phases.iter().map(|phase| longest_wait(system, index, phase)).sum();
    busy(system, component) + waits < available
}

/// The longest time for which the other end of a phase's channel keeps it waiting.
fn longest_wait(system: &System, index: usize, phase: &Phase) -> u64 {
    match phase.action {
        Action::Read(channel) | Action::Write(channel) => {
            let Channel { from, to, .. } = system.channels[channel];
            section(system, channel, if from == index { to } else { from })
        }
        Action::Elaborate(_) => 0,
    }
}

/// A component whose accesses to channels that are taken out only take time.
fn component(system: &System, index: usize, new_channel: &BTreeMap<usize, usize>) -> Component {
    let component = &system.components[index];
    let phase = |phase: &Phase| {
        // What is stated of the whole system is asked of the whole.
        let mut part = Phase { fresh: None, ..phase.clone() };
        match &mut part.action {
            Action::Read(channel) | Action::Write(channel) => match new_channel.get(channel) {
                Some(new) => *channel = *new,
                None => {
                    part.least = taken(system, component, phase);
                    part.time = part.least + longest_wait(system, index, phase);
                    part.action = Action::Elaborate(None);
                }
            },
            Action::Elaborate(_) => {}
        }
        part
    };
    let timing = match &component.timing {
        Timing::Asynchronous { awaits } => {
            // The writers of all that is awaited are parts, too.
            let channels = awaits.channels.iter().map(|channel| new_channel[channel]).collect();
            Timing::Asynchronous { awaits: Awaited { channels, ..*awaits } }
        }
        Timing::Synchronous { .. } => component.timing.clone(),
    };
    let phases = component.phases.iter().map(phase).collect();
    Component { timing, phases, tolerance: None, ..component.clone() }
}
