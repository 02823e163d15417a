//! Scene → picture where the chart says where shapes lie.
//!
//! In: a scene some of whose shapes have a place. Out: a picture in which these lie exactly there. A shape without a place
//! comes to lie beside the shapes it hangs together with, as ELK would have it, at the nearest spot that is free; no other
//! moves for it. The exits of a guard are turned towards what they lead to, links stand where there is room, and arrows
//! are routed around all of it. What lies as ELK has it keeps ELK's arrows (`kept`).
//!
//! Where the given places overlap, so do the shapes: the eye of who places them decides.

use crate::elk::{self, LayoutFault};
use crate::kept::Kept;
use crate::picture::{Figure, Label, Picture, Placed};
use crate::route::{Area, Port, Router, Side, Wire};
use crate::scene::{Edge, FRAME, Node, Scene, branch_size, frame_top, link_size};

/// Around everything.
const PADDING: f64 = 20.0;
/// LIMIT: what is placed farther out is drawn here.
const FAR: f64 = 1e6;
/// Between shapes where one is free to lie.
const APART: f64 = 24.0;

/// The scene with everything in its place.
pub fn placed(scene: &Scene) -> Result<Picture, LayoutFault> {
    let unplaced = |node: &Node| node.place.is_none() && node.figure != Figure::Composite;
    let small = scene.nodes.len() <= elk::LARGE;
    let ideal = if small || scene.nodes.iter().any(unplaced) { Some(elk::placed(scene)?) } else { None };
    let centres = centres(scene, ideal.as_ref());
    let kept = match ideal {
        Some(ideal) if small => Kept::new(scene, ideal, &centres),
        _ => Kept::nothing(scene),
    };
    let picture = arranged(scene, &centres, &kept);
    // What stays is no gain where a text of what was moved comes to lie on it.
    Ok(if is_clean(&picture) { picture } else { arranged(scene, &centres, &Kept::nothing(scene)) })
}

/// Whether no label lies on another one or on an arrow.
fn is_clean(picture: &Picture) -> bool {
    let labels: Vec<Area> = picture.labels.iter().map(of_label).collect();
    let stretches = picture.lines.iter().flat_map(|line| line.points.windows(2)).map(|pair| {
        let ((ax, ay), (bx, by)) = (pair[0], pair[1]);
        (ax.min(bx) - 1.0, ay.min(by) - 1.0, ax.max(bx) + 1.0, ay.max(by) + 1.0)
    });
    let others = stretches.collect::<Vec<_>>();
    labels
        .iter()
        .enumerate()
        .all(|(index, label)| labels[index + 1..].iter().chain(&others).all(|other| overlap(*label, *other) == 0.0))
}

/// The shapes at these places, with their arrows and labels.
fn arranged(scene: &Scene, centres: &[(f64, f64)], kept: &Kept) -> Picture {
    let mut boxes: Vec<Placed> =
        scene.nodes.iter().zip(centres).map(|(node, centre)| elk::shape_at(node, *centre)).collect();
    let known: Vec<Option<(f64, f64)>> = centres.iter().copied().map(Some).collect();
    for (index, node) in scene.nodes.iter().enumerate().filter(|(_, node)| node.figure == Figure::Composite) {
        let (left, upper, right, lower) = frame(scene, &known, index).unwrap_or_default();
        let (width, height) = ((right - left).max(node.width), (lower - upper).max(node.height));
        boxes[index] = Placed { x: left, y: upper, width, height, ..boxes[index].clone() };
        if let Some(frame) = kept.frame(index) {
            boxes[index] = frame.clone();
        }
    }
    if let Some(picture) = kept.whole(&boxes) {
        return picture;
    }
    let ways = kept.ways(scene.edges.len(), &boxes);
    // A guard one of whose arrows stays is turned as ELK has it.
    let is_kept = |index: usize| scene.edges.iter().zip(&ways).any(|(edge, way)| edge.from == index && way.is_some());
    let mut exits = exits(scene, centres);
    for (edge, side) in scene.edges.iter().zip(&mut exits) {
        if let (Some(branch), true) = (edge.branch, is_kept(edge.from)) {
            *side = Some(kept.exit(edge.from, branch));
        }
    }
    let mut labels = Vec::new();
    for (edge, side) in scene.edges.iter().zip(&exits) {
        if let (Some(branch), Some(side)) = (edge.branch, side) {
            labels.push(branch_label(edge.from, &boxes[edge.from], branch, *side));
        }
    }
    for (index, node) in scene.nodes.iter().enumerate() {
        let Some(link) = &node.link else { continue };
        if let Some(label) = kept.link(index, &boxes) {
            labels.push(label);
            continue;
        }
        let turned = |side: Side| scene.edges.iter().zip(&exits).any(|(e, s)| e.from == index && *s == Some(side));
        labels.push(link_label(index, link, &boxes, &labels, turned));
    }
    let wires: Vec<Wire> = scene
        .edges
        .iter()
        .zip(&exits)
        .enumerate()
        .map(|(index, (edge, side))| Wire {
            // Arrows of a system have ends of their own.
            from: if scene.free { index } else { edge.from * 3 + edge.branch.map_or(0, |yes| 1 + usize::from(yes)) },
            to: if scene.free { index } else { edge.to },
            start: starts(scene, &boxes[edge.from], *side),
            end: ends(scene, edge, &boxes[edge.to], &exits),
        })
        .collect();
    let routes = Router::new(
        &boxes.iter().map(in_the_way).collect::<Vec<_>>(),
        &labels.iter().map(of_label).collect::<Vec<_>>(),
        &wires,
        ways,
    )
    .routes();
    let lines = scene.edges.iter().zip(routes).map(|(edge, points)| elk::line(edge, points)).collect();
    let mut picture = Picture { boxes, lines, labels, ..Picture::default() };
    bound(&mut picture);
    picture
}

