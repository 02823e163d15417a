//! Scene → picture by the layered algorithm of the Eclipse Layout Kernel.
//!
//! In: a [`Scene`]. Out: a [`Picture`]. The graph is handed over as ELK's JSON, the form that its other implementations
//! read too. Arrows come in from above; a guard's `yes` goes on below and its `no` to the right, at the hexagon's corner,
//! so the straight way is the way of yes. Where `no` leads back to the left, it may leave there. Equal scenes give equal pictures: the library's random seed is fixed.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use crate::picture::{Figure, Label, Line, Picture, Placed};
use crate::scene::{Edge, FRAME, Node, Scene, branch_size, frame_top, link_size};

/// The layout library refused a graph: our bug or its own.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LayoutFault(pub String);

impl std::fmt::Display for LayoutFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the layout failed: {}", self.0)
    }
}

impl std::error::Error for LayoutFault {}

/// The stack for a layout: enough for some ten thousand shapes in a row.
const STACK_BYTES: usize = 128 << 20;

/// From so many shapes on the layout is the coarser one.
pub const LARGE: usize = 120;

/// The scene with everything in its place.
pub fn placed(scene: &Scene) -> Result<Picture, LayoutFault> {
    if scene.nodes.is_empty() {
        return Ok(Picture { width: 40.0, height: 40.0, ..Picture::default() });
    }
    let mut best = laid_out(scene, &BTreeSet::new())?;
    // Where `no` leads back on the left, it crosses what leads down to its guard: that one is turned, unless more arrows cross then.
    let mut turned = BTreeSet::new();
    for guard in back_to_the_left(&best).into_iter().take(TURNED) {
        let tried = turned.iter().copied().chain([guard]).collect();
        let other = laid_out(scene, &tried)?;
        let fewer = back_to_the_left(&other).len() < back_to_the_left(&best).len();
        if fewer && crossings(&other).len() <= crossings(&best).len() {
            (best, turned) = (other, tried);
        }
    }
    Ok(best)
}

/// LIMIT: so many guards are tried; each costs a layout.
const TURNED: usize = 4;

/// The layout in which the `no` of these guards leaves at the left.
fn laid_out(scene: &Scene, turned: &BTreeSet<usize>) -> Result<Picture, LayoutFault> {
    let graph = graph(scene, turned).to_string();
    // The library walks graphs by recursion, as deep as they are long.
    let answer = stacker::grow(STACK_BYTES, || elkrs::create_elk().layout_json(&graph));
    let answer = answer.map_err(|error| LayoutFault(error.to_string()))?;
    Ok(picture(scene, &answer))
}

/// The guards whose `no` leaves at the right, leads to the left of them, and crosses an arrow.
fn back_to_the_left(picture: &Picture) -> BTreeSet<usize> {
    let crossed: BTreeSet<usize> = crossings(picture).into_iter().flat_map(|(one, other)| [one, other]).collect();
    let comes_back = |line: &Line| {
        let guard = &picture.boxes[line.from];
        let starts_right = line.points.first().is_some_and(|start| start.0 > guard.x + guard.width / 2.0);
        line.branch == Some(false) && starts_right && line.points.iter().any(|point| point.0 < guard.x)
    };
    let lines = picture.lines.iter().enumerate();
    lines.filter(|(index, line)| crossed.contains(index) && comes_back(line)).map(|(_, line)| line.from).collect()
}

