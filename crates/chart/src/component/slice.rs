//! The part of a system's data that some of its functions rest on.
//!
//! In: a system whose components compute, and what is asked about. Out: the system with the machines and data that this rests on. What
//! components decide changes nothing of when they run and what they read and write, so nothing else has to be left in: a machine that
//! feeds none of those asked about, directly or through others, says nothing about them.

use std::collections::BTreeSet;

use super::compose::{Carrying, compose};
use crate::computing::{Computing, Feed, Take};
use crate::system::{Action, System};

/// The system with what the functions rest on that are asked about; none if no function of a component is.
pub(crate) fn slice(system: &System, asks_about: &dyn Fn(&str) -> bool) -> Option<System> {
    let machine_of = |component: usize| system.computing.machines.iter().find(|one| one.component == component);
    let mut needed: BTreeSet<usize> = (0..system.components.len())
        .filter(|component| names(system, *component).iter().any(|name| asks_about(name)))
        .collect();
    let asked = needed.clone();
    let mut open: Vec<usize> = needed.iter().copied().collect();
    let mut carried = BTreeSet::new();
    while let Some(component) = open.pop() {
        for (_, feed) in machine_of(component).iter().flat_map(|machine| &machine.feeds) {
            if let Feed::Channel(channel) | Feed::IsNew(channel) = feed {
                carried.insert(*channel);
                let writer = system.channels[*channel].from;
                if needed.insert(writer) {
                    open.push(writer);
                }
            }
        }
    }
    // What a component without a machine computes is asked about by what it writes.
    let given = |component: &usize| asked.contains(component) && machine_of(*component).is_none();
    carried.extend((0..system.channels.len()).filter(|channel| given(&system.channels[*channel].from)));
    if needed.is_empty() {
        return None;
    }
    let mut sliced = System { computing: Computing::default(), ..system.clone() };
    for (index, channel) in sliced.channels.iter_mut().enumerate() {
        if !carried.contains(&index) {
            channel.message = None;
        }
    }
    let Computing { mut machines, contents, .. } = system.computing.clone();
    machines.retain(|machine| needed.contains(&machine.component));
    sliced.computing = compose(&sliced, machines, contents, Carrying::ByNumber);
    Some(sliced)
}

/// The functions of a component: those of its machine with its sensors and actuators, or what it computes without one.
fn names(system: &System, component: usize) -> Vec<String> {
    let Some(machine) = system.computing.machines.iter().find(|machine| machine.component == component) else {
        let written = system.components[component].phases.iter().filter_map(|phase| match phase.action {
            Action::Write(channel) => Some(&system.channels[channel]),
            Action::Read(_) | Action::Elaborate(_) => None,
        });
        let written = written.filter(|channel| channel.message.is_some());
        return written.map(|channel| format!("{}_{}", system.components[component].name, channel.drawn)).collect();
    };
    let Computing { contents, .. } = system.computing.clone();
    let alone = compose(system, vec![machine.clone()], contents, Carrying::ByNumber);
    let prefix = format!("{}_", system.components[component].name);
    let own = alone.declarations.into_iter().map(|made| made.name).filter(|name| name.starts_with(&prefix));
    let sensors = machine.feeds.iter().filter(|(_, feed)| matches!(feed, Feed::Sensor(_))).map(|(name, _)| name);
    let actuators = machine.takes.iter().filter(|(_, take)| matches!(take, Take::Actuator(_))).map(|(name, _)| name);
    own.chain(sensors.chain(actuators).cloned()).collect()
}