fn area(shape: &Placed) -> Area {
    (shape.x, shape.y, shape.x + shape.width, shape.y + shape.height)
}

/// What arrows lead around: not the frame of a composite state.
fn in_the_way(shape: &Placed) -> Area {
    match shape.figure {
        Figure::Composite => (shape.x, shape.y, shape.x, shape.y),
        _ => area(shape),
    }
}

/// The frame of a composite state around what lies in it; `None` if nothing in it has a place yet.
fn frame(scene: &Scene, centres: &[Option<(f64, f64)>], composite: usize) -> Option<Area> {
    let inner = scene.nodes.iter().enumerate().filter(|(_, node)| node.inside == Some(composite));
    let areas = inner.filter_map(|(index, node)| match node.figure {
        Figure::Composite => frame(scene, centres, index),
        _ => Some(footprint(node, centres[index]?)),
    });
    let whole = areas.reduce(|a, b| (a.0.min(b.0), a.1.min(b.1), a.2.max(b.2), a.3.max(b.3)))?;
    let node = &scene.nodes[composite];
    let right = (whole.2 + FRAME).max(whole.0 - FRAME + node.width);
    Some((whole.0 - FRAME, whole.1 - frame_top(node.details.len()), right, whole.3 + FRAME))
}

fn of_label(label: &Label) -> Area {
    (label.x, label.y, label.x + label.width, label.y + label.height)
}

fn within(inner: Area, outer: Area) -> bool {
    inner.0 >= outer.0 && inner.1 >= outer.1 && inner.2 <= outer.2 && inner.3 <= outer.3
}

fn overlap(a: Area, b: Area) -> f64 {
    (a.2.min(b.2) - a.0.max(b.0)).max(0.0) * (a.3.min(b.3) - a.1.max(b.1)).max(0.0)
}

/// What a shape takes up with its link beside it.
fn footprint(node: &Node, (x, y): (f64, f64)) -> Area {
    let link = node.link.as_ref().map_or(0.0, |link| link_size(link).0 + 5.0);
    let (left, right) = if node.figure == Figure::Hexagon { (link, 0.0) } else { (0.0, link) };
    (x - node.width / 2.0 - left, y - node.height / 2.0, x + node.width / 2.0 + right, y + node.height / 2.0)
}

