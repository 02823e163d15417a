//! Which channel or sensor feeds each monitored function of a component's machine, and which channel or actuator takes each out function.
//!
//! In: a system, a machine, and the domains that its channels and devices carry. Out: the machine's feeds and takes, and a fault for each
//! function that nothing feeds or takes, each domain that does not fit, and each channel that the machine would have to write.

use model::{Domains, Function, FunctionKind};
use syntax::ast::{self, AstNode};
use syntax::{Diagnostic, Span, SyntaxKind};

use super::types::{Identity, Types};
use crate::computing::{ComponentMachine, Feed, Take};
use crate::fault::component as fault;
use crate::system::{Action, Component, System};

/// The name of the function that says whether a datum of a channel is new.
pub(super) fn is_new(channel: &str) -> String {
    let mut letters = channel.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    format!("isNew{first}{}", letters.as_str())
}

/// The channels that a component reads, and those that it writes, each with its phase.
fn ends(component: &Component) -> (Vec<usize>, Vec<(usize, usize)>) {
    let (mut read, mut written) = (Vec::new(), Vec::new());
    for (at, phase) in component.phases.iter().enumerate() {
        match phase.action {
            Action::Read(channel) => read.push(channel),
            Action::Write(channel) => written.push((channel, at)),
            Action::Elaborate(_) => {}
        }
    }
    (read, written)
}

/// The elaboration that prepares what a component writes in a phase: that of its machine, otherwise the last one before the phase.
pub(super) fn prepares(component: &Component, phase: usize) -> Option<usize> {
    let elaborates = |at: &usize| matches!(component.phases[*at].action, Action::Elaborate(_));
    let own = (0..component.phases.len()).find(|at| component.phases[*at].machine.is_some());
    own.or_else(|| (0..phase).rev().find(elaborates)).filter(|at| *at < phase)
}

/// Faults that need no machine to be seen: machines where there can be none, and data that nothing prepares.
pub(super) fn misplaced(system: &System) -> Vec<Diagnostic> {
    let mut faults = Vec::new();
    for component in &system.components {
        let mut first: Option<Span> = None;
        for phase in &component.phases {
            let Some(named) = &phase.machine else { continue };
            match (&phase.action, first) {
                (Action::Elaborate(_), Some(first)) => faults.push(fault::second(named.span, &component.name, first)),
                (Action::Elaborate(_), None) => first = Some(named.span),
                (Action::Read(_) | Action::Write(_), _) => faults.push(fault::no_elaboration(named.span)),
            }
        }
        let written = ends(component).1;
        let each = system.one_of_each_drawn(written.iter().map(|(channel, _)| *channel));
        for (channel, at) in written.into_iter().filter(|(channel, _)| each.contains(channel)) {
            let channel = &system.channels[channel];
            if channel.message.is_some() && prepares(component, at).is_none() {
                faults.push(fault::written_too_early(component.phases[at].span, &component.name, &channel.drawn));
            }
        }
    }
    faults
}

/// The machine's functions that come from its own file.
pub(super) fn own(machine: &ComponentMachine) -> impl Iterator<Item = &Function> {
    let root = machine.model().root;
    machine.model().functions.iter().filter(move |function| function.span.file == root && !function.library)
}

/// The place of a span of the machine's file, among the texts of the chart.
pub(super) fn place(machine: &ComponentMachine, span: Span) -> Span {
    Span { file: machine.file, ..span }
}

/// The function's declaration, if it is in the machine's own file: the other texts are not among those of the chart.
fn label(machine: &ComponentMachine, function: &Function) -> Option<Span> {
    (function.span.file == machine.model().root).then(|| place(machine, function.span))
}

