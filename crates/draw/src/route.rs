//! Orthogonal arrows around shapes that lie where they are.
//!
//! In: what is in the way, and for each wire the ports at which it may start and end. Out: the corners of each. A wire takes
//! the cheapest way over a grid of lines beside and between the shapes (Wybrow, Marriott, Stuckey, *Orthogonal Connector
//! Routing*, 2009, without its last step): length, corners, crossings, and running close to shapes or other wires all cost.
//! Wires to the same end may run together. When all lie, each is laid once more with the others known.
//!
//! There is always a way: through a shape where there is no other, at a price. LIMIT: costs are of whole eighths of pixels.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap;

/// Left, upper, right and lower end.
pub type Area = (f64, f64, f64, f64);

/// A side of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The upper one.
    Above,
    /// The right one.
    Right,
    /// The lower one.
    Below,
    /// The left one.
    Left,
}

impl Side {
    pub const ALL: [Side; 4] = [Side::Above, Side::Right, Side::Below, Side::Left];

    /// The way out there.
    pub fn out(self) -> (f64, f64) {
        match self {
            Side::Above => (0.0, -1.0),
            Side::Right => (1.0, 0.0),
            Side::Below => (0.0, 1.0),
            Side::Left => (-1.0, 0.0),
        }
    }

    fn opposite(self) -> Side {
        Side::ALL[(self as usize + 2) % 4]
    }
}

/// A place where a wire may meet a shape.
#[derive(Debug, Clone, Copy)]
pub struct Port {
    pub at: (f64, f64),
    pub side: Side,
    /// What it costs to use it, in pixels.
    pub extra: f64,
}

/// A wire to be laid.
#[derive(Debug, Clone)]
pub struct Wire {
    /// Wires with the same number may start together.
    pub from: usize,
    /// Wires with the same number may end together.
    pub to: usize,
    pub start: Vec<Port>,
    pub end: Vec<Port>,
}

// What costs how much, in eighths of a pixel; the lower four each pixel.
const UNIT: f64 = 8.0;
const CORNER: u64 = 36 * 8;
const CROSSING: u64 = 300 * 8;
const THROUGH: f64 = 20_000.0;
const BESIDE: f64 = 4.0;
const BORDER: f64 = 200.0;
const TOGETHER: u64 = 25;
const CLOSE: u64 = 6;

/// Lines keep this distance from shapes.
const CLEAR: f64 = 14.0;
/// So near to a shape a line is on its border.
const RIM: f64 = 2.0;
/// Nearer lines are close.
const TRACK: f64 = 8.0;
/// From so many shapes on the grid is coarser and ways are sought more greedily; each is laid once.
const LARGE: usize = 80;

/// The grid, what is in the way, and the wires as far as they lie.
pub struct Router<'w> {
    wires: &'w [Wire],
    /// The corners of wires that lie already.
    given: Vec<Option<Corners>>,
    large: bool,
    xs: Vec<f64>,
    ys: Vec<f64>,
    /// What a stretch of the grid costs by what it runs through or beside: level and upright in turn, by their left or
    /// upper node.
    base: Vec<u32>,
    /// The wires on a stretch, and whether they run on it or close to it.
    laid: FxHashMap<u32, Vec<(usize, bool)>>,
    /// The stretches that have ever been in `laid`.
    known: Vec<bool>,
}

/// The corners of a wire, from its start to its end.
pub type Corners = Vec<(f64, f64)>;

/// A node of the grid and the way in which it was come to.
type Spot = u32;