/// The centre of each shape: the one it has, or a free one.
fn centres(scene: &Scene, ideal: Option<&Picture>) -> Vec<(f64, f64)> {
    let within = |(x, y): (f64, f64)| (x.clamp(-FAR, FAR), y.clamp(-FAR, FAR));
    let is_composite = |index: usize| scene.nodes[index].figure == Figure::Composite;
    // A composite state has no place of its own.
    let given = |node: &Node| if node.figure == Figure::Composite { Some((0.0, 0.0)) } else { node.place.map(within) };
    let mut centres: Vec<Option<(f64, f64)>> = scene.nodes.iter().map(given).collect();
    if let Some(ideal) = ideal.filter(|_| centres.iter().any(Option::is_none)) {
        let ideal: Vec<(f64, f64)> =
            ideal.boxes.iter().map(|shape| (shape.x + shape.width / 2.0, shape.y + shape.height / 2.0)).collect();
        let placed = |centres: &[Option<(f64, f64)>], index: usize| -> Vec<usize> {
            let of = |edge: &Edge| match index {
                _ if edge.from == index => Some(edge.to),
                _ if edge.to == index => Some(edge.from),
                _ => None,
            };
            let known = |other: &usize| centres[*other].is_some() && !is_composite(*other);
            scene.edges.iter().filter_map(of).filter(known).collect()
        };
        while let Some(first) = centres.iter().position(Option::is_none) {
            let open = |index: &usize| centres[*index].is_none() && !placed(&centres, *index).is_empty();
            let index = (first..centres.len()).find(open).unwrap_or(first);
            let mut near = placed(&centres, index);
            if near.is_empty() {
                let distance =
                    |other: &usize| (ideal[*other].0 - ideal[index].0).hypot(ideal[*other].1 - ideal[index].1);
                let known = (0..centres.len()).filter(|other| centres[*other].is_some() && !is_composite(*other));
                near.extend(known.min_by(|a, b| distance(a).total_cmp(&distance(b))));
            }
            centres[index] = Some(free_spot(scene, &centres, index, wanted(&centres, &ideal, index, &near)));
        }
    }
    centres.into_iter().flatten().collect()
}

/// Where ELK would have the shape, seen from those of `near` in the middle of their places.
fn wanted(centres: &[Option<(f64, f64)>], ideal: &[(f64, f64)], index: usize, near: &[usize]) -> (f64, f64) {
    let from = |other: &usize| {
        let (x, y) = centres[*other].unwrap_or_default();
        (x + ideal[index].0 - ideal[*other].0, y + ideal[index].1 - ideal[*other].1)
    };
    // The first one alone: arrows to it are straight then.
    near.first().map_or(ideal[index], from)
}

/// The free spot nearest to the wanted one.
fn free_spot(scene: &Scene, centres: &[Option<(f64, f64)>], index: usize, wanted: (f64, f64)) -> (f64, f64) {
    let around: Vec<usize> =
        std::iter::successors(scene.nodes[index].inside, |outer| scene.nodes[*outer].inside).collect();
    let taken = |(other, node): (usize, &Node)| match node.figure {
        Figure::Composite if around.contains(&other) => None,
        Figure::Composite => frame(scene, centres, other),
        _ => Some(footprint(node, centres[other]?)),
    };
    let others: Vec<Area> = scene.nodes.iter().enumerate().filter_map(taken).collect();
    let floats = matches!(scene.nodes[index].figure, Figure::Enter | Figure::Exit);
    let apart = if floats { APART / 2.0 } else { APART };
    let free = |centre: (f64, f64)| {
        let own = footprint(&scene.nodes[index], centre);
        let own = (own.0 - apart, own.1 - apart, own.2 + apart, own.3 + apart);
        others.iter().all(|other| overlap(own, *other) == 0.0)
    };
    // The frames around it grow with it: they should not come to lie on what stands outside of them.
    let holds = |outer: usize, other: usize| {
        std::iter::successors(scene.nodes[other].inside, |next| scene.nodes[*next].inside).any(|next| next == outer)
    };
    let grows_well = |centre: (f64, f64)| {
        let mut centres = centres.to_vec();
        centres[index] = Some(centre);
        around.iter().all(|outer| {
            let Some(grown) = frame(scene, &centres, *outer) else { return true };
            let outside = (0..scene.nodes.len()).filter(|other| !holds(*outer, *other) && other != outer);
            let mut areas = outside.filter_map(|other| match scene.nodes[other].figure {
                Figure::Composite if around.contains(&other) => None,
                Figure::Composite => frame(scene, &centres, other),
                _ => Some(footprint(&scene.nodes[other], centres[other]?)),
            });
            areas.all(|area| overlap(grown, area) == 0.0)
        })
    };
    const STEP: f64 = 10.0;
    // Within so many rings a spot is looked for by which no frame comes to lie on anything; given places may allow none.
    const PICKY: i32 = 40;
    let wanted = (wanted.0.round(), wanted.1.round());
    let mut ring = 0;
    loop {
        // The ring of spots at this distance, those below and beside before those above.
        let mut spots: Vec<(i32, i32)> = Vec::new();
        for along in -ring..=ring {
            spots.extend([(along, ring), (ring, along), (-ring, along), (along, -ring)]);
        }
        spots.sort_by_key(|(x, y)| x * x + y * y);
        let spots = spots.iter().map(|(x, y)| (wanted.0 + f64::from(*x) * STEP, wanted.1 + f64::from(*y) * STEP));
        let picky = !around.is_empty() && ring < PICKY;
        if let Some(spot) = spots.into_iter().find(|spot| free(*spot) && (!picky || grows_well(*spot))) {
            return spot;
        }
        ring += 1;
    }
}

