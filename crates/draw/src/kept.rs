//! What still holds of the arrangement that a chart has without places, where some or all of its shapes have one.
//!
//! In: a scene, the picture that ELK makes of it, and where its shapes lie. Out: which shapes lie where ELK has them, seen from each other,
//! and which of its arrows can stay: those between such shapes that run into nothing that lies elsewhere. So a chart whose places were
//! written by `chart place` is drawn as it was, and a shape that is moved takes along its own arrows alone.

use std::collections::BTreeMap;

use crate::picture::{Figure, Label, Line, Picture, Placed};
use crate::route::{Corners, Side};
use crate::scene::Scene;

/// So far a place may be from where ELK has the shape: places are written in whole pixels.
const NEAR: f64 = 0.51;
/// So far arrows that stay keep from what lies elsewhere.
const CLEAR: f64 = 6.0;

/// What stays.
#[derive(Debug)]
pub struct Kept {
    /// ELK's picture, moved to where the shapes are.
    ideal: Picture,
    /// The shapes that lie there.
    stays: Vec<bool>,
}

impl Kept {
    /// Compares an arrangement with the one of ELK.
    pub fn new(scene: &Scene, mut ideal: Picture, centres: &[(f64, f64)]) -> Kept {
        let centre = |shape: &Placed| (shape.x + shape.width / 2.0, shape.y + shape.height / 2.0);
        // Most shapes say by how far the whole was moved.
        let mut moved: BTreeMap<(i64, i64), usize> = BTreeMap::new();
        let single = |index: &usize| scene.nodes[*index].figure != Figure::Composite;
        for index in (0..scene.nodes.len()).filter(single).filter(|index| scene.nodes[*index].place.is_some()) {
            let (ideal, own) = (centre(&ideal.boxes[index]), centres[index]);
            // By whole pixels, since `chart place` rounds each centre.
            *moved.entry(((own.0 - ideal.0.round()) as i64, (own.1 - ideal.1.round()) as i64)).or_insert(0) += 1;
        }
        let most = moved.iter().max_by_key(|(by, count)| (**count, std::cmp::Reverse(by.0.abs() + by.1.abs())));
        let (x, y) = most.map_or((0.0, 0.0), |((x, y), _)| (*x as f64, *y as f64));
        ideal.boxes.iter_mut().for_each(|shape| (shape.x, shape.y) = (shape.x + x, shape.y + y));
        ideal.labels.iter_mut().for_each(|label| (label.x, label.y) = (label.x + x, label.y + y));
        let points = ideal.lines.iter_mut().flat_map(|line| &mut line.points);
        points.for_each(|point| *point = (point.0 + x, point.1 + y));
        (ideal.left, ideal.top) = (ideal.left + x, ideal.top + y);
        let near = |index: usize| {
            let ideal = centre(&ideal.boxes[index]);
            (ideal.0 - centres[index].0).abs() <= NEAR && (ideal.1 - centres[index].1).abs() <= NEAR
        };
        let mut stays: Vec<bool> = (0..scene.nodes.len()).map(|index| !single(&index) || near(index)).collect();
        // A composite state stays if all in it does; inner ones come later in the order of reading.
        for index in (0..scene.nodes.len()).rev() {
            if !stays[index]
                && let Some(outer) = scene.nodes[index].inside
            {
                stays[outer] = false;
            }
        }
        Kept { ideal, stays }
    }

    /// Nothing stays.
    pub fn nothing(scene: &Scene) -> Kept {
        Kept { ideal: Picture::default(), stays: vec![false; scene.nodes.len()] }
    }

    /// ELK's picture with each shape exactly at its place, if all shapes stay and their arrows can follow.
    pub fn whole(&self, boxes: &[Placed]) -> Option<Picture> {
        if self.stays.iter().any(|stays| !stays) {
            return None;
        }
        let lines: Option<Vec<Line>> = (0..self.ideal.lines.len()).map(|edge| self.snapped(edge, boxes)).collect();
        let mut picture = Picture { lines: lines?, ..self.ideal.clone() };
        for (index, shape) in boxes.iter().enumerate() {
            let by = self.off(index, boxes);
            picture.labels.iter_mut().filter(|label| label.of == index).for_each(|label| shift(label, by));
            if shape.figure != Figure::Composite {
                picture.boxes[index] = shape.clone();
            }
        }
        Some(picture)
    }

