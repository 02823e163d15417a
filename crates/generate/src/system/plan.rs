//! Decides about a system before anything is printed: how each end of a channel is used, the numbers of the program's
//! parts, the order in which tasks start and stop.

use chart::system::{Action, Channel, ChannelKind, Component, System};

/// Options of the program.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Form {
    /// Hand buffers over by one atomic exchange instead of a protocol with a lock.
    pub wait_free: bool,
    /// The namespace of the generated and the user's classes; derived from the system's name if not given.
    pub namespace: Option<String>,
    /// The classes of the components' machines. A component whose machine has none here gets an empty hook.
    pub classes: Vec<MachineClass>,
}

/// The class that `generate::model` makes of a component's machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MachineClass {
    /// The machine's file, as the chart's system names it.
    pub file: String,
    /// The machine's name.
    pub machine: String,
    /// The namespace of the class and the stem of its files.
    pub name: String,
    /// The text of its header.
    pub header: String,
    /// Names that differ in C++: `(the model's, the class's)`.
    pub renamed: Vec<(String, String)>,
    /// The numbers of its domains, by their names: its dynamic values have them.
    pub domains: Vec<(String, u32)>,
}

impl MachineClass {
    /// A function of the machine as the class calls it.
    pub(super) fn called<'n>(&'n self, function: &'n str) -> &'n str {
        self.renamed.iter().find(|(model, _)| model == function).map_or(function, |(_, cpp)| cpp)
    }
}

/// How a channel is used at one of its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Access {
    /// In the channel's own array.
    InPlace,
    /// On a copy that is transferred under the lock.
    Copy,
    /// Messages of a queue.
    Message,
    /// A single cell, in place.
    Cell,
}

/// How the component with this index uses a channel.
pub(super) fn access(channel: &Channel, component: usize, form: &Form) -> Access {
    match channel.kind {
        ChannelKind::Queue { .. } => Access::Message,
        ChannelKind::Shared => Access::Cell,
        ChannelKind::Buffer { .. } if form.wait_free => Access::Cell,
        ChannelKind::Buffer { master, .. } if master == component => Access::InPlace,
        ChannelKind::Buffer { .. } => Access::Copy,
    }
}

/// The channels that a component reads and writes, in the order of the phases.
pub(super) fn ends(component: &Component) -> (Vec<usize>, Vec<usize>) {
    let of = |wanted: fn(&Action) -> Option<usize>| component.phases.iter().filter_map(|p| wanted(&p.action)).collect();
    let read = |action: &Action| if let Action::Read(channel) = action { Some(*channel) } else { None };
    let written = |action: &Action| if let Action::Write(channel) = action { Some(*channel) } else { None };
    (of(read), of(written))
}

/// Where the data lie that a component writes to a channel.
fn place(channel: &Channel, component: usize, form: &Form) -> String {
    match access(channel, component, form) {
        Access::InPlace | Access::Cell => format!("{}_channel_.own()", channel.name),
        Access::Copy => format!("{}_staged_", channel.name),
        Access::Message => format!("{}_staged_.datum", channel.name),
    }
}

/// Where a component prepares its results, in the order of `Out`.
pub(super) fn places(system: &System, index: usize, form: &Form) -> String {
    let (_, written) = ends(&system.components[index]);
    let prepared = system.one_of_each_drawn(written);
    prepared.iter().map(|channel| place(&system.channels[*channel], index, form)).collect::<Vec<_>>().join(", ")
}

/// What brings the results that a component has prepared to the other readers of the same channel: assignments.
pub(super) fn copies(system: &System, index: usize, form: &Form) -> Vec<String> {
    let (_, written) = ends(&system.components[index]);
    let prepared = system.one_of_each_drawn(written.iter().copied());
    let others = written.iter().filter(|channel| !prepared.contains(channel));
    let copy = |channel: &usize| {
        let channel = &system.channels[*channel];
        let first = prepared.iter().map(|first| &system.channels[*first]).find(|first| first.drawn == channel.drawn);
        first.map(|first| format!("{} = {};", place(channel, index, form), place(first, index, form)))
    };
    others.filter_map(copy).collect()
}

/// The indices of phases, channels and components among the names.
pub(super) struct Numbers {
    /// For each component, the number of its first phase.
    pub(super) phases: Vec<usize>,
    /// The number of the first channel.
    pub(super) channels: usize,
    /// The number of the first component.
    pub(super) components: usize,
    /// The number of the first device.
    pub(super) devices: usize,
}

/// The numbers of a system's parts.
pub(super) fn numbers(system: &System) -> Numbers {
    let mut next = 0;
    let mut phases = Vec::new();
    for component in &system.components {
        phases.push(next);
        next += component.phases.len();
    }
    let components = next + system.channels.len();
    Numbers { phases, channels: next, components, devices: components + system.components.len() }
}

/// The priority of each task: among tasks that are ready at the same instant, the one with the shorter period goes
/// first.
pub(super) fn ranks(system: &System) -> Vec<usize> {
    let mut order: Vec<usize> = (0..system.components.len()).collect();
    order.sort_by_key(|index| system.components[*index].timing.period().unwrap_or(u64::MAX));
    let rank = |index: usize| order.iter().position(|other| *other == index).unwrap_or(index);
    (0..system.components.len()).map(rank).collect()
}

/// The order of stopping: first components that move something, then the others, both in the order of the chart.
pub(super) fn stopping(system: &System) -> Vec<usize> {
    let acts = |component: &Component| {
        let actuator = |name: &String| system.devices.iter().any(|device| !device.is_sensor && device.name == *name);
        system.connections.iter().any(|(from, to)| *from == component.name && actuator(to))
    };
    let mut order: Vec<usize> = (0..system.components.len()).collect();
    order.sort_by_key(|index| !acts(&system.components[*index]));
    order
}