/// The side at which each edge out of a guard leaves: towards where it leads, `yes` rather below, `no` rather at the right.
fn exits(scene: &Scene, centres: &[(f64, f64)]) -> Vec<Option<Side>> {
    let away = |edge: &Edge, side: Side| {
        let (dx, dy) = (centres[edge.to].0 - centres[edge.from].0, centres[edge.to].1 - centres[edge.from].1);
        let (ux, uy) = side.out();
        let length = dx.hypot(dy).max(1.0);
        let habit = match (edge.branch, side) {
            (Some(true), Side::Below) | (Some(false), Side::Right) => 0.0,
            (_, Side::Above) => 0.9,
            (_, Side::Below) => 0.25,
            _ => 0.3,
        };
        habit - (dx * ux + dy * uy) / length
    };
    let mut sides = vec![None; scene.edges.len()];
    if scene.free {
        return sides;
    }
    for index in 0..scene.nodes.len() {
        let own: Vec<usize> =
            (0..sides.len()).filter(|e| scene.edges[*e].from == index && scene.edges[*e].branch.is_some()).collect();
        let best = |taken: Option<Side>, edge: usize| {
            let free = Side::ALL.into_iter().filter(|side| Some(*side) != taken);
            let cost = |side: &Side| away(&scene.edges[edge], *side);
            free.map(|side| (cost(&side), side)).min_by(|a, b| a.0.total_cmp(&b.0))
        };
        match own[..] {
            [one] => sides[one] = best(None, one).map(|(_, side)| side),
            [one, two] => {
                let pairs = Side::ALL.into_iter().filter_map(|first| {
                    let (cost, second) = best(Some(first), two)?;
                    Some((away(&scene.edges[one], first) + cost, first, second))
                });
                if let Some((_, first, second)) = pairs.min_by(|a, b| a.0.total_cmp(&b.0)) {
                    (sides[one], sides[two]) = (Some(first), Some(second));
                }
            }
            _ => {}
        }
    }
    sides
}

fn middle(shape: &Placed, side: Side) -> (f64, f64) {
    let (cx, cy) = (shape.x + shape.width / 2.0, shape.y + shape.height / 2.0);
    match side {
        Side::Above => (cx, shape.y),
        Side::Below => (cx, shape.y + shape.height),
        Side::Left => (shape.x, cy),
        Side::Right => (shape.x + shape.width, cy),
    }
}

fn branch_label(of: usize, shape: &Placed, branch: bool, side: Side) -> Label {
    let (width, height) = branch_size(branch);
    let (px, py) = middle(shape, side);
    let (x, y) = match side {
        Side::Below | Side::Right => (px + 3.0, py + 3.0),
        Side::Left => (px - 3.0 - width, py + 3.0),
        Side::Above => (px + 3.0, py - 3.0 - height),
    };
    Label { of, text: if branch { "yes" } else { "no" }.to_string(), is_link: false, x, y, width, height }
}