    /// The frame of a composite state that stays.
    pub fn frame(&self, index: usize) -> Option<&Placed> {
        self.stays[index].then(|| &self.ideal.boxes[index])
    }

    /// For each of so many arrows its way, if it stays.
    pub fn ways(&self, edges: usize, boxes: &[Placed]) -> Vec<Option<Corners>> {
        let elsewhere: Vec<&Placed> =
            boxes.iter().zip(&self.stays).filter(|(_, stays)| !**stays).map(|(shape, _)| shape).collect();
        let free = |points: &[(f64, f64)]| {
            points.windows(2).all(|pair| {
                let (left, right) = (pair[0].0.min(pair[1].0) - CLEAR, pair[0].0.max(pair[1].0) + CLEAR);
                let (upper, lower) = (pair[0].1.min(pair[1].1) - CLEAR, pair[0].1.max(pair[1].1) + CLEAR);
                elsewhere.iter().all(|shape| {
                    left >= shape.x + shape.width
                        || right <= shape.x
                        || upper >= shape.y + shape.height
                        || lower <= shape.y
                })
            })
        };
        let way = |(edge, line): (usize, &Line)| {
            let both = self.stays[line.from] && self.stays[line.to];
            let way = both.then(|| self.snapped(edge, boxes)).flatten()?;
            free(&way.points).then_some(way.points)
        };
        let mut ways: Vec<Option<Corners>> = self.ideal.lines.iter().enumerate().map(way).collect();
        ways.resize(edges, None);
        ways
    }

    /// How far a shape is from where ELK has it: less than a pixel, if it stays.
    fn off(&self, index: usize, boxes: &[Placed]) -> (f64, f64) {
        match boxes[index].figure {
            Figure::Composite => (0.0, 0.0),
            _ => (boxes[index].x - self.ideal.boxes[index].x, boxes[index].y - self.ideal.boxes[index].y),
        }
    }

    /// An arrow with its ends at the very places of its shapes; none if it were not straight then.
    fn snapped(&self, edge: usize, boxes: &[Placed]) -> Option<Line> {
        let mut line = self.ideal.lines[edge].clone();
        let (start, end) = (self.off(line.from, boxes), self.off(line.to, boxes));
        let points = &mut line.points;
        let last = points.len().checked_sub(1).filter(|last| *last > 0)?;
        let upright = |points: &[(f64, f64)], at: usize| points[at].0 == points[at + 1].0;
        let (first_upright, last_upright) = (upright(points, 0), upright(points, last - 1));
        if last == 1 && (if first_upright { start.0 != end.0 } else { start.1 != end.1 }) {
            return None;
        }
        points[0] = (points[0].0 + start.0, points[0].1 + start.1);
        points[last] = (points[last].0 + end.0, points[last].1 + end.1);
        if last > 1 {
            if first_upright {
                points[1].0 += start.0
            } else {
                points[1].1 += start.1
            }
            if last_upright { points[last - 1].0 += end.0 } else { points[last - 1].1 += end.1 }
        }
        Some(line)
    }

    /// The side at which ELK lets a branch of a guard leave.
    pub fn exit(&self, guard: usize, branch: bool) -> Side {
        let own = |line: &&Line| line.from == guard && line.branch == Some(branch);
        match self.ideal.lines.iter().find(own).map(|line| line.points.as_slice()) {
            Some([from, to, ..]) if from.0 > to.0 => Side::Left,
            Some([from, to, ..]) if from.0 < to.0 => Side::Right,
            _ => Side::Below,
        }
    }

    /// The label that ELK gives to the link of a shape that stays, if nothing that lies elsewhere is in its way.
    pub fn link(&self, of: usize, boxes: &[Placed]) -> Option<Label> {
        let mut label = self.ideal.labels.iter().find(|label| label.of == of && label.is_link)?.clone();
        shift(&mut label, self.off(of, boxes));
        let meets = |shape: &Placed| {
            label.x < shape.x + shape.width
                && shape.x < label.x + label.width
                && label.y < shape.y + shape.height
                && shape.y < label.y + label.height
        };
        let in_the_way = boxes.iter().zip(&self.stays).any(|(shape, stays)| !stays && meets(shape));
        (self.stays[of] && !in_the_way).then_some(label)
    }
}

fn shift(label: &mut Label, by: (f64, f64)) {
    (label.x, label.y) = (label.x + by.0, label.y + by.1);
}
