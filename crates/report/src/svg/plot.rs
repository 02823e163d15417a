//! What a closed loop did over time: the norm of the error by decades, and each joint beside its set-point.
//!
//! Times are in seconds. A line with more points than pixels shows each column's least and greatest.

use crate::markup::{Px, Text, put};
use crate::program::{ClosedLoop, Joint};
use crate::svg::scale::{Scale, label};
use crate::svg::text_width;

/// The frame of a plot: its size, and the room beside and below it.
struct Frame {
    width: f64,
    height: f64,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Frame {
    fn across(&self) -> (f64, f64) {
        (self.left, self.width - self.right)
    }

    fn upwards(&self) -> (f64, f64) {
        (self.height - self.bottom, self.top)
    }

    fn open(&self, out: &mut String, class: &str, title: &str) {
        put!(
            out,
            "<svg class=\"{class}\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\"><title>{}</title>\n",
            Text(title),
            w = Px(self.width),
            h = Px(self.height)
        );
    }

    /// Lines and labels of both scales; `x` ends with its unit.
    fn axes(&self, out: &mut String, x: &Scale, y: &Scale, (apart_x, apart_y): (f64, f64)) {
        let ((left, right), (base, top)) = (self.across(), self.upwards());
        let (mut lines, mut across, mut up) = (String::new(), String::new(), String::new());
        for value in y.ticks(apart_y) {
            put!(lines, "M{} {}H{}", Px(left), Px(y.place(value)), Px(right));
            put!(up, "<text x=\"{}\" y=\"{}\">{}</text>", Px(left - 7.0), Px(y.place(value) + 3.6), label(value));
        }
        let ticks = x.ticks(apart_x);
        for (index, value) in ticks.iter().enumerate() {
            put!(lines, "M{} {}V{}", Px(x.place(*value)), Px(top), Px(base + 4.0));
            let unit = if index + 1 == ticks.len() { "\u{202f}s" } else { "" };
            put!(
                across,
                "<text x=\"{}\" y=\"{}\">{}{unit}</text>",
                Px(x.place(*value)),
                Px(base + 17.0),
                label(*value)
            );
        }
        put!(out, "<path class=\"grid\" d=\"{lines}\"/>\n<g class=\"scale\">{up}</g><g class=\"ticks\">{across}</g>\n");
        put!(out, "<path class=\"base\" d=\"M{} {}H{}\"/>\n", Px(left), Px(base), Px(right));
    }
}

/// The end of a run in whole tenths of a second: its last cycle begins a little before.
fn rounded(end_s: f64) -> f64 {
    if end_s > 1.0 { (end_s * 10.0 - 1e-6).ceil() / 10.0 } else { end_s }
}

/// A line through points; a point without a value breaks it.
fn line(points: impl Iterator<Item = (f64, Option<f64>)>, x: &Scale, y: &Scale) -> String {
    let mut path = String::new();
    let mut column: Vec<(f64, f64)> = Vec::new();
    let mut joined = false;
    let flush = |path: &mut String, column: &mut Vec<(f64, f64)>, joined: &mut bool| {
        // For each column its first and last point, and its extremes, in their order.
        let by = |better: fn(f64, f64) -> bool| {
            (0..column.len()).reduce(|best, at| if better(column[at].1, column[best].1) { at } else { best })
        };
        let mut kept: Vec<usize> =
            [Some(0), by(|a, b| a < b), by(|a, b| a > b), column.len().checked_sub(1)].into_iter().flatten().collect();
        kept.sort_unstable();
        kept.dedup();
        for (at, y) in kept.into_iter().filter_map(|at| column.get(at)) {
            put!(path, "{}{} {}", if *joined { 'L' } else { 'M' }, Px(*at), Px(*y));
            *joined = true;
        }
        column.clear();
    };
    for (at, value) in points {
        let Some(value) = value else {
            flush(&mut path, &mut column, &mut joined);
            joined = false;
            continue;
        };
        let place = (x.place(at), y.place(value));
        if column.first().is_some_and(|first| first.0.floor() < place.0.floor()) {
            flush(&mut path, &mut column, &mut joined);
        }
        column.push(place);
    }
    flush(&mut path, &mut column, &mut joined);
    path
}

/// The norm of the error, by decades, with the goals and the bound below which a goal counts as reached.
pub(crate) fn error_norm(world: &ClosedLoop) -> String {
    let frame = Frame { width: 1120.0, height: 250.0, left: 52.0, right: 16.0, top: 24.0, bottom: 26.0 };
    let values = || world.error.iter().filter_map(|(_, error)| *error).filter(|error| *error > 0.0);
    let (least, most) = (values().fold(f64::MAX, f64::min), values().fold(0.0, f64::max));
    let decade = |value: f64, up: bool| {
        let power = value.max(1e-12).log10();
        10f64.powf(if up { power.ceil() } else { power.floor() })
    };
    let end = rounded(world.error.last().map_or(1.0, |(time, _)| *time));
    let x = Scale::linear((0.0, end), frame.across());
    let y = Scale::log((decade(least.min(most), false), decade(most, true)), frame.upwards());
    let mut out = String::new();
    frame.open(&mut out, "profile norm", "The norm of the features' error over time");
    frame.axes(&mut out, &x, &y, (90.0, 26.0));
    let (base, top) = frame.upwards();
    for (index, at) in world.goals_s.iter().enumerate() {
        let (x, words) = (x.place(*at), format!("goal {}", index + 1));
        put!(out, "<path class=\"event\" d=\"M{} {}V{}\"/>", Px(x), Px(top), Px(base));
        // Within the frame, also at its ends.
        let half = text_width(&words, 11.0) / 2.0 + 2.0;
        let middle = x.clamp(frame.left + half, frame.width - frame.right - half);
        put!(out, "<text class=\"eventlabel\" x=\"{}\" y=\"{}\">{words}</text>\n", Px(middle), Px(top - 8.0));
    }
    put!(out, "<path class=\"curve\" d=\"{}\"/>\n", line(world.error.iter().copied(), &x, &y));
    if let Some(bound) = world.bound {
        let (left, right) = frame.across();
        put!(out, "<path class=\"bound\" d=\"M{} {y}H{}\"/>\n", Px(left), Px(right), y = Px(y.place(bound)));
        put!(
            out,
            "<text class=\"boundlabel\" x=\"{}\" y=\"{}\">reached below {}</text>\n",
            Px(right - 4.0),
            Px(y.place(bound) - 6.0),
            label(bound)
        );
    }
    out.push_str("</svg>\n");
    out
}

/// A joint: where it should have been, and below that, paler and broader, where it was.
pub(crate) fn joint(joint: &Joint) -> String {
    let frame = Frame { width: 340.0, height: 140.0, left: 52.0, right: 14.0, top: 10.0, bottom: 26.0 };
    let values = || joint.set.iter().chain(&joint.measured).map(|(_, value)| *value);
    let (least, most) = (values().fold(f64::MAX, f64::min), values().fold(f64::MIN, f64::max));
    let room = ((most - least) * 0.06).max(1e-4);
    let end = rounded(joint.set.last().map_or(1.0, |(time, _)| *time));
    let x = Scale::linear((0.0, end), frame.across());
    let y = Scale::linear((least - room, most + room), frame.upwards());
    let mut out = String::new();
    frame.open(&mut out, "joint", &format!("{}: set-point and measured position over time", joint.name));
    frame.axes(&mut out, &x, &y, (50.0, 24.0));
    let path = |points: &[(f64, f64)]| line(points.iter().map(|(time, value)| (*time, Some(*value))), &x, &y);
    put!(out, "<path class=\"measured\" d=\"{}\"/>\n", path(&joint.measured));
    put!(out, "<path class=\"curve\" d=\"{}\"/>\n</svg>\n", path(&joint.set));
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_extremes_and_gaps() {
        let (x, y) = (Scale::linear((0.0, 10.0), (0.0, 10.0)), Scale::linear((0.0, 100.0), (100.0, 0.0)));
        let points = [(0.0, Some(0.0)), (0.2, Some(50.0)), (0.4, Some(20.0)), (0.6, Some(30.0)), (0.8, Some(25.0))];
        assert_eq!(line(points.into_iter(), &x, &y), "M0 100L0.2 50L0.8 75");
        let broken = [(0.0, Some(10.0)), (2.0, None), (4.0, Some(20.0)), (6.0, Some(30.0))];
        assert_eq!(line(broken.into_iter(), &x, &y), "M0 90M4 80L6 70");
    }

    #[test]
    fn an_error_that_is_never_known_is_drawn_as_none() {
        let world = ClosedLoop { error: vec![(0.0, None), (1.0, None)], ..ClosedLoop::default() };
        assert!(error_norm(&world).contains("<path class=\"curve\" d=\"\"/>"));
    }
}