/// The label of a link at the first spot around its shape that is free.
fn link_label(of: usize, link: &str, boxes: &[Placed], labels: &[Label], turned: impl Fn(Side) -> bool) -> Label {
    let (width, height) = link_size(link);
    let (left, upper, right, lower) = area(&boxes[of]);
    let (cx, cy) = ((left + right) / 2.0, (upper + lower) / 2.0);
    let beside = |side: Side| match side {
        Side::Left => (left - 5.0 - width, cy - height / 2.0),
        _ => (right + 5.0, cy - height / 2.0),
    };
    let sides = if boxes[of].figure == Figure::Hexagon { [Side::Left, Side::Right] } else { [Side::Right, Side::Left] };
    let mut spots: Vec<(f64, f64)> = sides.into_iter().filter(|side| !turned(*side)).map(beside).collect();
    for y in [lower + 3.0, upper - 3.0 - height] {
        spots.extend([(cx + 26.0, y), (cx - 26.0 - width, y)]);
    }
    let crowded = |(x, y): (f64, f64)| {
        let own = (x - 2.0, y - 2.0, x + width + 2.0, y + height + 2.0);
        // The frame that the shape lies in leaves room for all that lies there.
        let around = |shape: &&Placed| shape.figure == Figure::Composite && within(area(&boxes[of]), area(shape));
        let others = boxes.iter().filter(|shape| !around(shape)).map(area).chain(labels.iter().map(of_label));
        others.map(|other| overlap(own, other)).sum::<f64>()
    };
    let best = spots.into_iter().min_by(|a, b| crowded(*a).total_cmp(&crowded(*b)));
    let (x, y) = best.unwrap_or_else(|| beside(Side::Right));
    Label { of, text: link.to_string(), is_link: true, x, y, width, height }
}

/// Where an edge may start.
fn starts(scene: &Scene, shape: &Placed, exit: Option<Side>) -> Vec<Port> {
    if scene.free {
        return around(shape, Side::Below);
    }
    let port = |side: Side, extra: f64| Port { at: middle(shape, side), side, extra };
    match (exit, shape.figure) {
        (Some(side), _) => vec![port(side, 0.0)],
        (None, Figure::Enter) => Side::ALL.into_iter().map(|side| port(side, 0.0)).collect(),
        _ => vec![port(Side::Below, 0.0), port(Side::Right, 30.0), port(Side::Left, 30.0), port(Side::Above, 80.0)],
    }
}

/// Where an edge may end: not where another leaves.
fn ends(scene: &Scene, edge: &Edge, shape: &Placed, exits: &[Option<Side>]) -> Vec<Port> {
    if scene.free {
        return around(shape, Side::Above);
    }
    let taken =
        |side: Side| scene.edges.iter().zip(exits).any(|(other, exit)| other.from == edge.to && *exit == Some(side));
    let extra = |side: Side| match side {
        _ if matches!(shape.figure, Figure::Enter | Figure::Exit) => 0.0,
        Side::Above => 0.0,
        Side::Below => 60.0,
        _ => 30.0,
    };
    let sides = Side::ALL.into_iter().filter(|side| !taken(*side));
    sides.map(|side| Port { at: middle(shape, side), side, extra: extra(side) }).collect()
}

/// Three places on each side, one of them rather than the others.
fn around(shape: &Placed, usual: Side) -> Vec<Port> {
    let mut ports = Vec::new();
    for side in Side::ALL {
        // The ends of a channel are round.
        let upright = matches!(side, Side::Left | Side::Right);
        let parts = if upright && shape.figure == Figure::Channel { &[0.5][..] } else { &[0.5, 0.25, 0.75] };
        for part in parts.iter().copied() {
            let at = match side {
                Side::Above | Side::Below => ((shape.x + shape.width * part).round(), middle(shape, side).1),
                _ => (middle(shape, side).0, (shape.y + shape.height * part).round()),
            };
            let extra = if side == usual { 0.0 } else { 20.0 } + if part == 0.5 { 0.0 } else { 6.0 };
            ports.push(Port { at, side, extra });
        }
    }
    ports
}

/// The ends of the whole.
fn bound(picture: &mut Picture) {
    let points =
        picture.lines.iter().flat_map(|line| line.points.iter().map(|point| (point.0, point.1, point.0, point.1)));
    let areas = picture.boxes.iter().map(area).chain(picture.labels.iter().map(of_label)).chain(points);
    let whole = areas.reduce(|a, b| (a.0.min(b.0), a.1.min(b.1), a.2.max(b.2), a.3.max(b.3))).unwrap_or_default();
    picture.left = (whole.0 - PADDING).floor();
    picture.top = (whole.1 - PADDING).floor();
    picture.width = (whole.2 + PADDING).ceil() - picture.left;
    picture.height = (whole.3 + PADDING).ceil() - picture.top;
}