/// Finds what feeds and takes the functions of a machine.
pub(super) fn assign(system: &System, machine: &mut ComponentMachine, types: &Types) -> Vec<Diagnostic> {
    let mut faults = Vec::new();
    let component = &system.components[machine.component];
    let at = component.phases[machine.phase].machine.as_ref().map_or(component.span, |named| named.span);
    let (mut feeds, mut takes) = (Vec::new(), Vec::new());
    let outside = machine.model().functions.iter().filter(|function| !function.library);
    for function in outside {
        let is_own = function.span.file == machine.model().root;
        match function.kind {
            FunctionKind::Monitored | FunctionKind::Shared => {
                let feed = if is_own && function.kind == FunctionKind::Monitored {
                    feed_of(system, machine, function)
                } else {
                    None
                };
                match feed {
                    Some(feed) => {
                        faults.extend(misfit(system, machine, function, types, feed, at));
                        feeds.push((function.name.clone(), feed));
                    }
                    None => faults.push(unfed(system, machine, function, at)),
                }
            }
            FunctionKind::Out => match if is_own { take_of(system, machine, function) } else { None } {
                Some(taken) => {
                    faults.extend(unfit(system, machine, function, types, taken[0], at));
                    takes.extend(taken.into_iter().map(|take| (function.name.clone(), take)));
                }
                None => faults.push(untaken(system, machine, function, at)),
            },
            FunctionKind::Controlled if !is_own => faults.push(fault::foreign_state(at, &function.name)),
            FunctionKind::Controlled | FunctionKind::Static | FunctionKind::Derived | FunctionKind::Local => {}
        }
    }
    for channel in system.one_of_each_drawn(ends(component).1.into_iter().map(|(channel, _)| channel)) {
        let channel = &system.channels[channel];
        if channel.message.is_none() {
            continue;
        }
        let written = own(machine).find(|function| function.name == channel.drawn);
        match written {
            Some(function) if function.kind == FunctionKind::Out && function.parameters.is_empty() => {
                if !updates(machine, &channel.drawn) {
                    faults.push(fault::never_written(at, &channel.drawn, label(machine, function)));
                }
            }
            other => faults.push(fault::no_out_function(at, &channel.drawn, other.and_then(|one| label(machine, one)))),
        }
    }
    (machine.feeds, machine.takes) = (feeds, takes);
    faults
}

fn feed_of(system: &System, machine: &ComponentMachine, function: &Function) -> Option<Feed> {
    let component = &system.components[machine.component];
    let carries = |index: &usize| system.channels[*index].message.is_some();
    let mut read = ends(component).0.into_iter().filter(carries).collect::<Vec<_>>().into_iter();
    if !function.parameters.is_empty() {
        return None;
    }
    if let Some(feed) = read.find_map(|index| {
        let name = &system.channels[index].drawn;
        let own = (*name == function.name).then_some(Feed::Channel(index));
        own.or_else(|| (is_new(name) == function.name).then_some(Feed::IsNew(index)))
    }) {
        return Some(feed);
    }
    let sensor = |device: &crate::system::Device| {
        let connected = system.connections.iter().any(|(from, to)| *from == device.name && *to == component.name);
        device.is_sensor && device.message.is_some() && device.name == function.name && connected
    };
    system.devices.iter().position(sensor).map(Feed::Sensor)
}

/// What takes an out function: a channel, those to all readers of one that is drawn, or an actuator.
fn take_of(system: &System, machine: &ComponentMachine, function: &Function) -> Option<Vec<Take>> {
    let component = &system.components[machine.component];
    if !function.parameters.is_empty() {
        return None;
    }
    let carries =
        |index: &usize| system.channels[*index].message.is_some() && system.channels[*index].drawn == function.name;
    let written = ends(component).1.into_iter().map(|(index, _)| index).filter(carries);
    let channels: Vec<Take> = written.map(Take::Channel).collect();
    if !channels.is_empty() {
        return Some(channels);
    }
    let actuator = |device: &crate::system::Device| {
        let connected = system.connections.iter().any(|(from, to)| *from == component.name && *to == device.name);
        !device.is_sensor && device.message.is_some() && device.name == function.name && connected
    };
    system.devices.iter().position(actuator).map(|device| vec![Take::Actuator(device)])
}

/// Why a function that has the name of a channel or device has no part in it.
fn reason(system: &System, component: &Component, name: &str, reads: bool) -> Option<String> {
    let (read, written) = ends(component);
    let own = |index: usize| if reads { read.contains(&index) } else { written.iter().any(|(one, _)| *one == index) };
    let named = |index: &usize| {
        let channel = &system.channels[*index].drawn;
        channel == name || reads && is_new(channel) == name
    };
    let all = (0..system.channels.len()).filter(named).collect::<Vec<_>>();
    if let Some(index) = all.iter().find(|index| own(**index)).or(all.first()).copied() {
        let channel = &system.channels[index];
        let verb = if reads { "read" } else { "write" };
        return Some(match own(index) {
            true if channel.message.is_none() => {
                format!("say what the channel carries: `channel {0} : DOMAIN from …`", channel.drawn)
            }
            true => "a channel carries one value: the function has no arguments".to_string(),
            false => format!("the component does not {verb} the channel `{}`", channel.drawn),
        });
    }
    let device = system.devices.iter().find(|device| device.name == name)?;
    let word = if device.is_sensor { "sensor" } else { "actuator" };
    Some(match device.message {
        None => format!("say what the {word} carries: `{word} {name} : DOMAIN`"),
        Some(_) if device.is_sensor != reads => {
            format!("`{name}` is {}", if reads { "an actuator" } else { "a sensor" })
        }
        Some(_) if reads => format!("connect the two: `{name} -> {}`", component.name),
        Some(_) => format!("connect the two: `{} -> {name}`", component.name),
    })
}

