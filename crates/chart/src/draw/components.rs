//! A system as a component diagram, before anything has a place: components with their phases, channels as components of
//! their own between them, as in the paper's Figures 1 and 2, and devices.

use super::notation::{LEADING, SMALL, extent, text_width, wrapped};
use super::picture::Figure;
use super::scene::{Edge, Node, Scene};
use super::words;
use crate::system::{Action, ChannelKind, Component, System};

/// From one small line to the next.
pub(super) const SMALL_LEADING: f64 = 14.0;

/// The scene of a system.
pub(super) fn of_system(system: &System) -> Scene {
    let mut scene = Scene { free: true, ..Scene::default() };
    let devices = |sensors: bool| system.devices.iter().filter(move |device| device.is_sensor == sensors);
    for device in devices(true) {
        scene.nodes.push(node(&device.name, Figure::Device, &device.text, vec!["sensor".to_string()]));
    }
    for component in &system.components {
        scene.nodes.push(node(&component.name, Figure::Component, &component.text, about(component, system)));
    }
    for channel in &system.channels {
        let mut small = vec![words::channel(channel.kind)];
        if let ChannelKind::Buffer { master, .. } = channel.kind {
            small.push(format!("master: {}", system.components[master].text));
        }
        scene.nodes.push(node(&channel.name, Figure::Channel, &channel.name, small));
    }
    for device in devices(false) {
        scene.nodes.push(node(&device.name, Figure::Device, &device.text, vec!["actuator".to_string()]));
    }
    let place = |name: &str| scene.nodes.iter().position(|node| node.id == name);
    let component = |index: usize| place(&system.components[index].name);
    let ways = system.channels.iter().flat_map(|channel| {
        let middle = place(&channel.name);
        [(component(channel.from), middle), (middle, component(channel.to))]
    });
    let links = system.connections.iter().map(|(from, to)| (place(from), place(to)));
    let edges = ways.chain(links).filter_map(|(from, to)| Some(Edge { from: from?, branch: None, to: to? })).collect();
    scene.edges = edges;
    scene
}

/// When a component runs, and its phases.
fn about(component: &Component, system: &System) -> Vec<String> {
    let mut lines = vec![words::timing(component.timing, system.tick_ns)];
    for phase in &component.phases {
        let what = match phase.action {
            Action::Read(channel) => format!("read {}", system.channels[channel].name),
            Action::Write(channel) => format!("write {}", system.channels[channel].name),
            Action::Elaborate(_) => "elaborate".to_string(),
        };
        lines.push(format!("{what}, {}", words::time(phase.time, system.tick_ns)));
    }
    lines
}

fn node(name: &str, figure: Figure, text: &str, small: Vec<String>) -> Node {
    let lines = wrapped(text, 180.0);
    let (width, height) = extent(&lines);
    let wide = small.iter().map(|line| text_width(line, SMALL)).fold(width, f64::max);
    let height = height + small.len() as f64 * SMALL_LEADING + 16.0;
    Node {
        id: name.to_string(),
        figure,
        dashed: false,
        lines,
        small,
        link: None,
        width: 2.0 * ((wide + 36.0).max(90.0) / 2.0).ceil(),
        height: 2.0 * (height.max(LEADING + 20.0) / 2.0).ceil(),
        initial: false,
    }
}
