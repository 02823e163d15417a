//! Finds what cannot be generated of a system, and why.

use chart::build::late;
use chart::system::{Action, System};
use chart::{Content, Feed, Take};
use syntax::{Diagnostic, Span};

use super::names::{datum, pascal};
use crate::fault::not_generated;
use crate::names::snake;

/// The parts of a system that cannot be generated, with their places in the chart.
pub fn ungenerated(system: &System) -> Vec<Diagnostic> {
    let mut faults = late(system);
    for component in &system.components {
        // Not all file systems tell capitals apart.
        if component.name.eq_ignore_ascii_case("data") {
            faults.push(not_generated(
                component.span,
                format!("a component `{}` cannot be generated", component.name),
                "its file would be data.hpp, which has the types of the data",
                "rename it",
            ));
        }
        let mut hooks: Vec<String> = Vec::new();
        for phase in &component.phases {
            match phase.action {
                Action::Elaborate(_) if hooks.contains(&snake(&phase.subject)) => faults.push(not_generated(
                    phase.span,
                    format!("a second elaboration `{}` of `{}` cannot be generated", phase.subject, component.name),
                    "each elaboration is a function of the component's hook class",
                    "rename one of them",
                )),
                Action::Elaborate(_) => hooks.push(snake(&phase.subject)),
                Action::Write(_) if hooks.is_empty() => faults.push(not_generated(
                    phase.span,
                    format!("`{}` writes `{}` before it has elaborated anything", component.name, phase.subject),
                    "what is written comes from the component's hook, and there is none before this phase",
                    "put an `elaborate` phase before it",
                )),
                _ => {}
            }
        }
    }
    let computing = &system.computing;
    let said = |name: &str| {
        let channels = system.channels.iter().map(|channel| (&channel.drawn, &channel.message));
        let devices = system.devices.iter().map(|device| (&device.name, &device.message));
        let found = channels.chain(devices).find(|(known, _)| *known == name);
        found.and_then(|(_, message)| message.as_ref()).map_or(system.span, |message| message.span)
    };
    let mut types: Vec<(String, Span)> = Vec::new();
    for (name, content) in &computing.contents {
        match content {
            Content::Other(domain) => faults.push(not_generated(
                said(name),
                format!("data of {domain} cannot be generated"),
                "channels and devices of a program carry Booleans, numbers, literals of enums, and tuples of two to five of these",
                "split the datum into several channels, or number what it says",
            )),
            Content::Boolean | Content::Integer | Content::Real | Content::Enum { .. } | Content::Tuple(_) => {}
        }
    }
    for (name, content) in &computing.contents {
        for (made, _) in content.enums() {
            if !types.iter().any(|(known, _)| known == made) {
                types.push((made.to_string(), said(name)));
            }
        }
    }
    for machine in &computing.machines {
        let component = &system.components[machine.component];
        let is_hook = |name: &str| {
            let elaborations = component.phases.iter().filter(|phase| matches!(phase.action, Action::Elaborate(_)));
            elaborations.into_iter().any(|phase| snake(&phase.subject) == snake(name))
        };
        let sensors = machine.feeds.iter().filter(|(_, feed)| matches!(feed, Feed::Sensor(_))).map(|(name, _)| name);
        let actuators =
            machine.takes.iter().filter(|(_, take)| matches!(take, Take::Actuator(_))).map(|(name, _)| name);
        for name in sensors.chain(actuators).filter(|name| is_hook(name)) {
            faults.push(not_generated(
                component.span,
                format!("`{}` has an elaboration and a device `{name}`", component.name),
                "both are functions of the component's hook class",
                "rename one of them",
            ));
        }
        types.push((super::machines::name(component), component.span));
    }
    let drawn = system.drawn_channels().map(|channels| &channels[0]);
    let channels = drawn.map(|channel| (&channel.drawn, datum(system, &channel.drawn), channel.span));
    let components = system.components.iter().map(|one| (&one.name, pascal(&one.name), one.span));
    for (name, made, span) in channels.chain(components) {
        match types.iter().find(|(known, _)| *known == made) {
            Some(_) => faults.push(not_generated(
                span,
                format!("`{name}` and another name make one type `{made}`"),
                "components and channels are types of the generated code",
                "rename one of them",
            )),
            None => types.push((made, span)),
        }
    }
    faults
}