/// The pairs of arrows that cross, once for each crossing. Those with the same end may run together.
fn crossings(picture: &Picture) -> Vec<(usize, usize)> {
    // LIMIT: of a larger picture no crossings are looked for.
    if picture.boxes.len() > LARGE {
        return Vec::new();
    }
    let inner = |at: f64, one: f64, other: f64| one.min(other) < at && at < one.max(other);
    let crosses = |a: &[(f64, f64)], b: &[(f64, f64)]| {
        let ((ax, ay), (bx, by)) = ((a[0], a[1]), (b[0], b[1]));
        let upright = |from: (f64, f64), to: (f64, f64)| from.0 == to.0;
        match (upright(ax, ay), upright(bx, by)) {
            (true, false) => inner(ax.0, bx.0, by.0) && inner(bx.1, ax.1, ay.1),
            (false, true) => inner(bx.0, ax.0, ay.0) && inner(ax.1, bx.1, by.1),
            _ => false,
        }
    };
    let mut found = Vec::new();
    for (one, line) in picture.lines.iter().enumerate() {
        for (other, second) in picture.lines.iter().enumerate().skip(one + 1) {
            let each = line.points.windows(2).flat_map(|a| second.points.windows(2).map(move |b| (a, b)));
            found.extend(each.filter(|(a, b)| crosses(a, b)).map(|_| (one, other)));
        }
    }
    found
}

fn graph(scene: &Scene, turned: &BTreeSet<usize>) -> Value {
    let nested = scene.nodes.iter().any(|node| node.inside.is_some());
    let is_composite = |index: usize| scene.nodes[index].figure == Figure::Composite;
    let edges: Vec<Value> = scene
        .edges
        .iter()
        .enumerate()
        .map(|(index, edge)| {
            let from = match edge.branch {
                _ if scene.free => edge.from.to_string(),
                Some(true) => format!("{}yes", edge.from),
                Some(false) => format!("{}no", edge.from),
                None if is_composite(edge.from) => edge.from.to_string(),
                None => format!("{}out", edge.from),
            };
            let straightness = if edge.branch == Some(false) { "1" } else { "10" };
            let to = if scene.free || is_composite(edge.to) { edge.to.to_string() } else { format!("{}in", edge.to) };
            let (from, to) = if leads_back(scene, edge) { (to, from) } else { (from, to) };
            json!({
                "id": format!("e{index}"), "sources": [from], "targets": [to],
                "layoutOptions": { "elk.layered.priority.straightness": straightness },
            })
        })
        .collect();
    // The finer placement takes time with the cube of the size.
    let large = scene.nodes.len() > LARGE;
    json!({
        "id": "root",
        "layoutOptions": {
            "elk.algorithm": "layered",
            "elk.direction": "DOWN",
            "elk.randomSeed": "1",
            "elk.edgeRouting": "ORTHOGONAL",
            "elk.layered.cycleBreaking.strategy": "DEPTH_FIRST",
            "elk.layered.considerModelOrder.strategy": "PREFER_NODES",
            "elk.layered.nodePlacement.strategy": if large { "BRANDES_KOEPF" } else { "NETWORK_SIMPLEX" },
            "elk.layered.nodePlacement.favorStraightEdges": "true",
            "elk.layered.thoroughness": if large { "3" } else { "20" },
            "elk.spacing.nodeNode": "34",
            "elk.spacing.edgeNode": "20",
            "elk.spacing.edgeEdge": "14",
            "elk.spacing.labelNode": "5",
            "elk.spacing.labelPortHorizontal": "3",
            "elk.spacing.labelPortVertical": "3",
            "elk.spacing.componentComponent": "44",
            "elk.layered.spacing.nodeNodeBetweenLayers": "30",
            "elk.layered.spacing.edgeNodeBetweenLayers": "16",
            "elk.layered.spacing.edgeEdgeBetweenLayers": "12",
            "elk.padding": "[top=20,left=20,bottom=20,right=20]",
            "elk.hierarchyHandling": if nested { "INCLUDE_CHILDREN" } else { "INHERIT" },
        },
        "children": children(scene, None, turned),
        "edges": edges,
    })
}

/// Whether an arrow leads back to the state with which the composite state begins that both its ends are in. The library is given it
/// the other way round, so that this state comes to lie above what follows it.
fn leads_back(scene: &Scene, edge: &Edge) -> bool {
    let to = &scene.nodes[edge.to];
    let around = |index: usize| std::iter::successors(scene.nodes[index].inside, |outer| scene.nodes[*outer].inside);
    let inside = to.inside.is_some_and(|composite| around(edge.from).any(|outer| outer == composite));
    to.initial && inside && edge.from != edge.to
}