impl<'w> Router<'w> {
    /// The grid for these shapes and labels. The wires whose corners are `given` stay as they are.
    pub fn new(shapes: &[Area], labels: &[Area], wires: &'w [Wire], given: Vec<Option<Corners>>) -> Router<'w> {
        let corners: Vec<(f64, f64)> = given.iter().flatten().flatten().copied().collect();
        let ports = || wires.iter().flat_map(|wire| wire.start.iter().chain(&wire.end));
        let large = shapes.len() >= LARGE;
        let beside = |low: f64, high: f64, clear: f64| {
            (0..if large { 2 } else { 4 }).flat_map(move |track| {
                let off = clear + f64::from(track) * TRACK;
                [low - off, high + off]
            })
        };
        let tight = |low: f64, high: f64| [low - 4.0, high + 4.0];
        let xs = shapes.iter().flat_map(|s| beside(s.0, s.2, CLEAR)).chain(labels.iter().flat_map(|l| tight(l.0, l.2)));
        let ys = shapes.iter().flat_map(|s| beside(s.1, s.3, CLEAR)).chain(labels.iter().flat_map(|l| tight(l.1, l.3)));
        let apart = if large { TRACK - 1.0 } else { 3.0 };
        let xs = tracks(ports().map(|port| port.at.0).chain(corners.iter().map(|corner| corner.0)), xs, apart);
        let ys = tracks(ports().map(|port| port.at.1).chain(corners.iter().map(|corner| corner.1)), ys, apart);
        let base = vec![0; xs.len() * ys.len() * 2];
        let known = vec![false; base.len()];
        let mut router = Router { wires, given, large, xs, ys, base, laid: FxHashMap::default(), known };
        for shape in shapes {
            router.avoid(*shape, CLEAR - 1.0, BESIDE);
            router.avoid(*shape, RIM, BORDER);
            router.avoid(*shape, 0.0, THROUGH);
        }
        for label in labels {
            router.avoid(*label, 2.0, THROUGH / 4.0);
        }
        router
    }

    /// Each pixel in an area, with so much around it, costs more.
    fn avoid(&mut self, area: Area, around: f64, cost: f64) {
        let area = (area.0 - around, area.1 - around, area.2 + around, area.3 + around);
        let inner = |lines: &[f64], low: f64, high: f64| {
            lines.partition_point(|line| *line <= low)..lines.partition_point(|line| *line < high)
        };
        let outer = |lines: &[f64], low: f64, high: f64| {
            let inner = inner(lines, low, high);
            inner.start.saturating_sub(1)..inner.end.min(lines.len() - 1)
        };
        let part = |lines: &[f64], at: usize, low: f64, high: f64| {
            ((lines[at + 1].min(high) - lines[at].max(low)).max(0.0) * cost * UNIT) as u32
        };
        for j in inner(&self.ys, area.1, area.3) {
            for i in outer(&self.xs, area.0, area.2) {
                let stretch = &mut self.base[(j * self.xs.len() + i) * 2];
                *stretch = stretch.saturating_add(part(&self.xs, i, area.0, area.2));
            }
        }
        for i in inner(&self.xs, area.0, area.2) {
            for j in outer(&self.ys, area.1, area.3) {
                let stretch = &mut self.base[(j * self.xs.len() + i) * 2 + 1];
                *stretch = stretch.saturating_add(part(&self.ys, j, area.1, area.3));
            }
        }
    }

    /// The corners of each wire, from its start to its end.
    pub fn routes(mut self) -> Vec<Corners> {
        let mut order: Vec<usize> = (0..self.wires.len()).filter(|index| self.given[*index].is_none()).collect();
        let reach = |wire: &Wire| match (wire.start.first(), wire.end.first()) {
            (Some(a), Some(b)) => ((a.at.0 - b.at.0).abs() + (a.at.1 - b.at.1).abs()) as u64,
            _ => 0,
        };
        order.sort_by_key(|index| reach(&self.wires[*index]));
        let mut ways: Vec<Vec<Spot>> = vec![Vec::new(); self.wires.len()];
        for index in 0..self.wires.len() {
            if let Some(corners) = &self.given[index] {
                let way = self.along(corners);
                self.lay(index, &way, true);
            }
        }
        for round in 0..if self.large { 1 } else { 2 } {
            for &index in &order {
                if round > 0 {
                    self.lay(index, &ways[index], false);
                }
                ways[index] = self.way(index);
                self.lay(index, &ways[index], true);
            }
        }
        let given = std::mem::take(&mut self.given);
        let way = |(way, given): (&Vec<Spot>, Option<Corners>)| {
            given.unwrap_or_else(|| way.iter().map(|spot| self.point(*spot)).collect())
        };
        ways.iter().zip(given).map(way).collect()
    }

    /// The nodes of the grid on a wire with these corners, all of which are nodes.
    fn along(&self, corners: &[(f64, f64)]) -> Vec<Spot> {
        let mut way = Vec::new();
        for pair in corners.windows(2) {
            let (from, to) = (self.nearest(pair[0]), self.nearest(pair[1]));
            let side = match (from.0.cmp(&to.0), from.1.cmp(&to.1)) {
                (Ordering::Less, _) => Side::Right,
                (Ordering::Greater, _) => Side::Left,
                (_, Ordering::Less) => Side::Below,
                (_, Ordering::Greater) => Side::Above,
                _ => continue,
            };
            let (mut node, mut steps) = (from, from.0.abs_diff(to.0).max(from.1.abs_diff(to.1)));
            way.push(self.spot(node, side));
            while let (true, Some((next, ..))) = (steps > 0, self.next(node, side)) {
                (node, steps) = (next, steps - 1);
                way.push(self.spot(node, side));
            }
        }
        way
    }

    fn nearest(&self, (x, y): (f64, f64)) -> (usize, usize) {
        let index = |lines: &[f64], at: f64| lines.partition_point(|line| *line < at).min(lines.len() - 1);
        (index(&self.xs, x), index(&self.ys, y))
    }

    fn node(&self, spot: Spot) -> (usize, usize) {
        let node = spot as usize / 4;
        (node % self.xs.len(), node / self.xs.len())
    }

    fn point(&self, spot: Spot) -> (f64, f64) {
        let (i, j) = self.node(spot);
        (self.xs[i], self.ys[j])
    }

    fn spot(&self, (i, j): (usize, usize), way: Side) -> Spot {
        ((j * self.xs.len() + i) * 4 + way as usize) as Spot
    }

    fn at(&self, port: &Port) -> (usize, usize) {
        self.nearest(port.at)
    }

    /// The next node in a direction, the stretch to it and its length.
    fn next(&self, (i, j): (usize, usize), way: Side) -> Option<((usize, usize), u32, f64)> {
        let stretch = |i: usize, j: usize, upright: usize| ((j * self.xs.len() + i) * 2 + upright) as u32;
        match way {
            Side::Above if j > 0 => Some(((i, j - 1), stretch(i, j - 1, 1), self.ys[j] - self.ys[j - 1])),
            Side::Left if i > 0 => Some(((i - 1, j), stretch(i - 1, j, 0), self.xs[i] - self.xs[i - 1])),
            Side::Below if j + 1 < self.ys.len() => Some(((i, j + 1), stretch(i, j, 1), self.ys[j + 1] - self.ys[j])),
            Side::Right if i + 1 < self.xs.len() => Some(((i + 1, j), stretch(i, j, 0), self.xs[i + 1] - self.xs[i])),
            _ => None,
        }
    }

    /// Two wires may run together.
    fn kin(&self, a: usize, b: usize) -> bool {
        self.wires[a].to == self.wires[b].to || self.wires[a].from == self.wires[b].from
    }

    /// Wires that are not kin of this one run on a stretch, or close to it.
    fn strangers(&self, wire: usize, stretch: u32) -> (bool, bool) {
        if !self.known[stretch as usize] {
            return (false, false);
        }
        let laid = self.laid.get(&stretch).map(Vec::as_slice).unwrap_or_default();
        let found = |on: bool| laid.iter().any(|(other, is_on)| *is_on == on && !self.kin(wire, *other));
        (found(true), found(false))
    }

    fn cost(&self, wire: usize, to: (usize, usize), stretch: u32, length: f64, way: Side) -> u64 {
        let length = (length * UNIT).ceil() as u64;
        let (on, close) = self.strangers(wire, stretch);
        let beside = if on {
            TOGETHER * length
        } else if close {
            CLOSE * length
        } else {
            0
        };
        let across = match way {
            Side::Above | Side::Below => [Side::Left, Side::Right],
            _ => [Side::Above, Side::Below],
        };
        let crosses =
            across.into_iter().filter_map(|way| self.next(to, way)).any(|(_, side, _)| self.strangers(wire, side).0);
        length + u64::from(self.base[stretch as usize]) + beside + if crosses { CROSSING } else { 0 }
    }

    /// The cheapest way of a wire.
    fn way(&self, wire: usize) -> Vec<Spot> {
        const GOAL: Spot = Spot::MAX;
        let Wire { start, end, .. } = &self.wires[wire];
        let goals: Vec<(Spot, u64)> = end
            .iter()
            .map(|port| (self.spot(self.at(port), port.side.opposite()), (port.extra * UNIT) as u64))
            .collect();
        let rest = |spot: Spot| {
            let (x, y) = self.point(spot);
            let to = |port: &Port| (port.at.0 - x).abs() + (port.at.1 - y).abs();
            let rest = (end.iter().map(to).fold(f64::INFINITY, f64::min) * UNIT) as u64;
            // Every wire crosses the border of its end at last.
            let last = ((RIM * BORDER + (CLEAR - 1.0) * BESIDE) * UNIT) as u64;
            last + if self.large { rest + rest / 2 } else { rest }
        };
        let mut best: FxHashMap<Spot, (u64, Spot)> = FxHashMap::default();
        let mut open = BinaryHeap::new();
        for port in start {
            let spot = self.spot(self.at(port), port.side);
            let cost = (port.extra * UNIT) as u64;
            best.insert(spot, (cost, spot));
            open.push(Reverse((cost + rest(spot), rest(spot), spot, cost)));
        }
        while let Some(Reverse((_, _, spot, cost))) = open.pop() {
            if spot == GOAL {
                break;
            }
            let (known, before) = best[&spot];
            if known < cost {
                continue;
            }
            let mut reach = |spot: Spot, to: Spot, cost: u64, rest: u64| {
                if best.get(&to).is_none_or(|(known, _)| cost < *known) {
                    best.insert(to, (cost, spot));
                    open.push(Reverse((cost + rest, rest, to, cost)));
                }
            };
            if before != spot
                && let Some((_, extra)) = goals.iter().find(|(goal, _)| *goal == spot)
            {
                reach(spot, GOAL, cost + extra, 0);
            }
            let node = self.node(spot);
            let came = Side::ALL[spot as usize % 4];
            for way in Side::ALL {
                // A wire leaves its shape straight.
                if way == came.opposite() || (before == spot && way != came) {
                    continue;
                }
                let Some((to, stretch, length)) = self.next(node, way) else { continue };
                let corner = if way == came { 0 } else { CORNER };
                let cost = cost + corner + self.cost(wire, to, stretch, length, way);
                let next = self.spot(to, way);
                reach(spot, next, cost, rest(next));
            }
        }
        let Some((_, last)) = best.get(&GOAL) else { return Vec::new() };
        let mut way = vec![*last];
        while let Some(spot) = way.last().copied() {
            let (_, before) = best[&spot];
            if before == spot {
                break;
            }
            way.push(before);
        }
        way.reverse();
        way
    }

    /// Notes where a wire runs, or takes it away.
    fn lay(&mut self, wire: usize, way: &[Spot], here: bool) {
        for pair in way.windows(2) {
            let (a, b) = (self.node(pair[0]), self.node(pair[1]));
            let (i, j) = (a.0.min(b.0), a.1.min(b.1));
            let upright = usize::from(a.0 == b.0);
            let (lines, own) = if upright == 1 { (&self.xs, i) } else { (&self.ys, j) };
            let first = lines.partition_point(|line| *line <= lines[own] - TRACK);
            let last = lines.partition_point(|line| *line < lines[own] + TRACK);
            for near in first..last {
                let (i, j) = if upright == 1 { (near, j) } else { (i, near) };
                let stretch = ((j * self.xs.len() + i) * 2 + upright) as u32;
                self.known[stretch as usize] = true;
                let laid = self.laid.entry(stretch).or_default();
                let entry = (wire, near == own);
                if here {
                    laid.push(entry);
                } else if let Some(at) = laid.iter().position(|known| *known == entry) {
                    laid.swap_remove(at);
                }
            }
        }
    }
}

/// The lines of a grid: through all ports, and others as far as they are not too close.
fn tracks(ports: impl Iterator<Item = f64>, others: impl Iterator<Item = f64>, apart: f64) -> Vec<f64> {
    let mut lines: Vec<f64> = ports.collect();
    lines.sort_by(f64::total_cmp);
    lines.dedup();
    let mut others: Vec<f64> = others.map(f64::round).collect();
    others.sort_by(f64::total_cmp);
    let mut all = Vec::with_capacity(lines.len() + others.len());
    let mut ports = lines.iter().copied().peekable();
    for other in others {
        while let Some(port) = ports.next_if(|port| *port <= other) {
            all.push(port);
        }
        let room = |near: Option<&f64>| near.is_none_or(|near: &f64| (near - other).abs() >= apart);
        if room(all.last()) && room(ports.peek()) {
            all.push(other);
        }
    }
    all.extend(ports);
    all
}