/// What the functions of a component's machine may be called.
fn offered(system: &System, component: &Component, reads: bool) -> Vec<String> {
    let (read, written) = ends(component);
    let mut names = Vec::new();
    let written = system.one_of_each_drawn(written.into_iter().map(|(channel, _)| channel));
    for index in if reads { read } else { written } {
        let channel = &system.channels[index];
        names.push(channel.drawn.clone());
        if reads {
            names.push(is_new(&channel.drawn));
        }
    }
    let devices = system.devices.iter().filter(|device| device.is_sensor == reads && device.message.is_some());
    names.extend(devices.map(|device| device.name.clone()));
    names
}

fn unfed(system: &System, machine: &ComponentMachine, function: &Function, at: Span) -> Diagnostic {
    let component = &system.components[machine.component];
    let why = reason(system, component, &function.name, true);
    fault::unfed(at, &function.name, why, &offered(system, component, true), label(machine, function))
}

fn untaken(system: &System, machine: &ComponentMachine, function: &Function, at: Span) -> Diagnostic {
    let component = &system.components[machine.component];
    let why = reason(system, component, &function.name, false);
    fault::untaken(at, &function.name, why, &offered(system, component, false), label(machine, function))
}

fn misfit(
    system: &System,
    machine: &ComponentMachine,
    function: &Function,
    types: &Types,
    feed: Feed,
    at: Span,
) -> Option<Diagnostic> {
    let name = match feed {
        Feed::Channel(index) => &system.channels[index].drawn,
        Feed::Sensor(index) => &system.devices[index].name,
        Feed::IsNew(_) if function.codomain == Domains::BOOLEAN => return None,
        Feed::IsNew(_) => {
            let domain = machine.model().domains.display(function.codomain);
            return Some(fault::misfit(at, &function.name, &domain, "Boolean", label(machine, function), None));
        }
    };
    let carried = &types[name];
    if carried.feeds(&Identity::of(&machine.checked, function.codomain)) {
        return None;
    }
    let domain = machine.model().domains.display(function.codomain);
    Some(fault::misfit(
        at,
        &function.name,
        &domain,
        &carried.named.text,
        label(machine, function),
        Some(carried.named.span),
    ))
}

fn unfit(
    system: &System,
    machine: &ComponentMachine,
    function: &Function,
    types: &Types,
    take: Take,
    at: Span,
) -> Option<Diagnostic> {
    let name = match take {
        Take::Channel(index) => &system.channels[index].drawn,
        Take::Actuator(index) => &system.devices[index].name,
    };
    let carried = &types[name];
    if carried.takes(&Identity::of(&machine.checked, function.codomain)) {
        return None;
    }
    let domain = machine.model().domains.display(function.codomain);
    Some(fault::misfit(
        at,
        &function.name,
        &domain,
        &carried.named.text,
        label(machine, function),
        Some(carried.named.span),
    ))
}

/// Whether some rule of the machine's file updates the function of that name.
fn updates(machine: &ComponentMachine, function: &str) -> bool {
    let root = machine.model().root;
    let text = &machine.checked.sources.file(root).text;
    let Some(tree) = ast::SourceFile::cast(syntax::parse_asmetal(root, text).syntax()) else { return false };
    let first = |node: &syntax::SyntaxNode| {
        let mut tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
        tokens.find(|token| !token.kind().is_trivia()).is_some_and(|token| token.text() == function)
    };
    tree.syntax().descendants().any(|node| node.kind() == SyntaxKind::UPDATE_RULE && first(&node))
}

/// Two machines that set one actuator.
pub(super) fn doubled(system: &System, machines: &[ComponentMachine]) -> Vec<Diagnostic> {
    let mut faults = Vec::new();
    let place = |machine: &ComponentMachine| {
        let component = &system.components[machine.component];
        component.phases[machine.phase].machine.as_ref().map_or(component.span, |named| named.span)
    };
    for (index, machine) in machines.iter().enumerate() {
        for (_, take) in &machine.takes {
            let Take::Actuator(actuator) = take else { continue };
            let first = machines[..index].iter().find(|other| other.takes.iter().any(|(_, other)| other == take));
            if let Some(first) = first {
                faults.push(fault::set_twice(place(machine), &system.devices[*actuator].name, place(first)));
            }
        }
    }
    faults
}