/// The shapes in a composite state; without one, those in none.
fn children(scene: &Scene, around: Option<usize>, turned: &BTreeSet<usize>) -> Vec<Value> {
    let here = scene.nodes.iter().enumerate().filter(|(_, node)| node.inside == around);
    here.map(|(index, node)| match node.figure {
        Figure::Composite => json!({
            "id": index.to_string(), "children": children(scene, Some(index), turned),
            "layoutOptions": {
                "elk.padding": format!("[top={},left={FRAME},bottom={FRAME},right={FRAME}]", frame_top(node.details.len())),
                "elk.nodeSize.constraints": "[MINIMUM_SIZE]",
                "elk.nodeSize.minimum": format!("({},{})", node.width, node.height),
            },
        }),
        _ => shape(index, node, forks(scene, index), scene.free, turned.contains(&index)),
    })
    .collect()
}

/// Whether the arrows out of a shape say yes or no: it is a guard, or the block of a pattern that answers.
fn forks(scene: &Scene, index: usize) -> bool {
    let answers = |edge: &Edge| edge.from == index && edge.branch.is_some();
    scene.nodes[index].figure == Figure::Hexagon || scene.edges.iter().any(answers)
}

/// A shape with the places where arrows meet it.
fn shape(index: usize, node: &Node, forks: bool, free: bool, turned: bool) -> Value {
    let (width, height) = (node.width, node.height);
    if free {
        return json!({ "id": index.to_string(), "width": width, "height": height });
    }
    let port = |name: &str, side: &str, x: f64, y: f64, label: Option<bool>| {
        let labels: Vec<Value> = label
            .into_iter()
            .map(|branch| {
                let (width, height) = branch_size(branch);
                json!({ "text": if branch { "yes" } else { "no" }, "width": width, "height": height })
            })
            .collect();
        json!({
            "id": format!("{index}{name}"), "x": x, "y": y, "width": 0, "height": 0, "labels": labels,
            "layoutOptions": { "elk.port.side": side, "elk.port.borderOffset": "0" },
        })
    };
    let mut ports = vec![port("in", "NORTH", width / 2.0, 0.0, None)];
    if forks {
        ports.push(port("yes", "SOUTH", width / 2.0, height, Some(true)));
        let (side, x) = if turned { ("WEST", 0.0) } else { ("EAST", width) };
        ports.push(port("no", side, x, height / 2.0, Some(false)));
    } else {
        ports.push(port("out", "SOUTH", width / 2.0, height, None));
    }
    let labels: Vec<Value> = node
        .link
        .iter()
        .map(|link| {
            let (width, height) = link_size(link);
            json!({ "text": link, "width": width, "height": height })
        })
        .collect();
    let side = if forks && !turned { "H_LEFT" } else { "H_RIGHT" };
    json!({
        "id": index.to_string(), "width": width, "height": height, "ports": ports, "labels": labels,
        "layoutOptions": {
            "elk.portConstraints": "FIXED_POS",
            "elk.portLabels.placement": "[OUTSIDE]",
            "elk.nodeLabels.placement": format!("[OUTSIDE, V_CENTER, {side}]"),
        },
    })
}

fn number(value: &Value, key: &str) -> f64 {
    value.get(key).and_then(Value::as_f64).unwrap_or_default()
}

fn list<'v>(value: &'v Value, key: &str) -> impl Iterator<Item = &'v Value> {
    value.get(key).and_then(Value::as_array).into_iter().flatten()
}

