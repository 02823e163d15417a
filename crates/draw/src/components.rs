//! A system as a component diagram, before anything has a place: components with their phases, channels as components of
//! their own between them, as in the paper's Figures 1 and 2, and devices.

use chart::Layout;
use chart::system::{Action, Component, Device, System};

use crate::measure::{LEADING, RULE, SMALL, SMALL_LEADING, TEXT, bold_width, extent, text_width, wrapped};
use crate::picture::{Detail, Figure};
use crate::scene::{Edge, Node, Scene};
use crate::words;

/// The scene of a system; its shapes have the places of `layout`, as far as it has any.
pub fn of_system(system: &System, layout: Option<&Layout>) -> Scene {
    let mut scene = Scene { free: true, ..Scene::default() };
    let devices = |sensors: bool| system.devices.iter().filter(move |device| device.is_sensor == sensors);
    for device in devices(true) {
        scene.nodes.push(node(&device.name, Figure::Device, &device.text, vec![plain(&carrying("sensor", device))]));
    }
    for component in &system.components {
        scene.nodes.push(node(&component.name, Figure::Component, &component.text, about(component, system)));
    }
    for channels in system.drawn_channels() {
        let channel = &channels[0];
        let mut small: Vec<Detail> = channel.message.iter().map(|message| plain(&message.text)).collect();
        small.push(plain(&words::channel(channel.kind)));
        if channels.len() > 1 {
            small.push(plain("one for each reader"));
        }
        small.extend(words::masters(system, channels).iter().map(|master| plain(master)));
        scene.nodes.push(node(&channel.drawn, Figure::Channel, &channel.drawn, small));
    }
    for device in devices(false) {
        scene.nodes.push(node(&device.name, Figure::Device, &device.text, vec![plain(&carrying("actuator", device))]));
    }
    let place = |name: &str| scene.nodes.iter().position(|node| node.id == name);
    let component = |index: usize| place(&system.components[index].name);
    let ways = system.drawn_channels().flat_map(|channels| {
        let middle = place(&channels[0].drawn);
        let read = channels.iter().map(move |channel| (middle, component(channel.to)));
        std::iter::once((component(channels[0].from), middle)).chain(read)
    });
    let links = system.connections.iter().map(|(from, to)| (place(from), place(to)));
    let edges = ways.chain(links).filter_map(|(from, to)| Some(Edge { from: from?, branch: None, to: to? })).collect();
    scene.edges = edges;
    for node in &mut scene.nodes {
        node.place = layout.and_then(|places| places.get(&node.id)).copied();
    }
    scene
}

/// What a device is, and of which domain its values are.
fn carrying(kind: &str, device: &Device) -> String {
    device.message.as_ref().map_or(kind.to_string(), |message| format!("{kind}: {}", message.text))
}

fn plain(text: &str) -> Detail {
    Detail { id: None, text: text.to_string(), right: None }
}

/// When a component runs, and its phases.
fn about(component: &Component, system: &System) -> Vec<Detail> {
    let mut lines = vec![plain(&words::timing(component, system))];
    let drawn = component.phases.chunk_by(|one, next| one.drawn == next.drawn);
    for (phase, times) in drawn.map(|phases| (&phases[0], phases.len())) {
        let what = match phase.action {
            Action::Read(channel) => format!("read {}", system.channels[channel].drawn),
            Action::Write(channel) => format!("write {}", system.channels[channel].drawn),
            Action::Elaborate(_) => {
                let machine = phase.machine.as_ref().map_or(String::new(), |machine| format!(" by {}", machine.text));
                format!("elaborate {}{machine}", phase.subject)
            }
        };
        let id = Some(format!("{}/{}", component.name, phase.drawn));
        let time = words::duration(phase, system.tick_ns);
        let time = if times > 1 { format!("{times} \u{d7} {time}") } else { time };
        lines.push(Detail { id, text: what, right: Some(time) });
        if let Some(bound) = phase.fresh {
            lines.push(plain(&format!("new every {}", words::time(bound.limit, system.tick_ns))));
        }
    }
    lines
}

/// Between the two texts of a line.
const GAP: f64 = 18.0;

fn node(name: &str, figure: Figure, text: &str, details: Vec<Detail>) -> Node {
    let lines = wrapped(text, 180.0);
    let (_, height) = extent(&lines);
    // The sign of a component stands beside its name.
    let sign = if figure == Figure::Component { 20.0 } else { 0.0 };
    let width = lines.iter().map(|line| bold_width(line, TEXT) + 2.0 * sign).fold(0.0, f64::max);
    let wide = |detail: &Detail| {
        let right = detail.right.as_ref().map_or(0.0, |right| text_width(right, SMALL) + GAP);
        text_width(&detail.text, SMALL) + right
    };
    let wide = details.iter().map(wide).fold(width, f64::max);
    let rule = if details.iter().any(|detail| detail.right.is_some()) { RULE } else { 0.0 };
    let height = height + details.len() as f64 * SMALL_LEADING + rule + 16.0;
    let margin = if figure == Figure::Channel { 36.0 } else { 28.0 };
    Node {
        id: name.to_string(),
        figure,
        dashed: false,
        named: false,
        lines,
        details,
        link: None,
        width: 2.0 * ((wide + margin).max(90.0) / 2.0).ceil(),
        height: 2.0 * (height.max(LEADING + 20.0) / 2.0).ceil(),
        place: None,
        initial: false,
        inside: None,
    }
}