fn picture(scene: &Scene, answer: &Value) -> Picture {
    let mut picture =
        Picture { width: number(answer, "width"), height: number(answer, "height"), ..Picture::default() };
    let mut found = Answer::default();
    found.within(answer, (0.0, 0.0));
    for (index, node) in scene.nodes.iter().enumerate() {
        let Some((child, (x, y))) = found.nodes.get(&index).copied() else { continue };
        let mut placed = shape_at(node, (x + node.width / 2.0, y + node.height / 2.0));
        if node.figure == Figure::Composite {
            (placed.width, placed.height) = (number(child, "width"), number(child, "height"));
        }
        picture.boxes.push(placed);
        picture.labels.extend(list(child, "labels").map(|given| label(given, index, x, y, true)));
        for port in list(child, "ports") {
            let leads = |edge: &&Edge| {
                let name = port.get("id").and_then(Value::as_str).unwrap_or_default();
                edge.from == index && name.ends_with(if edge.branch == Some(true) { "yes" } else { "no" })
            };
            if scene.edges.iter().any(|edge| leads(&edge)) {
                let (x, y) = (x + number(port, "x"), y + number(port, "y"));
                picture.labels.extend(list(port, "labels").map(|given| label(given, index, x, y, false)));
            }
        }
    }
    for (index, edge) in scene.edges.iter().enumerate() {
        let Some((given, (left, top))) = found.edges.get(&index).copied() else { continue };
        let mut points = Vec::new();
        for section in list(given, "sections") {
            let corner = |value: &Value| (left + number(value, "x"), top + number(value, "y"));
            points.extend(section.get("startPoint").map(corner));
            points.extend(list(section, "bendPoints").map(corner));
            points.extend(section.get("endPoint").map(corner));
        }
        if leads_back(scene, edge) {
            points.reverse();
        }
        picture.lines.push(line(edge, points));
    }
    picture
}

/// What the library answers of each shape and each arrow, by number. A shape stands with the place of its left upper corner in the
/// whole; an arrow, which the library puts into the innermost shape that holds both its ends, with the place of that one's.
#[derive(Default)]
struct Answer<'v> {
    nodes: BTreeMap<usize, (&'v Value, (f64, f64))>,
    edges: BTreeMap<usize, (&'v Value, (f64, f64))>,
}

impl<'v> Answer<'v> {
    fn within(&mut self, of: &'v Value, (left, top): (f64, f64)) {
        let id = |value: &'v Value| value.get("id").and_then(Value::as_str);
        for edge in list(of, "edges") {
            let index = id(edge).and_then(|id| id.trim_start_matches('e').parse().ok());
            self.edges.extend(index.map(|index: usize| (index, (edge, (left, top)))));
        }
        for child in list(of, "children") {
            let place = (left + number(child, "x"), top + number(child, "y"));
            let index = id(child).and_then(|id| id.parse().ok());
            self.nodes.extend(index.map(|index: usize| (index, (child, place))));
            self.within(child, place);
        }
    }
}

/// The shape of a node with its centre there.
pub fn shape_at(node: &Node, (x, y): (f64, f64)) -> Placed {
    Placed {
        id: node.id.clone(),
        figure: node.figure,
        dashed: node.dashed,
        named: node.named,
        initial: node.initial,
        lines: node.lines.clone(),
        details: node.details.clone(),
        x: x - node.width / 2.0,
        y: y - node.height / 2.0,
        width: node.width,
        height: node.height,
        inside: node.inside,
    }
}

/// The arrow of an edge.
pub fn line(edge: &Edge, points: Vec<(f64, f64)>) -> Line {
    Line { from: edge.from, to: edge.to, branch: edge.branch, points: straightened(points) }
}

fn label(given: &Value, of: usize, x: f64, y: f64, is_link: bool) -> Label {
    Label {
        of,
        text: given.get("text").and_then(Value::as_str).unwrap_or_default().to_string(),
        is_link,
        x: x + number(given, "x"),
        y: y + number(given, "y"),
        width: number(given, "width"),
        height: number(given, "height"),
    }
}

/// Without corners at which the line goes straight on.
fn straightened(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let mut out: Vec<(f64, f64)> = Vec::new();
    for point in points {
        while let [.., before, last] = out[..] {
            let upright = before.0 == last.0 && last.0 == point.0;
            let level = before.1 == last.1 && last.1 == point.1;
            if !(upright || level) {
                break;
            }
            out.pop();
        }
        if out.last() != Some(&point) {
            out.push(point);
        }
    }
    out
}
